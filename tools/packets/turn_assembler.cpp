// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "packets/turn_assembler.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace pose_wall::tools {
namespace {

// A turn has 1,800 firings of a VLP-16 at 600 turns a minute, 4,400 of an HDL-32E at 300; more means that no wrap was
// seen.
constexpr std::size_t kFiringsMax = 20'000;

// A capture's clock may have gone back within a turn.
std::uint32_t time_within(std::int64_t since_ns, std::uint32_t after_ns) {
  const std::int64_t most = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(since_ns, 0, most - after_ns)) + after_ns;
}

}  // namespace

double turned_deg(double from_deg, double to_deg) {
  const double turn_deg = to_deg - from_deg;
  return turn_deg < 0.0 ? turn_deg + 360.0 : turn_deg;
}

bool TurnAssembler::is_first_heard(const Datagram& datagram) {
  if (!sensor_) sensor_ = datagram.source_address;
  return *sensor_ == datagram.source_address;
}

void TurnAssembler::add_firing(const Firing& firing, double step_deg) {
  step_deg_ = step_deg;
  if (!moments_.empty() && firing.azimuth_deg < moments_.back().azimuth_deg - 180.0) {
    end_turn(turn_begun_);
    turn_begun_ = true;
  }
  if (moments_.empty() && firing.azimuth_deg < step_deg) turn_begun_ = true;
  if (moments_.size() == kFiringsMax) end_turn(false);
  moments_.push_back({firing.azimuth_deg, firing.time_ns});
  points_.insert(points_.end(), firing.points.begin(), firing.points.end());
}

void TurnAssembler::end_turn(bool is_complete) {
  const std::size_t firings = moments_.size(), rings = points_.size() / firings;
  Scan scan;
  scan.stamp_ns = moments_.front().time_ns;
  scan.rings = static_cast<std::uint32_t>(rings);
  scan.is_complete = is_complete;
  scan.points.resize(points_.size());
  for (std::size_t ring = 0; ring < rings; ++ring) {
    for (std::size_t i = 0; i < firings; ++i) {
      ScanPoint& point = scan.points[ring * firings + i];
      point = points_[i * rings + ring];
      point.t_ns = time_within(moments_[i].time_ns - scan.stamp_ns, point.t_ns);
    }
  }
  moments_.clear();
  points_.clear();
  push(std::move(scan));
}

void TurnAssembler::finish() {
  if (!moments_.empty()) end_turn(turn_begun_ && moments_.back().azimuth_deg > 360.0 - step_deg_);
}

}  // namespace pose_wall::tools
