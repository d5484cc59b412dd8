// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the two steps find the pose of a scan in a map of the same room, from any of a grid of offsets in six
// directions, to a millimetre and two hundredths of a degree, which is
// what cells leave where two surfaces meet; without the way along they leave it alone; axes lie along
// the road and point forward; a wide search finds a scan that stands turned by 40 degrees and a metre off.

#include "motion/registration.hpp"

#include <gtest/gtest.h>

#include "motion/pipeline.hpp"
#include "motion/wide_start.hpp"

namespace pose_wall::motion::test {
namespace {

constexpr double kDegree_rad = M_PI / 180.0;

double turn_between_rad(const Pose& a, const Pose& b) {
  return turn_of(a.R.transpose() * b.R).norm();
}

class Steps : public ::testing::Test {
 protected:
  // A room that is closed ahead and behind: its ends tell the way along. The map knows it from three places.
  void map_room() {
    for (const double x : {0.0, 0.6, -0.6}) {
      const Pose at = pose_of(x, 0.1 * x, 0.0, 0.0, 0.0, 0.0);
      pipeline_.see(scan_of(room_, at), at);
      pipeline_.take_in(at);
    }
  }
  bool search(double yaw_rad, double place_m, Pose* found) {
    Laid<StartScratch> scratch;
    Work work;
    return search_wide(*pipeline_.map, pipeline_.observations, {yaw_rad, place_m}, scratch.get(), &work, found);
  }
  void expect_found(const Pose& truth, const Pose& from, double within_m, double within_rad) {
    pipeline_.see(scan_of(room_, truth), from);
    const Alignment a = pipeline_.align(from, true, 12);
    EXPECT_LT((a.pose.t - truth.t).norm(), within_m) << (a.pose.t - truth.t).transpose();
    EXPECT_LT(turn_between_rad(a.pose, truth), within_rad) << turn_between_rad(a.pose, truth) / kDegree_rad << " deg";
    EXPECT_GT(a.matched, 80U);
    EXPECT_GT(a.ground, 80U);
  }

