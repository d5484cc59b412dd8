// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves, on short simulated runs: the way along rough rock is found and is right; a path does not hang on how the
// sensor is mounted, on the side that things stand on, on the order of the points or on how they are written; who
// drives back comes back; who stands stays; on a smooth road nothing is measured, and people who walk along change
// nothing in that; after a frame of nothing or of garbage the motion goes on, and what it says meanwhile keeps its
// contract; a sensor of few rings keeps height and turns within their levels on rough ground that it sees behind alone.

#include <gtest/gtest.h>

#include <random>

#include "lab/sim/sensors.hpp"
#include "motion/simulated.hpp"

namespace pose_wall::motion::test {
namespace {

using pose_wall::test::config_for;
using pose_wall::test::MotionUnderTest;
using pose_wall::tools::kRadPerDeg;

// Of each frame alone, and of each after the one before. Gives how many were measured after the first.
std::uint32_t expect_contract(const std::vector<MotionFrame>& frames) {
  std::uint32_t measured = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const char* const broken = pose_wall::test::broken_motion(frames[i].result);
    EXPECT_EQ(broken, nullptr) << "frame " << i << ": " << broken;
    if (i == 0) continue;
    const char* const between = pose_wall::test::broken_between(frames[i - 1].result, frames[i].result);
    EXPECT_EQ(between, nullptr) << "frame " << i << ": " << between;
    measured += frames[i].measured() ? 1U : 0U;
  }
  return measured;
}

// Measured, and wrong by more than its level: in the step, or in all of the way.
void expect_nothing_misleading(const std::vector<MotionFrame>& frames) {
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const MotionFrame& f = frames[i];
    if (!f.measured() || !frames[i - 1].has_pose()) continue;
    EXPECT_LE(std::fabs(f.step_along_error_m()), f.result.step_protection_level[POSE_WALL_MOTION_ALONG]) << i;
    EXPECT_LE(std::fabs(f.along_error_m()), f.result.protection_level[POSE_WALL_MOTION_ALONG]) << i;
  }
}

// Every pose within every level, whatever the state.
void expect_within_levels(const std::vector<MotionFrame>& frames) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const MotionFrame& f = frames[i];
    if (!f.has_pose()) continue;
    const Eigen::Vector3d off = f.position() - f.truth.t, axis = f.axis();
    const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(axis).normalized(), up = axis.cross(left);
    EXPECT_LE(std::fabs(off.dot(axis)), f.result.protection_level[POSE_WALL_MOTION_ALONG]) << i;
    EXPECT_LE(std::fabs(off.dot(left)), f.result.protection_level[POSE_WALL_MOTION_ACROSS]) << i;
    EXPECT_LE(std::fabs(off.dot(up)), f.result.protection_level[POSE_WALL_MOTION_UP]) << i;
    const Eigen::Vector3d turn = f.turn_off();
    EXPECT_LE(std::fabs(turn.dot(axis)), f.result.protection_level[POSE_WALL_MOTION_ROLL]) << i;
    EXPECT_LE(std::fabs(turn.dot(left)), f.result.protection_level[POSE_WALL_MOTION_PITCH]) << i;
    EXPECT_LE(std::fabs(turn.dot(up)), f.result.protection_level[POSE_WALL_MOTION_YAW]) << i;
  }
}

// ------------------------------------------------------------------------------------------ the way

TEST(SimRun, RoughRockTellsTheWay) {
  const SimulatedRun run(rough_road(0.5));
  const std::vector<MotionFrame> frames = run.run(60);
  EXPECT_GE(expect_contract(frames), 50U);
  expect_nothing_misleading(frames);
  expect_within_levels(frames);
  EXPECT_NEAR(frames.back().result.along_m, 2.95, 0.03);
  EXPECT_LT(frames.back().error_m(), 0.03);
  EXPECT_LT(frames.back().turn_error_rad(), 0.2 * kRadPerDeg);
}

