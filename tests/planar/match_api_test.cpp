// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The scan match as its callers see it: scans of drives in drawn roads, whose poses are known.

#include "pose_wall_planar_match.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math/random.hpp"
#include "driven_road.hpp"

namespace {

using namespace pose_wall::planar_test;
namespace sim = pose_wall::tools::sim;

struct Free {
  void operator()(void* p) const { std::free(p); }
};

class OpenedMatch {
 public:
  explicit OpenedMatch(int garbage = 0xA5) {
    EXPECT_EQ(pose_wall_planar_match_memory_needed(&bytes_), POSE_WALL_OK);
    block_.reset(std::aligned_alloc(POSE_WALL_BLOCK_ALIGNMENT, bytes_));
    std::memset(block_.get(), garbage, bytes_);
    EXPECT_EQ(pose_wall_planar_match_open(block_.get(), bytes_, &matcher_), POSE_WALL_OK);
  }
  pose_wall_planar_matcher* get() const { return matcher_; }
  void* block() const { return block_.get(); }

  // Scans from `first` to `last` at their true poses.
  void refer_to(const sim::NetworkRun& run, std::size_t first, std::size_t last) const {
    const sim::PlanePose& middle = run.at_scan(first).truth;
    EXPECT_EQ(pose_wall_planar_match_begin(matcher_, middle.x_m, middle.y_m), POSE_WALL_OK);
    for (std::size_t i = first; i < last; ++i) {
      const pose_wall_planar_scan scan = scan_of(run, i);
      const pose_wall_planar_pose pose = pose_of(run.at_scan(i).truth);
      EXPECT_EQ(pose_wall_planar_match_add(matcher_, &scan, &pose), POSE_WALL_OK);
    }
  }
  pose_wall_planar_match_result match(const sim::NetworkRun& run, std::size_t i,
                                      const pose_wall_planar_match_input& input) const {
    pose_wall_planar_match_result result{};
    result.struct_size = sizeof(result);
    const pose_wall_planar_scan scan = scan_of(run, i);
    EXPECT_EQ(pose_wall_planar_match_scan(matcher_, &scan, &input, &result), POSE_WALL_OK);
    return result;
  }

 private:
  std::uint64_t bytes_ = 0;
  std::unique_ptr<void, Free> block_;
  pose_wall_planar_matcher* matcher_ = nullptr;
};

pose_wall_planar_match_input input_at(const pose_wall_planar_pose& guess, double reach_m, double reach_rad) {
  pose_wall_planar_match_input input;
  EXPECT_EQ(pose_wall_planar_match_input_init(&input), POSE_WALL_OK);
  input.guess = guess;
  input.reach_m = reach_m;
  input.reach_rad = reach_rad;
  return input;
}

sim::NetworkPlan smooth_plan() {
  sim::NetworkPlan plan = small_plan();
  plan.lining = sim::Lining::kSmooth;
  plan.roads = 1;
  plan.bend_m = 0.0;
  plan.width_wave_m = plan.wave_m = plan.roughness_m = 0.0;
  plan.dead_ends_m = plan.niche_pitch_m = 0.0;
  return plan;
}

// Squared error in standard deviations, and the error itself.
double squared_error(const pose_wall_planar_match_result& result, const sim::PlanePose& truth) {
  const Eigen::Vector3d off(result.pose.x_m - truth.x_m, result.pose.y_m - truth.y_m,
                            std::remainder(result.pose.yaw_rad - truth.yaw_rad, 2.0 * 3.14159265358979));
  const Eigen::Matrix3d covariance = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(result.covariance);
  return off.dot(covariance.inverse() * off);
}

TEST(MatchApi, InRockAScanIsPlacedAsWellAsItsCovarianceSays) {
  const OpenedMatch matcher;
  pose_wall::Random random(5);
  const auto draw = [&](double most) { return most * (random.below(2001) / 1000.0 - 1.0); };
  double sum = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const sim::NetworkRun run = driven(small_plan(), 25.0, seed);
    const std::size_t half = run.scans() / 2;
    matcher.refer_to(run, 0, half);
    for (std::size_t i = half + 1; i < std::min(half + 30, run.scans()); i += 5) {
      const sim::PlanePose& truth = run.at_scan(i).truth;
      const pose_wall_planar_pose guess{truth.x_m + draw(0.9), truth.y_m + draw(0.9), truth.yaw_rad + draw(0.25)};
      const pose_wall_planar_match_result result = matcher.match(run, i, input_at(guess, 1.0, 0.3));
      ASSERT_EQ(result.state, POSE_WALL_PLANAR_MATCH_FOUND) << seed << ' ' << i;
      EXPECT_LT(apart_m(result.pose, pose_of(truth)), 0.06) << seed << ' ' << i;
      EXPECT_GT(result.explained, 0.8);
      EXPECT_EQ(result.is_whole, 1U);
      EXPECT_GE(result.score, result.second_score);
      const double squared = squared_error(result, truth);
      EXPECT_LT(squared, 25.0) << seed << ' ' << i;  // five standard deviations
      sum += squared;
      ++count;
    }
  }
  ASSERT_GT(count, 25);
  EXPECT_LT(sum / count, 6.0);  // of three numbers 3 in the mean
}

