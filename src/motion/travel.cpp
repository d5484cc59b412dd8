// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/travel.hpp"

#include <cmath>

#include "base/estimation/small_cholesky.hpp"

namespace pose_wall::motion {
namespace {

// Which part of a keyframe's own error stays in the map. Keyframes see the same rock again, so their errors are partly
// one another's: measured by z2 on rough roads.
constexpr double kStays = 0.6, kStaysAlong = 0.3;
// Metres a metre that cells and steps of the rock stretch the way by, at most: steel sets 0.2 %.
constexpr double kStretch = 0.005;
// Neighbouring patches of ground err together along a sensor's rings. With few rings, turns were off by up to three
// times the patches' estimate (VLP-16 on rough floors).
constexpr double kTurnDoubt = 3.0;
// Error of places and turns within cells, which no patch shows.
constexpr double kPlaceFloor_m = 0.0005, kTurnFloor_rad = 0.00005;

bool is_turn(int k) {
  return k >= POSE_WALL_MOTION_ROLL;
}

double least_variance(int k) {
  const double least = is_turn(k) ? kTurnFloor_rad : kPlaceFloor_m;
  return least * least;
}

// The turns doubted, and what places have from them: a floor seen behind alone lifts the machine as it pitches it.
SixBySix doubted(const SixBySix& C) {
  constexpr double kMore = kTurnDoubt * kTurnDoubt - 1.0;  // of a variance, beside the one that is there
  const Eigen::Matrix3d turns = C.bottomRightCorner<3, 3>(), of_places = C.bottomLeftCorner<3, 3>();
  SixBySix out = C;
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) out(k, k) += least_variance(k);
  const SmallCholesky<3> factor(out.bottomRightCorner<3, 3>());
  Eigen::Matrix<double, 6, 3> hangs;  // places and turns by turns: a congruence, so that no variance can be negative
  for (int k = 0; k < 3; ++k) hangs.row(k) = factor.solve(of_places.col(k)).transpose();
  hangs.bottomRows<3>().setIdentity();
  out += kMore * hangs * turns * hangs.transpose();
  return out;
}

}  // namespace

void Bounds::widen(double place_m, double turn_rad) {
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    const double by = is_turn(k) ? turn_rad : place_m;
    sigma[k] = std::sqrt(sigma[k] * sigma[k] + by * by / 3.0);
    level[k] += by;
  }
}

void Travel::go(double along_m) {
  along_m_ += along_m;
  way_m_ += std::fabs(along_m);
  lost_m_ += lost_rad_ * std::fabs(along_m);
  drift_[POSE_WALL_MOTION_ALONG] += kStretch * std::fabs(along_m);
  SixBySix F = SixBySix::Identity();
  F(POSE_WALL_MOTION_ACROSS, POSE_WALL_MOTION_YAW) = along_m;
  F(POSE_WALL_MOTION_UP, POSE_WALL_MOTION_PITCH) = -along_m;
  of_map_ = (F * of_map_ * F.transpose()).eval();
}

void Travel::take_in(const SixBySix& of_alignment, std::uint32_t keyframes) {
  Six stays = Six::Constant(kStays);
  // The map is the mean of its scans; while it is young, of few.
  const double share = 1.0 / static_cast<double>(keyframes);
  stays[POSE_WALL_MOTION_ALONG] = share > kStaysAlong ? share : kStaysAlong;
  drift_by(stays.asDiagonal() * doubted(of_alignment) * stays.asDiagonal());
}

void Travel::begin_with(const SixBySix& of_alignment) {
  drift_by(doubted(of_alignment));
}

void Travel::drift_by(const SixBySix& covariance) {
  of_map_ += covariance;
  drift_variance_ += covariance.diagonal();
}

void Travel::slip(double along_m, double unevenness) {
  slip_m_ += along_m;
  drift_[POSE_WALL_MOTION_ALONG] += along_m;
  const double turn2 = unevenness * unevenness, place2 = turn2 * along_m * along_m;
  Six variance = Six::Constant(place2);
  variance[POSE_WALL_MOTION_ALONG] = 0.0;
  for (int k = POSE_WALL_MOTION_ROLL; k < POSE_WALL_MOTION_DIRECTIONS; ++k) variance[k] = turn2;
  drift_by(variance.asDiagonal());
}

Bounds Travel::bounds(const SixBySix& of_alignment, double slipping_m, double factor) const {
  const Six variance = of_map_.diagonal() + Six(doubted(of_alignment).diagonal());
  Bounds out;
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    const double lost = is_turn(k) ? lost_rad_ : lost_m_;
    const double slip = k == POSE_WALL_MOTION_ALONG ? slip_m_ + slipping_m : 0.0;
    out.sigma[k] = std::sqrt(variance[k] + (slip + lost) * (slip + lost) / 3.0);
    out.level[k] = factor * std::sqrt(variance[k]) + slip + lost;
  }
  out.level[POSE_WALL_MOTION_ALONG] += kStretch * way_m_;
  return out;
}

Six Travel::level_of(const SixBySix& of_alignment, double slipping_m, double factor) {
  Six level = factor * doubted(of_alignment).diagonal().cwiseSqrt();
  level[POSE_WALL_MOTION_ALONG] += slipping_m;
  return level;
}

Bounds Travel::of_step(const SixBySix& before, const SixBySix& now, double slip_m, double factor) {
  const Six variance = variance_of_step(before, now);
  Bounds out;
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    const double slip = k == POSE_WALL_MOTION_ALONG ? slip_m : 0.0;
    out.sigma[k] = std::sqrt(variance[k] + slip * slip / 3.0);
    out.level[k] = factor * std::sqrt(variance[k]) + slip;
  }
  return out;
}

Six Travel::variance_of_step(const SixBySix& before, const SixBySix& now) {
  return doubted(before).diagonal() + doubted(now).diagonal();
}

}  // namespace pose_wall::motion