// At two frames a second, with turns: no guess of the place is good, and smooth walls give no relief. Its planes do.
TEST(SimRun, AHallTellsTheWayByItsPlanes) {
  for (const double turn_deg_s : {0.0, 12.0, -30.0}) {
    SCOPED_TRACE(turn_deg_s);
    sim::SceneSetup setup = clean_road(0.8);
    setup.road.width_m = 19.0;
    setup.road.height_m = 5.5;
    setup.road.face_distance_m = 24.0;
    setup.road.rear_distance_m = 9.0;
    setup.machine.lateral_m = 2.5;
    setup.machine.turn_rate_dps = turn_deg_s;
    setup.sequence.rate_hz = 2.0;
    const std::vector<MotionFrame> frames = SimulatedRun(setup).run(24);
    EXPECT_GE(expect_contract(frames), 23U);
    expect_nothing_misleading(frames);
    expect_within_levels(frames);
    EXPECT_LT(frames.back().error_m(), 0.03);
    EXPECT_LT(frames.back().turn_error_rad(), 0.2 * kRadPerDeg);
  }
}

TEST(SimRun, TheFirstPoseIsTheIdentity) {
  const SimulatedRun run(rough_road(0.5));
  const MotionFrame first = run.run(1).front();
  EXPECT_NE(first.result.reasons & POSE_WALL_MOTION_R_FIRST, 0U);
  EXPECT_TRUE(first.has_pose());
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(first.result.position_m[k], 0.0);
    EXPECT_NEAR(first.result.quaternion[k], 0.0, 1e-12);
    EXPECT_TRUE(std::isnan(first.result.step_m[k]));
  }
  EXPECT_NEAR(first.result.quaternion[3], 1.0, 1e-12);
  EXPECT_EQ(first.result.along_m, 0.0);
  EXPECT_EQ(first.result.frame_index, 0U);
}

// Single frames differ by what a small scanner's noise leaves; their mean must stay.
TEST(SimRun, StandingStillDriftsNowhere) {
  const std::vector<MotionFrame> frames = SimulatedRun(rough_road(0.0)).run(200);
  expect_contract(frames);
  expect_within_levels(frames);
  const auto mean = [&frames](std::size_t from) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = from; i < from + 50; ++i) sum += frames[i].position();
    return Eigen::Vector3d(sum / 50.0);
  };
  EXPECT_LT((mean(150) - mean(10)).norm(), 5e-3);
  EXPECT_LT(mean(150).norm(), 0.015) << "the first scan's own noise stays in the map";
  EXPECT_LT(frames.back().turn_error_rad(), 0.1 * kRadPerDeg);
}

TEST(SimRun, WhoDrivesBackComesBack) {
  sim::SceneSetup setup = rough_road(0.6);
  setup.machine.speed_change_at_s = 2.5;
  setup.machine.speed_after_mps = -0.6;
  const std::vector<MotionFrame> frames = SimulatedRun(setup).run(51);
  expect_contract(frames);
  expect_nothing_misleading(frames);
  EXPECT_NEAR(frames[25].result.along_m, 1.5, 0.03);
  EXPECT_NEAR(frames.back().result.along_m, 0.0, 0.02);
  EXPECT_LT(frames.back().error_m(), 0.02);
}

TEST(SimRun, TurningOnTheSpotIsNoWay) {
  sim::SceneSetup setup = rough_road(0.0);
  setup.machine.turn_rate_dps = 8.0;
  const std::vector<MotionFrame> frames = SimulatedRun(setup).run(40);
  expect_contract(frames);
  expect_within_levels(frames);
  EXPECT_LT(frames.back().turn_error_rad(), 0.3 * kRadPerDeg);
  EXPECT_LT(frames.back().error_m(), 0.05);
}

