// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/drive/road_feeler.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::tools {
namespace {

constexpr double kCreep_m_s = 0.2;
constexpr double kFelt_m = 12.0;
constexpr double kLeast_m = 1.0;     // of free way, or it turns back
constexpr double kCurve_1_m = 0.25;  // the sharpest
constexpr int kArcs = 10;            // to each side
constexpr double kStraight_m = 2.0;  // of free way that a sharpest arc must have more than a straight one
constexpr std::uint32_t kEachBeam = 5;

}  // namespace

// Along the arc up to the first thing in its strip, from the machine's end that leads. In a curve the ends swing out:
// the strip is wider there on the outer side, and what stands beside the machine bars the way at once.
double RoadFeeler::free_m(double drive, double curvature_1_m) const {
  const double lead_m = drive > 0.0 ? kFront_m : kRear_m, trail_m = drive > 0.0 ? kRear_m : kFront_m;
  const double beside_least_m = stop_needs_least_m();
  const bool is_straight = std::abs(curvature_1_m) < 1e-6;
  const double radius_m = is_straight ? 0.0 : 1.0 / curvature_1_m, side = radius_m > 0.0 ? 1.0 : -1.0;
  const double out_m = std::hypot(std::abs(radius_m) + kHalfWidth_m, std::max(kFront_m, kRear_m)) - std::abs(radius_m);
  double free_m = kFelt_m;
  for (const sim::Place& thing : things_) {
    const double ahead_m = drive * thing.x(), aside_m = thing.y();
    double along_m = ahead_m, off_m = std::abs(aside_m), half_m = kHalfWidth_m;
    bool is_swept = false;
    if (!is_straight) {
      const double to_centre_m = std::hypot(ahead_m, radius_m - aside_m);
      along_m = std::abs(radius_m) * std::atan2(ahead_m, side * (radius_m - aside_m));
      off_m = std::abs(std::abs(radius_m) - to_centre_m);
      is_swept = to_centre_m > std::abs(radius_m);
      if (is_swept) half_m = out_m;
    }
    if (off_m > half_m + beside_least_m) continue;
    if (along_m > lead_m) free_m = std::min(free_m, along_m - lead_m);
    if (is_swept && along_m > -trail_m && along_m <= lead_m) free_m = 0.0;
  }
  return free_m;
}

RoadFeeler::Arc RoadFeeler::best(double drive) const {
  Arc best;
  double most_m = -kFelt_m;
  for (int k = -kArcs; k <= kArcs; ++k) {
    const double share = static_cast<double>(k) / kArcs;
    const Arc arc{share * kCurve_1_m, free_m(drive, share * kCurve_1_m)};
    const double worth_m = arc.free_m - kStraight_m * std::abs(share);
    if (worth_m > most_m) {
      most_m = worth_m;
      best = arc;
    }
  }
  return best;
}

Motion RoadFeeler::creep(const pose_wall_planar_scan& scan) {
  things_.clear();
  for (std::uint32_t k = 0; k < scan.beams; k += kEachBeam) {
    const double range_m = static_cast<double>(scan.range_m[k]);
    if (!(range_m > scan.range_min_m && range_m < kFelt_m + kRear_m)) continue;
    const double angle_rad = scan.sensor.yaw_rad + scan.angle_min_rad + k * scan.angle_step_rad;
    things_.emplace_back(scan.sensor.x_m + range_m * std::cos(angle_rad),
                         scan.sensor.y_m + range_m * std::sin(angle_rad));
  }
  if (things_.empty()) return {};
  Arc arc = best(drive_);
  if (arc.free_m < kLeast_m) {
    const Arc back = best(-drive_);
    if (back.free_m < kLeast_m) return {};
    drive_ = -drive_;
    arc = back;
  }
  // Curvature counts along the way as it is driven: backwards a turn to the machine's left goes to the right.
  return {drive_ * kCreep_m_s, kCreep_m_s * arc.curvature_1_m * drive_};
}

}  // namespace pose_wall::tools
