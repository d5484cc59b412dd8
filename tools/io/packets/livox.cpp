// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/livox.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"

namespace pose_wall::tools {
namespace {

// The head and the points of each data type: include/livox_lidar_def.h of Livox-SDK2, commit 08f523c9 (1.4.3).
constexpr std::size_t kLivoxHeadBytes = 36;
constexpr std::size_t kLengthAt = 1, kIntervalAt = 3, kPointsAt = 5, kLivoxTypeAt = 10, kTimeAt = 28;
constexpr std::uint32_t kLivoxImu = 0x00, kCartesianMm = 0x01, kCartesianCm = 0x02, kSpherical = 0x03,
                        kLivoxTwoReturns = 0x11;
constexpr std::size_t kLivoxPointBytesMost = 64;  // of a data type that is not known; judgement, 2026-11-29
constexpr std::int64_t kIntervalUnit_ns = 100;
// Packets come each 0.2 to 0.5 ms; a clock that is set jumps by more than a few of them.
constexpr std::int64_t kLateMost_ns = 2'000'000;
// A HAP sends 452,000 points a second, most of all: more in the longest frame means that the clock stands still.
constexpr std::size_t kPointsMax = 5'000'000;

// Ports that data leaves from, and that it goes to: sdk_core/comm/define.h of the same commit. The SDK sets the first
// ones whatever its settings say (build_request.cpp); the second ones are the user's.
constexpr std::uint16_t kLivoxPort = 56300;

// Lines: src/comm/comm.h of livox_ros_driver2, commit 13eb05e4. What it does not know has one, and so has an Avia 2.
struct LivoxTraits {
  const char* title;
  std::uint16_t port;  // that data leaves from
  std::uint32_t lines;
};

const LivoxTraits& livox_traits(LivoxModel model) {
  static constexpr std::array<LivoxTraits, 4> kModels = {{{"Livox Mid-360", kLivoxPort, 4},
                                                          {"Livox Mid-360S", kLivoxPort, 4},
                                                          {"Livox HAP", kLivoxHapPort, 6},
                                                          {"Livox Avia 2", kLivoxPort, 1}}};
  return kModels[static_cast<std::size_t>(model)];
}

// Of the ports that are the maker's, the one from which data leaves; 0 where neither is. Who passes packets on may
// send from another port.
std::uint16_t livox_port(const Sender& from) {
  for (const std::uint16_t port : {from.port, from.to_port}) {
    if (port == kLivoxPort || port == kLivoxHostPort) return kLivoxPort;
    if (port == kLivoxHapPort) return kLivoxHapPort;
  }
  return 0;
}

std::uint32_t data_type(ByteView payload) {
  return little_endian_at(payload, kLivoxTypeAt, 1);
}

// 0: not known.
std::size_t livox_point_bytes(std::uint32_t type) {
  switch (type) {
    case kCartesianMm:
      return 14;
    case kCartesianCm:
      return 8;
    case kSpherical:
      return 10;
    case kLivoxTwoReturns:
      return 28;
    default:
      return 0;
  }
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

double squared_range_mm(ByteView bytes) {
  const double x = signed_at(bytes, 0, 4), y = signed_at(bytes, 4, 4), z = signed_at(bytes, 8, 4);
  return x * x + y * y + z * z;
}

// Which return comes first is not told, and one that is missing is 0 0 0: the farther one needs to know neither.
ScanPoint farther_of(ByteView both) {
  const ByteView first{both.data, both.size / 2}, second{both.data + both.size / 2, both.size / 2};
  return point_of(kCartesianMm, squared_range_mm(second) > squared_range_mm(first) ? second : first);
}

std::int64_t time_of(ByteView payload) {
  const std::uint64_t low = little_endian_at(payload, kTimeAt, 4), high = little_endian_at(payload, kTimeAt + 4, 4);
  const std::uint64_t most = std::numeric_limits<std::int64_t>::max();
  return static_cast<std::int64_t>((high << 32U | low) & most);
}

}  // namespace

bool is_livox_data(ByteView payload) {
  if (payload.size <= kLivoxHeadBytes || little_endian_at(payload, 0, 1) != 0) return false;
  const std::size_t bytes = livox_point_bytes(data_type(payload)), points = little_endian_at(payload, kPointsAt, 2);
  return bytes > 0 && points > 0 && payload.size == kLivoxHeadBytes + points * bytes;
}

bool is_livox_dual(ByteView payload) {
  return data_type(payload) == kLivoxTwoReturns;
}

std::string unread_livox(ByteView payload) {
  if (payload.size <= kLivoxHeadBytes || little_endian_at(payload, 0, 1) != 0 || is_livox_data(payload)) return "";
  const std::size_t points = little_endian_at(payload, kPointsAt, 2), body = payload.size - kLivoxHeadBytes;
  const std::uint32_t type = data_type(payload);
  if (type == kLivoxImu || little_endian_at(payload, kLengthAt, 2) != payload.size) return "";
  if (points == 0 || body % points != 0 || body / points > kLivoxPointBytesMost) return "";
  const std::size_t known = livox_point_bytes(type);
  if (known > 0) {
    return fmt::format("a Livox, data type 0x{:02x} of {} bytes a point instead of {}", type, body / points, known);
  }
  return fmt::format("a Livox, data type 0x{:02x} (0x01, 0x02, 0x03 and 0x11 are read)", type);
}

const char* livox_title(const Sender& from) {
  const std::uint16_t port = livox_port(from);
  if (port == kLivoxHapPort) return livox_traits(LivoxModel::kHap).title;
  return port == kLivoxPort ? "Livox Mid-360, Mid-360S or Avia 2" : "Livox Mid-360, Mid-360S, HAP or Avia 2";
}

LivoxAssembler::LivoxAssembler(std::optional<LivoxModel> model, std::int64_t frame_ns)
    : model_(model),
      frame_ns_(frame_ns),
      kind_(fmt::format("packets of a {}", model ? livox_traits(*model).title : livox_title({}))) {
  if (frame_ns < 1'000'000 || frame_ns > 10'000'000'000) {
    throw FrameError(say("frames of {} ns; 1 ms to 10 s are allowed", frame_ns));
  }
}

void LivoxAssembler::begin(const Sender& from) {
  if (model_) {
    const LivoxTraits& named = livox_traits(*model_);
    const std::uint16_t other = named.port == kLivoxPort ? kLivoxHapPort : kLivoxPort;
    if (from.port == other) {
      throw FrameError(
          say("packets of a {} are wanted, but these leave from port {}, as those of a {}; a {} sends "
              "from port {}",
              named.title, from.port, livox_title(from), named.title, named.port));
    }
    lines_ = named.lines;
    return;
  }
  kind_ = fmt::format("packets of a {}", livox_title(from));
  lines_ = livox_port(from) == kLivoxHapPort ? livox_traits(LivoxModel::kHap).lines : 1;
}

bool LivoxAssembler::add(const Datagram& datagram) {
  const ByteView payload = datagram.payload;
  if (!is_livox_data(payload)) return false;
  if (lines_ == 0) begin(datagram.from);
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
  add_points(payload, time_ns);
  return true;
}

void LivoxAssembler::add_points(ByteView payload, std::int64_t time_ns) {
  const std::uint32_t type = data_type(payload), points = little_endian_at(payload, kPointsAt, 2);
  const std::size_t size = livox_point_bytes(type);
  const std::int64_t packet_ns = kIntervalUnit_ns * little_endian_at(payload, kIntervalAt, 2);
  for (std::uint32_t i = 0; i < points; ++i) {
    const ByteView bytes{payload.data + kLivoxHeadBytes + i * size, size};
    ScanPoint point = type == kLivoxTwoReturns ? farther_of(bytes) : point_of(type, bytes);
    point.t_ns = static_cast<std::uint32_t>(time_ns - scan_.stamp_ns + packet_ns * i / points);
    point.ring = static_cast<std::uint16_t>(i % lines_);
    scan_.points.push_back(point);
  }
}

void LivoxAssembler::end_frame(bool is_complete) {
  scan_.rings = 1;
  scan_.is_complete = is_complete;
  push(std::exchange(scan_, Scan{}));
}

void LivoxAssembler::finish() {
  // The last packet of a frame begins shortly before its end.
  if (!scan_.points.empty()) end_frame(last_ns_ - scan_.stamp_ns >= frame_ns_ / 100 * 95);
}

}  // namespace pose_wall::tools
