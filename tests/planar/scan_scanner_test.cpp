// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "place/beams.hpp"
#include "planar/scan_scenes.hpp"
#include "planar/scanner_under_test.hpp"
#include "support/engine_under_test.hpp"
#include "support/sim_run.hpp"

namespace {

using namespace pose_wall::test;

constexpr std::int64_t kSecond_ns = 1000000000;

SeenScene seen_road(std::uint64_t seed = 1) {
  RoadScene road;
  road.noise_m = 0.01;
  return see(road, kScanVlp16, rays_of(kScanVlp16, 1), seed);
}

std::uint32_t things_of(const pose_wall_planar_scan& scan) {
  std::uint32_t things = 0;
  for (std::uint32_t b = 0; b < scan.beams; ++b) things += std::isfinite(scan.range_m[b]) ? 1U : 0U;
  return things;
}

TEST(ScanScanner, WithoutAFloorTheLastIsHeldForATimeAndThenNothingIsKnown) {
  const SeenScene seen = seen_road();
  ScannerUnderTest scanner(config_with());
  const pose_wall_planar_floor floor = level_floor();
  const auto at = [&](double time_s, const pose_wall_planar_floor* given) {
    scanner.process(cloud_of(seen.points, static_cast<std::int64_t>(time_s * 1e9)), given);
    return scanner.view().floor_state;
  };
  EXPECT_EQ(at(0.0, nullptr), static_cast<std::uint32_t>(POSE_WALL_PLANAR_FLOOR_NONE));
  EXPECT_EQ(things_of(scanner.scan()), 0U);
  EXPECT_TRUE(std::isnan(scanner.view().floor_age_s));
  EXPECT_TRUE(std::isnan(scanner.view().sensor_height_m));
  EXPECT_EQ(at(0.1, &floor), static_cast<std::uint32_t>(POSE_WALL_PLANAR_FLOOR_MEASURED));
  const std::uint32_t things = things_of(scanner.scan());
  EXPECT_GT(things, 3000U);
  EXPECT_EQ(scanner.view().floor_age_s, 0.0);
  EXPECT_EQ(at(0.5, nullptr), static_cast<std::uint32_t>(POSE_WALL_PLANAR_FLOOR_HELD));
  EXPECT_NEAR(scanner.view().floor_age_s, 0.4, 1e-9);
  EXPECT_LT(scanner.view().low_reach_m, 10.0);  // it may have turned by 0.02 rad since
  EXPECT_GT(things_of(scanner.scan()), things / 2);
  EXPECT_EQ(at(0.7, nullptr), static_cast<std::uint32_t>(POSE_WALL_PLANAR_FLOOR_NONE));
  EXPECT_EQ(at(0.3, nullptr), static_cast<std::uint32_t>(POSE_WALL_PLANAR_FLOOR_NONE));
  for (std::uint32_t b = 0; b < scanner.scan().beams; ++b) {
    EXPECT_TRUE(std::isnan(scanner.scan().range_m[b]));
    EXPECT_EQ(scanner.scan().free_m[b], 0.0F);
    EXPECT_TRUE(std::isnan(scanner.view().clear_m[b]));
  }
}

TEST(ScanScanner, StampsThatGoBackEndAHeldFloor) {
  const SeenScene seen = seen_road();
  ScannerUnderTest scanner(config_with());
  const pose_wall_planar_floor floor = level_floor();
  scanner.process(cloud_of(seen.points, 5 * kSecond_ns), &floor);
  scanner.process(cloud_of(seen.points, 5 * kSecond_ns - 1), nullptr);
  EXPECT_EQ(scanner.view().floor_state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_FLOOR_NONE));
  scanner.process(cloud_of(seen.points, std::numeric_limits<std::int64_t>::max()), &floor);
  scanner.process(cloud_of(seen.points, std::numeric_limits<std::int64_t>::min()), nullptr);
  EXPECT_EQ(scanner.view().floor_state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_FLOOR_HELD));  // a nanosecond on
}

