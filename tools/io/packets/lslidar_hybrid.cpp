// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Facts: the maker's Lslidar_ROS1_driver, f29e947a, lslidar_ch_driver.{hpp,cpp}; packets of a real sensor in
// tidewise/drivers-lslidar_ch128x1, 8ee8faa2, test/data.

#include "io/packets/lslidar_hybrid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kHybridBytes = 1206, kOtherHybridBytes = 1212;
constexpr std::uint32_t kFrameMark = 0xCCBBAAFF;
constexpr std::uint32_t kHybridLines = 128;
constexpr double kHybridUnit_m = 0.01 / 256.0;
constexpr std::size_t kHybridPacketsForClock = 6;
constexpr std::int64_t kWaitForFaces_ns = 2'000'000'000;
constexpr std::size_t kHybridHeldMax = 20'000;      // 9,000 a second in the maker's example
constexpr std::int64_t kHybridPacketLeast_us = 50;  // one takes 0.1 to 1 ms
constexpr std::size_t kHybridPointsMax = 2'000'000;
// Where the clock stands still and packets came at once.
constexpr double kHybridPacket_ns = 225'000.0;

// Of the 32 groups of four lines: the mirror turns each by the angle of the face that the line's rest names.
constexpr std::array<double, 32> kGroup_deg = {
    -17.0, -16.0,  -15.0, -14.0,  -13.0, -12.0,  -11.0, -10.0, -9.0, -8.0,  -7.0, -6.0, -5.0, -4.125, -4.0, -3.125,
    -3.0,  -2.125, -2.0,  -1.125, -1.0,  -0.125, 0.0,   0.875, 1.0,  1.875, 2.0,  3.0,  4.0,  5.0,    6.0,  7.0};

std::uint32_t big_at(ByteView payload, std::size_t offset, std::size_t size) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < size; ++i) {
    number = number << 8U | std::to_integer<std::uint32_t>(payload.data[offset + i]);
  }
  return number;
}

// One point of one or two returns.
struct HybridItems {
  std::size_t bytes, count;
};

HybridItems items_of(ByteView packet) {
  return big_at(packet, packet.size - 1, 1) == 2 ? HybridItems{11, 109} : HybridItems{7, 171};
}

bool is_mark(ByteView packet, std::size_t offset) {
  return little_endian_at(packet, offset, 4) == kFrameMark;
}

bool has_points(ByteView packet) {
  if (packet.size != kHybridBytes && packet.size != kOtherHybridBytes) return false;
  const std::uint32_t returns = big_at(packet, packet.size - 1, 1);
  if (returns != 1 && returns != 2) return false;
  const HybridItems items = items_of(packet);
  for (std::size_t i = 0; i < items.count; ++i) {
    const std::size_t offset = i * items.bytes;
    if (is_mark(packet, offset)) continue;
    if (packet.size == kHybridBytes && big_at(packet, offset, 1) >= kHybridLines) return false;
    if (big_at(packet, offset + 1, 2) > 36000) return false;
  }
  return true;
}

bool has_upper_half(ByteView packet) {
  const HybridItems items = items_of(packet);
  for (std::size_t i = 0; i < items.count; ++i) {
    if (!is_mark(packet, i * items.bytes) && big_at(packet, i * items.bytes, 1) >= kHybridLines / 2) return true;
  }
  return false;
}

std::int64_t hybrid_clock(ByteView packet) {
  return big_at(packet, 1200, 4);
}

double middle_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// By the mirror: the light of a group meets a face, which looks half as far aside as the light that leaves it.
double sine_of_elevation(std::uint32_t line, double azimuth_rad, const LslidarFaces& faces) {
  const std::uint32_t group = line / 4;
  const double group_rad = (kGroup_deg[group] + (group % 2 == 0 ? faces.offset_deg : 0.0)) * kRadPerDeg;
  const double face_rad = faces.face_deg[line % 4] * kRadPerDeg;
  const double along =
      std::cos(face_rad) * std::cos(group_rad) * std::cos(0.5 * azimuth_rad) - std::sin(face_rad) * std::sin(group_rad);
  return std::sin(group_rad) + 2.0 * along * std::sin(face_rad);
}

}  // namespace

bool is_lslidar_hybrid(ByteView payload) {
  const ByteView packet = lslidar_packet(payload);
  return packet.size == kHybridBytes && has_points(packet);
}

std::string unread_lslidar_hybrid(ByteView payload) {
  if (is_lslidar_hybrid(payload)) {
    return "an LSLidar CH128X1, CH64W, CB64S1 or CH32A (of these a CH128X1 is read where lslidar_ch128x1 names it)";
  }
  return payload.size == kOtherHybridBytes && has_points(payload)
             ? "an LSLidar with a mirror (CH128S1, CX126S3 or other)"
             : "";
}

bool LslidarHybridAssembler::add(const Datagram& datagram) {
  const ByteView packet = lslidar_packet(datagram.payload);
  if (is_lslidar_device(packet)) {
    if (!faces_) faces_ = lslidar_faces_of(packet);
    return true;
  }
  if (!is_lslidar_hybrid(packet)) return false;
  if (packet_ns_ > 0.0) {
    add_points(packet, datagram.captured_ns);
    return true;
  }
  held_.push_back({Bytes(packet.data, packet.data + packet.size), datagram.captured_ns});
  if (held_.size() >= kHybridPacketsForClock) start_if_known(false);
  return true;
}

