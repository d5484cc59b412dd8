// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the map of surfaces says what was put into it, the fit finds a pose, and patches tell places apart.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "place/slide.hpp"
#include "planar/gates.hpp"
#include "planar/localise/surroundings.hpp"

namespace pose_wall::planar {
namespace {

// A map and surroundings in one dirty block.
class Opened {
 public:
  explicit Opened(std::uint32_t tiles_most = 64) {
    Arena measure(nullptr);
    map_.lay_out(measure, tiles_most);
    around_.lay_out(measure);
    const std::uint64_t bytes = measure.bytes();
    block_.reset(static_cast<unsigned char*>(std::aligned_alloc(64, (bytes + 63) / 64 * 64)));
    std::memset(block_.get(), 0xA5, bytes);
    Arena arena(block_.get());
    map_.lay_out(arena, tiles_most);
    around_.lay_out(arena);
    map_.open();
  }
  PlaceMap& map() { return map_; }
  Surroundings& around() { return around_; }

 private:
  struct Free {
    void operator()(unsigned char* p) const { std::free(p); }
  };
  std::unique_ptr<unsigned char, Free> block_;
  PlaceMap map_;
  Surroundings around_;
};

// Walls at y = 2.5 and -2.5 with bumps, from x = first to last, seen from the origin.
std::vector<ScanPoint> road(double first_m, double last_m, double bump_m) {
  std::vector<ScanPoint> out;
  for (double x = first_m; x < last_m; x += 0.05) {
    const double relief = bump_m * (std::sin(3.1 * x) + std::sin(1.3 * x * x / 4.0));
    out.push_back({static_cast<float>(x), static_cast<float>(2.5 + relief)});
    out.push_back({static_cast<float>(x), static_cast<float>(-2.5 + bump_m * std::cos(2.3 * x + 0.4 * std::sin(x)))});
  }
  return out;
}

Span<const ScanPoint> span_of(std::vector<ScanPoint>& points) {
  return Span<const ScanPoint>(points.data(), static_cast<std::uint32_t>(points.size()));
}

TEST(LocaliseMap, HoldsSurfacesAndWhatWasSeen) {
  Opened opened;
  std::vector<ScanPoint> points = road(-8, 8, 0.0);
  ASSERT_TRUE(opened.map().add(span_of(points), {100.0, -40.0, 0.0}));
  opened.map().finish();
  const Eigen::Vector2d at = Eigen::Vector2d(100.0, -40.0) - opened.map().middle_m();
  const Surface* const wall = opened.map().near(at.x() + 1.0, at.y() + 2.4);
  ASSERT_NE(wall, nullptr);
  EXPECT_NEAR(wall->y_m, at.y() + 2.5, 1e-3);
  EXPECT_NEAR(std::abs(wall->normal_y), 1.0, 1e-3);
  EXPECT_LT(wall->across_m2, 1e-6F);
  EXPECT_TRUE(opened.map().is_surface(at.x() + 1.0, at.y() + 2.5));
  EXPECT_FALSE(opened.map().is_surface(at.x() + 1.0, at.y()));
  EXPECT_TRUE(opened.map().is_seen(at.x() + 1.0, at.y() + 1.0));
  EXPECT_FALSE(opened.map().is_seen(at.x() + 1.0, at.y() + 4.0));
  EXPECT_EQ(opened.map().near(at.x() + 1.0, at.y() + 1.0), nullptr);
  EXPECT_EQ(opened.map().near(std::nan(""), 0.0), nullptr);
  EXPECT_EQ(opened.map().near(1e9, 0.0), nullptr);
  EXPECT_FALSE(opened.map().is_seen(0.0, -1e9));
}

TEST(LocaliseMap, FullMapSaysSo) {
  Opened opened(16);
  std::vector<ScanPoint> points = road(-8, 8, 0.0);
  bool fits = true;
  for (int k = 0; k < 20; ++k) fits = opened.map().add(span_of(points), {15.0 * k, 0.0, 0.0}) && fits;
  EXPECT_FALSE(fits);
  EXPECT_LE(opened.map().tiles(), 16U);
  opened.map().finish();
  EXPECT_FALSE(opened.map().add(span_of(points), {1e7, 0.0, 0.0}));  // outside the square
}

TEST(LocaliseFit, FindsAPoseAndPatchesTellPlacesApart) {
  Opened opened;
  std::vector<ScanPoint> points = road(-8, 8, 0.08);
  opened.map().add(span_of(points), {0.0, 0.0, 0.0});
  opened.map().finish();
  Surroundings& around = opened.around();
  std::vector<ScanPoint> scan = road(-5, 5, 0.08);
  around.take(span_of(scan), {0.0, 0.0}, 0.02);
  EXPECT_GT(around.patches, 18U);
  const Fit fit = fit_pose(opened.map(), around.points, {0.1, -0.08, 0.03}, {0.05});
  EXPECT_NEAR(fit.pose.x_m, 0.0, 0.01);
  EXPECT_NEAR(fit.pose.y_m, 0.0, 0.005);
  EXPECT_NEAR(fit.pose.yaw_rad, 0.0, 0.002);
  EXPECT_GT(fit.explained, 0.95);
  PatchCosts right, wrong;
  const PatchVerdict here = judge_patches(opened.map(), around, fit.pose, &right);
  Pose2 shifted = fit.pose;
  shifted.x_m += 1.0;
  const PatchVerdict there = judge_patches(opened.map(), around, shifted, &wrong);
  EXPECT_GT(here.fits, 0.95);
  EXPECT_LT(there.fits, 0.7);
  EXPECT_GT(worse_by(around, right, wrong), 3.0);
  EXPECT_EQ(worse_by(around, right, right), 0.0);
  EXPECT_LE(slide_of(opened.map(), around, fit, limit_of<gate::EXCLUDED>(), kRefit).reach_m, 0.4);
}

TEST(LocaliseFit, SmoothWallsSlide) {
  Opened opened;
  std::vector<ScanPoint> points = road(-12, 12, 0.0);
  opened.map().add(span_of(points), {0.0, 0.0, 0.0});
  opened.map().finish();
  Surroundings& around = opened.around();
  std::vector<ScanPoint> scan = road(-5, 5, 0.0);
  around.take(span_of(scan), {0.0, 0.0}, 0.02);
  const Fit fit = fit_pose(opened.map(), around.points, Pose2(), {0.02});
  const Slide slid = slide_of(opened.map(), around, fit, limit_of<gate::EXCLUDED>(), kRefit);
  EXPECT_EQ(slid.reach_m, 3.2);
  EXPECT_NEAR(std::abs(slid.direction.x()), 1.0, 1e-2);
}

TEST(LocaliseFit, LinesOfSightThroughWallsCount) {
  Opened opened;
  std::vector<ScanPoint> points = road(-8, 8, 0.0);
  opened.map().add(span_of(points), {0.0, 0.0, 0.0});
  opened.map().finish();
  std::vector<ScanPoint> inside = road(-6, 6, 0.0), wide = inside;
  for (ScanPoint& point : wide) point.y_m *= 2.0F;  // a road of 10 m
  opened.around().take(span_of(inside), {0.0, 0.0}, 0.02);
  EXPECT_LT(seen_through(opened.map(), opened.around(), Pose2()), 0.05);
  opened.around().take(span_of(wide), {0.0, 0.0}, 0.02);
  EXPECT_GT(seen_through(opened.map(), opened.around(), Pose2()), 0.8);
}

}  // namespace
}  // namespace pose_wall::planar
