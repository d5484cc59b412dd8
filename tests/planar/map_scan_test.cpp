// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <gtest/gtest.h>

#include <ios>

#include "base/math/crc32.hpp"
#include "opened_map.hpp"

namespace {

using pose_wall::kPi;
using pose_wall::Random;
using namespace pose_wall::planar::test;

constexpr std::uint32_t kUnknown = POSE_WALL_PLANAR_CELL_UNKNOWN, kFree = POSE_WALL_PLANAR_CELL_FREE,
                        kThing = POSE_WALL_PLANAR_CELL_THING;

TEST(MapScan, ABeamFreesItsWayAndEndsAtAThingWithNothingKnownBesideIt) {
  const OpenedMap map;
  const auto beam = one_beam(2.02F);
  for (int k = 0; k < 3; ++k) map.insert(beam->scan, {0.01, 0.01, 0.0});
  for (double x = 0.01; x < 1.90; x += 0.05) EXPECT_EQ(map.state(x, 0.01), kFree) << x;
  EXPECT_EQ(map.state(2.03, 0.01), kThing);
  EXPECT_EQ(map.state(1.98, 0.01), kUnknown);  // just before it
  EXPECT_EQ(map.state(2.08, 0.01), kUnknown);  // behind it
  EXPECT_EQ(map.state(1.0, 0.06), kUnknown);   // to the left
  EXPECT_EQ(map.state(-0.04, 0.01), kUnknown);
  EXPECT_GT(map.cell(2.03, 0.01).probability, 0.65);
  EXPECT_LT(map.cell(1.0, 0.01).probability, 0.35);
  EXPECT_TRUE(std::isnan(map.cell(1.0, 0.06).probability));
}

TEST(MapScan, OneBeamThroughACellDoesNotMakeItFree) {
  const OpenedMap map;
  map.insert(one_beam(2.02F)->scan, {0.01, 0.01, 0.0});
  EXPECT_EQ(map.state(1.0, 0.01), kUnknown);
  EXPECT_NEAR(map.cell(1.0, 0.01).probability, 0.4, 0.02);
}

TEST(MapScan, AnOpenBeamFreesAllUpToItsRangeAndAnUnknownOneNothing) {
  const OpenedMap map;
  const auto open = one_beam(std::numeric_limits<float>::infinity());
  open->scan.range_max_m = 10.0;
  for (int k = 0; k < 2; ++k) map.insert(open->scan, {0.01, 0.01, 0.0});
  EXPECT_EQ(map.state(9.9, 0.01), kFree);
  EXPECT_EQ(map.state(10.1, 0.01), kUnknown);
  EXPECT_EQ(map.box().things, 0U);
  const OpenedMap other;
  for (const float none : {0.0F, std::nanf(""), -1.0F, 31.0F}) other.insert(one_beam(none)->scan, {0.01, 0.01, 0.0});
  EXPECT_EQ(other.box().cells_seen, 0U);
  EXPECT_EQ(other.box().tiles, 0U);
}

TEST(MapScan, ThingsBeyondBeamMaxAreNoThingsAndTheWayIsFreeUpToThere) {
  auto settings = map_settings();
  settings.beam_max_m = 5.0;
  const OpenedMap map(settings);
  for (int k = 0; k < 2; ++k) map.insert(one_beam(8.0F)->scan, {0.01, 0.01, 0.0});
  EXPECT_EQ(map.state(4.9, 0.01), kFree);
  EXPECT_EQ(map.state(5.2, 0.01), kUnknown);
  EXPECT_EQ(map.box().things, 0U);
}

TEST(MapScan, WithinAScanAThingWinsOverAFreeBeamAndEachCellCountsOnce) {
  const OpenedMap map;
  std::vector<float> ranges(40, 6.0F);  // nearly along x; the first meets a thing that the others pass through
  ranges[0] = 2.02F;
  DrawnScan scan(std::move(ranges));
  scan.scan.angle_min_rad = 0.0;
  scan.scan.angle_step_rad = 1e-4;
  map.insert(scan.scan, {0.01, 0.01, 0.0});
  EXPECT_EQ(map.state(2.03, 0.01), kThing);
  EXPECT_NEAR(map.cell(1.0, 0.01).probability, 0.4, 0.02);  // as of one miss
}

TEST(MapScan, ProbabilitiesStayWithinTheirLimits) {
  const OpenedMap map;
  for (int k = 0; k < 300; ++k) map.insert(one_beam(2.02F)->scan, {0.01, 0.025, 0.0});
  EXPECT_NEAR(map.cell(2.03, 0.01).probability, 0.97, 0.005);
  EXPECT_NEAR(map.cell(1.0, 0.01).probability, 0.12, 0.005);
  for (int k = 0; k < 8; ++k) map.insert(one_beam(4.0F)->scan, {0.01, 0.025, 0.0});
  EXPECT_NE(map.state(2.03, 0.01), kThing);  // what went away is gone within a second of scans
}

TEST(MapScan, ABeamBesideTheMiddleOfACellLeavesAThingAndFreesTheRest) {
  const OpenedMap map;
  for (int k = 0; k < 5; ++k) map.insert(one_beam(2.02F)->scan, {0.01, 0.025, 0.0});
  for (int k = 0; k < 100; ++k) map.insert(one_beam(4.0F)->scan, {0.01, 0.045, 0.0});
  EXPECT_EQ(map.state(2.03, 0.03), kThing);
  EXPECT_EQ(map.state(1.93, 0.03), kFree);
  EXPECT_EQ(map.state(2.13, 0.03), kFree);
}

TEST(MapScan, PosesTurnAndShiftTheScanAndTheSensorStandsInBase) {
  const OpenedMap map;
  auto beam = one_beam(2.0F);
  beam->scan.sensor = {1.0, 0.5, kPi / 2.0};
  map.insert(beam->scan, {10.0, -20.0, kPi});
  // base looks to -x: the sensor at (9, -20.5) looks to -y.
  EXPECT_EQ(map.state(9.001, -22.499), kThing);
  const pose_wall_planar_box box = map.box();
  EXPECT_NEAR(box.y_min_m, -22.5, 0.051);
  EXPECT_NEAR(box.y_max_m, -20.5, 0.051);
}

// What a dense scan leaves out near the sensor, others have freed: nothing is freed that no beam crossed, and hardly a
// cell is missed.
TEST(MapScan, BeamsThatShareCellsAreTracedOnceAndMissNothing) {
  Random random(5);
  const auto road = rough_road(40.0, 5.0, 0.3, 3);
  const pose_wall_planar_pose pose{20.0, 0.2, 0.1};
  const auto scan = drawn_scan(road, pose, 6283, 0.0, &random);
  auto settings = map_settings();
  settings.tiles = 256;
  const OpenedMap map(settings);
  map.insert(scan->scan, pose);
  std::uint32_t missed = 0, inside = 0;
  for (std::uint32_t k = 0; k < 20000; ++k) {
    const double x = 10.0 + 0.001 * random.below(20000), y = -2.0 + 0.001 * random.below(4000);
    if (std::hypot(x - pose.x_m, y - pose.y_m) >
        0.8 * range_to(road, pose.x_m, pose.y_m, std::atan2(y - pose.y_m, x - pose.x_m))) {
      continue;
    }
    ++inside;
    missed += std::isnan(map.cell(x, y).probability) ? 1U : 0U;
  }
  EXPECT_GT(inside, 10000U);
  EXPECT_EQ(missed, 0U);
}

struct Wear {
  std::uint32_t pieces = 0, worn = 0;
};

// Pieces of rock, seen from the front, that have no thing within a cell and a half.
Wear wear_of(const OpenedMap& map, const std::vector<Line>& road, double x_min, double x_max) {
  Wear wear;
  for (const Line& line : road) {
    for (double t = 0.125; t < 1.0; t += 0.25) {
      const double x = line.x0 + t * (line.x1 - line.x0), y = line.y0 + t * (line.y1 - line.y0);
      if (x < x_min || x > x_max) continue;
      ++wear.pieces;
      wear.worn += map.cell(x, y).distance_m > 0.075 ? 1U : 0U;
    }
  }
  return wear;
}

// A sensor drives along a smooth wall and rough ones, and beams graze them all the time. Then it stands for 300 scans
// and sees all that lies behind it from far off and flat. Walls stay walls.
TEST(MapScan, GrazingBeamsDoNotWearWallsAway) {
  for (const double rough_m : {0.0, 0.1, 0.4}) {
    for (const std::uint32_t beams : {360U, 1440U}) {
      Random random(21);
      const auto road = rough_road(24.0, 5.0, rough_m, 9);
      auto settings = map_settings();
      settings.tiles = 256;
      const OpenedMap map(settings);
      const auto insert_at = [&](double x) {
        const pose_wall_planar_pose pose{x, 0.4 * std::sin(0.5 * x), 0.1 * std::sin(x)};
        const pose_wall_planar_pose measured{x + 0.01 * noise(&random), pose.y_m + 0.01 * noise(&random),
                                             pose.yaw_rad + 0.002 * noise(&random)};
        map.insert(drawn_scan(road, pose, beams, 0.02, &random)->scan, measured);
      };
      for (double x = 1.0; x < 23.0; x += 0.2) insert_at(x);
      const Wear driven = wear_of(map, road, 3.0, 21.0);
      for (double x = 3.0; x < 21.0; x += 0.31) EXPECT_EQ(map.state(x, 0.3), kFree) << x;
      for (int k = 0; k < 300; ++k) insert_at(22.5);
      const Wear stood = wear_of(map, road, 3.0, 21.0);
      EXPECT_LE(driven.worn, driven.pieces / 100) << rough_m << " m rough, " << beams << " beams";
      EXPECT_LE(stood.worn, stood.pieces / 25) << rough_m << " m rough, " << beams << " beams";
      expect_true_distances(map.inner(), 29);
    }
  }
}

// A person stood there and went away: the cells become free again, those of the wall behind do not.
TEST(MapScan, APersonWhoLeavesVanishesAndTheWallBehindStays) {
  Random random(33);
  auto road = rough_road(20.0, 5.0, 0.1, 4);
  const OpenedMap map;
  const pose_wall_planar_pose pose{10.0, 0.0, 0.0};
  auto with_person = road;
  with_person.push_back({11.9, 0.8, 12.3, 0.8});
  for (int k = 0; k < 20; ++k) map.insert(drawn_scan(with_person, pose, 720, 0.01, &random)->scan, pose);
  EXPECT_LT(map.cell(12.1, 0.8).distance_m, 0.075);
  for (int k = 0; k < 20; ++k) map.insert(drawn_scan(road, pose, 720, 0.01, &random)->scan, pose);
  EXPECT_GT(map.cell(12.1, 0.8).distance_m, 0.5);
  EXPECT_EQ(map.state(12.1, 0.8), kFree);
  EXPECT_LT(map.cell(12.1, 2.45).distance_m, 0.11);
  expect_true_distances(map.inner(), 7);
}

// Of a drive along a rough road, with people's worth of noise: on every machine.
TEST(MapScan, TheSameScansGiveTheSameBytes) {
  for (int run = 0; run < 2; ++run) {
    Random random(3);
    const auto road = rough_road(20.0, 5.0, 0.2, 2);
    const OpenedMap map;
    for (double x = 2.0; x < 18.0; x += 0.5) {
      const pose_wall_planar_pose pose{x, 0.1 * x - 1.0, 0.03 * x};
      map.insert(drawn_scan(road, pose, 360, 0.02, &random)->scan, pose);
    }
    pose_wall::BulkCrc32 crc;
    const auto bytes = map.saved();
    crc.add(bytes.data(), bytes.size());
    pose_wall_planar_ray ray{};
    ray.struct_size = sizeof(ray);
    double ranges_m = 0.0;
    for (int k = 0; k < 300; ++k) {
      const pose_wall_planar_pose pose{6.0 + 0.02 * k, 0.1, 0.02 * k};
      ASSERT_EQ(pose_wall_planar_map_ray(map.get(), &pose, 0.01 * k, 20.0, 1, &ray), POSE_WALL_OK);
      ranges_m += ray.range_m;
    }
    EXPECT_EQ(crc.value(), 0x6522DF69U) << std::hex << crc.value();
    EXPECT_EQ(ranges_m, 0x1.b670ba598341ap+10) << std::hexfloat << ranges_m;
  }
}

}  // namespace
