// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "packets/mid360.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "angles.hpp"
#include "language/language.hpp"

namespace pose_wall::tools {
namespace {

// Livox SDK2, communication protocol of the Mid-360: a head, then points by their data type.
constexpr std::size_t kMid360HeadBytes = 36;
constexpr std::size_t kIntervalAt = 3, kPointsAt = 5, kTypeAt = 10, kTimeAt = 28;
constexpr std::array<std::size_t, 4> kMid360PointBytes = {0, 14, 8, 10};
constexpr std::uint32_t kCartesianMm = 1, kCartesianCm = 2;
constexpr std::int64_t kIntervalUnit_ns = 100;
constexpr std::uint32_t kLines = 4;
// Four packets, one each 0.48 ms; a clock that is set jumps by more.
constexpr std::int64_t kLateMost_ns = 2'000'000;
// 200,000 points a second: more in one frame means that the sensor's clock stands still.
constexpr std::size_t kPointsMax = 4'000'000;

std::uint32_t data_type(ByteView payload) {
  return little_endian_at(payload, kTypeAt, 1);
}

double signed_at(ByteView payload, std::size_t offset, std::size_t size) {
  const std::uint32_t bits = little_endian_at(payload, offset, size);
  return size == 2 ? static_cast<std::int16_t>(bits) : static_cast<std::int32_t>(bits);
}

void place_cartesian(ScanPoint& point, ByteView bytes, std::size_t size, double unit_m) {
  point.x_m = static_cast<float>(unit_m * signed_at(bytes, 0, size));
  point.y_m = static_cast<float>(unit_m * signed_at(bytes, size, size));
  point.z_m = static_cast<float>(unit_m * signed_at(bytes, 2 * size, size));
}

// Depth in mm; from the zenith and around it in hundredths of a degree.
void place_spherical(ScanPoint& point, ByteView bytes) {
  const double range_m = 1e-3 * little_endian_at(bytes, 0, 4);
  if (range_m == 0.0) return;
  const double zenith_rad = 0.01 * little_endian_at(bytes, 4, 2) * kRadPerDeg;
  const double azimuth_rad = 0.01 * little_endian_at(bytes, 6, 2) * kRadPerDeg;
  point.x_m = static_cast<float>(range_m * std::sin(zenith_rad) * std::cos(azimuth_rad));
  point.y_m = static_cast<float>(range_m * std::sin(zenith_rad) * std::sin(azimuth_rad));
  point.z_m = static_cast<float>(range_m * std::cos(zenith_rad));
}

ScanPoint point_of(std::uint32_t type, ByteView bytes) {
  ScanPoint point;
  if (type == kCartesianMm) {
    place_cartesian(point, bytes, 4, 1e-3);
  } else if (type == kCartesianCm) {
    place_cartesian(point, bytes, 2, 1e-2);
  } else {
    place_spherical(point, bytes);
  }
  point.intensity = static_cast<float>(little_endian_at(bytes, bytes.size - 2, 1));
  return point;
}

std::int64_t time_of(ByteView payload) {
  const std::uint64_t low = little_endian_at(payload, kTimeAt, 4), high = little_endian_at(payload, kTimeAt + 4, 4);
  const std::uint64_t most = std::numeric_limits<std::int64_t>::max();
  return static_cast<std::int64_t>((high << 32U | low) & most);
}

}  // namespace

bool is_mid360_data(ByteView payload) {
  if (payload.size <= kMid360HeadBytes || little_endian_at(payload, 0, 1) != 0) return false;
  const std::uint32_t type = data_type(payload);
  if (type == 0 || type >= kMid360PointBytes.size()) return false;
  const std::size_t points = little_endian_at(payload, kPointsAt, 2);
  return points > 0 && payload.size == kMid360HeadBytes + points * kMid360PointBytes[type];
}

Mid360Assembler::Mid360Assembler(std::int64_t frame_ns) : frame_ns_(frame_ns) {
  if (frame_ns < 1'000'000 || frame_ns > 10'000'000'000) {
    throw FrameError(say("frames of {} ns; 1 ms to 10 s are allowed", frame_ns));
  }
}

bool Mid360Assembler::add(const Datagram& datagram) {
  const ByteView payload = datagram.payload;
  if (!is_mid360_data(payload)) return false;
  const std::int64_t time_ns = time_of(payload);
  const bool is_later = time_ns >= scan_.stamp_ns;
  // It came late, and its frame is gone.
  if (!scan_.points.empty() && !is_later && scan_.stamp_ns - time_ns < kLateMost_ns) return true;
  // A clock that went back, or stands still, begins another frame as well.
  if (!scan_.points.empty() &&
      (!is_later || time_ns - scan_.stamp_ns >= frame_ns_ || scan_.points.size() >= kPointsMax)) {
    end_frame(is_later);
  }
  if (scan_.points.empty()) scan_.stamp_ns = time_ns;
  last_ns_ = time_ns;
  const std::uint32_t type = data_type(payload);
  const std::uint32_t points = little_endian_at(payload, kPointsAt, 2);
  const std::int64_t packet_ns = kIntervalUnit_ns * little_endian_at(payload, kIntervalAt, 2);
  for (std::uint32_t i = 0; i < points; ++i) {
    ScanPoint point =
        point_of(type, {payload.data + kMid360HeadBytes + i * kMid360PointBytes[type], kMid360PointBytes[type]});
    point.t_ns = static_cast<std::uint32_t>(time_ns - scan_.stamp_ns + packet_ns * i / points);
    point.ring = static_cast<std::uint16_t>(i % kLines);
    scan_.points.push_back(point);
  }
  return true;
}

void Mid360Assembler::end_frame(bool is_complete) {
  scan_.rings = 1;
  scan_.is_complete = is_complete;
  push(std::exchange(scan_, Scan{}));
}

void Mid360Assembler::finish() {
  // The last packet of a frame begins shortly before its end.
  if (!scan_.points.empty()) end_frame(last_ns_ - scan_.stamp_ns >= frame_ns_ / 100 * 95);
}

}  // namespace pose_wall::tools
