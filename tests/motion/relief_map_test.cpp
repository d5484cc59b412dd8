// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the map gives back a tilted plane and the rock about it to a millimetre, in any place, also behind zero and
// ten kilometres away; between cells it interpolates, at a step anything between the two sides agrees; it knows what
// the road goes on behind, and from where each surface was seen; it forgets what it is told to forget; full, it gives
// up what was seen longest ago and nothing else; lines of rays over rough ground tilt no tile.

#include "motion/relief_map.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "motion/boxes.hpp"

namespace pose_wall::motion::test {
namespace {

constexpr int kU[] = {1, 0, 0}, kV[] = {2, 2, 1};

class Map : public ::testing::Test {
 protected:
  Map() { map_->clear(); }

  Eigen::Vector3f at(std::uint8_t facing, double u, double v, double height) const {
    Eigen::Vector3d p;
    p[facing] = height, p[kU[facing]] = u, p[kV[facing]] = v;
    return (p - map_->corner()).cast<float>();
  }
  // A surface, a point every 1.25 cm in both directions.
  void add(std::uint8_t facing, double u0, double u1, double v0, double v1,
           const std::function<double(double, double)>& height) {
    map_->begin_keyframe(sensor_);
    for (double u = u0 + 0.00625; u < u1; u += 0.0125) {
      for (double v = v0 + 0.00625; v < v1; v += 0.0125) map_->add(at(facing, u, v, height(u, v)), facing);
    }
    map_->end_keyframe();
  }
  // How far a point is from the rock that the map knows; infinite where it knows none.
  double above_rock(std::uint8_t facing, double u, double v, double height) const {
    Surface surface;
    Relief relief;
    if (!map_->find(at(facing, u, v, height), facing, &surface)) return INFINITY;
    if (!ReliefMap::relief(surface, &relief)) return INFINITY;
    return static_cast<double>(surface.above_m - relief.height_m);
  }