  BoxRoom room_ = {6.0, 2.5, 1.4, 1.8, {}};
  Pipeline pipeline_;
};

TEST_F(Steps, AScanFromTheMapsPlaceStaysThere) {
  map_room();
  expect_found(Pose{}, Pose{}, 1e-3, 0.02 * kDegree_rad);
}

TEST_F(Steps, AnyOfAGridOfOffsetsIsFound) {
  map_room();
  for (int k = 0; k < 64; ++k) {
    const auto sign = [k](int bit) { return ((k >> bit) & 1) != 0 ? 1.0 : -1.0; };
    const Pose truth = pose_of(0.10 * sign(0), 0.08 * sign(1), 0.05 * sign(2), kDegree_rad * sign(3),
                               kDegree_rad * sign(4), 2.0 * kDegree_rad * sign(5));
    SCOPED_TRACE(k);
    expect_found(truth, Pose{}, 1e-3, 0.02 * kDegree_rad);
  }
}

TEST_F(Steps, OneDirectionAtATime) {
  map_room();
  for (int k = 0; k < 6; ++k) {
    double by[6] = {};
    by[k] = k < 3 ? 0.12 : 2.5 * kDegree_rad;
    const Pose truth = pose_of(by[0], by[1], by[2], by[3], by[4], by[5]);
    SCOPED_TRACE(k);
    expect_found(truth, Pose{}, 1e-3, 0.02 * kDegree_rad);
  }
}

TEST_F(Steps, WithoutTheWayAlongItIsLeftAlone) {
  room_.length_m = 40.0;  // no end in sight
  map_room();
  const Pose truth = pose_of(0.1, 0.08, 0.03, 0.5 * kDegree_rad, -0.5 * kDegree_rad, kDegree_rad);
  pipeline_.see(scan_of(room_, truth), Pose{});
  const Alignment a = pipeline_.align(Pose{}, false);
  const Eigen::Vector3d off = a.pose.t - truth.t;
  EXPECT_NEAR(off.dot(a.axes.along), -0.1, 0.01) << "as it was given";
  EXPECT_LT(std::fabs(off.y()), 2e-3);
  EXPECT_LT(std::fabs(off.z()), 1e-3);
  EXPECT_LT(turn_between_rad(a.pose, truth), 0.02 * kDegree_rad);
  EXPECT_EQ(a.covariance(0, 0), 0.0);
}

TEST_F(Steps, TheRoadsAxisIsWhereSurfacesGiveLeastHold) {
  room_.length_m = 40.0;
  map_room();
  pipeline_.see(scan_of(room_, Pose{}), Pose{});
  for (const double forward : {1.0, -1.0}) {
    Alignment a;
    a.axes = find_axes(pipeline_.scan(), a.pose, {forward, 0.3, 0.0}, a.axes);
    EXPECT_LT((a.axes.along - Eigen::Vector3d(forward, 0.0, 0.0)).norm(), 1e-3);
    EXPECT_LT((a.axes.left - Eigen::Vector3d(0.0, forward, 0.0)).norm(), 1e-3);
    EXPECT_LT((a.axes.up - Eigen::Vector3d(0.0, 0.0, 1.0)).norm(), 1e-3);
    EXPECT_LT(a.axes.hold, 0.01);
  }
}

// Neither floor nor roof is in sight, so up is what is known least. The way along lies about level in the machine then,
// which may be pitched itself.
TEST_F(Steps, TheRoadsAxisIsNotUpWhereOnlyWallsAreSeen) {
  const auto rock = [](int, double u, double v) { return 0.02 * std::sin(2.0 * u + v) + 0.02 * std::sin(3.0 * v - u); };
  room_ = {6.0, 2.5, 20.0, 20.0, rock};
  map_room();
  for (const double pitch_deg : {0.0, 15.0}) {
    const Pose at = pose_of(0.0, 0.0, 0.0, 0.0, pitch_deg * kDegree_rad, 0.0);
    pipeline_.see(scan_of(room_, at), at);
    for (const double forward : {1.0, -1.0}) {
      Alignment a;
      a.pose = at;
      a.axes = find_axes(pipeline_.scan(), a.pose, {forward, 0.2, 0.0}, a.axes);
      EXPECT_GT(a.axes.along.dot(Eigen::Vector3d(forward, 0.0, 0.0)), 0.9) << pitch_deg << " " << forward;
      EXPECT_LT(std::fabs(a.axes.along.y()), 0.05) << pitch_deg << " " << forward;
      EXPECT_GT(a.axes.up.z(), 0.9) << pitch_deg << " " << forward;
    }
  }
}

TEST_F(Steps, AHallHoldsInEveryDirection) {
  room_ = {2.5, 2.5, 1.4, 1.8, {}};
  map_room();
  pipeline_.see(scan_of(room_, Pose{}), Pose{});
  Alignment a;
  a.axes = find_axes(pipeline_.scan(), a.pose, Eigen::Vector3d::UnitX(), a.axes);
  EXPECT_GT(a.axes.hold, 0.3);
}

// Floor and roof of a wide hall are nine points of ten. Its walls still give half of what is observed, or all they
// have.
TEST_F(Steps, TheWallsOfAHallAreNotOutnumbered) {
  room_ = {16.0, 14.0, 1.4, 3.0, {}};
  pipeline_.see(scan_of(room_, Pose{}, {128, 1024}), Pose{});
  std::uint32_t on_walls = 0, level = 0;
  for (const Observation& o : pipeline_.observations) ++(o.facing == kFacesZ ? level : on_walls);
  EXPECT_GT(on_walls, kObservationsMost / 4);
  EXPECT_GT(level, kObservationsMost / 4);
  EXPECT_EQ(on_walls + level, kObservationsMost);
}

// A machine that begins to move is not where it is expected, and its hall is a hall all the same.
TEST_F(Steps, AHallHoldsAlsoWhereTheWayIsNotKnownYet) {
  room_ = {6.0, 5.0, 1.4, 1.8, {}};
  map_room();
  pipeline_.see(scan_of(room_, pose_of(0.25, 0.0, 0.0, 0.0, 0.0, 0.0)), Pose{});
  Alignment a;
  a.axes = find_axes(pipeline_.scan(), a.pose, Eigen::Vector3d::UnitX(), a.axes);
  EXPECT_GT(a.axes.hold, 0.1);
}

// In a square hall any axis is as good. Where it lies askew, the walls hold across and yaw all the same.
TEST_F(Steps, WallsThatLieAskewToTheAxisCount) {
  room_ = {5.0, 5.0, 1.4, 1.8, {}};
  map_room();
  const Pose truth = pose_of(0.0, 0.0, 0.0, 0.0, 0.0, 0.01);
  pipeline_.see(scan_of(room_, truth), Pose{});
  Alignment a;
  const double s = std::sqrt(0.5);
  a.axes.along = {s, s, 0.0};
  a.axes.left = {-s, s, 0.0};
  StepOptions fine;
  fine.use_relief = true;
  for (int pass = 0; pass < 4; ++pass) take_steps(pipeline_.scan(), fine, pipeline_.steps.get(), &a);
  EXPECT_GT(a.matched, 80U);
  EXPECT_LT(turn_between_rad(a.pose, truth), 0.1 * kDegree_rad);
}

TEST_F(Steps, AnEmptyMapMovesNothing) {
  const Pose from = pose_of(0.1, 0.2, 0.3, 0.0, 0.0, 0.1);
  pipeline_.see(scan_of(room_, Pose{}), from);
  const Alignment a = pipeline_.align(from, true);
  EXPECT_EQ((a.pose.t - from.t).norm(), 0.0);
  EXPECT_LT(turn_between_rad(a.pose, from), 1e-12);
  EXPECT_EQ(a.matched, 0U);
}

TEST_F(Steps, CovariancesAreSymmetricAndNotNegative) {
  map_room();
  pipeline_.see(scan_of(room_, pose_of(0.05, 0.02, 0.0, 0.0, 0.0, 0.01)), Pose{});
  const Alignment a = pipeline_.align(Pose{}, true);
  EXPECT_LT((a.covariance - a.covariance.transpose()).norm(), 1e-12);
  for (int k = 0; k < 6; ++k) EXPECT_GE(a.covariance(k, k), 0.0) << k;
}

// ------------------------------------------------------------------------------------------ wide start

TEST_F(Steps, AWideSearchFindsAScanThatStandsTurnedAndOff) {
  room_ = {4.0, 2.5, 1.4, 1.8, {}};
  map_room();
  for (const double yaw_deg : {40.0, -40.0, 25.0}) {
    for (const double off_m : {1.0, -1.0}) {
      SCOPED_TRACE(yaw_deg);
      const Pose truth = pose_of(off_m, 0.4 * off_m, 0.0, 0.0, 0.0, yaw_deg * kDegree_rad);
      pipeline_.see(scan_of(room_, truth), Pose{});
      Pose found;
      ASSERT_TRUE(search(60.0 * kDegree_rad, 1.5, &found));
      EXPECT_LT((found.t - truth.t).norm(), 0.45) << "within a step of the search";
      EXPECT_LT(turn_between_rad(found, truth), 5.0 * kDegree_rad);
      const Alignment a = pipeline_.align(found, true);
      EXPECT_LT((a.pose.t - truth.t).norm(), 5e-3);
      EXPECT_LT(turn_between_rad(a.pose, truth), 0.05 * kDegree_rad);
    }
  }
}

TEST_F(Steps, AWideSearchFindsNothingInAnotherPlace) {
  map_room();
  BoxRoom other = {1.2, 1.0, 3.0, 4.0, {}};
  pipeline_.see(scan_of(other, Pose{}), Pose{});
  Pose found;
  EXPECT_FALSE(search(0.1, 0.3, &found));
  EXPECT_LT(share_on_map(*pipeline_.map, pipeline_.observations, Pose{}, 1), 0.25);
}

TEST_F(Steps, AllOfAScanLiesOnTheMapOfItsOwnPlace) {
  map_room();
  pipeline_.see(scan_of(room_, Pose{}), Pose{});
  EXPECT_GT(share_on_map(*pipeline_.map, pipeline_.observations, Pose{}, 1), 0.95);
  EXPECT_GT(share_on_map(*pipeline_.map, pipeline_.observations, Pose{}, 7), 0.9);
  EXPECT_EQ(share_on_map(*pipeline_.map, {}, Pose{}, 1), 0.0);
}

TEST_F(Steps, AScanIsTakenUprightAndSquareByItsNormals) {
  for (const double roll_deg : {-12.0, 0.0, 8.0}) {
    for (const double yaw_deg : {-30.0, 0.0, 40.0}) {
      const Pose truth = pose_of(0.0, 0.0, 0.0, roll_deg * kDegree_rad, 5.0 * kDegree_rad, yaw_deg * kDegree_rad);
      pipeline_.see(scan_of(room_, truth), Pose{});
      const Eigen::Matrix3d level =
          upright(pipeline_.observations, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
      // Up of the room, as the upright scan has it.
      const Eigen::Vector3d up = level * (truth.R.transpose() * Eigen::Vector3d::UnitZ());
      EXPECT_LT((up - Eigen::Vector3d::UnitZ()).norm(), 0.5 * kDegree_rad) << roll_deg << " " << yaw_deg;
      const double yaw = squaring_yaw_rad(pipeline_.observations, level);
      const Eigen::Vector3d wall = turn_by({0.0, 0.0, yaw}) * level * (truth.R.transpose() * Eigen::Vector3d::UnitY());
      const double off = std::min(std::fabs(wall.x()), std::fabs(wall.y()));
      EXPECT_LT(off, 0.3 * kDegree_rad) << roll_deg << " " << yaw_deg;
    }
  }
}

TEST_F(Steps, WithoutGroundNothingIsTurnedUpright) {
  EXPECT_EQ(upright({}, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()),
            Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  EXPECT_EQ(squaring_yaw_rad({}, Eigen::Matrix3d::Identity()), 0.0);
}

}  // namespace
}  // namespace pose_wall::motion::test
