// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/route/poses.hpp"

#include <cmath>

namespace pose_wall::planar::route {
namespace {

constexpr double kTurnMostRounded_rad = 2.3;  // a sharper corner is no curve
constexpr double kTurnLeast_rad = 1e-4;       // less is no turn: a tenth of a millimetre at a metre
constexpr double kSpotStep_rad = 0.5;         // poses of a turn on the spot

// The arc in place of a corner begins cut_m before it and ends cut_m behind it. cut_m 0: a turn on the spot.
struct Curve {
  double cut_m = 0.0, radius_m = 0.0, length_m = 0.0;
};

class Writer {
 public:
  Writer(Span<const Corner> corners, const Pose2& start, const Costs& costs, const Rounding& rounding, Sweeps* sweeps,
         Span<pose_wall_planar_path_pose> out)
      : corners_(corners), at_(start), costs_(costs), rounding_(rounding), sweeps_(sweeps), out_(out) {}

  Written write() {
    add(0.0, 0, 0);
    double cut_m = 0.0;  // of the stretch ahead, by the corner behind the machine
    for (std::uint32_t k = 0; k < corners_.size(); ++k) {
      const Curve curve = k > 0 ? curve_at(k, cut_m) : Curve();
      if (k > 0) {
        const double length_m = (corners_[k].place() - corners_[k - 1].place()).norm() - cut_m - curve.cut_m;
        at_.yaw_rad = corners_[k - 1].yaw_rad;
        go(length_m, 0.0, corners_[k - 1].gear);
      }
      take_corner(k, curve);
      cut_m = curve.cut_m;
    }
    if (written_.poses > 0 && written_.poses <= out_.size())
      out_[written_.poses - 1].flags |= POSE_WALL_PLANAR_PATH_STOP;
    return written_;
  }

 private:
  void take_corner(std::uint32_t k, const Curve& curve) {
    const Corner& corner = corners_[k];
    if (curve.cut_m > 0.0) {
      go(curve.length_m, corner.turn_rad, corner.gear);
    } else {
      at_.x_m = corner.x_m;
      at_.y_m = corner.y_m;
      if (std::abs(corner.turn_rad) > kTurnLeast_rad) turn(corner.turn_rad);
      const bool is_cusp = k > 0 && corner.gear * corners_[k - 1].gear < 0;
      if (is_cusp) stop(POSE_WALL_PLANAR_PATH_CUSP);
      written_.cusps += is_cusp ? 1 : 0;
      written_.cost_m += is_cusp ? costs_.cusp_m : 0.0;
    }
  }

  // The widest arc for which there is room.
  Curve curve_at(std::uint32_t k, double cut_behind_m) {
    if (k + 1 >= corners_.size()) return {};
    const Corner& corner = corners_[k];
    const double turn_rad = std::abs(corner.turn_rad);
    if (corner.gear != corners_[k - 1].gear || !(turn_rad > kTurnLeast_rad && turn_rad < kTurnMostRounded_rad))
      return {};
    const double before_m = (corner.place() - corners_[k - 1].place()).norm() - cut_behind_m;
    const double share = k + 2 == corners_.size() ? 1.0 : 0.5;
    const double behind_m = share * (corners_[k + 1].place() - corner.place()).norm();
    const double slope = sine(0.5 * turn_rad) / cosine(0.5 * turn_rad);
    const double room_m = before_m < behind_m ? before_m : behind_m;
    double radius_m = room_m / slope;
    if (radius_m > rounding_.radius_most_m) radius_m = rounding_.radius_most_m;
    for (; radius_m >= rounding_.radius_least_m; radius_m *= 0.8) {
      const Curve curve{radius_m * slope, radius_m, radius_m * turn_rad};
      const Eigen::Vector2d back = (corners_[k - 1].place() - corner.place()).normalized() * curve.cut_m;
      const Pose2 begin{corner.x_m + back.x(), corner.y_m + back.y(), corners_[k - 1].yaw_rad};
      if (sweeps_->is_arc_free(begin, corner.gear * curve.length_m, corner.turn_rad)) return curve;
    }
    return {};
  }

  void go(double length_m, double turn_rad, std::int32_t gear) {
    if (!(length_m > 1e-6)) return;
    const auto steps = static_cast<std::uint32_t>(length_m / rounding_.pose_step_m) + 1;
    const Pose2 from = at_;
    const double curvature_1_m = gear * turn_rad / length_m, begin_m = written_.length_m;
    for (std::uint32_t k = 1; k <= steps; ++k) {
      const double part = static_cast<double>(k) / steps;
      at_ = along_arc(from, gear * part * length_m, part * turn_rad);
      written_.length_m = begin_m + part * length_m;
      add(curvature_1_m, gear, 0);
    }
    written_.turning_rad += std::abs(turn_rad);
    written_.cost_m += costs_.of_stretch(length_m, gear) + costs_.of_turn(turn_rad);
  }

  void turn(double turn_rad) {
    stop(0);
    const auto steps = static_cast<std::uint32_t>(std::abs(turn_rad) / kSpotStep_rad) + 1;
    const double from_rad = at_.yaw_rad;
    for (std::uint32_t k = 1; k <= steps; ++k) {
      at_.yaw_rad = from_rad + k * turn_rad / steps;
      add(0.0, 0, turn_rad > 0.0 ? POSE_WALL_PLANAR_PATH_TURN_LEFT : POSE_WALL_PLANAR_PATH_TURN_RIGHT);
    }
    stop(0);
    ++written_.spot_turns;
    written_.turning_rad += std::abs(turn_rad);
    written_.cost_m += costs_.of_turn(turn_rad);
  }

  // The machine stands still at the pose written last.
  void stop(std::uint32_t more_flags) {
    if (written_.poses > 0 && written_.poses <= out_.size()) {
      out_[written_.poses - 1].flags |= POSE_WALL_PLANAR_PATH_STOP | more_flags;
    }
  }

  void add(double curvature_1_m, std::int32_t gear, std::uint32_t flags) {
    if (written_.poses < out_.size()) {
      out_[written_.poses] = {pose_for_caller(at_), curvature_1_m, written_.length_m, gear, flags};
    }
    ++written_.poses;
  }

  Span<const Corner> corners_;
  Pose2 at_;
  Costs costs_;
  Rounding rounding_;
  Sweeps* sweeps_;
  Span<pose_wall_planar_path_pose> out_;
  Written written_;
};

}  // namespace

Written write_poses(Span<const Corner> corners, const Pose2& start, const Costs& costs, const Rounding& rounding,
                    Sweeps* sweeps, Span<pose_wall_planar_path_pose> out) {
  return Writer(corners, start, costs, rounding, sweeps, out).write();
}

}  // namespace pose_wall::planar::route
