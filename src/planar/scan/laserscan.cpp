// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/scan/laserscan.hpp"

#include <limits>

#include "base/math/finite.hpp"

namespace pose_wall::planar {

pose_wall_planar_laserscan laserscan_of(const pose_wall_planar_scan& scan) {
  pose_wall_planar_laserscan out{};
  out.angle_min = static_cast<float>(scan.angle_min_rad);
  out.angle_max = static_cast<float>(scan.angle_min_rad + (scan.beams - 1.0) * scan.angle_step_rad);
  out.angle_increment = static_cast<float>(scan.angle_step_rad);
  out.range_min = static_cast<float>(scan.range_min_m);
  out.range_max = static_cast<float>(scan.range_max_m);
  out.count = scan.beams;
  out.ranges = scan.range_m;
  return out;
}

pose_wall_planar_scan scan_of(const pose_wall_planar_laserscan& message) {
  pose_wall_planar_scan scan{};
  scan.struct_size = sizeof(scan);
  scan.beams = message.count;
  scan.angle_min_rad = static_cast<double>(message.angle_min);
  scan.angle_step_rad = static_cast<double>(message.angle_increment);
  // A float of the step errs by up to 6e-8 of it, over a turn 4e-7 rad. First and last angle are exacter, where they
  // belong to the same beams: some drivers give the end of the last beam instead of its middle.
  if (message.count > 1) {
    const double span_rad = static_cast<double>(message.angle_max) - scan.angle_min_rad;
    const double step_rad = span_rad / (message.count - 1.0),
                 off = (step_rad - scan.angle_step_rad) * (message.count - 1.0);
    constexpr double kSame_rad = 1e-5;  // some times the rounding of an angle
    if (off > -kSame_rad && off < kSame_rad) scan.angle_step_rad = step_rad;
  }
  scan.range_min_m = static_cast<double>(message.range_min);
  scan.range_max_m = static_cast<double>(message.range_max);
  scan.range_m = message.ranges;
  return scan;
}

void copy_without_infinity(const float* from, std::uint32_t count, float* to) {
  for (std::uint32_t k = 0; k < count; ++k) {
    to[k] = from[k] > std::numeric_limits<float>::max() ? static_cast<float>(not_a_number()) : from[k];
  }
}

}  // namespace pose_wall::planar
