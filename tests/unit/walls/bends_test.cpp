// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: an upright wall of rough rock comes out upright and where it is though a heap stands out of its foot, an arch
// out of its top or, by a sensor that hardly looks up, a ledge out of the top of what is seen; a wall that is one plane
// is left whole, and of what is seen half a metre stays. Scenes are cast ray by ray. Does not prove it for voxels or
// bends along the road.

#include "engine/walls/fit/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/walls/fit/surface.hpp"
#include "support/ray_scene.hpp"
#include "support/rock.hpp"
#include "support/wall_profiles.hpp"

namespace pose_wall {
namespace {

using namespace test;

constexpr double kBentWall_m = 2.0;  // to the left, as in a road of 4 m
constexpr std::uint32_t kRuns = 10;
// Looks down past the foot of the wall, and up by 7 degrees: at 2 m it ends a quarter of a metre above itself.
const Lidar kLooksDown{-50.0, 7.0, 1.0, 0.35};

double heap(double z_m) {
  return z_m < -0.5 ? -0.4 * (z_m + 0.5) : 0.0;
}
// What hangs along the top of what a sensor sees that hardly looks up: pipes on brackets.
double ledge(double z_m) {
  return z_m > 0.1 ? (z_m < 0.3 ? z_m - 0.1 : 0.2) : 0.0;
}

constexpr double kNoise_m = 0.01;  // of a range, as the config says

struct Fitted {
  bool solved = false;
  double lean_rad = 0.0;
  double offset_m = 0.0;  // error at the sensor's height
  Heights heights{0.0, 0.0}, band{0.0, 0.0};
};

Fitted fitted(WallProfile profile, const Lidar& lidar, std::uint32_t seed) {
  Noise noise(seed);
  const Rock rock(0.05, 0.3, &noise);
  RayScene scene;
  scene.set_noise(kNoise_m);
  scene.add(test::side_panel(kBentWall_m, {-16.0, 16.0}, {kFloorZ_m, 2.0}));
  scene.set_relief(kBentWall_m, [&](const Eigen::Vector3d& p) { return -rock.at(p.x(), p.z()) - profile(p.z()); });
  BandFixture band({{"range_noise", "0.01"}});
  scene.scan(lidar, &band);
  const WallScene walls = band.scene();
  test::Placed<WallGrid> grid;
  test::Placed<WallFitScratch> scratch(band.points().set().capacity());
  const Plane start{-Eigen::Vector3d::UnitY(), kBentWall_m};
  const WallSurface surface = fit_surface(walls, start, grid.get(), scratch.get());
  Fitted out;
  out.solved = surface.patch.solved;
  out.heights = surface.heights;
  out.band = {walls.z_min_level_m, walls.z_max_level_m};
  if (!out.solved) return out;
  out.lean_rad = lean_of(surface.plane());
  out.offset_m = surface.plane().signed_distance(Eigen::Vector3d::Zero()) - kBentWall_m;
  return out;
}

struct Summary {
  int top_cut = 0, foot_cut = 0;
  double worst_lean_rad = 0.0, worst_offset_m = 0.0, highest_m = -1e3;
};

Summary summary(WallProfile profile, const Lidar& lidar) {
  Summary out;
  for (std::uint32_t seed = 1; seed <= kRuns; ++seed) {
    const Fitted f = fitted(profile, lidar, seed);
    EXPECT_TRUE(f.solved) << seed;
    out.top_cut += f.heights.max_m < f.band.max_m ? 1 : 0;
    out.foot_cut += f.heights.min_m > f.band.min_m ? 1 : 0;
    out.worst_lean_rad = std::fmax(out.worst_lean_rad, std::fabs(f.lean_rad));
    out.highest_m = std::fmax(out.highest_m, f.heights.max_m);
    out.worst_offset_m = std::fmax(out.worst_offset_m, std::fabs(f.offset_m));
  }
  return out;
}

constexpr double kDegree = M_PI / 180.0;

TEST(WallBends, AWallThatIsOnePlaneIsLeftWhole) {
  for (const Lidar& lidar : {test::kOs0, kLooksDown}) {
    const Summary s = summary(plain_wall, lidar);
    EXPECT_EQ(s.top_cut, 0);
    EXPECT_EQ(s.foot_cut, 0);
    EXPECT_LE(s.worst_lean_rad, 1.5 * kDegree);
  }
}

TEST(WallBends, AnArchLosesItsTop) {
  const Summary s = summary(arched_wall, test::kOs0);
  EXPECT_EQ(s.top_cut, static_cast<int>(kRuns));
  EXPECT_EQ(s.foot_cut, 0);
  EXPECT_LE(s.worst_lean_rad, 2.0 * kDegree);
  EXPECT_LE(s.worst_offset_m, 0.02);
}

TEST(WallBends, AHeapLosesItsFoot) {
  for (const Lidar& lidar : {test::kOs0, kLooksDown}) {
    const Summary s = summary(heap, lidar);
    EXPECT_EQ(s.top_cut, 0);
    EXPECT_EQ(s.foot_cut, static_cast<int>(kRuns));
    EXPECT_LE(s.worst_lean_rad, 3.0 * kDegree);
    EXPECT_LE(s.worst_offset_m, 0.03);
  }
}

// Its upper half is that of what is seen, not of the band: above, there is nothing.
TEST(WallBends, WhatHangsAtTheTopOfWhatIsSeenIsCutOff) {
  const Summary s = summary(ledge, kLooksDown);
  EXPECT_EQ(s.top_cut, static_cast<int>(kRuns));
  EXPECT_LE(s.highest_m, 0.35) << "seen to half a metre, it loses a quarter";
  EXPECT_EQ(s.foot_cut, 0);
  EXPECT_LE(s.worst_lean_rad, 3.0 * kDegree);
  EXPECT_LE(s.worst_offset_m, 0.03);
}

// All of it bends: there is no end that could be cut off.
double barrel(double z_m) {
  return 0.25 * z_m * z_m;
}

TEST(WallBends, HalfAMetreStays) {
  for (const Lidar& lidar : {test::kOs0, kLooksDown}) {
    for (std::uint32_t seed = 1; seed <= kRuns; ++seed) {
      const Fitted f = fitted(barrel, lidar, seed);
      EXPECT_TRUE(!f.solved || f.heights.max_m - f.heights.min_m >= 0.5) << seed;
    }
  }
}

}  // namespace
}  // namespace pose_wall
