// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "place/fit.hpp"

#include <Eigen/LU>
#include <cmath>

namespace pose_wall::planar {

Eigen::Matrix3d FitSums::information() const {
  Eigen::Matrix3d out;
  out << xx, xy, xt, xy, yy, yt, xt, yt, tt;
  return out;
}

bool fit_step(const FitSums& sums, const Prior& prior, Pose2* pose) {
  constexpr double kStill_m = 2e-4, kStill_rad = 2e-5;  // a hundredth of a scanner's noise, also 10 m away
  constexpr double kLeap2 = 4.0;                        // 2 m: a surface is found from 0.5 m at most
  // A metre's information, and a radian's: directions without any stay where they are.
  const Eigen::Matrix3d H = sums.information() + prior.information + Eigen::Matrix3d::Identity();
  const Eigen::Vector3d g = Eigen::Vector3d(sums.x, sums.y, sums.t) + prior.information * prior.off(*pose);
  const Eigen::Vector3d step = H.inverse() * g;
  if (!(step.squaredNorm() < kLeap2)) return false;
  *pose = {pose->x_m - step.x(), pose->y_m - step.y(), wrapped(pose->yaw_rad - step.z())};
  return !(std::abs(step.x()) < kStill_m && std::abs(step.y()) < kStill_m && std::abs(step.z()) < kStill_rad);
}

Fit fit_of(const FitSums& sums, const Pose2& pose) {
  constexpr std::uint32_t kExplainedLeast = 10;  // points: three numbers with some to spare
  Fit out;
  out.pose = pose;
  out.information = sums.information();
  out.points = sums.seen;
  out.seen = sums.all > 0 ? static_cast<double>(sums.seen) / sums.all : 0.0;
  out.explained = sums.seen > 0 ? static_cast<double>(sums.explained) / sums.seen : 0.0;
  out.rms_m = sums.explained > 0 ? std::sqrt(sums.squares / sums.explained) : 0.0;
  out.is_valid = sums.explained >= kExplainedLeast;
  return out;
}

Eigen::Matrix3d less_along(const Eigen::Matrix3d& information, const Eigen::Vector2d& direction, double most) {
  const Eigen::Vector3d d(direction.x(), direction.y(), 0.0), held = information * d;
  const double along = d.dot(held);
  if (!(along > most)) return information;
  return information - held * held.transpose() * ((along - most) / (along * along));
}

}  // namespace pose_wall::planar