TEST(SimRun, ASmoothRoadIsNeverMeasuredAndNeverMisleads) {
  for (const double speed_m_s : {0.0, 0.5, 2.0}) {
    SCOPED_TRACE(speed_m_s);
    const std::vector<MotionFrame> frames = SimulatedRun(clean_road(speed_m_s)).run(40);
    EXPECT_EQ(expect_contract(frames), 0U);
    expect_within_levels(frames);
    double before = 0.0;
    for (std::size_t i = 1; i < frames.size(); ++i) {
      EXPECT_EQ(frames[i].result.along_state, static_cast<std::uint32_t>(POSE_WALL_ALONG_UNOBSERVABLE)) << i;
      EXPECT_GE(frames[i].result.protection_level[POSE_WALL_MOTION_ALONG], before) << i;
      before = frames[i].result.protection_level[POSE_WALL_MOTION_ALONG];
    }
    EXPECT_GE(before, 2.0 * 3.9 * 0.99) << "the top speed for as long";
  }
}

// They stand still as the machine sees it: many of them, far apart, all of one word.
sim::SceneSetup with_people(sim::SceneSetup setup) {
  setup.road.width_m = 5.5;
  setup.objects.people_side = sim::kSideBoth;
  setup.objects.people_count = 6.0;
  setup.objects.people_speed_mps = setup.machine.speed_mps;
  return setup;
}

TEST(SimRun, PeopleWhoWalkAlongASmoothRoadTellNothing) {
  for (const std::uint64_t seed : {1ULL, 2ULL, 3ULL, 4ULL}) {
    const std::vector<MotionFrame> frames = SimulatedRun(with_people(clean_road(0.8)), seed).run(25);
    EXPECT_EQ(expect_contract(frames), 0U) << seed;
  }
}

TEST(SimRun, PeopleWhoWalkAlongDoNotOutweighTheRock) {
  sim::SceneSetup setup = with_people(rough_road(0.8));
  setup.rock.roughness_m = 0.03;
  for (const std::uint64_t seed : {1ULL, 2ULL, 3ULL}) {
    const std::vector<MotionFrame> frames = SimulatedRun(setup, seed).run(25);
    EXPECT_GE(expect_contract(frames), 12U) << seed;
    expect_nothing_misleading(frames);
  }
}

// A sensor whose ranges are off by 3 cm carries the bend that it sees along with it.
TEST(SimRun, ABendOfSmoothLiningTellsHardlyAnythingAndNothingWrong) {
  sim::SceneSetup setup = clean_road(0.5);
  setup.road.curve_radius_m = 20.0;
  for (const double range_bias_m : {0.03, -0.03}) {
    setup.sensor.range_bias_m = range_bias_m;
    const std::vector<MotionFrame> frames = SimulatedRun(setup).run(30);
    EXPECT_LE(expect_contract(frames), 3U) << range_bias_m;
    expect_nothing_misleading(frames);
  }
}

// Every noise a ruler has is gone: what little is left must not be taken for rock.
TEST(SimRun, ASmoothRoadSeenExactlyNeverMisleads) {
  for (const double noise_m : {0.0, 0.001, 0.004}) {
    for (const double slope_deg : {0.0, 4.0}) {
      SCOPED_TRACE(noise_m);
      sim::SceneSetup setup = clean_road(0.7);
      setup.sensor.range_noise_m = noise_m;
      setup.machine.pitch_deg = slope_deg;
      setup.machine.turned_left_deg = slope_deg;
      const std::vector<MotionFrame> frames = SimulatedRun(setup).run(25);
      expect_nothing_misleading(frames);
      expect_within_levels(frames);
    }
  }
}

// ------------------------------------------------------------------------------------------ rings and times

// As drivers write them: x y z, ring, time, each point behind the other.
struct DriverPoint {
  float xyz[3];
  std::uint16_t ring, unused;
  std::uint32_t time_ns;
};

