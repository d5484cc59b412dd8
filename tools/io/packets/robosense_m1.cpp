// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/robosense_m1.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/packets/robosense_models.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kNumberAt = 4, kMicrosAt = 16, kBlocksAt = 32, kM1Blocks = 25, kM1Channels = 5, kChannelBytes = 9;
constexpr std::size_t kM1BlockBytes = 2 + kM1Channels * kChannelBytes;
constexpr double kM1Unit_m = 0.005, kM1Nearest_m = 0.2, kM1Farthest_m = 200.0;
// rs_driver: packets may change places within so many numbers.
constexpr std::size_t kOutOfOrderMost = 10;
constexpr std::size_t kLateMost = 300;                  // half a frame
constexpr std::int64_t kFrameGapMost_ns = 100'000'000;  // a frame

double m1_angle_rad(ByteView payload, std::size_t offset) {
  constexpr double kZero = 32'768.0;
  return 0.01 * (static_cast<double>(robosense_number(payload, offset, 2)) - kZero) * kRadPerDeg;
}

ScanPoint m1_point(ByteView payload, std::size_t offset) {
  ScanPoint point;
  const double range_m = kM1Unit_m * static_cast<double>(robosense_number(payload, offset, 2));
  if (range_m < kM1Nearest_m || range_m > kM1Farthest_m) return point;
  const double pitch_rad = m1_angle_rad(payload, offset + 2), yaw_rad = m1_angle_rad(payload, offset + 4);
  // Counterclockwise, unlike the maker's sensors that turn.
  point.x_m = static_cast<float>(range_m * std::cos(pitch_rad) * std::cos(yaw_rad));
  point.y_m = static_cast<float>(range_m * std::cos(pitch_rad) * std::sin(yaw_rad));
  point.z_m = static_cast<float>(range_m * std::sin(pitch_rad));
  point.intensity = static_cast<float>(robosense_number(payload, offset + 6, 1));
  return point;
}

}  // namespace

bool is_robosense_m1_data(ByteView payload) {
  constexpr std::uint64_t kHead = 0x55AA5AA5;
  return payload.size == kRoboSenseM1Bytes && robosense_number(payload, 0, 4) == kHead;
}

bool RoboSenseM1Assembler::add(const Datagram& datagram) {
  if (!is_robosense_m1_data(datagram.payload)) return false;
  const auto number = static_cast<std::size_t>(robosense_number(datagram.payload, kNumberAt, 2));
  if (number >= kNumbers) return false;
  if (points_.empty()) first_ = number;
  if (!points_.empty() && number + kOutOfOrderMost < last_) {
    end_frame(true);
    first_ = number;
  } else if (!points_.empty() && first_ < kOutOfOrderMost && number > last_ + kLateMost) {
    return true;  // late, of the frame before
  }
  if (seen_.test(number)) return true;  // captured twice
  const std::int64_t packet_ns = clock_.moment_ns(
      datagram.captured_ns, 1000 * static_cast<std::int64_t>(robosense_number(datagram.payload, kMicrosAt, 4)),
      kClockSecond_ns);
  if (!points_.empty() && packet_ns - last_ns_ > kFrameGapMost_ns) {
    end_frame(false);  // the rest of it is lost, and this is of another
    first_ = number;
  }
  last_ns_ = packet_ns;
  if (points_.empty()) began_ns_ = packet_ns;
  seen_.set(number);
  last_ = points_.empty() ? number : std::max(last_, number);
  add_blocks(datagram.payload, packet_ns);
  return true;
}

void RoboSenseM1Assembler::add_blocks(ByteView payload, std::int64_t packet_ns) {
  for (std::size_t block = 0; block < kM1Blocks; ++block) {
    const std::size_t start = kBlocksAt + block * kM1BlockBytes;
    const std::uint64_t return_number = robosense_number(payload, start + 1, 1);
    if (return_number_.value_or(return_number) != return_number) {
      throw FrameError(
          tr("an M1 that sends two returns of each firing is not read: which of its blocks belong together "
             "is not known; set it to one return, the last"));
    }
    return_number_ = return_number;
    const std::int64_t most_ns = std::numeric_limits<std::uint32_t>::max();
    const std::int64_t after_ns =
        packet_ns - began_ns_ + 1000 * static_cast<std::int64_t>(robosense_number(payload, start, 1));
    for (std::size_t channel = 0; channel < kM1Channels; ++channel) {
      ScanPoint point = m1_point(payload, start + 2 + channel * kChannelBytes);
      point.t_ns = static_cast<std::uint32_t>(std::clamp<std::int64_t>(after_ns, 0, most_ns));
      point.ring = static_cast<std::uint16_t>(channel);
      points_.push_back(point);
    }
  }
}

void RoboSenseM1Assembler::end_frame(bool is_complete) {
  Scan scan;
  scan.stamp_ns = began_ns_ + clock_.offset_ns();
  scan.rings = 1;
  // Begun with its first packets: whether it was seen whole.
  scan.is_complete = is_complete && first_ < kOutOfOrderMost;
  scan.points = std::exchange(points_, {});
  seen_.reset();
  push(std::move(scan));
}

void RoboSenseM1Assembler::finish() {
  constexpr std::size_t kLastOfFrame = 629;  // of one return
  if (!points_.empty()) end_frame(last_ >= kLastOfFrame);
}

}  // namespace pose_wall::tools