TEST(MatchApi, ASmoothRoadLeavesTheWayAlongOpenAndAPriorHoldsIt) {
  const OpenedMatch matcher;
  const sim::NetworkRun run = driven(smooth_plan(), 30.0, 3);
  const std::size_t at = run.scans() / 2;
  matcher.refer_to(run, at - 10, at);
  const sim::PlanePose& truth = run.at_scan(at).truth;
  pose_wall_planar_match_input input = input_at(pose_of(truth), 0.0, 0.0);
  const pose_wall_planar_match_result open = matcher.match(run, at, input);
  ASSERT_EQ(open.state, POSE_WALL_PLANAR_MATCH_FOUND);
  EXPECT_GE(open.slide_m, 1.6);
  EXPECT_TRUE(std::isnan(open.score));
  const double c = std::cos(open.slide_rad), s = std::sin(open.slide_rad);
  const auto variance_along = [&](const pose_wall_planar_match_result& r, double x, double y) {
    return x * x * r.covariance[0] + 2.0 * x * y * r.covariance[1] + y * y * r.covariance[4];
  };
  EXPECT_GT(variance_along(open, c, s), 0.5 * open.slide_m * open.slide_m);
  EXPECT_LT(variance_along(open, -s, c), 0.03 * 0.03);
  input.has_prior = 1;
  input.covariance[0] = input.covariance[4] = 0.05 * 0.05;
  input.covariance[8] = 0.05 * 0.05;
  const pose_wall_planar_match_result held = matcher.match(run, at, input);
  EXPECT_LT(variance_along(held, c, s), 1.01 * 0.05 * 0.05);
  EXPECT_LT(apart_m(held.pose, pose_of(truth)), 0.1);
}

TEST(MatchApi, OtherMemoryGivesTheSameBits) {
  const sim::NetworkRun run = driven(small_plan(), 15.0, 4);
  const OpenedMatch one(0xA5), other(0x00);
  one.refer_to(run, 0, 20);
  other.refer_to(run, 0, 20);
  const pose_wall_planar_match_input input = input_at(pose_of(run.at_scan(19).truth), 0.5, 0.2);
  const pose_wall_planar_match_result a = one.match(run, 21, input), b = other.match(run, 21, input);
  EXPECT_EQ(std::memcmp(&a, &b, sizeof(a)), 0);
  // References of before are forgotten.
  one.refer_to(run, 0, 20);
  const pose_wall_planar_match_result again = one.match(run, 21, input);
  EXPECT_EQ(std::memcmp(&a, &again, sizeof(a)), 0);
}

TEST(MatchApi, WithoutSurfacesThereIsNoPose) {
  const sim::NetworkRun run = driven(small_plan(), 5.0, 4);
  const OpenedMatch matcher;
  ASSERT_EQ(pose_wall_planar_match_begin(matcher.get(), 500.0, 500.0), POSE_WALL_OK);
  const pose_wall_planar_match_result result = matcher.match(run, 0, input_at({500.0, 500.0, 0.0}, 0.3, 0.1));
  EXPECT_EQ(result.state, POSE_WALL_PLANAR_MATCH_NONE);
  EXPECT_TRUE(std::isnan(result.pose.x_m));
  EXPECT_TRUE(std::isnan(result.covariance[0]));
  EXPECT_TRUE(std::isnan(result.second.x_m));
}