std::vector<MotionFrame> run_as_driver(const SimulatedRun& run, std::uint32_t count, bool ring, bool time) {
  MotionUnderTest motion(config_for(run.simulator.setup()));
  return run.run_by(0, count, [&](std::uint32_t, const sim::Frame& frame, std::int64_t*) {
    std::vector<DriverPoint> points(frame.count());
    for (std::size_t k = 0; k < points.size(); ++k) {
      std::memcpy(points[k].xyz, &frame.xyz_intensity[4 * k], sizeof points[k].xyz);
      points[k].ring = frame.ring[k];
      points[k].unused = 0;
      points[k].time_ns = frame.time_ns[k];
    }
    pose_wall_cloud cloud;
    pose_wall_cloud_xyz32(&cloud, points.data(), static_cast<std::uint32_t>(points.size()), sizeof points[0],
                          frame.stamp_ns);
    if (ring) cloud.ring = {offsetof(DriverPoint, ring), POSE_WALL_FIELD_UINT16};
    if (time) cloud.time = {offsetof(DriverPoint, time_ns), POSE_WALL_FIELD_UINT32};
    return motion.process(cloud);
  });
}

// Also where a sensor has fewer directions than the image has columns: 16 and 32 rings in 512, a VLP-16 at 20 Hz.
TEST(SimRun, RingsTellTheSameWayAsElevations) {
  const struct {
    double rings, columns;
  } sensors[] = {{64.0, 512.0}, {64.0, 1024.0}, {32.0, 1024.0}, {16.0, 1800.0},
                 {32.0, 512.0}, {16.0, 1024.0}, {16.0, 900.0}};
  for (const auto& sensor : sensors) {
    sim::SceneSetup setup = rough_road(0.5);
    setup.sensor.rings = sensor.rings;
    setup.sensor.columns = sensor.columns;
    const SimulatedRun run(setup);
    const std::vector<MotionFrame> with = run_as_driver(run, 20, true, false),
                                   without = run_as_driver(run, 20, false, false);
    const std::uint32_t measured = expect_contract(with), measured_without = expect_contract(without);
    EXPECT_GE(measured + 4U, measured_without)
        << sensor.rings << " x " << sensor.columns << ": with rings " << measured << ", without " << measured_without
        << " of 19 measured; plane points " << with.back().result.plane_points << " and "
        << without.back().result.plane_points;
  }
}

// Rings of 16 meet the ground from 5 m on, and before a face only behind the machine: height hangs on pitch there.
TEST(SimRun, FewRingsOverRoughGroundStayWithinTheirLevels) {
  for (const std::uint64_t seed : {3U, 4U, 5U}) {
    SCOPED_TRACE(seed);
    sim::SceneSetup setup = rough_road(1.0);
    setup.rock.roughness_m = 0.05;
    setup.floor.floor_roughness_m = 0.02;
    setup.road.face_distance_m = 6.0;
    setup.sensor = sim::find_sensor("vlp16")->sensor;
    const std::vector<MotionFrame> frames = run_as_driver(SimulatedRun(setup, seed), 20, true, false);
    expect_contract(frames);
    expect_within_levels(frames);
  }
}

// As above, but the machine stands while the map begins.
TEST(SimRun, TimesTakeTheMotionOutOfTheScanOfAMachineThatSetsOff) {
  sim::SceneSetup setup = rough_road(0.0);
  setup.machine.speed_change_at_s = 0.5;
  setup.machine.speed_after_mps = 0.3;
  setup.sequence.scan_s = 0.099;
  setup.sensor.rings = 64.0;
  const SimulatedRun run(setup);
  const std::vector<MotionFrame> with = run_as_driver(run, 25, true, true);
  expect_contract(with);
  expect_nothing_misleading(with);
  expect_within_levels(with);
  EXPECT_LT(with.back().error_m(), 0.04);
}

// A scan that takes a tenth of a second while the machine turns by a degree and drives 8 cm.
TEST(SimRun, TimesTakeTheMotionOutOfTheScan) {
  sim::SceneSetup setup = rough_road(0.8);
  setup.machine.turn_rate_dps = 8.0;
  setup.sequence.scan_s = 0.099;
  setup.sensor.rings = 64.0;
  const SimulatedRun run(setup);
  const std::vector<MotionFrame> with = run_as_driver(run, 25, true, true),
                                 without = run_as_driver(run, 25, true, false);
  expect_contract(with);
  expect_nothing_misleading(with);
  expect_within_levels(with);
  EXPECT_LT(with.back().turn_error_rad(), 0.3 * kRadPerDeg);
  EXPECT_LT(with.back().turn_error_rad(), without.back().turn_error_rad());
  EXPECT_LT(with.back().error_m(), 0.06);
}

