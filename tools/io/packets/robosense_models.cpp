// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/robosense_models.hpp"

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace pose_wall::tools {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kFirstHead = "\x55\xAA\x05\x0A\x5A\xA5\x50\xA0"sv;  // RS-LiDAR-16 and 32, Bpearl
constexpr std::string_view kSecondHead = "\x55\xAA\x05\x5A"sv;                 // Helios, Airy, Ruby
constexpr std::string_view kSolidStateHead = "\x55\xAA\x5A\xA5"sv;             // M1 to M3, E1, MX
constexpr std::string_view kDeviceHead = "\xA5\xFF\x00\x5A\x11\x11\x55\x55"sv;
constexpr std::uint32_t kTurn = 36'000;  // hundredths of a degree
constexpr std::size_t kHeadTimeAt = 20;

std::vector<double> in_steps_of(double step_us, std::size_t lasers) {
  std::vector<double> times_us;
  for (std::size_t k = 0; k < lasers; ++k) times_us.push_back(step_us * static_cast<double>(k));
  return times_us;
}

// Lasers k and k + 16 of an RS-LiDAR-32 and a Bpearl are half a step apart.
std::vector<double> in_two_halves(std::vector<double> first_us, double later_us) {
  const std::size_t half = first_us.size();
  for (std::size_t k = 0; k < half; ++k) first_us.push_back(first_us[k] + later_us);
  return first_us;
}

std::vector<double> rs32_us() {
  std::vector<double> first_us = in_steps_of(2.88, 16);
  first_us.back() = 44.64;
  return in_two_halves(first_us, 1.44);
}

// ros_rslidar: both halves of an RS-LiDAR-32 of the first rhythm fire together.
std::vector<double> first_rs32_us() {
  return in_two_halves(in_steps_of(3.0, 16), 0.0);
}

std::vector<double> bpearl_us() {
  std::vector<double> first_us = in_steps_of(2.56, 16);
  for (std::size_t k = 8; k < first_us.size(); ++k) first_us[k] += 25.68 - 8 * 2.56;
  return in_two_halves(first_us, 1.28);
}

// An Airy's rhythm depends on its mode: see robosense_device.cpp. This is how long a firing takes.
std::vector<RoboSenseRhythm> airy_rhythm() {
  return {{111.08, {}}};
}

std::vector<RoboSenseTraits> all_robosense() {
  using Model = RoboSenseModel;
  using Layout = RoboSenseLayout;
  constexpr double kHelios_us = 55.56;
  return {
      {Model::kRs16,
       "robosense_rs16",
       "RoboSense RS-LiDAR-16",
       Layout::kFirst,
       16,
       0.005,
       0.4,
       230.0,
       0.03825,
       0.0,
       {{55.5, in_steps_of(2.8, 16)}, {50.0, in_steps_of(3.0, 16)}}},
      {Model::kRs32,
       "robosense_rs32",
       "RoboSense RS-LiDAR-32",
       Layout::kFirst,
       32,
       0.005,
       0.4,
       230.0,
       0.03997,
       0.0,
       {{55.52, rs32_us()}, {50.0, first_rs32_us()}}},
      {Model::kHelios32,
       "robosense_helios32",
       "RoboSense RS-Helios",
       Layout::kHelios,
       32,
       0.0025,
       0.1,
       180.0,
       0.03498,
       0.0,
       {{kHelios_us, in_steps_of(1.73, 32)}}},
      // Its manual (6.2.2.3) puts the second firing of a block half a block later. rs_driver has 27.68 us since
      // 2024-03-29, where the times of 32 lasers took the place of those of 16.
      {Model::kHelios16p,
       "robosense_helios16p",
       "RoboSense RS-Helios-16P",
       Layout::kHelios,
       16,
       0.0025,
       0.1,
       180.0,
       0.03498,
       0.0,
       {{kHelios_us, in_steps_of(1.73, 16)}}},
      {Model::kBpearl,
       "robosense_bpearl",
       "RoboSense RS-Bpearl",
       Layout::kFirst,
       32,
       0.005,
       0.1,
       150.0,
       0.01473,
       0.09427,
       {{55.52, bpearl_us()}}},
      {Model::kBpearl4,
       "robosense_bpearl4",
       "RoboSense RS-Bpearl 4",
       Layout::kFirst,
       32,
       0.0025,
       0.1,
       150.0,
       0.01619,
       0.09571,
       {{55.56, in_steps_of(1.668, 32)}}},
      {Model::kAiry, "robosense_airy", "RoboSense Airy", Layout::kAiry, 96, 0.005, 0.1, 60.0, 0.010017, 0.04532,
       airy_rhythm()},
  };
}

bool begins_with(ByteView payload, std::string_view head) {
  return payload.size >= head.size() && text_of({payload.data, head.size()}) == head;
}

bool has_blocks(ByteView payload, std::size_t blocks, std::size_t block_bytes) {
  for (std::size_t block = 0; block < blocks; ++block) {
    if (robosense_number(payload, kRoboSenseHeadBytes + block * block_bytes, 2) != 0xFFEE) return false;
  }
  return true;
}

}  // namespace