TEST(ScanScanner, AFloorThatIsTooUncertainDoesNotCount) {
  const SeenScene seen = seen_road();
  ScannerUnderTest scanner(config_with());
  pose_wall_planar_floor floor = level_floor();
  floor.tilt_level_rad = 0.051;
  scanner.process(cloud_of(seen.points, 0), &floor);
  EXPECT_EQ(scanner.view().floor_state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_FLOOR_NONE));
  floor.tilt_level_rad = 0.01;
  scanner.process(cloud_of(seen.points, 1), &floor);
  EXPECT_EQ(scanner.view().floor_state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_FLOOR_MEASURED));
  EXPECT_EQ(pose_wall_planar_scanner_reset(scanner.get()), POSE_WALL_OK);
  scanner.process(cloud_of(seen.points, 2), nullptr);
  EXPECT_EQ(scanner.view().floor_state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_FLOOR_NONE));
}

// Beyond a degree the whole level counts as tilt, and a better floor of a moment ago is kept.
TEST(ScanScanner, AnUncertainFloorCountsWithItsWholeLevel) {
  const SeenScene seen = seen_road();
  ScannerUnderTest sure(config_with()), unsure(config_with());
  pose_wall_planar_floor floor = level_floor();
  sure.process(cloud_of(seen.points, 0), &floor);
  floor.tilt_level_rad = 0.03;
  unsure.process(cloud_of(seen.points, 0), &floor);
  EXPECT_EQ(unsure.view().floor_state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_FLOOR_MEASURED));
  EXPECT_LT(unsure.view().low_reach_m, sure.view().low_reach_m);
  sure.process(cloud_of(seen.points, 1), &floor);
  EXPECT_EQ(sure.view().floor_state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_FLOOR_HELD));
}