// ------------------------------------------------------------------------------------------ symmetries

struct Mount {
  double roll_deg, pitch_deg, yaw_deg;
};

TEST(SimRun, HowTheSensorIsMountedDoesNotMatter) {
  const sim::SceneSetup plain = rough_road(0.5);
  const std::vector<MotionFrame> expected = SimulatedRun(plain).run(30);
  for (const Mount& mount :
       {Mount{0.0, 0.0, 90.0}, Mount{180.0, 0.0, 0.0}, Mount{0.0, 0.0, 180.0}, Mount{0.0, 10.0, -45.0}}) {
    SCOPED_TRACE(mount.yaw_deg + 1000.0 * mount.roll_deg);
    sim::SceneSetup turned = plain;
    turned.mount.mount_roll_deg = mount.roll_deg;
    turned.mount.mount_pitch_deg = mount.pitch_deg;
    turned.mount.mount_yaw_deg = mount.yaw_deg;
    const std::vector<MotionFrame> frames = SimulatedRun(turned).run(30);
    EXPECT_GE(expect_contract(frames), 24U);
    EXPECT_LT((frames.back().position() - expected.back().position()).norm(), 0.03);
    EXPECT_LT(frames.back().error_m(), 0.03);
  }
}

TEST(SimRun, AMirroredSceneGivesTheMirroredPath) {
  sim::SceneSetup setup = rough_road(0.5);
  setup.machine.turned_left_deg = 4.0;
  setup.machine.lateral_m = 0.4;
  const SimulatedRun run(setup);
  MotionUnderTest plain(config_for(setup)), mirror(config_for(setup));
  const std::vector<MotionFrame> expected = run.run(plain, 30);
  const std::vector<MotionFrame> frames = run.run(mirror, 30, [](std::uint32_t, sim::Frame* frame) {
    for (std::size_t i = 0; i < frame->count(); ++i) frame->xyz_intensity[4 * i + 1] *= -1.0F;
  });
  const auto level = [](const MotionFrame& f, int k) { return f.result.protection_level[k]; };
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Eigen::Vector3d a = expected[i].position(), b = frames[i].position();
    double most = 0.0;
    for (const int k : {POSE_WALL_MOTION_ALONG, POSE_WALL_MOTION_ACROSS, POSE_WALL_MOTION_UP}) {
      most += level(expected[i], k) + level(frames[i], k);
    }
    ASSERT_LT((a - Eigen::Vector3d(b.x(), -b.y(), b.z())).norm(), most) << i;
  }
  const Eigen::Vector3d a = expected.back().position(), b = frames.back().position();
  EXPECT_LT((a - Eigen::Vector3d(b.x(), -b.y(), b.z())).norm(), 0.03);
}

// Which points are asked hangs on their order; what they say must not, but for their noise.
TEST(SimRun, TheOrderOfThePointsHardlyMatters) {
  sim::SceneSetup setup = rough_road(0.5);
  setup.sensor.rings = 64.0;
  setup.sensor.columns = 1024.0;
  const SimulatedRun run(setup);
  MotionUnderTest plain(config_for(setup)), shuffled(config_for(setup));
  const std::vector<MotionFrame> expected = run.run(plain, 30);
  const std::vector<MotionFrame> frames = run.run(shuffled, 30, [](std::uint32_t i, sim::Frame* frame) {
    std::vector<std::array<float, 4>> points(frame->count());
    std::memcpy(points.data(), frame->xyz_intensity.data(), points.size() * sizeof points[0]);
    std::mt19937 random(i);
    std::shuffle(points.begin(), points.end(), random);
    std::memcpy(frame->xyz_intensity.data(), points.data(), points.size() * sizeof points[0]);
  });
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double off = frames[i].result.along_m - expected[i].result.along_m;
    EXPECT_LE(std::fabs(off), frames[i].result.protection_level[POSE_WALL_MOTION_ALONG] +
                                  expected[i].result.protection_level[POSE_WALL_MOTION_ALONG])
        << i;
    if (i >= 5) sum += off, count += 1.0;
  }
  EXPECT_LT(std::fabs(sum / count), 5e-3) << "of single frames it is noise, in the mean it would be a bias";
}

