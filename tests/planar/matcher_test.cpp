// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/match/matcher.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "base/math/random.hpp"
#include "place/slide.hpp"
#include "planar/gates.hpp"

namespace {

namespace gate = pose_wall::planar::gate;

using namespace pose_wall;
using namespace pose_wall::planar;

class Bench {
 public:
  Bench() {
    Arena measure(nullptr);
    lay_out(measure);
    block_.assign(measure.bytes() + 64, 0xA5);
    const auto at = reinterpret_cast<std::uintptr_t>(block_.data());
    Arena arena(block_.data() + (64 - at % 64) % 64);
    lay_out(arena);
    map.open();
  }
  SurfaceMap map;
  Matcher matcher;

 private:
  void lay_out(Arena& arena) {
    map.lay_out(arena);
    matcher.lay_out(arena);
  }
  std::vector<unsigned char> block_;
};

using Points = std::vector<ScanPoint>;

Span<const ScanPoint> span(const Points& points) {
  return Span<const ScanPoint>(points.data(), static_cast<std::uint32_t>(points.size()));
}

// Two walls along x, 5 m apart, with noise; with the shape `bump` gives them.
template <typename Bump>
Points road(double from_m, double to_m, std::uint64_t seed, Bump bump) {
  Random random(seed);
  const auto noise = [&] { return (random.below(2001) / 1000.0 - 1.0) * 0.02; };
  Points out;
  for (double x = from_m; x < to_m; x += 0.07) {
    out.push_back({static_cast<float>(x), static_cast<float>(2.5 + bump(x, 0) + noise())});
    out.push_back({static_cast<float>(x), static_cast<float>(-2.5 + bump(x, 1) + noise())});
  }
  return out;
}

double smooth(double, int) {
  return 0.0;
}
// Relief that repeats nowhere.
double rough(double x, int wall) {
  return 0.15 * pose_wall::sine(2.3 * x + wall) + 0.1 * pose_wall::sine(5.1 * x + 0.37 * x * x / 20.0 + 2.0 * wall);
}

// The points that a machine at `pose` would see of them.
Points seen_from(const Points& points, const Pose2& pose) {
  const Turn2 turn(pose.yaw_rad);
  Points out;
  for (const ScanPoint& p : points) {
    const Eigen::Vector2d at =
        turn.back(Eigen::Vector2d(static_cast<double>(p.x_m), static_cast<double>(p.y_m)) - pose.place());
    out.push_back({static_cast<float>(at.x()), static_cast<float>(at.y())});
  }
  return out;
}

TEST(Matcher, ASearchFindsThePoseInAWideWindow) {
  Bench bench;
  bench.map.begin({0.0, 0.0});
  bench.map.add(span(road(-20.0, 20.0, 1, rough)), Pose2(), true);
  bench.map.finish();
  Random random(7);
  for (int trial = 0; trial < 12; ++trial) {
    const auto draw = [&](double most) { return most * (random.below(2001) / 1000.0 - 1.0); };
    const Pose2 truth{draw(3.0), draw(1.0), draw(0.4)};
    const Points scan = seen_from(road(-8.0, 8.0, 100 + static_cast<std::uint64_t>(trial), rough), truth);
    const Found found = bench.matcher.search(span(scan), bench.map, {Pose2(), 4.0, 0.5});
    EXPECT_TRUE(found.is_whole) << trial;
    const Fit fit = fit_pose(bench.map, span(scan), found.pose, {0.02});
    ASSERT_TRUE(fit.is_valid);
    EXPECT_LT((fit.pose.place() - truth.place()).norm(), 0.02) << trial;
    EXPECT_NEAR(fit.pose.yaw_rad, truth.yaw_rad, 0.003) << trial;
    EXPECT_GT(fit.explained, 0.95) << trial;
  }
}

TEST(Matcher, ASmoothRoadSlidesAndARoughOneDoesNot) {
  Bench bench;
  for (const bool is_rough : {false, true}) {
    const auto bump = is_rough ? rough : smooth;
    bench.map.begin({0.0, 0.0});
    bench.map.add(span(road(-20.0, 20.0, 1, bump)), Pose2(), true);
    bench.map.finish();
    const Points scan = road(-8.0, 8.0, 2, bump);
    const Fit fit = fit_pose(bench.map, span(scan), Pose2(), {0.02});
    const Slide slide =
        slide_of(bench.map, bench.matcher.sort(span(scan), 0.02), fit, limit_of<gate::EXCLUDED>(), kRefit);
    if (is_rough) {
      EXPECT_LE(slide.reach_m, 0.1);
      continue;
    }
    EXPECT_GE(slide.reach_m, 3.2);
    EXPECT_GT(slide.direction.x() * slide.direction.x(), 0.99);  // along the road
    const Eigen::Matrix3d information = told_by(fit, slide);
    const Eigen::Vector3d along(slide.direction.x(), slide.direction.y(), 0.0);
    EXPECT_LE(along.dot(information * along), 1.001 / (3.2 * 3.2));
    EXPECT_GT(information(1, 1), 1e3);
  }
}

TEST(Matcher, WhatWasNeverSeenIsNoContradiction) {
  Bench bench;
  bench.map.begin({0.0, 0.0});
  bench.map.add(span(road(-20.0, 0.0, 1, rough)), Pose2(), true);  // the road ahead is not known yet
  bench.map.finish();
  const Points scan = road(-8.0, 8.0, 2, rough);
  const Fit fit = fit_pose(bench.map, span(scan), Pose2(), {0.02});
  EXPECT_GT(fit.explained, 0.9);
  EXPECT_LT(fit.pose.place().norm(), 0.03);
}

TEST(Matcher, ThePriorHoldsWhatTheScanDoesNot) {
  Bench bench;
  bench.map.begin({0.0, 0.0});
  bench.map.add(span(road(-20.0, 20.0, 1, smooth)), Pose2(), true);
  bench.map.finish();
  const Points scan = road(-8.0, 8.0, 2, smooth);
  Prior prior{{0.7, 0.1, 0.01}, Eigen::Matrix3d::Zero()};
  prior.information.diagonal() << 1e4, 1e2, 1e2;
  const Fit fit = fit_pose(bench.map, span(scan), prior.pose, {0.02, prior});
  EXPECT_NEAR(fit.pose.x_m, 0.7, 0.05);
  EXPECT_NEAR(fit.pose.y_m, 0.0, 0.01);
  EXPECT_NEAR(fit.pose.yaw_rad, 0.0, 0.002);
}

TEST(Matcher, NothingToMatchIsNotValid) {
  Bench bench;
  bench.map.begin({0.0, 0.0});
  bench.map.finish();
  const Points scan = road(-8.0, 8.0, 2, rough);
  EXPECT_FALSE(fit_pose(bench.map, span(scan), Pose2(), {0.02}).is_valid);
  EXPECT_EQ(bench.matcher.search(span(scan), bench.map, {Pose2(), 1.0, 0.1}).score, 0.0);
  EXPECT_FALSE(fit_pose(bench.map, Span<const ScanPoint>(), Pose2(), {0.02}).is_valid);
}

TEST(SurfaceMap, AWindowThatIsBegunAnewHoldsNothingOfTheLast) {
  Bench bench;
  bench.map.begin({0.0, 0.0});
  bench.map.add(span(road(-20.0, 20.0, 1, rough)), Pose2(), true);
  bench.map.finish();
  EXPECT_NE(bench.map.near(1.0, 2.5), nullptr);
  EXPECT_TRUE(bench.map.is_seen(1.0, 0.0));
  bench.map.begin({3.0, 0.0});
  bench.map.finish();
  EXPECT_TRUE(bench.map.is_empty());
  EXPECT_EQ(bench.map.near(1.0, 2.5), nullptr);
  EXPECT_FALSE(bench.map.is_seen(1.0, 0.0));
  for (std::uint32_t level = 0; level < 3; ++level) {
    const std::int32_t side = SurfaceMap::kSide >> (2U * level);
    std::uint32_t sum = 0;
    for (std::int32_t y = 0; y < side; ++y) {
      for (std::int32_t x = 0; x < side; ++x) sum += bench.map.likelihood(level, x, y);
    }
    EXPECT_EQ(sum, 0U) << level;
  }
}

TEST(SurfaceMap, ACoarseCellBoundsAllFineCellsThatAShiftWithinItCanReach) {
  Bench bench;
  bench.map.begin({0.0, 0.0});
  bench.map.add(span(road(-20.0, 20.0, 1, rough)), Pose2(), true);
  bench.map.finish();
  for (std::int32_t y = 400; y < 620; y += 3) {
    for (std::int32_t x = 400; x < 620; x += 3) {
      for (std::uint32_t level = 1; level < 3; ++level) {
        const std::uint32_t bound = bench.map.likelihood(level, x >> (2U * level), y >> (2U * level));
        const std::int32_t reach = (1 << (2U * level)) - 1;
        for (std::int32_t dy = 0; dy <= reach; dy += reach) {
          for (std::int32_t dx = 0; dx <= reach; dx += reach) {
            EXPECT_GE(bound, bench.map.likelihood(0, x + dx, y + dy)) << level;
          }
        }
      }
    }
  }
}

}  // namespace
