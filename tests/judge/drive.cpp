// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/drive.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::judge {
namespace {

constexpr double kFastest_m_s = 5.0;       // half a metre a frame
constexpr double kTurn_deg_s = 5.0;        // of a tracked machine under way
constexpr double kSway_deg = 0.3;          // of nose and sides on a floor that is even to some millimetres
constexpr double kHeading_deg = 6.0;       // a machine under way points along its road
constexpr double kAheadOfMachine_m = 3.3;  // the foremost sampling point that is drawn, and some room
constexpr double kFreeAhead_m = 0.3;

Stance between(const Stance& a, const Stance& b, double share) {
  const auto mix = [share](double from, double to) { return from + share * (to - from); };
  return {mix(a.x_m, b.x_m), mix(a.y_m, b.y_m), mix(a.turned_left_rad, b.turned_left_rad),
          mix(a.nose_down_rad, b.nose_down_rad), mix(a.right_down_rad, b.right_down_rad)};
}

// What the driver does, drawn once: rates are slow waves, so that one frame's motion is much like the last one's.
struct Manner {
  explicit Manner(Draw* draw)
      : speed_m_s(draw->uniform(0.0, kFastest_m_s)),
        turn_rad_s(kRadPerDeg * draw->uniform(-kTurn_deg_s, kTurn_deg_s)),
        curve_s(draw->uniform(4.0, 12.0)),
        nose_rad(kRadPerDeg * draw->uniform(0.0, kSway_deg)),
        side_rad(kRadPerDeg * draw->uniform(0.0, kSway_deg)),
        nose_s(draw->uniform(1.0, 3.0)),
        side_s(draw->uniform(1.0, 3.0)),
        start_s(draw->uniform(0.0, 10.0)) {}

  Stance next(const Stance& now, double time_s, double vigour) const {
    const double t_s = start_s + time_s;
    const double turn = vigour * turn_rad_s * std::cos(2.0 * kPi * time_s / curve_s) * kPeriod_s;
    const double ahead_m = vigour * speed_m_s * (1.0 + 0.1 * std::sin(2.0 * kPi * t_s / 7.0)) / 1.1 * kPeriod_s;
    const double heading_rad = now.turned_left_rad + 0.5 * turn;
    Stance then = now;
    then.x_m += ahead_m * std::cos(heading_rad);
    then.y_m += ahead_m * std::sin(heading_rad);
    then.turned_left_rad += turn;
    then.nose_down_rad += vigour * (sway(nose_rad, nose_s, t_s + kPeriod_s) - sway(nose_rad, nose_s, t_s));
    then.right_down_rad += vigour * (sway(side_rad, side_s, t_s + kPeriod_s) - sway(side_rad, side_s, t_s));
    return then;
  }

  static double sway(double size_rad, double period_s, double t_s) {
    return size_rad * std::sin(2.0 * kPi * t_s / period_s);
  }

