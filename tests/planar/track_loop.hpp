// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The tracker in a closed loop with tracks that slip, lag and obey late, and with poses that are late and noisy.

#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>
#include <vector>

#include "../support/aligned_block.hpp"
#include "bytes_needed.hpp"
#include "pose_wall_planar_track.h"

namespace pose_wall::test {

struct Ground {
  double slip_left = 0.12, slip_right = 0.12;  // parts of the track's speed that are lost
  double slip_wave = 0.0;                      // how much both change along the way, one against the other
  double delay_s = 0.3, lag_s = 0.15, track_m = 0.9;
  double pose_sigma_m = 0.01, pose_sigma_rad = 0.0035, pose_late_s = 0.08;
};

// A machine of two tracks, in steps of 5 ms.
class TrackedMachine {
 public:
  TrackedMachine(const Ground& ground, const pose_wall_planar_pose& pose) : ground_(ground), pose_(pose) {}

  void obey(double now_s, double left, double right) { waiting_.push_back({now_s + ground_.delay_s, left, right}); }

  void run(double now_s, double step_s) {
    for (; !waiting_.empty() && waiting_.front().at_s <= now_s; waiting_.pop_front()) acting_ = waiting_.front();
    const double share = 1.0 - std::exp(-step_s / ground_.lag_s);
    left_ += share * (acting_.left - left_);
    right_ += share * (acting_.right - right_);
    const double wave = ground_.slip_wave * std::sin(0.7 * way_);
    const double left = left_ * (1.0 - ground_.slip_left - wave), right = right_ * (1.0 - ground_.slip_right + wave);
    const double v = 0.5 * (left + right), w = (right - left) / ground_.track_m;
    pose_.x_m += v * step_s * std::cos(pose_.yaw_rad + 0.5 * w * step_s);
    pose_.y_m += v * step_s * std::sin(pose_.yaw_rad + 0.5 * w * step_s);
    pose_.yaw_rad += w * step_s;
    way_ += std::abs(v) * step_s;
    speed_ = v;
  }

  const pose_wall_planar_pose& pose() const { return pose_; }
  double speed() const { return speed_; }

 private:
  struct Order {
    double at_s, left, right;
  };
  Ground ground_;
  pose_wall_planar_pose pose_;
  std::deque<Order> waiting_;
  Order acting_{0.0, 0.0, 0.0};
  double left_ = 0.0, right_ = 0.0, way_ = 0.0, speed_ = 0.0;
};

// One moment of a run, by the truth.
struct Moment {
  double time_s, cross_m, along_m, heading_rad, speed_m_s, commanded_m_s, turn_rad_s;
  std::uint32_t state, slowed_by;
  bool is_curve;
};

struct LoopRun {
  std::vector<Moment> moments;
  std::uint32_t last_state = 0;
  pose_wall_planar_pose end{};
  double seconds = 0.0, slip = 0.0, drift_1_m = 0.0;

  double worst_cross(double from_along_m, bool only_curves) const {
    double worst = 0.0;
    for (const Moment& m : moments) {
      if (m.along_m >= from_along_m && (m.is_curve || !only_curves)) worst = std::max(worst, std::abs(m.cross_m));
    }
    return worst;
  }
  // Of the cross error, from beyond -band to beyond band or back.
  int swings(double from_along_m, double band_m) const {
    int side = 0, count = 0;
    for (const Moment& m : moments) {
      if (m.along_m < from_along_m || std::abs(m.cross_m) < band_m) continue;
      const int now = m.cross_m > 0.0 ? 1 : -1;
      count += side != 0 && now != side ? 1 : 0;
      side = now;
    }
    return count;
  }
};

struct LoopTracker {
  AlignedBlock block;
  pose_wall_planar_tracker* tracker = nullptr;

