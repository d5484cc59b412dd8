// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/travel.hpp"

#include <cmath>

#include "base/estimation/small_cholesky.hpp"
#include "base/math/finite.hpp"

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

void Pieces::add(double m, const Eigen::Vector3d& direction) {
  m_ += m;
  by_way_ += m * direction * direction.transpose();
}

void Pieces::add(const Pieces& other) {
  m_ += other.m_;
  by_way_ += other.by_way_;
}

double Pieces::towards(const Eigen::Vector3d& direction) const {
  return std::sqrt(larger(m_ * direction.dot(by_way_ * direction), 0.0));  // beside the way it may round below nothing
}

SixBySix turned(const SixBySix& covariance, const Eigen::Matrix3d& in_road_before, const Eigen::Matrix3d& in_road_now) {
  SixBySix by = SixBySix::Zero();
  by.topLeftCorner<3, 3>() = by.bottomRightCorner<3, 3>() = in_road_now * in_road_before.transpose();
  return by * covariance * by.transpose();
}

void Travel::go(const Eigen::Vector3d& moved_m, const Eigen::Matrix3d& in_road) {
  of_map_ = turned(of_map_, in_road_, in_road);
  in_road_ = in_road;
  const double along_m = moved_m.x();
  along_m_ += along_m;
  const double way_m = std::sqrt(moved_m.squaredNorm());
  if (way_m > 0.0) way_.add(way_m, in_road.transpose() * moved_m / way_m);
  lost_m_ += lost_rad_ * way_m;
  drift_[POSE_WALL_MOTION_ALONG] += kStretch * std::fabs(along_m);
  SixBySix F = SixBySix::Identity();
  for (int turn = 0; turn < 3; ++turn) {
    F.col(POSE_WALL_MOTION_ROLL + turn).head<3>() = Eigen::Vector3d::Unit(turn).cross(moved_m);
  }
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

void Travel::slip(const Pieces& slip, double unevenness) {
  slip_.add(slip);
  for (int k = 0; k < POSE_WALL_MOTION_ROLL; ++k) drift_[k] += part_of(slip, k);
  const double turn2 = unevenness * unevenness, place2 = turn2 * slip.m() * slip.m();
  Six variance = Six::Constant(place2);
  variance[POSE_WALL_MOTION_ALONG] = 0.0;
  for (int k = POSE_WALL_MOTION_ROLL; k < POSE_WALL_MOTION_DIRECTIONS; ++k) variance[k] = turn2;
  drift_by(variance.asDiagonal());
}

Bounds Travel::bounds(const SixBySix& of_alignment, const Pieces& slipping, double factor) const {
  const Six variance = of_map_.diagonal() + Six(doubted(of_alignment).diagonal());
  Bounds out;
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    const double lost = is_turn(k) ? lost_rad_ : lost_m_;
    const double slip = part_of(slip_, k) + part_of(slipping, k);
    out.sigma[k] = std::sqrt(variance[k] + (slip + lost) * (slip + lost) / 3.0);
    out.level[k] = factor * std::sqrt(variance[k]) + kStretch * part_of(way_, k) + slip + lost;
  }
  return out;
}

Six Travel::level_of(const SixBySix& of_alignment, const Pieces& slipping, double factor) const {
  Six level = factor * doubted(of_alignment).diagonal().cwiseSqrt();
  for (int k = 0; k < POSE_WALL_MOTION_ROLL; ++k) level[k] += part_of(slipping, k);
  return level;
}

Bounds Travel::of_step(const SixBySix& before, const SixBySix& now, const Pieces& slipped, double factor) const {
  const Six variance = variance_of_step(before, now);
  Bounds out;
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    const double slip = part_of(slipped, k);
    out.sigma[k] = std::sqrt(variance[k] + slip * slip / 3.0);
    out.level[k] = factor * std::sqrt(variance[k]) + slip;
  }
  return out;
}

Six Travel::variance_of_step(const SixBySix& before, const SixBySix& now) {
  return doubted(before).diagonal() + doubted(now).diagonal();
}

}  // namespace pose_wall::motion