const std::vector<RoboSenseTraits>& robosense_sensors() {
  static const std::vector<RoboSenseTraits> sensors = all_robosense();
  return sensors;
}

const RoboSenseTraits& robosense_traits(RoboSenseModel model) {
  return robosense_sensors()[static_cast<std::size_t>(model)];
}

std::uint64_t robosense_number(ByteView bytes, std::size_t offset, std::size_t size) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < size; ++i) number = number << 8U | std::to_integer<std::uint64_t>(bytes.data[offset + i]);
  return number;
}

std::optional<RoboSenseLayout> robosense_layout_of(ByteView payload) {
  if (payload.size != kRoboSenseBytes) return std::nullopt;
  if (begins_with(payload, kFirstHead) && has_blocks(payload, 12, 100)) return RoboSenseLayout::kFirst;
  if (!begins_with(payload, kSecondHead)) return std::nullopt;
  if (has_blocks(payload, 12, 100)) return RoboSenseLayout::kHelios;
  if (has_blocks(payload, 8, 148)) return RoboSenseLayout::kAiry;
  return std::nullopt;
}

bool is_robosense_device(ByteView payload) {
  return payload.size == kRoboSenseBytes && begins_with(payload, kDeviceHead);
}

bool has_robosense_points(ByteView payload, RoboSenseLayout layout) {
  constexpr std::size_t kDataTypeAt = 16;
  return layout != RoboSenseLayout::kAiry || robosense_number(payload, kDataTypeAt, 1) == 0;
}

std::size_t robosense_block_start(const RoboSenseTraits& traits, std::size_t block) {
  return kRoboSenseHeadBytes + block * traits.block_bytes();
}

std::optional<std::uint32_t> robosense_azimuth(const RoboSenseTraits& traits, ByteView payload, std::size_t block) {
  const auto azimuth =
      static_cast<std::uint32_t>(robosense_number(payload, robosense_block_start(traits, block) + 2, 2));
  if (azimuth > kTurn) return std::nullopt;
  return azimuth % kTurn;
}

std::int64_t robosense_clock_us(const RoboSenseTraits& traits, ByteView payload) {
  constexpr std::int64_t kSecond_us = 1'000'000;
  const bool is_calendar = traits.layout == RoboSenseLayout::kFirst && traits.model != RoboSenseModel::kBpearl4;
  if (!is_calendar) {
    constexpr std::uint64_t kSecondsMost = 1ULL
                                           << 32U;  // in 2106; nanoseconds of bytes that are no time do not overflow
    const std::uint64_t seconds = std::min(robosense_number(payload, kHeadTimeAt, 6), kSecondsMost);
    return static_cast<std::int64_t>(seconds) * kSecond_us +
           static_cast<std::int64_t>(robosense_number(payload, kHeadTimeAt + 6, 4));
  }
  // Day, hour, minute, second; milliseconds and microseconds in two bytes each.
  std::int64_t clock_s = 0;
  const std::array<std::int64_t, 4> of_the_next = {1, 24, 60, 60};
  for (std::size_t i = 0; i < of_the_next.size(); ++i) {
    clock_s = clock_s * of_the_next[i] + static_cast<std::int64_t>(robosense_number(payload, kHeadTimeAt + 2 + i, 1));
  }
  return clock_s * kSecond_us + 1000 * static_cast<std::int64_t>(robosense_number(payload, kHeadTimeAt + 6, 2)) +
         static_cast<std::int64_t>(robosense_number(payload, kHeadTimeAt + 8, 2));
}

std::string unread_robosense(ByteView payload) {
  const bool is_ruby = begins_with(payload, kSecondHead) && (payload.size == kRoboSenseBytes || payload.size == 1268);
  if (is_ruby && robosense_number(payload, kRoboSenseHeadBytes, 1) == 0xFE) return "a RoboSense Ruby";
  // By the sizes of rs_driver's decoders: M2 1342, M3 1448, MX 1404, E1 1200, EMX 812.
  const std::array<std::size_t, 5> sizes = {1342, 1448, 1404, 1200, 812};
  const bool is_solid = begins_with(payload, kSolidStateHead);
  if (is_solid && std::find(sizes.begin(), sizes.end(), payload.size) != sizes.end()) {
    return "a RoboSense M2, M3, MX, E1 or EMX";
  }
  return "";
}

}  // namespace pose_wall::tools
