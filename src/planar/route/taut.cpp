// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/route/taut.hpp"

#include <cmath>

namespace pose_wall::planar::route {
namespace {

constexpr double kGain_m = 2e-3, kGainCut_m = 1e-2;       // a change that saves less is not worth its sweeps
constexpr double kStepFirst_m = 0.8, kStepLast_m = 0.02;  // moves of a corner, smaller from round to round
constexpr double kCutFirst_m = 3.0, kCutLast_m = 0.1;     // from a corner along its stretches
constexpr double kCutTurn_rad = 0.05;                     // a corner that turns by less is not cut
constexpr std::uint32_t kRounds = 4, kSweepsOfMoves = 3;  // at most; each ends where nothing gains kGain_m

double length_of(const Corner& a, const Corner& b) {
  return (b.place() - a.place()).norm();
}

}  // namespace

// Of the stretches between two corners and of the turns at both and between.
double Taut::cost_between(std::uint32_t from, std::uint32_t to) const {
  double cost_m = costs_.of_turn(corners_[from].turn_rad);
  for (std::uint32_t k = from; k < to; ++k) {
    cost_m += costs_.of_stretch(length_of(corners_[k], corners_[k + 1]), corners_[k].gear);
    cost_m += costs_.of_turn(corners_[k + 1].turn_rad);
  }
  const std::int32_t before = from == 0 ? 0 : corners_[from - 1].gear;
  return cost_m + cusps_about(before, &corners_[from], to - from, corners_[to].gear);
}

// Changes of gear along a chain; gear 0 is none.
double Taut::cusps_about(std::int32_t before, const Corner* corners, std::uint32_t count, std::int32_t behind) const {
  double cost_m = 0.0;
  std::int32_t last = before;
  for (std::uint32_t k = 0; k <= count; ++k) {
    const std::int32_t gear = k < count ? corners[k].gear : behind;
    if (gear * last < 0) cost_m += costs_.cusp_m;
    last = gear;
  }
  return cost_m;
}

bool Taut::try_change(const Change& change) {
  Corner chain[kNewMost + 2];
  const std::uint32_t last = change.count + 1;
  const double arriving_rad = arriving_yaw(change.from);
  chain[0] = corners_[change.from];
  chain[last] = corners_[change.to];
  for (std::uint32_t k = 0; k < change.count; ++k) {
    chain[k + 1].x_m = change.place_m[k].x();
    chain[k + 1].y_m = change.place_m[k].y();
  }
  double yaw_rad = arriving_rad, cost_m = 0.0;
  for (std::uint32_t k = 0; k < last; ++k) {
    chain[k].gear = change.gear[k];
    chain[k].yaw_rad = driving_yaw(chain[k].place(), chain[k + 1].place(), chain[k].gear, yaw_rad);
    chain[k].turn_rad = wrapped(chain[k].yaw_rad - yaw_rad);
    cost_m += costs_.of_turn(chain[k].turn_rad) + costs_.of_stretch(length_of(chain[k], chain[k + 1]), chain[k].gear);
    yaw_rad = chain[k].yaw_rad;
  }
  chain[last].turn_rad = wrapped(chain[last].yaw_rad - yaw_rad);
  const std::int32_t before = change.from == 0 ? 0 : corners_[change.from - 1].gear;
  cost_m += costs_.of_turn(chain[last].turn_rad) + cusps_about(before, chain, last, chain[last].gear);
  const double gain_m = change.count == 2 ? kGainCut_m : kGain_m;
  if (!(cost_m < cost_between(change.from, change.to) - gain_m)) return false;
  if (!is_way_free(chain, last + 1, arriving_rad)) return false;
  commit(change, chain);
  return true;
}

// Straight stretches first: they are cheap and fail most.
bool Taut::is_way_free(const Corner* chain, std::uint32_t count, double arriving_rad) const {
  for (std::uint32_t k = 0; k + 1 < count; ++k) {
    if (!sweeps_->is_straight_free(chain[k].left_as(), chain[k].gear * length_of(chain[k], chain[k + 1]))) return false;
  }
  double yaw_rad = arriving_rad;
  for (std::uint32_t k = 0; k < count; ++k) {
    if (!sweeps_->is_turn_free({chain[k].x_m, chain[k].y_m, yaw_rad}, chain[k].turn_rad)) return false;
    yaw_rad = chain[k].yaw_rad;
  }
  return true;
}

void Taut::commit(const Change& change, const Corner* chain) {
  const std::uint32_t behind = change.from + change.count + 1;
  if (behind <= change.to) {
    for (std::uint32_t k = change.to; k < count_; ++k) corners_[k - (change.to - behind)] = corners_[k];
    count_ -= change.to - behind;
  } else {
    for (std::uint32_t k = count_; k > change.to; --k) corners_[k - 1 + (behind - change.to)] = corners_[k - 1];
    count_ += behind - change.to;
  }
  for (std::uint32_t k = 0; k < change.count + 2; ++k) corners_[change.from + k] = chain[k];
  const std::uint32_t first = change.from > 0 ? change.from - 1 : 0;
  for (std::uint32_t k = first; k < count_ && k <= behind + 1; ++k) corners_[k].tried = 0;
}

// From each corner straight to the farthest that is cheaper to reach so.
bool Taut::leave_out() {
  bool has_changed = false;
  for (std::uint32_t from = 0; from + 2 < count_ + 0; ++from) {
    for (std::uint32_t to = count_ - 1; to > from + 1 && !is_spent(); --to) {
      Change change;
      change.from = from;
      change.to = to;
      change.gear[0] = corners_[from].gear;
      bool is_done = try_change(change);
      change.gear[0] = -change.gear[0];
      is_done = is_done || try_change(change);
      if (!is_done) continue;
      has_changed = true;
      break;
    }
  }
  return has_changed;
}

// Towards the middle between its neighbours, away from it, and along the line through them.
bool Taut::move_corner(std::uint32_t k, double step_m) {
  const Eigen::Vector2d along = (corners_[k + 1].place() - corners_[k - 1].place()).normalized();
  const Eigen::Vector2d off = corners_[k].place() - corners_[k - 1].place();
  const Eigen::Vector2d left(-along.y(), along.x()), inwards = left.dot(off) > 0.0 ? -left : left;
  bool has_changed = false;
  for (const Eigen::Vector2d& direction : {inwards, along, Eigen::Vector2d(-along), Eigen::Vector2d(-inwards)}) {
    Change change;
    change.from = k - 1;
    change.to = k + 1;
    change.count = 1;
    change.place_m[0] = corners_[k].place() + step_m * direction;
    change.gear[0] = corners_[k - 1].gear;
    change.gear[1] = corners_[k].gear;
    has_changed = try_change(change) || has_changed;
  }
  return has_changed;
}

bool Taut::move_corners(double step_m, std::uint32_t tried_bit) {
  bool has_changed = false;
  for (std::uint32_t k = 1; k + 1 < count_ && !is_spent(); ++k) {
    if ((corners_[k].tried & tried_bit) != 0) continue;
    if (move_corner(k, step_m)) {
      has_changed = true;
    } else {
      corners_[k].tried |= tried_bit;
    }
  }
  return has_changed;
}

bool Taut::cut_corner(std::uint32_t k, double before_m, double behind_m) {
  const Eigen::Vector2d at = corners_[k].place(), before = corners_[k - 1].place(), behind = corners_[k + 1].place();
  Change change;
  change.from = k - 1;
  change.to = k + 1;
  change.count = 2;
  change.place_m[0] = at + (before - at).normalized() * before_m;
  change.place_m[1] = at + (behind - at).normalized() * behind_m;
  change.gear[0] = change.gear[1] = corners_[k - 1].gear;
  change.gear[2] = corners_[k].gear;
  return try_change(change);
}

bool Taut::cut_corners() {
  bool has_changed = false;
  for (std::uint32_t k = 1; k + 1 < count_ && !is_spent(); ++k) {
    const double before_m = length_of(corners_[k - 1], corners_[k]);
    const double behind_m = length_of(corners_[k], corners_[k + 1]);
    const bool may_be_cut = corners_[k].gear == corners_[k - 1].gear && std::abs(corners_[k].turn_rad) > kCutTurn_rad;
    for (double cut_m = kCutFirst_m; may_be_cut && cut_m > kCutLast_m; cut_m *= 0.6) {
      const double a = cut_m < 0.5 * before_m ? cut_m : 0.5 * before_m;
      const double b = cut_m < 0.5 * behind_m ? cut_m : 0.5 * behind_m;
      if (count_ + 1 > corners_.size()) return has_changed;
      if (!cut_corner(k, a, b)) continue;
      has_changed = true;
      ++k;
      break;
    }
  }
  return has_changed;
}

void Taut::pull() {
  leave_out();
  for (std::uint32_t round = 0; round < kRounds && !is_spent(); ++round) {
    bool has_changed = false;
    std::uint32_t tried_bit = 1;
    for (double step_m = kStepFirst_m; step_m > kStepLast_m; step_m *= 0.5, tried_bit <<= 1) {
      for (std::uint32_t k = 0; k < kSweepsOfMoves; ++k) {
        if (!move_corners(step_m, tried_bit)) break;
        has_changed = true;
      }
    }
    has_changed = leave_out() || has_changed;
    has_changed = cut_corners() || has_changed;
    if (!has_changed) return;
  }
}

}  // namespace pose_wall::planar::route
