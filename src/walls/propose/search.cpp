// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "walls/propose/search.hpp"

#include <cmath>

#include "base/estimation/mlesac.hpp"
#include "base/math/elementary.hpp"

namespace pose_wall {
namespace {

constexpr double kBaselineMin_m = 1.0;  // judgement, 2026-11-21: 5 cm of rock over a metre turn a draw by 3 degrees
constexpr std::uint32_t kDrawsPerIteration = 16;  // judgement, 2026-11-21: twice the floor's, as fewer draws pass
constexpr std::uint32_t kPointsMin = 30;          // judgement, 2026-11-21: fewer points of the band draw no wall
constexpr double kDrawSlack_deg = 5.0;            // judgement, 2026-11-21: past yaw_max_deg, for refinement moves them

}  // namespace

bool SameWall::operator()(const Plane& a, const Plane& b) const {
  constexpr double kReach_m = 3.0;  // judgement, 2026-11-21: compared beside the machine and so far along the road
  const double across_a = a.n.dot(view.side_level), across_b = b.n.dot(view.side_level);
  if (!(std::fabs(across_a) > 1e-3 && std::fabs(across_b) > 1e-3)) return false;
  for (const double s : {-kReach_m, 0.0, kReach_m}) {
    const Eigen::Vector3d p = s * view.along_level;
    const double lateral_a = -a.signed_distance(p) / across_a, lateral_b = -b.signed_distance(p) / across_b;
    if (!(std::fabs(lateral_a - lateral_b) <= apart_m)) return false;
  }
  return true;
}

WallLimits::WallLimits(double angle_max_rad, double lean_max_rad)
    : cos_angle_max(cosine(angle_max_rad)), cos_lean_max(cosine(lean_max_rad)) {}

bool may_be_wall(const Plane& plane, const SideView& view, const WallLimits& limits) {
  const double horizontal = std::sqrt(plane.n.x() * plane.n.x() + plane.n.y() * plane.n.y());
  if (!(horizontal >= limits.cos_lean_max)) return false;
  // The normal points to the machine: against the side, and the origin lies on its positive side.
  const double against_side = -plane.n.dot(view.side_level) / horizontal;
  return plane.d > 0.0 && against_side >= limits.cos_angle_max;
}

void WallSearch::lay_out(Arena& arena, std::uint32_t points_max) {
  side_ = arena.take<std::uint32_t>(points_max);
  subset_.lay_out(arena, kSubsetPoints);
}

void WallSearch::begin(const PointSet& band_level, const SideView& view, const Settings& settings, Random* random) {
  band_ = &band_level;
  settings_ = &settings;
  random_ = random;
  view_ = view;
  scored_ = 0;
  list_.clear();
  count_ = 0;
  const auto side_x = static_cast<float>(view.side_level.x()), side_y = static_cast<float>(view.side_level.y());
  for_each_four_points(band_level, [&](std::uint32_t i, FourFloats x, FourFloats y, FourFloats, FourTruths counts) {
    const FourTruths here = counts & (side_x * x + side_y * y > FourFloats{});
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (here[lane] != 0) side_[count_++] = i + lane;
    }
  });
  subset_.count = count_ < kPointsMin ? 0 : kSubsetPoints;
  for (std::uint32_t k = 0; k < subset_.count; ++k) {
    const std::uint32_t i = side_[random->below(count_)];
    subset_.x[k] = band_level.x[i];
    subset_.y[k] = band_level.y[i];
    subset_.z[k] = band_level.z[i];
  }
}

void WallSearch::offer(const Plane& plane) {
  if (subset_.count == 0) return;
  list_.offer({plane, truncated_cost(subset_, plane, settings_->wall_ransac_thresh, list_.too_much())},
              SameWall{view_});
  ++scored_;
}

bool WallSearch::draw_plane(const WallLimits& limits, Plane* plane) {
  const Eigen::Vector3d a = band_->at(side_[random_->below(count_)]);
  const Eigen::Vector3d b = band_->at(side_[random_->below(count_)]);
  const Eigen::Vector3d along(b.x() - a.x(), b.y() - a.y(), 0.0);
  const double baseline = std::sqrt(along.squaredNorm());
  if (!(baseline >= kBaselineMin_m)) return false;
  plane->n = Eigen::Vector3d(along.y() / baseline, -along.x() / baseline, 0.0);
  plane->d = -plane->n.dot(a);
  if (plane->d < 0.0) *plane = plane->flipped();
  return may_be_wall(*plane, view_, limits);
}

void WallSearch::draw() {
  if (subset_.count == 0) return;
  const WallLimits limits(radians(settings_->yaw_max_deg + kDrawSlack_deg), radians(settings_->wall_lean_max_deg));
  const std::uint32_t draws = settings_->wall_iterations * kDrawsPerIteration;
  for (std::uint32_t draw = 0; draw < draws && scored_ < settings_->wall_iterations; ++draw) {
    Plane plane;
    if (draw_plane(limits, &plane)) offer(plane);
  }
}

void WallSearch::offer_offsets(const Eigen::Vector3d& normal_level) {
  constexpr std::uint32_t kBins = 640;  // 32 m, as far as the wall's grid
  constexpr double kBin_m = 0.05;       // the inlier threshold's default
  constexpr int kPeaks = 4;  // judgement, 2026-11-21: the wall, what stands before it, behind it, and one more
  constexpr std::uint32_t kApart = 3;  // bins between peaks: 15 cm, as SameWall::kApart_m
  const double flat = std::sqrt(normal_level.x() * normal_level.x() + normal_level.y() * normal_level.y());
  if (!(flat > 0.5)) return;
  Plane plane;
  plane.n = Eigen::Vector3d(normal_level.x() / flat, normal_level.y() / flat, 0.0);
  if (plane.n.dot(view_.side_level) > 0.0) plane.n = -plane.n;
  std::uint32_t bins[kBins] = {};
  for (std::uint32_t k = 0; k < count_; ++k) {
    const double distance = -plane.n.dot(band_->at(side_[k]));
    if (distance >= 0.0 && distance < kBins * kBin_m) ++bins[static_cast<std::uint32_t>(distance / kBin_m)];
  }
  for (int peak = 0; peak < kPeaks; ++peak) {
    std::uint32_t best = 0;
    for (std::uint32_t b = 1; b < kBins; ++b) {
      if (bins[b] > bins[best]) best = b;
    }
    if (bins[best] == 0) return;
    plane.d = (static_cast<double>(best) + 0.5) * kBin_m;
    offer(plane);
    const std::uint32_t from = best > kApart ? best - kApart : 0;
    for (std::uint32_t b = from; b <= best + kApart && b < kBins; ++b) bins[b] = 0;
  }
}

}  // namespace pose_wall