  explicit LoopTracker(const pose_wall_planar_track_settings& settings) : block(bytes_needed(settings), Dirt::kRandom) {
    if (pose_wall_planar_track_open(&settings, block.data(), block.size(), &tracker) != POSE_WALL_OK) tracker = nullptr;
  }
};

// The truth's place along a route: by the points of its stretches, near where it was last.
class Truth {
 public:
  explicit Truth(const std::vector<pose_wall_planar_path_pose>& poses) : poses_(poses) {}

  Moment at(const pose_wall_planar_pose& pose, std::uint32_t index) {
    Moment best{};
    double least = 1e9;
    const std::size_t from = index > 2 ? index - 2 : 0;
    for (std::size_t k = from; k + 1 < poses_.size() && k < from + 12; ++k) {
      const auto &a = poses_[k], &b = poses_[k + 1];
      if (b.drive == 0) continue;
      for (int i = 0; i <= 25; ++i) {
        const double s = (b.along_m - a.along_m) * i / 25.0, turn = b.drive * s * b.curvature_1_m, half = 0.5 * turn;
        const double chord = b.drive * s * (std::abs(half) > 1e-6 ? std::sin(half) / half : 1.0);
        const double x = a.pose.x_m + chord * std::cos(a.pose.yaw_rad + half);
        const double y = a.pose.y_m + chord * std::sin(a.pose.yaw_rad + half), yaw = a.pose.yaw_rad + turn;
        const double dx = pose.x_m - x, dy = pose.y_m - y, distance = std::hypot(dx, dy);
        if (distance >= least) continue;
        least = distance;
        best.cross_m = -std::sin(yaw) * dx + std::cos(yaw) * dy;
        best.along_m = a.along_m + s;
        best.heading_rad = std::remainder(pose.yaw_rad - yaw, 2.0 * 3.14159265358979);
        best.is_curve = std::abs(b.curvature_1_m) > 1e-6;
      }
    }
    return best;
  }

