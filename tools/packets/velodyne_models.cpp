// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "packets/velodyne_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::uint16_t kVelodyneBlockFlag = 0xEEFF;
constexpr std::uint8_t kStrongest = 0x37, kLast = 0x38, kDual = 0x39;
constexpr std::uint32_t kHour_us = 3'600'000'000U;

// Elevation and height of each laser: VLP-16 user manual, 63-9243.
constexpr std::array<std::array<double, 2>, 16> kPuck = {{{-15, 0.0112},
                                                          {1, -0.0007},
                                                          {-13, 0.0097},
                                                          {3, -0.0022},
                                                          {-11, 0.0081},
                                                          {5, -0.0037},
                                                          {-9, 0.0066},
                                                          {7, -0.0051},
                                                          {-7, 0.0051},
                                                          {9, -0.0066},
                                                          {-5, 0.0037},
                                                          {11, -0.0081},
                                                          {-3, 0.0022},
                                                          {13, -0.0097},
                                                          {-1, 0.0007},
                                                          {15, -0.0112}}};
constexpr double kHiResStep = 2.0 / 3.0;  // of 1 degree between the lasers of a Puck: 1.33 of 2

// HDL-32E user manual, 63-9113; the same figures stand in 32db.yaml of ros-drivers/velodyne.
constexpr std::array<double, 32> kHdl32e_deg = {-30.67, -9.33, -29.33, -8.00, -28.00, -6.67, -26.67, -5.33,
                                                -25.33, -4.00, -24.00, -2.67, -22.67, -1.33, -21.33, 0.00,
                                                -20.00, 1.33,  -18.67, 2.67,  -17.33, 4.00,  -16.00, 5.33,
                                                -14.67, 6.67,  -13.33, 8.00,  -12.00, 9.33,  -10.67, 10.67};

// Elevation and azimuth of each laser: VLP-32C user manual, 63-9325; VeloView-VLP-32C.yaml of ros-drivers/velodyne has
// the same figures, its azimuths with the other sign.
constexpr std::array<std::array<double, 2>, 32> kVlp32c = {
    {{-25, 1.4},     {-1, -4.2},    {-1.667, 1.4},  {-15.639, -1.4}, {-11.31, 1.4},  {0, -1.4},      {-0.667, 4.2},
     {-8.843, -1.4}, {-7.254, 1.4}, {0.333, -4.2},  {-0.333, 1.4},   {-6.148, -1.4}, {-5.333, 4.2},  {1.333, -1.4},
     {0.667, 4.2},   {-4, -1.4},    {-4.667, 1.4},  {1.667, -4.2},   {1, 1.4},       {-3.667, -4.2}, {-3.333, 4.2},
     {3.333, -1.4},  {2.333, 1.4},  {-2.667, -1.4}, {-3, 1.4},       {7, -1.4},      {4.667, 1.4},   {-2.333, -4.2},
     {-2, 4.2},      {15, -1.4},    {10.333, 1.4},  {-1.333, -1.4}}};

void number_rings(VelodyneTraits& traits) {
  for (std::size_t i = 0; i < traits.lasers; ++i) {
    const double elevation_deg = traits.laser[i].elevation_deg;
    traits.laser[i].ring = static_cast<std::uint16_t>(
        std::count_if(traits.laser.begin(), traits.laser.begin() + static_cast<std::ptrdiff_t>(traits.lasers),
                      [&](const VelodyneLaser& other) { return other.elevation_deg < elevation_deg; }));
  }
}

// Pucks fire one laser every 2.304 us, sixteen in 55.296 us; the table of times in their manual.
VelodyneTraits puck(bool hi_res) {
  VelodyneTraits traits{hi_res ? VelodyneModel::kVlp16HiRes : VelodyneModel::kVlp16,
                        hi_res ? "vlp16_hires" : "vlp16",
                        hi_res ? "Velodyne Puck Hi-Res" : "Velodyne VLP-16",
                        static_cast<std::uint8_t>(hi_res ? 0x24 : 0x22),
                        16,
                        55'296.0,
                        0.002};
  for (std::size_t i = 0; i < kPuck.size(); ++i) {
    traits.laser[i].elevation_deg = kPuck[i][0] * (hi_res ? kHiResStep : 1.0);
    traits.laser[i].up_m = hi_res ? 0.0 : kPuck[i][1];
    traits.laser[i].after_ns = static_cast<double>(i) * 2'304.0;
  }
  number_rings(traits);
  return traits;
}

// One laser every 1.152 us, and a pause of eight such times.
VelodyneTraits hdl32e() {
  VelodyneTraits traits{VelodyneModel::kHdl32e, "hdl32e", "Velodyne HDL-32E", 0x21, 32, 46'080.0, 0.002};
  for (std::size_t i = 0; i < kHdl32e_deg.size(); ++i) {
    traits.laser[i].elevation_deg = kHdl32e_deg[i];
    traits.laser[i].after_ns = static_cast<double>(i) * 1'152.0;
  }
  number_rings(traits);
  return traits;
}

// Two lasers at once every 2.304 us, sixteen pairs in 55.296 us.
VelodyneTraits vlp32c() {
  VelodyneTraits traits{VelodyneModel::kVlp32c, "vlp32c", "Velodyne VLP-32C", 0x28, 32, 55'296.0, 0.004};
  for (std::size_t i = 0; i < kVlp32c.size(); ++i) {
    traits.laser[i].elevation_deg = kVlp32c[i][0];
    traits.laser[i].azimuth_deg = kVlp32c[i][1];
    traits.laser[i].after_ns = static_cast<double>(i / 2) * 2'304.0;
  }
  number_rings(traits);
  return traits;
}

const std::array<VelodyneTraits, 4>& all_traits() {
  static const std::array<VelodyneTraits, 4> traits = {puck(false), puck(true), hdl32e(), vlp32c()};
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
      if (fits(traits)) who += (who.empty() ? "" : " or ") + std::string(traits.title);
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
  return say("their product byte (0x{:02x}) says {}", product, traits.title);
}

VelodyneModel with_stated(const VelodyneTraits& stated, std::uint8_t product, const Clock& clock) {
  const VelodyneTraits* const told = model_of_product(product);
  const bool clock_differs = clock.packet_us != 0 && !clock.fits(stated);
  // First Pucks say 0x21: then what was stated decides, if the clock says it too.
  const bool told_differs = told != nullptr && told != &stated && (clock.packet_us == 0 || clock.fits(*told));
  if (told_differs || clock_differs) {
    throw FrameError(say("the sensor is said to be a {} ({}), but of its packets {}", stated.title, stated.word,
                         told_differs ? product_says(product, *told) : clock_says(clock)));
  }
  if (const char* const other = stranger(product)) {
    throw FrameError(say("the sensor is said to be a {} ({}), but its packets are of a Velodyne {} (0x{:02x})",
                         stated.title, stated.word, other, product));
  }
  return stated.model;
}

}  // namespace

double VelodyneTraits::packet_us(bool is_dual) const {
  const std::size_t firings = kVelodyneBlocks / (is_dual ? 2U : 1U) * firings_per_block();
  return 1e-3 * cycle_ns * static_cast<double>(firings);
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
