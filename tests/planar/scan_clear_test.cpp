// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/scan/clear.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "planar/scan_scenes.hpp"

namespace {

using namespace pose_wall::planar;
using pose_wall::test::SceneDraw;

ClearScene scene_of(double sensor_m) {
  ClearScene scene;
  scene.sensor_m = sensor_m;
  scene.tolerance_m = 0.05;
  scene.high_m = 1.9;
  scene.thing_m = 0.2;
  scene.reach_m = 10.0;
  return scene;
}

std::uint32_t slot_of(double tangent) {
  const double bent = tangent / (std::fabs(tangent) + kSlotBend);
  return static_cast<std::uint32_t>((bent + 1.0) * (kSlots / 2));
}

void add(double tangent, SectorRays* rays) {
  const std::uint32_t slot = slot_of(tangent);
  rays->word[slot / 32] |= 1U << slot % 32;
}

ClearRange clear_of(const std::vector<double>& tangents, const ClearScene& scene) {
  static const SlotEdges edges;
  SectorRays rays{};
  for (const double t : tangents) add(t, &rays);
  CloseSlots close;
  return clear_range(rays, scene, edges, &close);
}

std::vector<double> even(double low, double high, double step) {
  std::vector<double> out;
  for (double t = low; t <= high; t += step) out.push_back(t);
  return out;
}

TEST(ScanClear, EdgesOfSlotsEncloseTheirTangents) {
  const SlotEdges edges;
  SceneDraw draw(3);
  for (int i = 0; i < 10000; ++i) {
    const double t = draw.between(-3.0, 3.0);
    const std::uint32_t slot = slot_of(t);
    EXPECT_LE(edges.tangent[slot], t + 1e-12);
    EXPECT_GE(edges.tangent[slot + 1], t - 1e-12);
  }
}

TEST(ScanClear, CloseRaysAreClearFromWhereTheLowestMeetsAThingOnTheFloor) {
  const ClearRange clear = clear_of(even(-0.4, 0.4, 0.005), scene_of(1.5));
  EXPECT_NEAR(clear.from_m, 1.3 / 0.4, 0.15);
  EXPECT_FLOAT_EQ(clear.to_m, 10.0F);
}

TEST(ScanClear, RingsOfTwoDegreesAreClearAsFarAsTheirDistanceAllows) {
  // 0.035 apart: 0.2 m at 5.7 m, less where the lower of two rays is on the floor
  std::vector<double> rings;
  for (int r = 0; r < 16; ++r) rings.push_back(std::tan((2.0 * r - 15.0) * M_PI / 180.0));
  const ClearRange none = clear_of(rings, scene_of(1.9));  // the lowest ring comes below 0.2 m too late
  EXPECT_GE(none.from_m, none.to_m);
  const ClearRange clear = clear_of(rings, scene_of(1.0));
  EXPECT_GT(clear.from_m, 0.8 / 0.268);
  EXPECT_LT(clear.from_m, clear.to_m);
  EXPECT_LT(clear.to_m, 0.2 / 0.035);
  const ClearRange larger = [&] {
    ClearScene scene = scene_of(1.5);
    scene.thing_m = 0.5;
    return clear_of(rings, scene);
  }();
  EXPECT_GT(larger.to_m, 8.0F);
}

TEST(ScanClear, OneLostRingEndsIt) {
  std::vector<double> rays = even(-0.4, 0.4, 0.005);
  ASSERT_FLOAT_EQ(clear_of(rays, scene_of(1.5)).to_m, 10.0F);
  // none between -0.05 and 0.01: 0.2 m fit at 3.3 m
  std::vector<double> with_gap;
  for (const double t : rays) {
    if (t < -0.05 || t > 0.01) with_gap.push_back(t);
  }
  const ClearRange none = clear_of(with_gap, scene_of(1.5));  // 0.2 m on the floor are seen from 3.25 m on only
  EXPECT_GE(none.from_m, none.to_m);
  const ClearRange near = clear_of(with_gap, scene_of(0.8));
  EXPECT_LT(near.from_m, near.to_m);
  EXPECT_LT(near.to_m, 0.2 / 0.06);
}

TEST(ScanClear, WithoutRaysAllAroundThereIsNone) {
  const auto has = [](const ClearRange& clear) { return clear.from_m < clear.to_m; };
  EXPECT_FALSE(has(clear_of({}, scene_of(1.5))));
  EXPECT_FALSE(has(clear_of({0.0}, scene_of(1.5))));
  EXPECT_FALSE(has(clear_of(even(0.0, 0.4, 0.005), scene_of(1.5))));    // nothing looks down
  EXPECT_FALSE(has(clear_of(even(-0.4, -0.1, 0.005), scene_of(1.2))));  // nothing looks up
}

TEST(ScanClear, AnUncertainTiltOfTheFloorEndsIt) {
  ClearScene scene = scene_of(1.5);
  scene.tilt_rad = 0.03;
  EXPECT_LE(clear_of(even(-0.4, 0.4, 0.003), scene).to_m, 0.15 / 0.03 + 1e-6);
}

// Whether a thing of the guarantee fits between the rays at this range: by trying all heights.
bool hides(const std::vector<double>& tangents, const ClearScene& s, double range_m) {
  for (double z0 = 0.0; z0 + s.thing_m <= s.high_m; z0 += 0.004) {
    bool seen = false;
    for (const double t : tangents) {
      const double z = s.sensor_m + t * range_m;
      // its return is told if it is higher than the floor may be
      seen = seen || (z > s.tolerance_m && z > z0 && z < z0 + s.thing_m);
    }
    if (!seen) return true;
  }
  return false;
}

TEST(ScanClear, NothingFitsBetweenRaysThatAreClear) {
  SceneDraw draw(11);
  int clear_cases = 0, points = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const ClearScene scene = scene_of(draw.between(0.3, 2.6));
    std::vector<double> tangents;
    const double step = draw.between(0.004, 0.05), low = draw.between(-0.9, -0.1), high = draw.between(-0.2, 0.9);
    const double lost = draw.below(2) == 0 ? 0.0 : 0.2;
    for (double t = low; t < high; t += step * draw.between(0.5, 1.5)) {
      if (draw.uniform() >= lost) tangents.push_back(t);
    }
    const ClearRange clear = clear_of(tangents, scene);
    if (!(clear.from_m < clear.to_m)) continue;
    ++clear_cases;
    for (int i = 0; i <= 10; ++i, ++points) {
      const double range_m =
          static_cast<double>(clear.from_m) +
          (static_cast<double>(clear.to_m) - static_cast<double>(clear.from_m)) * (0.001 + 0.0998 * i);
      ASSERT_FALSE(hides(tangents, scene, range_m)) << trial << " at " << range_m << " of " << clear.from_m << " to "
                                                    << clear.to_m << ", sensor " << scene.sensor_m;
    }
  }
  EXPECT_GT(clear_cases, 300);
}

}  // namespace