 private:
  const std::vector<pose_wall_planar_path_pose>& poses_;
};

inline LoopRun run_loop(LoopTracker& tracker, const std::vector<pose_wall_planar_path_pose>& route,
                        const pose_wall_planar_pose& start, const Ground& ground, std::uint32_t seed,
                        pose_wall_planar_clearance clearance = nullptr, void* context = nullptr,
                        double most_s = 3000.0) {
  LoopRun run;
  if (pose_wall_planar_track_route(tracker.tracker, route.data(), static_cast<std::uint32_t>(route.size()), clearance,
                                   context) != POSE_WALL_OK) {
    return run;
  }
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  TrackedMachine machine(ground, start);
  Truth truth(route);
  std::deque<std::pair<double, pose_wall_planar_pose>> seen;
  pose_wall_planar_track_input input{};
  input.struct_size = sizeof(input);
  pose_wall_planar_track_command command{};
  command.struct_size = sizeof(command);
  constexpr double kStep_s = 0.005;
  const double begin_s = 1000.0 * seed;  // a tracker's clock goes on from run to run
  for (int k = 0; k * kStep_s < most_s; ++k) {
    const double now_s = begin_s + k * kStep_s;
    if (k % 20 == 0) {  // a pose each 0.1 s
      pose_wall_planar_pose noisy = machine.pose();
      noisy.x_m += ground.pose_sigma_m * normal(random);
      noisy.y_m += ground.pose_sigma_m * normal(random);
      noisy.yaw_rad += ground.pose_sigma_rad * normal(random);
      seen.push_back({now_s, noisy});
    }
    if (k % 10 == 0) {  // a step each 0.05 s
      while (!seen.empty() && seen.front().first <= now_s - ground.pose_late_s + 1e-9) {
        input.has_pose = 1;
        input.pose = seen.front().second;
        input.pose_ns = static_cast<std::int64_t>(seen.front().first * 1e9);
        seen.pop_front();
      }
      input.now_ns = static_cast<std::int64_t>(now_s * 1e9);
      input.pose_level_m = 0.05;
      input.speed_m_s = std::nan("");
      if (pose_wall_planar_track_step(tracker.tracker, &input, &command) != POSE_WALL_OK) return run;
      machine.obey(now_s, command.left_m_s, command.right_m_s);
      Moment moment = truth.at(machine.pose(), command.pose_index);
      moment.time_s = now_s - begin_s;
      moment.speed_m_s = machine.speed();
      moment.commanded_m_s = command.speed_m_s;
      moment.turn_rad_s = command.turn_rad_s;
      moment.state = command.state;
      moment.slowed_by = command.slowed_by;
      if (command.state == POSE_WALL_PLANAR_TRACK_FOLLOWING) run.moments.push_back(moment);
      run.last_state = command.state;
      run.seconds = moment.time_s;
      if (command.state == POSE_WALL_PLANAR_TRACK_DONE || command.state == POSE_WALL_PLANAR_TRACK_OFF_PATH) break;
    }
    machine.run(now_s, kStep_s);
  }
  run.end = machine.pose();
  run.slip = command.slip;
  run.drift_1_m = command.drift_1_m;
  return run;
}

// Routes by hand: stretches of length, turned angle and gear; length 0 turns on the spot.
struct RoutePiece {
  double length_m, turn_rad;
  int drive;
};

inline std::vector<pose_wall_planar_path_pose> route_of(const std::vector<RoutePiece>& pieces,
                                                        pose_wall_planar_pose at = {0.0, 0.0, 0.0}) {
  std::vector<pose_wall_planar_path_pose> route{{at, 0.0, 0.0, 0, 0}};
  double along = 0.0;
  for (const RoutePiece& piece : pieces) {
    const int steps = piece.length_m > 0.0 ? std::max(1, static_cast<int>(piece.length_m / 0.25)) : 1;
    if (route.back().drive * piece.drive != 1 && route.size() > 1) route.back().flags |= POSE_WALL_PLANAR_PATH_STOP;
    for (int k = 0; k < steps; ++k) {
      const double s = piece.length_m / steps, turn = piece.turn_rad / steps, half = 0.5 * turn;
      const double chord = piece.drive * s * (std::abs(half) > 1e-9 ? std::sin(half) / half : 1.0);
      at.x_m += chord * std::cos(at.yaw_rad + half);
      at.y_m += chord * std::sin(at.yaw_rad + half);
      at.yaw_rad = std::remainder(at.yaw_rad + turn, 2.0 * 3.14159265358979323846);
      along += s;
      const double curvature = piece.length_m > 0.0 ? piece.drive * piece.turn_rad / piece.length_m : 0.0;
      std::uint32_t flags = turn > 0.0 ? POSE_WALL_PLANAR_PATH_TURN_LEFT : POSE_WALL_PLANAR_PATH_TURN_RIGHT;
      if (piece.length_m > 0.0) flags = 0;
      route.push_back({at, curvature, along, piece.length_m > 0.0 ? piece.drive : 0, flags});
    }
  }
  route.back().flags |= POSE_WALL_PLANAR_PATH_STOP;
  return route;
}

// Straight stretches, curves of 1.5 to 8 m, cusps and turns on the spot by chance, and a straight end.
inline std::vector<pose_wall_planar_path_pose> drawn_route(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<RoutePiece> pieces{{3.0, 0.0, 1}};
  int drive = 1;
  for (int k = 0; k < 8; ++k) {
    const double kind = part(random), turn = (part(random) < 0.5 ? -1.0 : 1.0) * (0.3 + 1.3 * part(random));
    if (kind < 0.6) {
      const double radius = 1.5 + 6.5 * part(random);
      pieces.push_back({std::abs(turn) * radius, turn, drive});
    } else if (kind < 0.8) {
      pieces.push_back({0.0, turn, 0});
    } else {
      drive = -drive;
    }
    pieces.push_back({2.0 + 6.0 * part(random), 0.0, drive});
  }
  return route_of(pieces);
}

}  // namespace pose_wall::test