  Laid<ReliefMap> map_;
  Eigen::Vector3d sensor_ = Eigen::Vector3d::Zero();  // of the scans that are added; it has to see their surfaces
};

TEST_F(Map, ATiltedPlaneToAMillimetreAnywhere) {
  const struct {
    double u, v, height;
  } places[] = {{0.0, 0.0, -1.4}, {-3.0, -2.0, 2.5}, {-10000.0, 5.0, 1.0}, {10000.0, -7.0, -0.5}, {3.0, 9999.0, 0.0}};
  for (const auto& place : places) {
    for (const std::uint8_t facing : {kFacesX, kFacesY, kFacesZ}) {
      map_->clear();
      Eigen::Vector3d middle;
      middle[facing] = place.height, middle[kU[facing]] = place.u, middle[kV[facing]] = place.v;
      map_->set_corner(middle);
      sensor_ = middle;
      sensor_[facing] += 1.4;
      const auto plane = [&](double u, double v) { return place.height + 0.12 * (u - place.u) - 0.07 * (v - place.v); };
      add(facing, place.u, place.u + 3.0, place.v, place.v + 2.0, plane);
      EXPECT_GE(map_->tiles(), 6U);
      EXPECT_LE(map_->tiles(), 12U);
      for (double u = place.u + 0.11; u < place.u + 2.9; u += 0.17) {
        for (double v = place.v + 0.11; v < place.v + 1.9; v += 0.17) {
          Surface surface;
          ASSERT_TRUE(map_->find(at(facing, u, v, plane(u, v)), facing, &surface)) << u << " " << v;
          EXPECT_NEAR(static_cast<double>(surface.above_m), 0.0, 1e-3) << u << " " << v;
          Surface higher;
          ASSERT_TRUE(map_->find(at(facing, u, v, plane(u, v) + 0.1), facing, &higher));
          EXPECT_NEAR(static_cast<double>(higher.above_m), 0.1, 1e-3);
        }
      }
    }
  }
}

// Surfaces that face along, ten kilometres out: their heights are as fine as near.
TEST_F(Map, AFaceTenKilometresAwayIsAsExactAsANearOne) {
  const double far_m = 10000.3;
  map_->set_corner({far_m, 0.0, 0.0});
  add(kFacesX, 0.0, 1.0, 0.0, 1.0, [&](double u, double) { return far_m + 0.1 * u; });
  for (double u = 0.1; u < 0.95; u += 0.1) {
    EXPECT_NEAR(above_rock(kFacesX, u, 0.5, far_m + 0.1 * u + 0.05), 0.05, 1e-3) << u;
  }
}

TEST_F(Map, TheCornerMayMoveBetweenFrames) {
  const auto plane = [](double u, double) { return 0.05 * u; };
  sensor_ = {0.0, 0.0, 1.4};
  add(kFacesZ, 0.0, 2.0, 0.0, 2.0, plane);
  const double before = above_rock(kFacesZ, 1.3, 1.3, plane(1.3, 1.3) + 0.02);
  for (const double x : {40.0, -75.5, 100.0}) {
    map_->set_corner({x, -x, 3.0});
    EXPECT_NEAR(above_rock(kFacesZ, 1.3, 1.3, plane(1.3, 1.3) + 0.02), before, 1e-4) << x;
  }
}

TEST_F(Map, WavesOfTheRockAreInterpolatedAlong) {
  const auto wave = [](double u, double) { return 0.02 * std::sin(2.0 * M_PI * u / 0.6); };
  add(kFacesY, 0.0, 3.0, 0.0, 1.0, wave);
  double worst = 0.0;
  for (double u = 0.1; u < 2.9; u += 0.013) {
    const double off = std::fabs(above_rock(kFacesY, u, 0.55, wave(u, 0.0)));
    if (std::isfinite(off)) worst = std::max(worst, off);  // at a tile's end the map does not know
  }
  EXPECT_LT(worst, 0.002) << "a cell of 5 cm smoothes by 1 mm";
  EXPECT_GT(std::fabs(above_rock(kFacesY, 0.15, 0.55, wave(0.45, 0.0))), 0.03) << "half a wave on it does not fit";
}

TEST_F(Map, AtAStepAnythingBetweenItsSidesAgrees) {
  sensor_ = {0.5, 0.5, 1.4};
  add(kFacesZ, 0.0, 1.0, 0.0, 1.0, [](double u, double) { return u < 0.5 ? 0.0 : 0.2; });
  EXPECT_NEAR(above_rock(kFacesZ, 0.501, 0.5, 0.1), 0.0, 1e-6);
  EXPECT_NEAR(above_rock(kFacesZ, 0.501, 0.5, 0.05), 0.0, 1e-6);
  EXPECT_NEAR(above_rock(kFacesZ, 0.501, 0.5, 0.25), 0.05, 0.02) << "above both";
  EXPECT_NEAR(above_rock(kFacesZ, 0.3, 0.5, 0.1), 0.1, 0.01) << "away from it no";
}

TEST_F(Map, WhereNothingWasSeenItKnowsNothing) {
  add(kFacesZ, 0.0, 0.4, 0.0, 1.0, [](double, double) { return 0.0; });
  Surface surface;
  Relief relief;
  ASSERT_TRUE(map_->find(at(kFacesZ, 0.8, 0.5, 0.0), kFacesZ, &surface)) << "the tile's plane goes on";
  EXPECT_FALSE(ReliefMap::relief(surface, &relief)) << "but its rock does not";
  EXPECT_FALSE(map_->find(at(kFacesZ, 1.2, 0.5, 0.0), kFacesZ, &surface));
  EXPECT_FALSE(map_->find(at(kFacesZ, 0.2, 0.5, 0.4), kFacesZ, &surface)) << "another layer";
  EXPECT_FALSE(map_->find(at(kFacesZ, 0.2, 0.5, 0.0), kFacesX, &surface)) << "another facing";
}

TEST_F(Map, TwoSurfacesOneAboveTheOtherAreTwo) {
  map_->begin_keyframe(Eigen::Vector3d::Zero());
  for (double u = 0.01; u < 1.0; u += 0.02) {
    for (double v = 0.01; v < 1.0; v += 0.02) {
      map_->add(at(kFacesZ, u, v, 0.0), kFacesZ);
      map_->add(at(kFacesZ, u, v, 2.0), kFacesZ);
    }
  }
  map_->end_keyframe();
  EXPECT_EQ(map_->tiles(), 2U);
  EXPECT_NEAR(above_rock(kFacesZ, 0.5, 0.5, 0.03), 0.03, 1e-3);
  EXPECT_NEAR(above_rock(kFacesZ, 0.5, 0.5, 1.97), -0.03, 1e-3);
}

TEST_F(Map, WhatTheRoadGoesOnBehindStandsFree) {
  const auto stands_free = [this](std::uint8_t facing, double u, double v, double height) {
    Surface surface;
    EXPECT_TRUE(map_->find(at(facing, u, v, height), facing, &surface)) << u << " " << v << " " << height;
    return surface.tile->stands_free != 0;
  };
  const auto face = [this](std::uint8_t facing, double u0, double u1, double v0, double v1, double height) {
    for (double u = u0 + 0.01; u < u1; u += 0.05) {
      for (double v = v0 + 0.01; v < v1; v += 0.05) map_->add(at(facing, u, v, height), facing);
    }
  };
  map_->begin_keyframe({0.0, 0.0, 1.4});
  face(kFacesZ, -4.0, 6.0, -2.5, 2.5, 0.0);  // ground, roof, walls, and where the road ends
  face(kFacesZ, -4.0, 6.0, -2.5, 2.5, 3.5);
  face(kFacesY, -4.0, 6.0, 0.0, 3.5, 2.5);
  face(kFacesY, -4.0, 6.0, 0.0, 3.5, -2.5);
  face(kFacesX, -2.5, 2.5, 0.0, 3.5, 6.0);
  face(kFacesY, 2.3, 2.7, 0.0, 1.8, 1.7);  // somebody before the left wall, side and front
  face(kFacesX, 1.7, 2.2, 0.0, 1.8, 2.3);
  face(kFacesZ, -3.0, -2.0, -1.0, 0.0, 0.8);  // a box on the ground
  map_->end_keyframe();
  EXPECT_TRUE(stands_free(kFacesY, 2.5, 1.5, 1.7)) << "the wall is behind";
  EXPECT_TRUE(stands_free(kFacesX, 1.9, 1.5, 2.3)) << "the ground goes on behind";
  EXPECT_TRUE(stands_free(kFacesZ, -2.5, -0.5, 0.8)) << "the ground is below";
  EXPECT_FALSE(stands_free(kFacesY, 2.5, 1.5, 2.5));
  EXPECT_FALSE(stands_free(kFacesY, -3.5, 0.5, -2.5));
  EXPECT_FALSE(stands_free(kFacesX, 0.5, 1.5, 6.0));
  EXPECT_FALSE(stands_free(kFacesZ, -2.5, -0.5, 0.0));
  EXPECT_FALSE(stands_free(kFacesZ, 2.5, 0.5, 3.5));
}

TEST_F(Map, ATileKnowsFromWhereItWasSeen) {
  for (const double x : {0.5, 3.5}) {
    map_->begin_keyframe({x, 0.0, 0.5});
    for (double u = 0.01; u < 1.0; u += 0.05) {
      for (double v = 0.01; v < 1.0; v += 0.05) map_->add(at(kFacesY, u, v, 3.0), kFacesY);
    }
    map_->end_keyframe();
  }
  Surface surface;
  ASSERT_TRUE(map_->find(at(kFacesY, 0.5, 0.5, 3.0), kFacesY, &surface));
  EXPECT_NEAR(map_->seen_from(*surface.tile).x() + static_cast<float>(map_->corner().x()), 2.0F, 1e-4F)
      << "between both";
}

TEST_F(Map, ALaterScanAddsToTheMeanOfACell) {
  add(kFacesZ, 0.0, 1.0, 0.0, 1.0, [](double, double) { return 0.0; });
  add(kFacesZ, 0.0, 1.0, 0.0, 1.0, [](double, double) { return 0.01; });
  EXPECT_NEAR(above_rock(kFacesZ, 0.5, 0.5, 0.005), 0.0, 5e-4);
  EXPECT_EQ(map_->keyframes(), 2U);
  EXPECT_EQ(map_->tiles(), 1U);
}

TEST_F(Map, ForgottenReliefLeavesThePlanes) {
  const auto plane = [](double u, double) { return 0.1 * u; };
  add(kFacesZ, 0.0, 2.0, 0.0, 2.0, plane);
  const std::uint32_t tiles = map_->tiles();
  map_->forget_relief();
  Surface surface;
  Relief relief;
  ASSERT_TRUE(map_->find(at(kFacesZ, 1.5, 0.5, plane(1.5, 0.5)), kFacesZ, &surface));
  EXPECT_NEAR(static_cast<double>(surface.above_m), 0.0, 1e-3);
  EXPECT_FALSE(ReliefMap::relief(surface, &relief));
  EXPECT_EQ(map_->tiles(), tiles);
  EXPECT_EQ(map_->points(0, 0, nullptr), 0U);
}

TEST_F(Map, ClearedItIsEmpty) {
  add(kFacesZ, 0.0, 1.0, 0.0, 1.0, [](double, double) { return 0.0; });
  map_->clear();
  Surface surface;
  EXPECT_FALSE(map_->find(at(kFacesZ, 0.5, 0.5, 0.0), kFacesZ, &surface));
  EXPECT_EQ(map_->tiles(), 0U);
  EXPECT_EQ(map_->keyframes(), 0U);
  EXPECT_FALSE(map_->gave_way());
}

class FullMap : public Map {
 protected:
  // One tile a square metre along a line, near the corner so that it may be any length.
  void add_tile(int i) {
    map_->set_corner({static_cast<double>(i), 0.0, 0.0});
    map_->add(at(kFacesZ, i + 0.5, 0.5, 1.0), kFacesZ);
  }
  bool knows(int i) {
    map_->set_corner({static_cast<double>(i), 0.0, 0.0});
    Surface surface;
    return map_->find(at(kFacesZ, i + 0.5, 0.5, 1.0), kFacesZ, &surface);
  }
  void fill(int from, int to) {
    for (int i = from; i < to; ++i) {
      map_->begin_keyframe(Eigen::Vector3d::Zero());
      add_tile(i);
      map_->end_keyframe();
    }
  }
};

TEST_F(FullMap, WhatWasSeenLongestAgoGivesWay) {
  const int most = static_cast<int>(kTilesMost);
  fill(0, most);
  EXPECT_EQ(map_->tiles(), kTilesMost);
  EXPECT_FALSE(map_->gave_way());
  map_->begin_keyframe(Eigen::Vector3d::Zero());
  add_tile(0);  // seen again: the next oldest is 1
  map_->end_keyframe();
  fill(most, most + 100);
  EXPECT_TRUE(map_->gave_way());
  EXPECT_EQ(map_->tiles(), kTilesMost);
  EXPECT_TRUE(knows(0));
  for (int i = 1; i <= 100; ++i) EXPECT_FALSE(knows(i)) << i;
  for (int i = 101; i < most + 100; ++i) ASSERT_TRUE(knows(i)) << i;
}

TEST_F(FullMap, OneScanThatFillsItGivesUpNothingOfItself) {
  const int most = static_cast<int>(kTilesMost);
  map_->begin_keyframe(Eigen::Vector3d::Zero());
  for (int i = 0; i < most + 500; ++i) add_tile(i);
  map_->end_keyframe();
  EXPECT_EQ(map_->tiles(), kTilesMost);
  EXPECT_FALSE(map_->gave_way());
  for (int i = 0; i < most; ++i) ASSERT_TRUE(knows(i)) << i;
  for (int i = most; i < most + 500; ++i) EXPECT_FALSE(knows(i)) << i;
}

// Many times over: the chains of a bucket stay whole.
TEST_F(FullMap, ItKeepsGivingWay) {
  const int most = static_cast<int>(kTilesMost);
  fill(0, 4 * most);
  for (int i = 3 * most; i < 4 * most; ++i) ASSERT_TRUE(knows(i)) << i;
  for (int i = 0; i < 3 * most; i += 17) ASSERT_FALSE(knows(i)) << i;
}

TEST_F(Map, ItsPointsLieOnItsSurfacesAndComeInParts) {
  const auto plane = [](double u, double v) { return 0.1 * u - 0.05 * v; };
  add(kFacesY, -1.0, 1.0, 0.0, 1.0, plane);
  const std::uint32_t total = map_->points(0, 0, nullptr);
  ASSERT_GT(total, 300U);
  std::vector<float> all(3 * total, 1e9F), part(3 * 10, 1e9F);
  EXPECT_EQ(map_->points(0, total, all.data()), total);
  for (std::uint32_t i = 0; i < total; ++i) {
    EXPECT_NEAR(all[3 * i + 1], plane(all[3 * i], all[3 * i + 2]), 2e-3) << i;
  }
  EXPECT_EQ(map_->points(7, 10, part.data()), total);
  EXPECT_TRUE(std::equal(part.begin(), part.end(), all.begin() + 21));
  std::fill(part.begin(), part.end(), 1e9F);
  map_->points(total, 10, part.data());
  EXPECT_EQ(part[0], 1e9F);
  map_->points(0xFFFFFFF0U, 10, part.data());
  EXPECT_EQ(part[0], 1e9F);
  map_->points(total - 1, 10, part.data());
  EXPECT_EQ(part[0], all[3 * (total - 1)]);
  EXPECT_EQ(part[3], 1e9F);
}

// A sparse sensor drives over rough ground: each ring is one line in a tile. Where the ground stands out, a ray meets
// it sooner, so points of a line err along the ray. The tiles may not lean towards the sensor for it. (They did, by
// 0.04.)
TEST_F(Map, LinesOfRaysOverRoughGroundTiltNoTile) {
  const auto height = [](double x, double y) {
    return 0.02 * (std::sin(19.0 * x + 7.0 * y) + std::sin(13.0 * y - 5.0 * x + 1.0) + std::sin(23.0 * y + 11.0 * x));
  };
  double leans = 0.0, tiles = 0.0;
  for (int place = 0; place < 40; ++place) {
    map_->clear();
    const Eigen::Vector3d sensor(0.37 * place, 0.21 * place, 1.4);
    map_->begin_keyframe(sensor);
    for (const double down_deg : {9.0, 11.0, 13.0}) {
      for (double turn_rad = -0.6; turn_rad < 0.6; turn_rad += 0.0035) {
        const double down_rad = down_deg * M_PI / 180.0;
        const Eigen::Vector3d ray(std::cos(down_rad) * std::cos(turn_rad), std::cos(down_rad) * std::sin(turn_rad),
                                  -std::sin(down_rad));
        double range_m = 0.5 * sensor.z() / std::sin(down_rad);
        Eigen::Vector3d p = sensor + range_m * ray;
        for (; p.z() > height(p.x(), p.y()); p += 0.002 * ray) {
        }
        map_->add(at(kFacesZ, p.x(), p.y(), p.z()), kFacesZ);
      }
    }
    map_->end_keyframe();
    for (std::uint32_t k = 0; k < map_->tiles(); ++k) {
      const Tile& tile = map_->tile(k);
      const Eigen::Vector2d away = (Eigen::Vector2d(tile.u + 0.5, tile.v + 0.5) - sensor.head<2>()).normalized();
      leans += away.dot(Eigen::Vector2d(static_cast<double>(tile.slope_u), static_cast<double>(tile.slope_v)));
      tiles += 1.0;
    }
  }
  EXPECT_GT(tiles, 400.0);
  EXPECT_NEAR(leans / tiles, 0.0, 0.01) << "of " << tiles;
}

TEST_F(Map, UnevennessIsHowMuchTheSlopesDiffer) {
  sensor_ = {-3.0, 0.5, 1.4};
  add(kFacesZ, 0.0, 4.0, 0.0, 1.0, [](double u, double) { return 0.05 * u; });
  EXPECT_LT(map_->unevenness(), 1e-3) << "one slope is no unevenness";
  map_->clear();
  add(kFacesZ, 0.0, 2.0, 0.0, 1.0, [](double u, double) { return u < 1.0 ? 0.1 * u : 0.2 - 0.1 * u; });
  EXPECT_NEAR(map_->unevenness(), 0.1, 2e-3);
}

}  // namespace
}  // namespace pose_wall::motion::test
