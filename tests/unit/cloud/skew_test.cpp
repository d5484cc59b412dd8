// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a point that was measured later lies where it would have been seen at the stamp, in every unit and type of
// times; without an odometry, without times or with times that make no scan, points stay where they are.

#include "engine/cloud/skew.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "base/math/rotation.hpp"
#include "lidar/cloud_reader.hpp"

namespace pose_wall {
namespace {

struct TimedPoint {
  float x, y, z;
  double time;
};

pose_wall_cloud cloud_of(const std::vector<TimedPoint>& points) {
  pose_wall_cloud cloud;
  EXPECT_EQ(pose_wall_cloud_xyz32(&cloud, points.data(), static_cast<std::uint32_t>(points.size()),
                                  sizeof(points.front()), 0),
            POSE_WALL_OK);
  cloud.time = {offsetof(TimedPoint, time), POSE_WALL_FIELD_FLOAT64};
  return cloud;
}

pose_wall_odometry moving(double forward_m_s, double turn_rad_s) {
  pose_wall_odometry o{};
  o.velocity_m_s[0] = forward_m_s;
  o.turn_rate_rad_s[2] = turn_rad_s;
  return o;
}

const unsigned char* bytes_of(const TimedPoint& p) {
  return reinterpret_cast<const unsigned char*>(&p);
}

TEST(VoxelSkew, APointThatWasSeenLaterLiesFurtherOn) {
  const std::vector<TimedPoint> points = {{1, 2, 3, 5.0}, {1, 2, 3, 5.1}};
  const pose_wall_odometry odometry = moving(2.0, 0.0);
  const pose_wall_cloud cloud = cloud_of(points);
  const Skew skew(cloud, &odometry);
  ASSERT_TRUE(skew.is_there());
  EXPECT_NEAR(skew.scan_s(), 0.1, 1e-9);
  const FourFloats t = {skew.seconds(bytes_of(points[0])), skew.seconds(bytes_of(points[1])), 0.0F, 0.0F};
  const FourPlaces p = skew.taken_out({all_four(1.0F), all_four(2.0F), all_four(3.0F)}, t);
  EXPECT_EQ(p.x[0], 1.0F);
  EXPECT_NEAR(p.x[1], 1.2F, 1e-6F);
  EXPECT_EQ(p.y[1], 2.0F);
  EXPECT_EQ(p.z[1], 3.0F);
}

TEST(VoxelSkew, ATurnIsTakenOutToATenthOfAMillimetre) {
  const std::vector<TimedPoint> points = {{0, 0, 0, 0.0}, {10, 0, 0, 0.1}};
  const double rate = 0.1745;  // 10 degrees a second
  const pose_wall_odometry odometry = moving(0.0, rate);
  const pose_wall_cloud cloud = cloud_of(points);
  const Skew skew(cloud, &odometry);
  const FourFloats t = all_four(skew.seconds(bytes_of(points[1])));
  const FourPlaces p = skew.taken_out({all_four(10.0F), all_four(0.0F), all_four(0.0F)}, t);
  const Eigen::Vector3d truth = rotation_zyx(0.0, 0.0, 0.1 * rate) * Eigen::Vector3d(10.0, 0.0, 0.0);
  EXPECT_NEAR(static_cast<double>(p.x[0]), truth.x(), 1e-4);
  EXPECT_NEAR(static_cast<double>(p.y[0]), truth.y(), 1e-4);
}

TEST(VoxelSkew, TheUnitIsTheOneByWhichItIsAScan) {
  EXPECT_EQ(time_unit_s(0.1), 1.0);
  EXPECT_EQ(time_unit_s(99.0), 1e-3);
  EXPECT_EQ(time_unit_s(1e5), 1e-6);
  EXPECT_EQ(time_unit_s(1e8), 1e-9);
  for (const double none : {0.0, 0.005, 5e9, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(time_unit_s(none), 0.0) << none;
  }
}

TEST(VoxelSkew, WithoutOdometryOrTimesNothingIsTakenOut) {
  const std::vector<TimedPoint> points = {{1, 2, 3, 0.0}, {1, 2, 3, 0.1}}, same = {{1, 2, 3, 0.1}, {1, 2, 3, 0.1}};
  const pose_wall_odometry odometry = moving(1.0, 1.0);
  pose_wall_cloud cloud = cloud_of(points);
  EXPECT_FALSE(Skew(cloud, nullptr).is_there());
  EXPECT_FALSE(Skew(cloud_of(same), &odometry).is_there());
  cloud.time = {};
  EXPECT_FALSE(Skew(cloud, &odometry).is_there());
}

TEST(VoxelSkew, ATimeThatIsNoneIsTheFirst) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<TimedPoint> points = {{1, 2, 3, 0.0}, {1, 2, 3, nan}, {1, 2, 3, 0.1}};
  const pose_wall_odometry odometry = moving(1.0, 0.0);
  const pose_wall_cloud cloud = cloud_of(points);
  const Skew skew(cloud, &odometry);
  ASSERT_TRUE(skew.is_there());
  EXPECT_EQ(skew.seconds(bytes_of(points[1])), 0.0F);
}

}  // namespace
}  // namespace pose_wall