TEST(SimRun, HowPointsAreWrittenChangesNoBit) {
  using pose_wall::test::CloudLayout;
  const sim::SceneSetup setup = rough_road(0.5);
  const SimulatedRun run(setup);
  const CloudLayout layouts[] = {
      {}, {true, false, 3, 9, 5, 1, 0}, {false, true, 1, 0, 2, 1, 0}, {true, true, 0, 0, 0, 2, 7}};
  std::vector<std::vector<pose_wall_motion_result>> results(std::size(layouts));
  for (std::size_t k = 0; k < std::size(layouts); ++k) {
    MotionUnderTest motion(config_for(setup));
    for (std::uint32_t i = 0; i < 12; ++i) {
      Points points = pose_wall::test::points_of(run.simulator.render(i));
      points.resize(points.size() / 2 * 2);  // two rows
      const auto encoded = pose_wall::test::encode(points, layouts[k], 100000000LL * i);
      results[k].push_back(motion.process(encoded.cloud));
    }
  }
  for (std::size_t k = 1; k < results.size(); ++k) {
    for (std::size_t i = 0; i < results[k].size(); ++i) {
      ASSERT_EQ(std::memcmp(&results[k][i], &results[0][i], sizeof results[0][i]), 0) << k << " frame " << i;
    }
  }
}

// ------------------------------------------------------------------------------------------ faults

class Faulty : public ::testing::Test {
 protected:
  // Frames of the run, of which some are changed.
  std::vector<MotionFrame> run(std::uint32_t count, const std::function<void(std::uint32_t, sim::Frame*)>& change) {
    return run_.run(motion_, count, change);
  }
  static void empty(sim::Frame* frame) {
    frame->xyz_intensity.clear();
    frame->labels.clear();
  }

  const SimulatedRun run_{rough_road(0.4)};
  MotionUnderTest motion_{config_for(run_.simulator.setup())};
};

TEST_F(Faulty, FramesOfNothingAreLostAndItGoesOn) {
  const std::vector<MotionFrame> frames = run(40, [](std::uint32_t i, sim::Frame* frame) {
    if (i == 15) empty(frame);
    if (i == 16) std::fill(frame->xyz_intensity.begin(), frame->xyz_intensity.end(), std::nanf(""));
    if (i == 17) frame->xyz_intensity.resize(4), frame->labels.resize(1);
  });
  expect_contract(frames);
  for (const std::size_t i : {15U, 16U, 17U}) {
    EXPECT_FALSE(frames[i].has_pose());
    EXPECT_NE(frames[i].result.reasons & POSE_WALL_MOTION_R_FEW_POINTS, 0U);
  }
  std::uint32_t measured = 0;
  for (std::size_t i = 18; i < frames.size(); ++i) measured += frames[i].measured() ? 1U : 0U;
  EXPECT_GE(measured, 15U);
  expect_nothing_misleading(frames);
  expect_within_levels(frames);
}

// The step is that from the last frame that had a pose, and says how long ago that was.
TEST_F(Faulty, TheStepAfterALostFrameIsFromTheLastPose) {
  const std::vector<MotionFrame> frames = run(25, [](std::uint32_t i, sim::Frame* frame) {
    if (i == 10 || i == 11 || i == 12) empty(frame);
  });
  const MotionFrame& after = frames[13];
  ASSERT_TRUE(after.has_pose());
  EXPECT_NEAR(after.result.step_s, 0.4, 1e-6);
  EXPECT_NEAR(after.result.step_m[0], 0.4 * 0.4, after.result.step_protection_level[POSE_WALL_MOTION_ALONG]);
}