  double speed_m_s, turn_rad_s, curve_s, nose_rad, side_rad, nose_s, side_s, start_s;
};

// What stands ahead of the machine, higher than the floor's rock and lower than its sensor.
struct Obstacle {
  double from_x_m, low_y_m, high_y_m;
};

std::vector<Obstacle> obstacles_ahead(const Road& road, const Machine& machine, const Stance& first) {
  const double sensor_z_m = machine.base_height_m + machine.mounting.position_base_m.z();
  std::vector<Obstacle> ahead;
  for (const Solid& solid : road.solids) {
    const Vector3d reach_m = solid.axes.cwiseAbs() * solid.half_m;
    const double from_x_m = solid.centre_m.x() - reach_m.x();
    const double above_floor_m = road.floor.distance_m(solid.centre_m) - reach_m.z();
    if (from_x_m < first.x_m + kHalfLength_m || above_floor_m > sensor_z_m) continue;
    ahead.push_back({from_x_m, solid.centre_m.y() - reach_m.y(), solid.centre_m.y() + reach_m.y()});
  }
  return ahead;
}

double beside_m(const Road& road, const Stance& stance) {
  const double room_m = 0.5 * (road.free_left_m + road.free_right_m) - kHalfWidth_m - kClear_m;
  const double middle_m = 0.5 * (road.free_left_m - road.free_right_m);
  return room_m - std::abs(stance.y_m - middle_m) - kHalfLength_m * std::abs(std::sin(stance.turned_left_rad));
}

bool clear(const Road& road, const std::vector<Obstacle>& ahead, const Drive& drive) {
  const double least_m = std::min(0.0, beside_m(road, drive.stances.front()));
  return std::all_of(drive.stances.begin(), drive.stances.end(), [&](const Stance& stance) {
    if (beside_m(road, stance) < least_m) return false;
    if (stance.x_m > 0.0 && stance.x_m + kAheadOfMachine_m > road.room_ahead_m) return false;
    const double half_m = kHalfWidth_m + kClear_m + kHalfLength_m * std::abs(std::sin(stance.turned_left_rad));
    return std::none_of(ahead.begin(), ahead.end(), [&](const Obstacle& it) {
      const bool in_lane = it.low_y_m < stance.y_m + half_m && it.high_y_m > stance.y_m - half_m;
      return in_lane && stance.x_m > 0.0 && stance.x_m + kHalfLength_m + kFreeAhead_m > it.from_x_m;
    });
  });
}

Drive driven(const Manner& manner, const Stance& first, double vigour, int frames) {
  Drive drive;
  drive.stances = {first};
  for (int k = 0; k < frames; ++k) {
    drive.stances.push_back(manner.next(drive.stances.back(), k * kPeriod_s, vigour));
  }
  return drive;
}

}  // namespace

Passage::Passage(const Road& road, const Machine& machine, const Stance& from, const Stance& to) {
  for (int k = 0; k <= kSteps; ++k) {
    const double share = static_cast<double>(k) / kSteps;
    pose_[static_cast<std::size_t>(k)] = between(from, to, share).pose(road, machine);
  }
}

Pose Passage::at(double share) const {
  const double step = std::clamp(share, 0.0, 1.0) * kSteps;
  const auto k = std::min(static_cast<std::size_t>(step), static_cast<std::size_t>(kSteps - 1));
  const double rest = step - static_cast<double>(k);
  const Pose &a = pose_[k], &b = pose_[k + 1];
  return {(1.0 - rest) * a.turn + rest * b.turn, (1.0 - rest) * a.position_m + rest * b.position_m};
}

Pace Drive::pace() const {
  Pace pace;
  for (std::size_t k = 1; k < stances.size(); ++k) {
    const Stance &a = stances[k - 1], &b = stances[k];
    const auto rate = [](double change) { return std::abs(change) / kPeriod_s; };
    pace.ahead_m_s = std::max(pace.ahead_m_s, std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) / kPeriod_s);
    pace.across_m_s = std::max(pace.across_m_s, rate(b.y_m - a.y_m));
    pace.turn_rad_s = std::max({pace.turn_rad_s, rate(b.turned_left_rad - a.turned_left_rad),
                                rate(b.nose_down_rad - a.nose_down_rad), rate(b.right_down_rad - a.right_down_rad)});
  }
  return pace;
}

Drive draw_drive(const Road& road, const Machine& machine, const Stance& first, Going going, int frames, Draw* draw) {
  const bool stands = draw->chance(0.5);
  const Manner manner(draw);
  if (going == Going::kStands || (going == Going::kDrawn && stands)) return driven(manner, first, 0.0, frames);
  Stance along = first;
  const double heading_rad = kRadPerDeg * kHeading_deg;
  along.turned_left_rad = std::clamp(first.turned_left_rad, -heading_rad, heading_rad);
  const std::vector<Obstacle> ahead = obstacles_ahead(road, machine, first);
  for (double vigour = 1.0; vigour > 0.02; vigour *= 0.7) {
    const Drive drive = driven(manner, along, vigour, frames);
    if (clear(road, ahead, drive)) return drive;
  }
  return driven(manner, along, 0.0, frames);
}

}  // namespace pose_wall::judge