TEST(MatchApi, ARefusedCallChangesNothing) {
  const sim::NetworkRun run = driven(small_plan(), 5.0, 3);
  const OpenedMatch matcher;
  pose_wall_planar_match_result result{}, before{};
  result.struct_size = before.struct_size = sizeof(result);
  const pose_wall_planar_scan scan = scan_of(run, 1);
  pose_wall_planar_scan bad = scan;
  bad.beams = 0;
  const pose_wall_planar_pose pose{0.0, 0.0, 0.0}, nowhere{std::nan(""), 0.0, 0.0};
  const pose_wall_planar_match_input good = input_at(pose, 0.3, 0.1);
  const auto match = [&](auto change) {
    pose_wall_planar_match_input input = good;
    change(input);
    return pose_wall_planar_match_scan(matcher.get(), &scan, &input, &result);
  };
  EXPECT_EQ(match([](auto&) {}), POSE_WALL_PLANAR_E_ORDER);
  EXPECT_EQ(pose_wall_planar_match_add(matcher.get(), &scan, &pose), POSE_WALL_PLANAR_E_ORDER);
  EXPECT_EQ(pose_wall_planar_match_begin(matcher.get(), std::nan(""), 0.0), POSE_WALL_PLANAR_E_POSE);
  ASSERT_EQ(pose_wall_planar_match_begin(matcher.get(), 0.0, 0.0), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_planar_match_add(matcher.get(), &bad, &pose), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(pose_wall_planar_match_add(matcher.get(), &scan, &nowhere), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(pose_wall_planar_match_scan(matcher.get(), &bad, &good, &result), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(match([&](auto& in) { in.guess = nowhere; }), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(match([](auto& in) { in.reach_m = 38.1; }), POSE_WALL_E_VALUE_RANGE);
  EXPECT_EQ(match([](auto& in) { in.reach_rad = std::nan(""); }), POSE_WALL_E_VALUE_RANGE);
  EXPECT_EQ(match([](auto& in) { in.struct_size = 4; }), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(match([](auto& in) { in.has_prior = 2; }), POSE_WALL_E_VALUE_RANGE);
  EXPECT_EQ(match([](auto& in) { in.has_prior = 1; }), POSE_WALL_PLANAR_E_POSE);  // all zeros are no covariance
  const auto with_covariance = [&](std::vector<double> c) {
    return match([&](auto& in) {
      in.has_prior = 1;
      std::copy(c.begin(), c.end(), in.covariance);
    });
  };
  EXPECT_EQ(with_covariance({1, 2, 0, 2, 1, 0, 0, 0, 1}), POSE_WALL_PLANAR_E_POSE);    // not positive
  EXPECT_EQ(with_covariance({1, 0.5, 0, 0, 1, 0, 0, 0, 1}), POSE_WALL_PLANAR_E_POSE);  // not symmetric
  EXPECT_EQ(pose_wall_planar_match_scan(matcher.get(), nullptr, &good, &result), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_planar_match_scan(matcher.get(), &scan, nullptr, &result), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_planar_match_scan(nullptr, &scan, &good, &result), POSE_WALL_E_NULL);
  alignas(64) unsigned char other[64] = {};
  auto* const none = reinterpret_cast<pose_wall_planar_matcher*>(other);
  EXPECT_EQ(pose_wall_planar_match_scan(none, &scan, &good, &result), POSE_WALL_E_ENGINE);
  EXPECT_EQ(std::memcmp(&result, &before, sizeof(result)), 0);
  pose_wall_planar_matcher* opened = nullptr;
  EXPECT_EQ(pose_wall_planar_match_open(matcher.block(), 1000, &opened), POSE_WALL_E_BLOCK_SMALL);
  EXPECT_EQ(match([](auto&) {}), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_planar_match_add(matcher.get(), &scan, &pose), POSE_WALL_PLANAR_E_ORDER);
}

}  // namespace