TEST_F(Faulty, AFirstFrameOfNothingChangesNoPathThatFollows) {
  const std::vector<MotionFrame> frames = run(30, [](std::uint32_t i, sim::Frame* frame) {
    if (i == 0) empty(frame);
  });
  expect_contract(frames);
  EXPECT_FALSE(frames[0].has_pose());
  std::uint32_t measured = 0;
  for (const MotionFrame& f : frames) measured += f.measured() ? 1U : 0U;
  EXPECT_GE(measured, 24U);
  EXPECT_NEAR(frames.back().result.along_m, 28 * 0.04, 0.03);
}

// Nobody knows what lies between a frame without a pose and the one in which the map begins.
TEST_F(Faulty, AMapThatBeginsLateClaimsNoStep) {
  const std::vector<MotionFrame> frames = run(3, [](std::uint32_t i, sim::Frame* frame) {
    if (i == 0) empty(frame);
  });
  const pose_wall_motion_result& first = frames[1].result;
  ASSERT_NE(first.reasons & POSE_WALL_MOTION_R_FIRST, 0U);
  EXPECT_TRUE(std::isnan(first.step_m[0]) ||
              std::fabs(frames[1].step_along_error_m()) <= first.step_protection_level[POSE_WALL_MOTION_ALONG])
      << "a step of " << first.step_m[0] << " m within " << first.step_protection_level[POSE_WALL_MOTION_ALONG]
      << " m, and it was " << frames[1].step.norm() << " m";
}

// As it stands in the road is found from the first scan that has points, not from the first call.
TEST(SimRun, AMachineThatStandsAskewIsFoundSoAfterAFirstFrameOfNothing) {
  sim::SceneSetup setup = rough_road(0.4);
  setup.machine.turned_left_deg = 38.0;
  setup.machine.drift_mps = 0.0;
  const SimulatedRun run(setup);
  MotionUnderTest plain(config_for(setup)), late(config_for(setup));
  const auto count = [](const std::vector<MotionFrame>& frames) {
    std::uint32_t measured = 0;
    for (const MotionFrame& f : frames) measured += f.measured() ? 1U : 0U;
    return measured;
  };
  const std::uint32_t expected = count(run.run(plain, 25));
  const std::uint32_t found = count(run.run(late, 26, [](std::uint32_t i, sim::Frame* frame) {
    if (i == 0) frame->xyz_intensity.clear(), frame->labels.clear();
  }));
  EXPECT_GE(found + 3U, expected);
}

TEST_F(Faulty, GarbageIsNotMeasured) {
  const std::vector<MotionFrame> frames = run(40, [](std::uint32_t i, sim::Frame* frame) {
    if (i < 12 || i >= 20) return;
    std::mt19937 random(i);
    for (float& v : frame->xyz_intensity) {
      const auto bits = static_cast<std::uint32_t>(random());
      if (i % 2 == 0) {
        std::memcpy(&v, &bits, sizeof v);
      } else {
        v = static_cast<float>(bits) * (16.0F / 4294967296.0F) - 8.0F;
      }
    }
  });
  expect_contract(frames);
  for (std::size_t i = 12; i < 20; ++i) EXPECT_FALSE(frames[i].measured()) << i;
  expect_within_levels(frames);
  EXPECT_TRUE(frames.back().has_pose());
}

TEST_F(Faulty, StampsThatStandOrGoBackTakeNothing) {
  std::int64_t held = 0;
  const std::vector<MotionFrame> frames = run(30, [&held](std::uint32_t i, sim::Frame* frame) {
    if (i == 9) held = frame->stamp_ns;
    if (i == 10 || i == 11) frame->stamp_ns = held;
    if (i == 12) frame->stamp_ns = held - 1000000000;
  });
  expect_contract(frames);
  for (const std::size_t i : {10U, 11U, 12U}) {
    EXPECT_NE(frames[i].result.reasons & POSE_WALL_MOTION_R_STAMP, 0U);
    EXPECT_FALSE(frames[i].measured());
    EXPECT_EQ(frames[i].result.along_m, frames[9].result.along_m);
    EXPECT_EQ(frames[i].result.tiles, frames[9].result.tiles);
  }
  EXPECT_TRUE(frames.back().measured());
  EXPECT_LT(frames.back().error_m(), 0.03);
}

