// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <cmath>
#include <limits>

#include "driven_road.hpp"

namespace {

using namespace pose_wall::planar_test;

// The largest distance of keyframes from the truth, both from the first one.
double worst_m(const OpenedSlam& slam, const sim::NetworkRun& run, const std::vector<std::size_t>& scans) {
  double worst = 0.0;
  const pose_wall_planar_pose first = pose_of(run.at_scan(scans[0]).truth);
  for (std::uint32_t k = 0; k < scans.size(); ++k) {
    const pose_wall_planar_pose truth = step_between(first, pose_of(run.at_scan(scans[k]).truth));
    worst = std::max(worst, apart_m(slam.keyframe(k).pose, truth));
  }
  return worst;
}

struct Drive {
  std::vector<std::size_t> scan_of_keyframe;
  pose_wall_planar_slam_result last{};
};

Drive take_all(const OpenedSlam& slam, const sim::NetworkRun& run, bool with_odometry = true) {
  Drive out;
  for (std::size_t i = 0; i < run.scans(); ++i) {
    out.last = slam.process(run, i, with_odometry);
    if (out.last.is_keyframe != 0) out.scan_of_keyframe.push_back(i);
  }
  EXPECT_EQ(pose_wall_planar_slam_settle(slam.get()), POSE_WALL_OK);
  return out;
}

TEST(Slam, ADriveThatComesBackIsClosedAndKnownToCentimetres) {
  const sim::NetworkRun run = driven(small_plan(), 200.0, 11);
  const OpenedSlam slam;
  const Drive drive = take_all(slam, run);
  EXPECT_GT(drive.last.closures, 20U);
  EXPECT_EQ(drive.last.taken_back, 0U);
  EXPECT_LT(worst_m(slam, run, drive.scan_of_keyframe), 0.15);
  const pose_wall_planar_pose odometry =
      step_between(pose_of(run.at_scan(0).odometry), pose_of(run.at_scan(run.scans() - 1).odometry));
  const pose_wall_planar_pose truth =
      step_between(pose_of(run.at_scan(0).truth), pose_of(run.at_scan(run.scans() - 1).truth));
  EXPECT_GT(apart_m(odometry, truth), 3.0);  // so it was not odometry that found the way back
}

TEST(Slam, WithoutOdometryARoughRoadIsFollowedAllTheSame) {
  const sim::NetworkRun run = driven(small_plan(), 80.0, 12);
  const OpenedSlam slam;
  const Drive drive = take_all(slam, run, false);
  EXPECT_LT(worst_m(slam, run, drive.scan_of_keyframe), 0.3);
}

TEST(Slam, TwinRoadsOfSmoothLiningAreNotTakenForOneAnother) {
  sim::NetworkPlan plan = small_plan();
  plan.alike = true;
  plan.twin_rock = true;
  for (const std::uint64_t seed : {21U, 22U}) {
    const sim::NetworkRun run = driven(plan, 150.0, seed);
    const OpenedSlam slam;
    const Drive drive = take_all(slam, run);
    EXPECT_LT(worst_m(slam, run, drive.scan_of_keyframe), 0.3) << seed;
  }
}

TEST(Slam, TheSameScansGiveTheSameBitsWhateverTheBlockHeld) {
  const sim::NetworkRun run = driven(small_plan(), 30.0, 13);
  const OpenedSlam first(512, 0xA5), second(512, 0x00);
  take_all(first, run);
  take_all(second, run);
  EXPECT_EQ(first.saved(), second.saved());
  EXPECT_EQ(pose_wall_planar_slam_clear(first.get()), POSE_WALL_OK);
  take_all(first, run);
  EXPECT_EQ(first.saved(), second.saved());
}

TEST(Slam, OdometryThatStallsAndCatchesUpDoesNotLeadAstray) {
  sim::NetworkRun run = driven(small_plan(), 60.0, 14);
  // The scans 40 to 47 repeat the odometry of scan 39.
  for (std::size_t i = 40; i < 48; ++i) run.steps[run.scan_step[i]].odometry = run.at_scan(39).odometry;
  const OpenedSlam slam;
  const Drive drive = take_all(slam, run);
  EXPECT_LT(worst_m(slam, run, drive.scan_of_keyframe), 0.3);
}

TEST(Slam, ASavedTrailGoesOnWhereTheMachineStands) {
  const sim::NetworkRun run = driven(small_plan(), 120.0, 15);
  const OpenedSlam before, after;
  const std::size_t half = run.scans() / 2;
  pose_wall_planar_slam_result last{};
  for (std::size_t i = 0; i < half; ++i) last = before.process(run, i);
  const std::vector<unsigned char> saved = before.saved();
  ASSERT_EQ(pose_wall_planar_slam_load(after.get(), saved.data(), saved.size(), &last.pose), POSE_WALL_OK);
  EXPECT_EQ(after.saved(), saved);
  for (std::size_t i = half; i < run.scans(); ++i) last = after.process(run, i);
  const pose_wall_planar_pose truth =
      step_between(pose_of(run.at_scan(0).truth), pose_of(run.at_scan(run.scans() - 1).truth));
  EXPECT_LT(apart_m(last.pose, truth), 0.2);
}

TEST(Slam, ATrailThatIsFullSaysSoAndKeepsWhatItHas) {
  const sim::NetworkRun run = driven(small_plan(), 30.0, 16);
  const OpenedSlam slam(16);
  const Drive drive = take_all(slam, run);
  EXPECT_EQ(drive.last.is_full, 1U);
  EXPECT_LE(drive.last.keyframes, 16U);
  EXPECT_GE(drive.last.keyframes, 8U);  // each of at most twice as many points as in the mean
  EXPECT_TRUE(std::isfinite(drive.last.pose.x_m));
}

TEST(Slam, ScansOfNothingAndOfNoiseKeepThePoseFinite) {
  const sim::NetworkRun run = driven(small_plan(), 20.0, 17);
  const OpenedSlam slam;
  std::vector<float> ranges(360);
  for (std::size_t i = 0; i < 60; ++i) {
    pose_wall_planar_scan scan = scan_of(run, i % run.scans());
    if (i % 3 != 0) {
      for (std::size_t k = 0; k < ranges.size(); ++k) {
        ranges[k] = i % 3 == 1 ? std::numeric_limits<float>::quiet_NaN()
                               : 0.2F + static_cast<float>((k * 7919 + i * 104729) % 997) * 0.03F;
      }
      scan.range_m = ranges.data();
    }
    pose_wall_planar_slam_result result{};
    result.struct_size = sizeof(result);
    ASSERT_EQ(pose_wall_planar_slam_process(slam.get(), &scan, nullptr, &result), POSE_WALL_OK);
    EXPECT_TRUE(std::isfinite(result.pose.x_m + result.pose.y_m + result.pose.yaw_rad)) << i;
    EXPECT_TRUE(std::isfinite(result.explained + result.misfit_m)) << i;
  }
}

}  // namespace
