// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "packets/velodyne_models.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::uint16_t kVelodyneBlockFlag = 0xEEFF;
constexpr std::uint8_t kStrongest = 0x37, kLast = 0x38, kDual = 0x39;
constexpr std::uint32_t kHour_us = 3'600'000'000U;

const std::array<VelodyneTraits, 4>& all_traits() {
  static const std::array<VelodyneTraits, 4> traits = {
      {{VelodyneModel::kVlp16, "vlp16", 0x22, velodyne_vlp16()},
       {VelodyneModel::kVlp16HiRes, "vlp16_hires", 0x24, velodyne_vlp16_hires()},
       {VelodyneModel::kHdl32e, "hdl32e", 0x21, velodyne_hdl32e()},
       {VelodyneModel::kVlp32c, "vlp32c", 0x28, velodyne_vlp32c()}}};
  return traits;
}

std::uint16_t azimuth_at(ByteView payload, std::size_t block) {
  return static_cast<std::uint16_t>(little_endian_at(payload, block * kVelodyneBlockBytes + 2, 2));
}

std::uint8_t mode_of(ByteView payload) {
  return std::to_integer<std::uint8_t>(payload.data[kVelodyneBytes - 2]);
}

// Whose packets are known, and are not read.
const char* stranger(std::uint8_t product) {
  switch (product) {
    case 0x23:
      return "VLP-32A or B";
    case 0x31:
      return "Velarray";
    case 0x63:
    case 0xA1:
      return "VLS-128";
    default:
      return nullptr;
  }
}

const VelodyneTraits* model_of_product(std::uint8_t product) {
  for (const VelodyneTraits& traits : all_traits()) {
    if (traits.product == product) return &traits;
  }
  return nullptr;
}

struct Clock {
  std::uint32_t packet_us = 0;  // 0: it does not tell
  bool is_dual = false;

  // Pucks of both kinds keep the same time.
  bool fits(const VelodyneTraits& traits) const {
    const double wanted_us = traits.packet_us(is_dual);
    return std::fabs(packet_us - wanted_us) <= 0.01 * wanted_us;
  }
  std::string who() const {
    std::string who;
    for (const VelodyneTraits& traits : all_traits()) {
      if (fits(traits)) who += (who.empty() ? "" : " or ") + std::string(traits.title());
    }
    return who;
  }
};

// The shortest time between two packets: where some were lost others are longer.
Clock clock_of(const std::vector<ByteView>& packets) {
  Clock clock;
  clock.is_dual = is_velodyne_dual(packets.front());
  for (std::size_t i = 1; i < packets.size(); ++i) {
    const std::uint32_t before_us = little_endian_at(packets[i - 1], kVelodyneBytes - 6, 4);
    const std::uint32_t now_us = little_endian_at(packets[i], kVelodyneBytes - 6, 4);
    const std::uint32_t gap_us = now_us >= before_us ? now_us - before_us : now_us + kHour_us - before_us;
    if (gap_us > 0 && (clock.packet_us == 0 || gap_us < clock.packet_us)) clock.packet_us = gap_us;
  }
  if (clock.who().empty()) clock.packet_us = 0;
  return clock;
}

std::string clock_says(const Clock& clock) {
  return say("their clock ({} us a packet) says {}", clock.packet_us, clock.who());
}

std::string product_says(std::uint8_t product, const VelodyneTraits& traits) {
  return say("their product byte (0x{:02x}) says {}", product, traits.title());
}

VelodyneModel with_stated(const VelodyneTraits& stated, std::uint8_t product, const Clock& clock) {
  const VelodyneTraits* const told = model_of_product(product);
  const bool clock_differs = clock.packet_us != 0 && !clock.fits(stated);
  // First Pucks say 0x21: then what was stated decides, if the clock says it too.
  const bool told_differs = told != nullptr && told != &stated && (clock.packet_us == 0 || clock.fits(*told));
  if (told_differs || clock_differs) {
    throw FrameError(say("the sensor is said to be a {} ({}), but of its packets {}", stated.title(), stated.word,
                         told_differs ? product_says(product, *told) : clock_says(clock)));
  }
  if (const char* const other = stranger(product)) {
    throw FrameError(say("the sensor is said to be a {} ({}), but its packets are of a Velodyne {} (0x{:02x})",
                         stated.title(), stated.word, other, product));
  }
  return stated.model;
}

}  // namespace

double VelodyneTraits::packet_us(bool is_dual) const {
  const std::size_t firings = kVelodyneBlocks / (is_dual ? 2U : 1U) * firings_per_block();
  return 1e-3 * beams.cycle_ns * static_cast<double>(firings);
}

const VelodyneTraits& velodyne_traits(VelodyneModel model) {
  return all_traits()[static_cast<std::size_t>(model)];
}

bool is_velodyne_data(ByteView payload) {
  if (payload.size != kVelodyneBytes) return false;
  for (std::size_t block = 0; block < kVelodyneBlocks; ++block) {
    if (little_endian_at(payload, block * kVelodyneBlockBytes, 2) != kVelodyneBlockFlag) return false;
    if (azimuth_at(payload, block) >= 36000) return false;
  }
  return true;
}

// Before firmware 3.0.29 the mode is not said: then pairs of blocks share an azimuth while the head turns.
bool is_velodyne_dual(ByteView payload) {
  const std::uint8_t mode = mode_of(payload);
  if (mode == kDual || mode == kStrongest || mode == kLast) return mode == kDual;
  for (std::size_t block = 0; block < kVelodyneBlocks; block += 2) {
    if (azimuth_at(payload, block) != azimuth_at(payload, block + 1)) return false;
    if (block > 0 && azimuth_at(payload, block) == azimuth_at(payload, block - 1)) return false;
  }
  return true;
}

std::uint8_t velodyne_product(ByteView payload) {
  return std::to_integer<std::uint8_t>(payload.data[kVelodyneBytes - 1]);
}

VelodyneModel identify_velodyne(const std::vector<ByteView>& packets, std::optional<VelodyneModel> stated) {
  const std::uint8_t product = velodyne_product(packets.front());
  const Clock clock = clock_of(packets);
  if (stated) return with_stated(velodyne_traits(*stated), product, clock);
  if (const VelodyneTraits* const told = model_of_product(product)) {
    if (clock.packet_us == 0 || clock.fits(*told)) return told->model;
    throw FrameError(say("the packets contradict themselves: {}, {}; name the sensor that it is",
                         product_says(product, *told), clock_says(clock)));
  }
  if (const char* const other = stranger(product)) {
    throw FrameError(say("packets of a Velodyne {} (product byte 0x{:02x}) are not read", other, product));
  }
  std::vector<const VelodyneTraits*> fitting;
  for (const VelodyneTraits& traits : all_traits()) {
    if (clock.packet_us != 0 && clock.fits(traits)) fitting.push_back(&traits);
  }
  // A Puck Hi-Res came when packets had long named their sensor.
  if (!fitting.empty()) return fitting.front()->model;
  throw FrameError(
      say("packets of a Velodyne, but neither their product byte (0x{:02x}) nor their clock tells which; name "
          "the sensor that it is",
          product));
}

}  // namespace pose_wall::tools
