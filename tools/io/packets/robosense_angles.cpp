// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/robosense_angles.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::tools {
namespace {

constexpr std::size_t kElevationsAt = 468, kRs16ElevationsAt = 1165, kAngleBytes = 3;
// A sensor's own angles are within hundredths of a degree of the design's.
constexpr double kFromDesignMost_deg = 1.5;

// Between which elevations the lowest and the highest laser lie: by the designs, with the tolerance.
struct Fan {
  double lowest_from_deg, lowest_to_deg, highest_from_deg, highest_to_deg;
};

// Designs: RS-LiDAR-32 -25 to 15. Helios 5515 -55 to 15, 1615 -16 to 15, 1610 -16 to 10; 16P -15 to 15. Bpearl 2.3 to
// 89.5. Airy 0 to 90. Those of a Helios overlap: which it is, is told otherwise.
Fan fan_of(const RoboSenseTraits& traits) {
  switch (traits.model) {
    case RoboSenseModel::kRs32:
      return {-27.0, -23.0, 13.0, 17.0};
    case RoboSenseModel::kHelios32:
      return {-58.0, -12.0, 8.0, 18.0};
    case RoboSenseModel::kHelios16p:
      return {-18.0, -12.0, 12.0, 18.0};
    case RoboSenseModel::kBpearl:
    case RoboSenseModel::kBpearl4:
      return {-2.0, 6.0, 80.0, 92.0};
    case RoboSenseModel::kAiry:
      return {-3.0, 6.0, 80.0, 93.0};
    case RoboSenseModel::kRs16:
      break;
  }
  return {-16.5, -13.5, 13.5, 16.5};
}

double unit_deg(const RoboSenseTraits& traits) {
  return traits.model == RoboSenseModel::kRs32 ? 0.001 : 0.01;
}

// A sign (0 plus, 1 minus; 0xFF where nothing was written) and a number.
std::optional<double> signed_angle(ByteView device, std::size_t offset, double unit) {
  const std::uint64_t sign = robosense_number(device, offset, 1);
  if (sign > 1) return std::nullopt;
  const double angle_deg = unit * static_cast<double>(robosense_number(device, offset + 1, 2));
  if (angle_deg > 180.0) return std::nullopt;
  return sign == 1 ? -angle_deg : angle_deg;
}

// Nothing that was written has two lasers at one elevation, nor all of them elsewhere than its design.
bool is_fan_of(const RoboSenseTraits& traits, const std::vector<Laser>& lasers) {
  std::vector<double> elevations_deg;
  for (const Laser& laser : lasers) elevations_deg.push_back(laser.elevation_deg);
  std::sort(elevations_deg.begin(), elevations_deg.end());
  if (std::adjacent_find(elevations_deg.begin(), elevations_deg.end()) != elevations_deg.end()) return false;
  const Fan fan = fan_of(traits);
  const double lowest_deg = elevations_deg.front(), highest_deg = elevations_deg.back();
  return lowest_deg >= fan.lowest_from_deg && lowest_deg <= fan.lowest_to_deg && highest_deg >= fan.highest_from_deg &&
         highest_deg <= fan.highest_to_deg;
}

// No sign: lasers 1 to 8 point below the horizon.
std::optional<std::vector<Laser>> rs16_angles(ByteView device) {
  constexpr double kUnit_deg = 0.0001;
  std::vector<Laser> lasers = robosense_rs16_design();
  for (std::size_t k = 0; k < lasers.size(); ++k) {
    const std::uint64_t number = robosense_number(device, kRs16ElevationsAt + kAngleBytes * k, kAngleBytes);
    const double angle_deg = kUnit_deg * static_cast<double>(number) * (k < 8 ? -1.0 : 1.0);
    if (std::abs(angle_deg - lasers[k].elevation_deg) > kFromDesignMost_deg) return std::nullopt;
    lasers[k].elevation_deg = angle_deg;
  }
  return lasers;
}

bool is_unwritten(ByteView device, std::size_t offset, std::size_t size) {
  const std::byte first = device.data[offset];
  if (first != std::byte{0x00} && first != std::byte{0xFF}) return false;
  return std::all_of(device.data + offset, device.data + offset + size, [&](std::byte one) { return one == first; });
}

}  // namespace

std::vector<Laser> robosense_rs16_design() {
  std::vector<Laser> lasers;
  for (int k = 0; k < 16; ++k) {
    lasers.push_back({k < 8 ? -15.0 + 2.0 * k : 15.0 - 2.0 * (k - 8), 0.0, 0.0, 0.0, 0});
  }
  number_rings(&lasers);
  return lasers;
}

std::optional<std::vector<Laser>> robosense_angles(const RoboSenseTraits& traits, ByteView device, std::size_t lines) {
  if (traits.model == RoboSenseModel::kRs16) {
    std::optional<std::vector<Laser>> lasers = rs16_angles(device);
    if (lasers) number_rings(&*lasers);
    return lasers;
  }
  // Azimuths stand behind room for all elevations of the kind: 96 of an Airy, 32 of the others.
  const std::size_t room = traits.layout == RoboSenseLayout::kAiry ? 96 : 32;
  std::vector<Laser> lasers;
  for (std::size_t k = 0; k < lines; ++k) {
    const std::size_t offset = kElevationsAt + kAngleBytes * k;
    const std::optional<double> elevation_deg = signed_angle(device, offset, unit_deg(traits));
    const std::optional<double> azimuth_deg = signed_angle(device, offset + kAngleBytes * room, unit_deg(traits));
    if (!elevation_deg || !azimuth_deg) return std::nullopt;
    lasers.push_back({*elevation_deg, *azimuth_deg, 0.0, 0.0, 0});
  }
  // The 48 lines of an Airy are some of 96, of no known design.
  const bool is_part = lines != traits.lasers;
  if (!is_part && !is_fan_of(traits, lasers)) return std::nullopt;
  if (is_part && is_unwritten(device, kElevationsAt, kAngleBytes * lines)) return std::nullopt;
  number_rings(&lasers);
  return lasers;
}

bool has_no_rs16_angles(ByteView device) {
  return is_unwritten(device, kRs16ElevationsAt, 16 * kAngleBytes);
}

}  // namespace pose_wall::tools