void LslidarHybridAssembler::start_if_known(bool is_last) {
  if (!faces_) {
    const bool has_time =
        held_.size() < kHybridHeldMax && held_.back().captured_ns - held_.front().captured_ns < kWaitForFaces_ns;
    if (!is_last && has_time) return;
    throw FrameError(
        tr("packets of an LSLidar CH128X1, which do not tell the angles of its mirror's faces; its device packets do, "
           "and none came: record or receive UDP port 2369, too"));
  }
  const auto view = [](const Held& held) { return ByteView{held.payload.data(), held.payload.size()}; };
  if (std::none_of(held_.begin(), held_.end(), [&](const Held& held) { return has_upper_half(view(held)); })) {
    throw FrameError(
        tr("the sensor is said to be an LSLidar CH128X1 (lslidar_ch128x1), but its first packets hold no line from 64 "
           "on, as those of a CB64S1 or a CH32A"));
  }
  std::vector<double> gaps_ns, arrivals_ns;
  for (std::size_t i = 1; i < held_.size(); ++i) {
    const std::int64_t gap = hybrid_clock(view(held_[i])) - hybrid_clock(view(held_[i - 1]));
    if (const std::int64_t unit_ns = lslidar_clock_unit_ns(gap, kHybridPacketLeast_us); unit_ns > 0) {
      gaps_ns.push_back(static_cast<double>(unit_ns * gap));
      clock_unit_ns_ = unit_ns;
    }
    const auto arrival_ns = static_cast<double>(held_[i].captured_ns - held_[i - 1].captured_ns);
    if (arrival_ns >= 50e3 && arrival_ns <= 5e6) arrivals_ns.push_back(arrival_ns);
  }
  if (gaps_ns.empty()) gaps_ns = arrivals_ns;
  packet_ns_ = gaps_ns.empty() ? kHybridPacket_ns : middle_of(gaps_ns);
  for (const Held& held : std::exchange(held_, {})) add_points(view(held), held.captured_ns);
}

// The time of a packet is that of its end.
void LslidarHybridAssembler::add_points(ByteView packet, std::int64_t captured_ns) {
  const HybridItems items = items_of(packet);
  std::optional<std::int64_t> clock_ns;
  if (clock_unit_ns_ > 0) clock_ns = clock_unit_ns_ * hybrid_clock(packet);
  const std::int64_t end_ns = clock_.moment_ns(captured_ns, clock_ns, kClockSecond_ns);
  end_behind_pause(end_ns);
  for (std::size_t i = 0; i < items.count; ++i) {
    const std::size_t offset = i * items.bytes;
    const double share = static_cast<double>(i) / static_cast<double>(items.count);
    const std::int64_t time_ns = end_ns + std::llround(packet_ns_ * (share - 1.0));
    if (is_mark(packet, offset)) {
      if (!scan_.points.empty()) end_frame(frame_begun_);
      frame_begun_ = true;
      continue;
    }
    if (scan_.points.size() == kHybridPointsMax) end_frame(false);
    if (scan_.points.empty()) scan_.stamp_ns = time_ns;
    ScanPoint point;
    // A capture's clock may go back.
    const std::int64_t most_ns = std::numeric_limits<std::uint32_t>::max();
    point.t_ns = static_cast<std::uint32_t>(std::clamp<std::int64_t>(time_ns - scan_.stamp_ns, 0, most_ns));
    const std::uint32_t line = big_at(packet, offset, 1);
    point.ring = static_cast<std::uint16_t>(line);
    const std::uint32_t second = items.bytes == 11 ? big_at(packet, offset + 7, 3) : 0;
    const bool is_second = second > big_at(packet, offset + 3, 3);
    const double range_m = kHybridUnit_m * (is_second ? second : big_at(packet, offset + 3, 3));
    if (range_m > 0.0) {
      const double azimuth_rad = 0.01 * big_at(packet, offset + 1, 2) * kRadPerDeg;
      const double up = sine_of_elevation(line, azimuth_rad, *faces_), flat_m = range_m * std::sqrt(1.0 - up * up);
      point.x_m = static_cast<float>(flat_m * std::sin(azimuth_rad));
      point.y_m = static_cast<float>(-flat_m * std::cos(azimuth_rad));
      point.z_m = static_cast<float>(range_m * up);
      point.intensity = static_cast<float>(big_at(packet, offset + (is_second ? 10 : 6), 1));
    }
    scan_.points.push_back(point);
  }
}

// Behind a pause the frame is another one, whose mark is lost.
void LslidarHybridAssembler::end_behind_pause(std::int64_t end_ns) {
  if (!scan_.points.empty() && end_ns - last_end_ns_ > kPacketPause_ns) {
    end_frame(false);
    frame_begun_ = false;
  }
  last_end_ns_ = end_ns;
}

void LslidarHybridAssembler::end_frame(bool is_complete) {
  scan_.rings = 1;
  scan_.is_complete = is_complete;
  scan_.stamp_ns += clock_.offset_ns();
  push(std::exchange(scan_, Scan{}));
}

void LslidarHybridAssembler::finish() {
  if (!held_.empty()) start_if_known(true);
  // No mark says where the last frame ends.
  if (!scan_.points.empty()) end_frame(false);
}

}  // namespace pose_wall::tools