TEST(ScanScanner, ARefusedCallChangesNothing) {
  const SeenScene seen = seen_road();
  ScannerUnderTest scanner(config_with());
  const pose_wall_planar_floor floor = level_floor();
  scanner.process(cloud_of(seen.points, 0), &floor);
  const std::vector<float> before(scanner.scan().range_m, scanner.scan().range_m + scanner.scan().beams);
  pose_wall_cloud cloud = cloud_of(seen.points, 1);
  pose_wall_planar_scan scan{};
  scan.struct_size = sizeof(scan);
  pose_wall_planar_scan_view view{};
  view.struct_size = sizeof(view);
  const auto with = [&](const pose_wall_planar_floor& changed) {
    return pose_wall_planar_scanner_process(scanner.get(), &cloud, &changed, &scan, &view);
  };
  const auto floor_with = [&](auto change) {
    pose_wall_planar_floor changed = floor;
    change(changed);
    return with(changed);
  };
  const double nan = std::nan("");
  EXPECT_EQ(floor_with([&](auto& f) { f.normal[2] = nan; }), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(floor_with([](auto& f) { f.normal[2] = -1.0; }), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(floor_with([](auto& f) { f.normal[2] = 1.1; }), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(floor_with([&](auto& f) { f.height_m = nan; }), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(floor_with([&](auto& f) { f.tilt_sigma_rad = nan; }), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(floor_with([&](auto& f) { f.tilt_level_rad = nan; }), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(floor_with([&](auto& f) { f.reach_m = nan; }), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(floor_with([](auto& f) { f.struct_size = 8; }), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(pose_wall_planar_scanner_process(nullptr, &cloud, &floor, &scan, &view), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_planar_scanner_process(scanner.get(), nullptr, &floor, &scan, &view), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_planar_scanner_process(scanner.get(), &cloud, &floor, nullptr, &view), POSE_WALL_E_NULL);
  scan.struct_size = 4;
  EXPECT_EQ(with(floor), POSE_WALL_E_STRUCT_SIZE);
  scan.struct_size = sizeof(scan);
  view.struct_size = 4;
  EXPECT_EQ(with(floor), POSE_WALL_E_STRUCT_SIZE);
  view.struct_size = sizeof(view);
  cloud.data_bytes -= 1;
  EXPECT_EQ(with(floor), POSE_WALL_E_CLOUD_SIZE);
  EXPECT_EQ(scan.beams, 0U);
  EXPECT_EQ(std::memcmp(before.data(), scanner.scan().range_m, before.size() * sizeof(float)), 0);
  EXPECT_EQ(pose_wall_planar_scanner_process(scanner.get(), &cloud, nullptr, &scan, nullptr), POSE_WALL_E_CLOUD_SIZE);
}

TEST(ScanScanner, OpeningRefusesBadBlocksAndConfigs) {
  const pose_wall_config config = config_with();
  const pose_wall_planar_scanner_settings settings = scan_settings();
  AlignedBlock block(bytes_of(settings), Dirt::kRandom);
  pose_wall_planar_scanner* scanner = nullptr;
  const auto open = [&](const pose_wall_config* c, void* data, std::uint64_t bytes) {
    return pose_wall_planar_scanner_open(c, &settings, data, bytes, &scanner);
  };
  EXPECT_EQ(open(nullptr, block.data(), block.size()), POSE_WALL_E_NULL);
  EXPECT_EQ(open(&config, nullptr, block.size()), POSE_WALL_E_NULL);
  EXPECT_EQ(open(&config, block.data(), block.size() - 1), POSE_WALL_E_BLOCK_SMALL);
  EXPECT_EQ(open(&config, static_cast<char*>(block.data()) + 8, block.size()), POSE_WALL_E_BLOCK_ALIGN);
  EXPECT_EQ(scanner, nullptr);
  EXPECT_EQ(pose_wall_planar_scanner_reset(reinterpret_cast<pose_wall_planar_scanner*>(block.data())),
            POSE_WALL_E_ENGINE);
  EXPECT_EQ(pose_wall_planar_scanner_open(&config, nullptr, block.data(), block.size(), &scanner), POSE_WALL_OK);
}

TEST(ScanScanner, TheBlocksFormerContentsDoNotMatter) {
  const SeenScene seen = seen_road();
  const pose_wall_planar_floor floor = level_floor();
  ScannerUnderTest zeros(config_with(), scan_settings(), Dirt::kZeros);
  ScannerUnderTest random(config_with(), scan_settings(), Dirt::kRandom);
  for (int frame = 0; frame < 2; ++frame) {
    zeros.process(cloud_of(seen.points, frame), &floor);
    random.process(cloud_of(seen.points, frame), &floor);
    const std::size_t bytes = zeros.scan().beams * sizeof(float);
    EXPECT_EQ(std::memcmp(zeros.scan().range_m, random.scan().range_m, bytes), 0);
    EXPECT_EQ(std::memcmp(zeros.scan().free_m, random.scan().free_m, bytes), 0);
    EXPECT_EQ(std::memcmp(zeros.view().bias_m, random.view().bias_m, bytes), 0);
    EXPECT_EQ(std::memcmp(zeros.view().sigma_m, random.view().sigma_m, bytes), 0);
    EXPECT_EQ(std::memcmp(zeros.view().low_m, random.view().low_m, bytes), 0);
    EXPECT_EQ(std::memcmp(zeros.view().clear_m, random.view().clear_m, bytes), 0);
    EXPECT_EQ(std::memcmp(zeros.view().returns, random.view().returns, bytes / 2), 0);
  }
}

// FNV-1a over the bytes of an array.
std::uint64_t digest_of(const void* from, std::size_t bytes, std::uint64_t digest) {
  const auto* const at = static_cast<const unsigned char*>(from);
  for (std::size_t i = 0; i < bytes; ++i) digest = (digest ^ at[i]) * 0x100000001B3ULL;
  return digest;
}

// A room of walls, floor and scattered returns whose coordinates are whole 1024ths: no library takes part in them.
Points exact_points() {
  pose_wall::Random random(42);
  Points points;
  const auto part = [&](std::uint32_t bound) { return static_cast<float>(random.below(bound)) / 1024.0F; };
  for (int i = 0; i < 40000; ++i) {
    const float along = part(20480) - 10.0F, up = part(3072) - 1.5F, off = part(32);
    const std::uint32_t kind = random.below(8);
    if (kind < 3) points.push_back({along, 2.5F + off, up});
    if (kind >= 3 && kind < 6) points.push_back({along, -2.5F - off, up});
    if (kind == 6) points.push_back({along, part(5120) - 2.5F, -1.5F + off});
    if (kind == 7) points.push_back({along, part(5120) - 2.5F, up});
  }
  return points;
}

TEST(ScanScanner, TheSameBitsOnEveryMachine) {
  pose_wall_config config = config_with();
  set(&config, "extrinsic_x", 0.3);
  set(&config, "extrinsic_roll", 0.02);
  set(&config, "extrinsic_yaw", -0.4);
  pose_wall_planar_scanner_settings settings = scan_settings();
  settings.alone = POSE_WALL_PLANAR_ALONE_IS_APART;
  ScannerUnderTest scanner(config, settings);
  pose_wall_planar_floor floor = level_floor();
  floor.normal[0] = 0.03;
  floor.normal[2] = 0.99955;
  floor.tilt_sigma_rad = 0.0007;
  floor.reach_m = 5.0;
  scanner.process(cloud_of(exact_points(), 0), &floor);
  const pose_wall_planar_scan& scan = scanner.scan();
  const pose_wall_planar_scan_view& view = scanner.view();
  std::uint64_t digest = 0xCBF29CE484222325ULL;
  for (const float* const values : {scan.range_m, scan.free_m, view.bias_m, view.sigma_m, view.low_m, view.overhead_m,
                                    view.alone_m, view.clear_from_m, view.clear_m}) {
    digest = digest_of(values, scan.beams * sizeof(float), digest);
  }
  EXPECT_GT(things_of(scan), 2000U);
  EXPECT_EQ(digest, 0x548723EC7A8547A1ULL) << std::hex << digest;
}

TEST(ScanScanner, AnEmptyCloudAndOneOfGarbageAreScansToo) {
  ScannerUnderTest scanner(config_with());
  const pose_wall_planar_floor floor = level_floor();
  scanner.process(cloud_of({}, 0), &floor);
  EXPECT_EQ(things_of(scanner.scan()), 0U);
  SceneDraw draw(9);
  for (int round = 0; round < 30; ++round) {
    Points points(3000);
    for (auto& p : points) {
      for (float& x : p) {
        const auto bits = static_cast<std::uint32_t>(draw.below(0xFFFFFFFFU));
        if (draw.below(2) == 0) {
          x = static_cast<float>(draw.between(-40.0, 40.0));
        } else {
          std::memcpy(&x, &bits, sizeof(x));
        }
      }
    }
    scanner.process(cloud_of(points, round), &floor);
    const pose_wall_planar_scan& scan = scanner.scan();
    ASSERT_EQ(pose_wall::planar::check_scan(&scan), POSE_WALL_OK);
    for (std::uint32_t b = 0; b < scan.beams; ++b) {
      const float range_m = scan.range_m[b];
      const bool fits = std::isnan(range_m) || std::isinf(range_m) || (range_m >= 0.3F && range_m <= 31.0F);
      ASSERT_TRUE(fits) << range_m;
      ASSERT_TRUE(scan.free_m[b] >= 0.0F && scan.free_m[b] <= 31.0F) << scan.free_m[b];
      ASSERT_TRUE(std::isfinite(scanner.view().bias_m[b]));
    }
    const pose_wall_planar_scan_view& view = scanner.view();
    EXPECT_EQ(
        view.dropped + view.of_body + view.of_floor + view.of_low + view.of_band + view.of_overhead + view.of_roof,
        view.points_in);
  }
}

TEST(ScanScanner, TheSensorsPlaceAndTurnOnTheMachineAreTheConfigs) {
  // 1 m ahead, 0.5 m to the left, 1.2 m up, turned left by a quarter: a thing 4 m ahead of it is to the left of base
  pose_wall_config config = config_with();
  set(&config, "extrinsic_x", 1.0);
  set(&config, "extrinsic_y", 0.5);
  set(&config, "extrinsic_z", 1.2);
  set(&config, "extrinsic_yaw", M_PI / 2.0);
  ScannerUnderTest scanner(config);
  const pose_wall_planar_floor floor = level_floor(0.3);
  scanner.process(cloud_of({{4.0F, 0, 0}}, 7), &floor);
  EXPECT_NEAR(scanner.scan().sensor.x_m, 1.0, 1e-9);
  EXPECT_NEAR(scanner.scan().sensor.y_m, 0.5, 1e-9);
  EXPECT_NEAR(scanner.view().sensor_height_m, 1.5, 1e-9);
  EXPECT_NEAR(scanner.scan().range_m[scanner.beam_at(M_PI / 2.0)], 4.0, 1e-4);
  EXPECT_EQ(scanner.scan().stamp_ns, 7);
}

TEST(ScanScanner, OnTheEnginesFloorASimulatedRoadHasItsWallsWhereTheyAre) {
  const sim::SceneSetup setup;
  const sim::Simulator simulator(setup, 5);
  const pose_wall_config config = config_for(setup);
  EngineUnderTest engine(config);
  ScannerUnderTest scanner(config);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const sim::Frame frame = simulator.render(i);
    const pose_wall_result result = engine.process(cloud_of(frame));
    pose_wall_planar_floor floor{};
    floor.struct_size = sizeof(floor);
    ASSERT_EQ(pose_wall_planar_floor_of(&result, &floor), POSE_WALL_OK);
    EXPECT_EQ(floor.measured, 1U);
    scanner.process(cloud_of(frame), &floor);
    EXPECT_EQ(scanner.view().floor_state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_FLOOR_MEASURED));
    EXPECT_GT(things_of(scanner.scan()), 3000U);
    // the nearest things to the left and right are the walls, near the engine's distances
    const double left_m = result.quantity[POSE_WALL_D_LF].raw, right_m = result.quantity[POSE_WALL_D_RF].raw;
    double to_left_m = 1e9, to_right_m = 1e9;
    for (std::uint32_t b = 0; b < scanner.scan().beams; ++b) {
      const auto r = static_cast<double>(scanner.scan().range_m[b]);
      if (!std::isfinite(r)) continue;
      const double y = r * std::sin(scanner.angle_of(b)) + scanner.scan().sensor.y_m;
      if (y > 0.0) to_left_m = std::min(to_left_m, r);
      if (y < 0.0) to_right_m = std::min(to_right_m, r);
    }
    EXPECT_NEAR(to_left_m, left_m, 0.4);
    EXPECT_NEAR(to_right_m, right_m, 0.4);
  }
}

TEST(ScanScanner, AResultWithoutAFloorGivesNone) {
  pose_wall_result result{};
  result.struct_size = sizeof(result);
  pose_wall_planar_floor floor{};
  floor.struct_size = sizeof(floor);
  floor.measured = 1;
  EXPECT_EQ(pose_wall_planar_floor_of(&result, &floor), POSE_WALL_OK);
  EXPECT_EQ(floor.measured, 0U);
  EXPECT_EQ(pose_wall_planar_floor_of(nullptr, &floor), POSE_WALL_E_NULL);
  floor.struct_size = 3;
  EXPECT_EQ(pose_wall_planar_floor_of(&result, &floor), POSE_WALL_E_STRUCT_SIZE);
}

}  // namespace
