// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/velodyne_models.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::uint16_t kVelodyneBlockFlag = 0xEEFF;
constexpr std::uint8_t kStrongest = 0x37, kLast = 0x38, kDual = 0x39;
// Of packets that were lost one after the other. A C16 of LSLidar keeps 1,200 us: within four packets no multiple of
// that comes near one of a Velodyne's times.
constexpr double kPacketsBetween = 4.0;

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
    case 0x10:
      return "an LSLidar C16";
    case 0x20:
      return "an LSLidar C32";
    case 0x23:
      return "a Velodyne VLP-32A or B";
    case 0x31:
      return "a Velodyne Velarray";
    case 0x63:
    case 0xA1:
      return "a Velodyne VLS-128";
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

// What the times between packets say.
struct Clock {
  std::vector<std::uint32_t> gaps_us;  // none: there is one packet, or the clock stands still
  std::uint32_t shortest_us = 0;       // where packets were lost other gaps are longer
  bool is_dual = false;

  bool is_silent() const { return gaps_us.empty(); }
  // Pucks of both kinds keep the same time.
  bool fits(const VelodyneTraits& traits) const {
    const double wanted_us = traits.packet_us(is_dual);
    return std::fabs(shortest_us - wanted_us) <= 0.01 * wanted_us;
  }
  std::string who() const {
    std::string who;
    for (const VelodyneTraits& traits : all_traits()) {
      if (fits(traits)) who += (who.empty() ? "" : " or ") + std::string(traits.title());
    }
    return who;
  }
  // By which it may be named.
  std::string words_with(const VelodyneTraits& told) const {
    std::string words = told.word;
    for (const VelodyneTraits& traits : all_traits()) {
      if (&traits != &told && fits(traits)) words += std::string(", ") + traits.word;
    }
    return words;
  }
  // With packets lost between any two, where no other Velodyne's time is seen.
  bool confirms(const VelodyneTraits& traits) const {
    if (contradicts(traits)) return false;
    return fits(traits) || std::any_of(gaps_us.begin(), gaps_us.end(), [&](std::uint32_t gap_us) {
             return gap_us / traits.packet_us(is_dual) <= kPacketsBetween + 0.5;
           });
  }
  // It runs, and as another one's or as no Velodyne's.
  bool contradicts(const VelodyneTraits& traits) const {
    if (fits(traits) || !who().empty()) return !fits(traits);
    return std::any_of(gaps_us.begin(), gaps_us.end(), [&](std::uint32_t gap_us) {
      const double packets = gap_us / traits.packet_us(is_dual);
      return packets <= kPacketsBetween + 0.5 && std::fabs(packets - std::round(packets)) > 0.01 * packets;
    });
  }
};

Clock clock_of(const std::vector<ByteView>& packets) {
  Clock clock;
  clock.is_dual = is_velodyne_dual(packets.front());
  for (std::size_t i = 1; i < packets.size(); ++i) {
    const std::int64_t went_us = velodyne_clock_us(packets[i]) - velodyne_clock_us(packets[i - 1]);
    const auto gap_us = static_cast<std::uint32_t>(went_us < 0 ? went_us + kVelodyneHour_us : went_us);
    if (gap_us == 0) continue;
    clock.gaps_us.push_back(gap_us);
    if (clock.shortest_us == 0 || gap_us < clock.shortest_us) clock.shortest_us = gap_us;
  }
  return clock;
}

std::string clock_says(const Clock& clock) {
  const std::string who = clock.who();
  if (who.empty()) return say("their clock ({} us a packet) is no Velodyne's", clock.shortest_us);
  return say("their clock ({} us a packet) says {}", clock.shortest_us, who);
}

std::string product_says(std::uint8_t product, const VelodyneTraits& traits) {
  return say("their product byte (0x{:02x}) says {}", product, traits.title());
}

VelodyneModel with_stated(const VelodyneTraits& stated, std::uint8_t product, const Clock& clock) {
  if (const char* const other = stranger(product)) {
    throw FrameError(say("the sensor is said to be a {} ({}), but its packets are of {} (0x{:02x})", stated.title(),
                         stated.word, other, product));
  }
  const VelodyneTraits* const told = model_of_product(product);
  const bool clock_tells = !clock.who().empty();
  const bool clock_differs = clock_tells && !clock.fits(stated);
  // First Pucks say 0x21: then what was stated decides, if the clock says it too.
  const bool told_differs = told != nullptr && told != &stated && (!clock_tells || clock.fits(*told));
  if (told_differs || clock_differs) {
    throw FrameError(say("the sensor is said to be a {} ({}), but of its packets {}", stated.title(), stated.word,
                         told_differs ? product_says(product, *told) : clock_says(clock)));
  }
  // A name alone is no proof: other makers' packets are laid out as these, in another unit.
  if (told != &stated && !clock.confirms(stated)) {
    throw FrameError(say(
        "the sensor is said to be a {} ({}), but nothing in its packets confirms it: their product byte "
        "(0x{:02x}) is no Velodyne's, and {}; sensors of LSLidar and others send packets of this "
        "layout in another unit",
        stated.title(), stated.word, product, clock.is_silent() ? tr("their clock stands still") : clock_says(clock)));
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

std::int64_t velodyne_clock_us(ByteView payload) {
  return little_endian_at(payload, kVelodyneBytes - 6, 4);
}

std::uint8_t velodyne_product(ByteView payload) {
  return std::to_integer<std::uint8_t>(payload.data[kVelodyneBytes - 1]);
}

VelodyneModel identify_velodyne(const std::vector<ByteView>& packets, std::optional<VelodyneModel> stated) {
  const std::uint8_t product = velodyne_product(packets.front());
  const Clock clock = clock_of(packets);
  if (stated) return with_stated(velodyne_traits(*stated), product, clock);
  if (const VelodyneTraits* const told = model_of_product(product)) {
    if (!clock.contradicts(*told)) return told->model;
    const std::string words = clock.words_with(*told);
    throw FrameError(
        clock.who().empty()
            ? say("the packets contradict themselves: {}, {}; sensors of LSLidar and others send such "
                  "packets in another unit, which would scale all distances. If it is that one, name it: {}",
                  product_says(product, *told), clock_says(clock), words)
            : say("the packets contradict themselves: {}, {}; name it as its type plate does: {}",
                  product_says(product, *told), clock_says(clock), words));
  }
  if (const char* const other = stranger(product)) {
    throw FrameError(say("packets of {} (product byte 0x{:02x}) are not read", other, product));
  }
  // A Puck Hi-Res came when packets had long named their sensor.
  for (const VelodyneTraits& traits : all_traits()) {
    if (clock.fits(traits)) return traits.model;
  }
  throw FrameError(
      say("packets laid out as a Velodyne's, but neither their product byte (0x{:02x}) nor their clock "
          "tells which; sensors of LSLidar and others send such packets in another unit",
          product));
}

}  // namespace pose_wall::tools