// A clock that was set back stays back: the motion must not stand for as long.
TEST_F(Faulty, AClockThatWasSetBackIsFollowed) {
  const std::vector<MotionFrame> frames = run(40, [](std::uint32_t i, sim::Frame* frame) {
    if (i >= 10) frame->stamp_ns -= 3600000000000LL;
  });
  expect_contract(frames);
  std::uint32_t with_stamp_reason = 0;
  for (const MotionFrame& f : frames) with_stamp_reason += (f.result.reasons & POSE_WALL_MOTION_R_STAMP) != 0 ? 1U : 0U;
  EXPECT_LT(with_stamp_reason, 10U) << "frames that were taken for nothing";
}

TEST_F(Faulty, AClockThatJumpsFarAheadIsAGap) {
  for (const long long jump_ns : {3600000000000LL, 86400000000000LL * 3650, 1LL << 62}) {
    SCOPED_TRACE(jump_ns);
    motion_.reset();
    const std::vector<MotionFrame> frames = run(30, [jump_ns](std::uint32_t i, sim::Frame* frame) {
      if (i >= 12) frame->stamp_ns += jump_ns;
    });
    expect_contract(frames);
    expect_nothing_misleading(frames);
    expect_within_levels(frames);
    EXPECT_TRUE(frames.back().has_pose());
  }
}

// The last twist's noise, carried on for minutes, would be a turn by any angle.
TEST(SimRun, WhoStoodThroughALongGapIsFoundWhereItStood) {
  const SimulatedRun run(rough_road(0.0));
  for (const std::int64_t gap_s : {5, 60, 600, 3600}) {
    MotionUnderTest motion(config_for(run.simulator.setup()));
    const std::vector<MotionFrame> frames = run.run(motion, 20, [gap_s](std::uint32_t i, sim::Frame* frame) {
      if (i >= 15) frame->stamp_ns += gap_s * 1000000000;
    });
    ASSERT_TRUE(frames[15].has_pose()) << gap_s << " s";
    EXPECT_LT(frames[15].error_m(), 0.1) << gap_s << " s";
    EXPECT_LT(frames[15].turn_error_rad(), 1.0 * kRadPerDeg) << gap_s << " s";
  }
}

TEST_F(Faulty, StampsAtTheEndsOfTheirRange) {
  const std::int64_t ends[] = {INT64_MIN, INT64_MAX, 0, INT64_MAX - 1, INT64_MIN + 1};
  const std::vector<MotionFrame> frames =
      run(10, [&ends](std::uint32_t i, sim::Frame* frame) { frame->stamp_ns = ends[i % 5]; });
  expect_contract(frames);
}

// 2 Hz and 1 m/s: half a metre between frames, also at the start and where it stops.
TEST(SimRun, TwoFramesASecondNeverMislead) {
  sim::SceneSetup setup = rough_road(0.0);
  setup.sequence.rate_hz = 2.0;
  setup.machine.speed_change_at_s = 3.0;
  setup.machine.speed_after_mps = 1.2;
  for (const std::uint64_t seed : {1ULL, 2ULL}) {
    const std::vector<MotionFrame> frames = SimulatedRun(setup, seed).run(24);
    expect_contract(frames);
    expect_nothing_misleading(frames);
    expect_within_levels(frames);
  }
}

TEST(SimRun, MorePointsThanTheImageHasCellsAreNoTrouble) {
  sim::SceneSetup setup = rough_road(0.5);
  setup.sensor.rings = 128.0;
  setup.sensor.columns = 1024.0;
  const std::vector<MotionFrame> frames = SimulatedRun(setup).run(6);
  expect_contract(frames);
  EXPECT_GT(frames.back().result.points_in, 65536U);
  EXPECT_LT(frames.back().error_m(), 0.03);
}

}  // namespace
}  // namespace pose_wall::motion::test
