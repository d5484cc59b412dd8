// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "packets/velodyne.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "angles.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kPayloadBytes = 1206;
constexpr std::size_t kBlocks = 12;
constexpr std::size_t kBlockBytes = 100;
constexpr std::size_t kLasers = 16;
constexpr std::uint16_t kBlockFlag = 0xEEFF;
constexpr std::uint8_t kDualReturn = 0x39;
constexpr std::uint8_t kHiRes = 0x24;
constexpr double kFiring_ns = 55'296.0;
constexpr double kLaser_ns = 2'304.0;
constexpr double kVelodyneUnit_m = 0.002;
// A turn has 1,800 firings of 16 at 600 turns a minute, 3,600 at 300; more means that no wrap was seen.
constexpr std::size_t kFiringsMax = 20'000;

struct Laser {
  double elevation_deg;
  double offset_up_m;
};

constexpr std::array<Laser, kLasers> kPuck = {{{-15, 0.0112},
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
constexpr double kHiResStep = 2.0 / 3.0;  // of 1° between the lasers of a Puck: 1.33° of 2°

std::uint32_t ring_of(std::size_t laser) {
  return static_cast<std::uint32_t>(laser % 2 == 0 ? laser / 2 : 8 + laser / 2);
}

double azimuth_of(ByteView payload, std::size_t block) {
  return 0.01 * little_endian_at(payload, block * kBlockBytes + 2, 2);
}

bool is_data(ByteView payload) {
  if (payload.size != kPayloadBytes) return false;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    if (little_endian_at(payload, block * kBlockBytes, 2) != kBlockFlag) return false;
    if (little_endian_at(payload, block * kBlockBytes + 2, 2) >= 36000) return false;
  }
  return true;
}

double turned_deg(double from_deg, double to_deg) {
  const double turn_deg = to_deg - from_deg;
  return turn_deg < 0.0 ? turn_deg + 360.0 : turn_deg;
}

}  // namespace

bool VelodyneAssembler::add(const Datagram& datagram) {
  if (!is_data(datagram.payload)) return false;
  if (!sensor_) sensor_ = datagram.source_address;
  if (*sensor_ != datagram.source_address) return false;  // of another sensor on the same wire
  add_blocks(datagram.payload, datagram.captured_ns);
  return true;
}

void VelodyneAssembler::add_blocks(ByteView payload, std::int64_t captured_ns) {
  const bool is_dual = std::to_integer<std::uint8_t>(payload.data[kPayloadBytes - 2]) == kDualReturn;
  product_ = std::to_integer<std::uint8_t>(payload.data[kPayloadBytes - 1]);
  // Of a pair of blocks the first holds the last return. The second holds the strongest, or the second strongest where
  // the last is the strongest: dust before a wall would be taken for the wall.
  const std::size_t step = is_dual ? 2 : 1;
  for (std::size_t block = 0; block < kBlocks; block += step) {
    const double azimuth_deg = azimuth_of(payload, block);
    if (block + step < kBlocks) last_turn_deg_ = turned_deg(azimuth_deg, azimuth_of(payload, block + step));
    const ByteView lasers{payload.data + block * kBlockBytes + 4, kBlockBytes - 4};
    const double block_ns = static_cast<double>(block / step) * 2.0 * kFiring_ns;
    for (std::size_t half = 0; half < 2; ++half) {
      const double half_ns = static_cast<double>(half) * kFiring_ns;
      const auto time_ns = captured_ns + std::llround(block_ns + half_ns);
      const double half_deg = azimuth_deg + 0.5 * static_cast<double>(half) * last_turn_deg_;
      add_firing(firing_of({lasers.data + half * 48, 48}, half_deg, last_turn_deg_, time_ns));
    }
  }
}

VelodyneAssembler::Firing VelodyneAssembler::firing_of(ByteView lasers, double azimuth_deg, double turn_deg,
                                                       std::int64_t time_ns) const {
  Firing firing;
  firing.azimuth_deg = azimuth_deg < 360.0 ? azimuth_deg : azimuth_deg - 360.0;
  firing.time_ns = time_ns;
  for (std::size_t laser = 0; laser < kLasers; ++laser) {
    const double after_ns = static_cast<double>(laser) * kLaser_ns;
    ScanPoint& point = firing.points[ring_of(laser)];
    point.ring = static_cast<std::uint16_t>(ring_of(laser));
    point.t_ns = static_cast<std::uint32_t>(after_ns);
    const double range_m = kVelodyneUnit_m * little_endian_at(lasers, 3 * laser, 2);
    if (range_m == 0.0) continue;
    const bool hi_res = product_ == kHiRes;
    const double elevation_rad = kPuck[laser].elevation_deg * (hi_res ? kHiResStep : 1.0) * kRadPerDeg;
    const double azimuth_rad = (azimuth_deg + turn_deg * after_ns / (2.0 * kFiring_ns)) * kRadPerDeg;
    const double flat_m = range_m * std::cos(elevation_rad);
    point.x_m = static_cast<float>(flat_m * std::cos(azimuth_rad));
    point.y_m = static_cast<float>(-flat_m * std::sin(azimuth_rad));
    point.z_m = static_cast<float>(range_m * std::sin(elevation_rad) + (hi_res ? 0.0 : kPuck[laser].offset_up_m));
    point.intensity = std::to_integer<std::uint8_t>(lasers.data[3 * laser + 2]);
  }
  return firing;
}

void VelodyneAssembler::add_firing(const Firing& firing) {
  if (!firings_.empty() && firing.azimuth_deg < firings_.back().azimuth_deg - 180.0) {
    end_turn(turn_begun_);
    turn_begun_ = true;
  }
  if (firings_.empty() && firing.azimuth_deg < last_turn_deg_) turn_begun_ = true;
  if (firings_.size() == kFiringsMax) end_turn(false);
  firings_.push_back(firing);
}

void VelodyneAssembler::end_turn(bool is_complete) {
  Scan scan;
  scan.stamp_ns = firings_.front().time_ns;
  scan.rings = kLasers;
  scan.is_complete = is_complete;
  scan.points.resize(kLasers * firings_.size());
  for (std::size_t ring = 0; ring < kLasers; ++ring) {
    for (std::size_t i = 0; i < firings_.size(); ++i) {
      ScanPoint& point = scan.points[ring * firings_.size() + i];
      point = firings_[i].points[ring];
      point.t_ns += static_cast<std::uint32_t>(firings_[i].time_ns - scan.stamp_ns);
    }
  }
  firings_.clear();
  push(std::move(scan));
}

void VelodyneAssembler::finish() {
  if (!firings_.empty()) end_turn(turn_begun_ && firings_.back().azimuth_deg > 360.0 - last_turn_deg_);
}

}  // namespace pose_wall::tools
