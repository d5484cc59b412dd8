// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: where the sensor stands by /tf and /tf_static, against answers worked out by hand and against tf2. Nothing is
// told by links that are missing, old, rings or no rotations. Other machines' links do not matter.

#include "apps/live/ros_messages/transform_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "live/tf_message.hpp"
#ifdef POSE_WALL_TEST_HAS_TF2
#include <tf2/buffer_core.h>
#endif

namespace pose_wall::tools::live {
namespace {

using namespace pose_wall::test;

constexpr double kTurn = 1.5707963267948966;  // a quarter
// Of 1/2: cosine and sine of half of kTurn, as a quaternion has them.
constexpr double kRoot = 0.70710678118654757;
// Rounding of a few products of numbers near 1.
constexpr double kRounding = 1e-12;
// When a link of /tf has just become too old.
constexpr std::int64_t kLater_ns = TransformTree::kOld_ns + 1;

void take(TransformTree* tree, const std::vector<TfLink>& links, bool is_static = true, std::int64_t now_ns = 0) {
  tree->take(MessageEncoding::kRos1, view_of(tf_message(links)), is_static, now_ns);
}

void expect_extrinsic(const std::optional<Extrinsic>& found, const Extrinsic& expected) {
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->x_m, expected.x_m, kRounding);
  EXPECT_NEAR(found->y_m, expected.y_m, kRounding);
  EXPECT_NEAR(found->z_m, expected.z_m, kRounding);
  EXPECT_NEAR(found->roll_rad, expected.roll_rad, kRounding);
  EXPECT_NEAR(found->pitch_rad, expected.pitch_rad, kRounding);
  EXPECT_NEAR(found->yaw_rad, expected.yaw_rad, kRounding);
}

// A quarter turn to the left on a mast 2 m ahead: what the sensor has ahead, base has to the left.
TEST(TransformTree, OneLinkIsTheSensorsPlace) {
  for (const MessageEncoding encoding : {MessageEncoding::kRos1, MessageEncoding::kCdr}) {
    TransformTree tree;
    const std::string message = tf_message({{"base_link", "lidar", {2.0, 0.5, 1.25}, {0, 0, kRoot, kRoot}}}, encoding);
    tree.take(encoding, view_of(message), true, 0);
    expect_extrinsic(tree.extrinsic("base_link", "lidar", 0), {2.0, 0.5, 1.25, 0.0, 0.0, kTurn});
  }
}

// The same link read from the other end: base is the child, so the inverse counts. R(-90 deg) of -(2, 0.5, 1.25).
TEST(TransformTree, ALinkIsFollowedBackwards) {
  TransformTree tree;
  take(&tree, {{"lidar", "base_link", {2.0, 0.5, 1.25}, {0, 0, kRoot, kRoot}}});
  expect_extrinsic(tree.extrinsic("base_link", "lidar", 0), {-0.5, 2.0, -1.25, 0.0, 0.0, -kTurn});
}

// base -> mast (1, 0, 1), quarter turn left; mast -> lidar (1, 0, 0) is then 1 to the left of the mast.
TEST(TransformTree, AChainIsFollowedAndSlashesAreNoPartOfANamesMeaning) {
  TransformTree tree;
  take(&tree, {{"/mast", "/lidar", {1, 0, 0}}, {"base_link", "mast", {1, 0, 1}, {0, 0, kRoot, kRoot}}});
  expect_extrinsic(tree.extrinsic("/base_link", "lidar", 0), {1.0, 1.0, 1.0, 0.0, 0.0, kTurn});
}

// Roll and pitch by hand: turned about x by 90 degrees, its y points up; about y by 90, its x points down.
TEST(TransformTree, RollAndPitchTurnAsTheConfigsDo) {
  TransformTree tree;
  take(&tree,
       {{"base", "rolled", {}, {kRoot, 0, 0, kRoot}}, {"base", "nodding", {}, {0, std::sin(0.1), 0, std::cos(0.1)}}});
  expect_extrinsic(tree.extrinsic("base", "rolled", 0), {0, 0, 0, kTurn, 0, 0});
  expect_extrinsic(tree.extrinsic("base", "nodding", 0), {0, 0, 0, 0, 0.2, 0});
}

TEST(TransformTree, ALensOnItsNoseKeepsItsMatrix) {
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(kTurn, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(-0.4, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = R;
  const Extrinsic told = extrinsic_of(pose);
  const Eigen::Matrix3d again = (Eigen::AngleAxisd(told.yaw_rad, Eigen::Vector3d::UnitZ()) *
                                 Eigen::AngleAxisd(told.pitch_rad, Eigen::Vector3d::UnitY()) *
                                 Eigen::AngleAxisd(told.roll_rad, Eigen::Vector3d::UnitX()))
                                    .toRotationMatrix();
  // Near 90 degrees the pitch is known to the root of the rounding only.
  EXPECT_LT((again - R).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(TransformTree, NeverTheIdentityByDefault) {
  TransformTree tree;
  EXPECT_FALSE(tree.extrinsic("base_link", "lidar", 0));
  take(&tree, {{"base_link", "camera", {1, 0, 0}}, {"other", "lidar", {1, 0, 0}}});
  EXPECT_FALSE(tree.extrinsic("base_link", "lidar", 0));
}

TEST(TransformTree, TheNewestCountsAndAnOldOneByTfIsGone) {
  TransformTree tree;
  take(&tree, {{"base", "lidar", {1, 0, 0}}}, false, 0);
  take(&tree, {{"base", "lidar", {2, 0, 0}}}, false, 1);
  expect_extrinsic(tree.extrinsic("base", "lidar", kLater_ns), {2, 0, 0, 0, 0, 0});
  EXPECT_FALSE(tree.extrinsic("base", "lidar", kLater_ns + 1));
  take(&tree, {{"base", "lidar", {3, 0, 0}}}, false, kLater_ns + 1);
  expect_extrinsic(tree.extrinsic("base", "lidar", kLater_ns + 1), {3, 0, 0, 0, 0, 0});
}

TEST(TransformTree, AStaticOneDoesNotGrowOld) {
  TransformTree tree;
  take(&tree, {{"base", "lidar", {1, 0, 0}}}, true, 0);
  EXPECT_TRUE(tree.extrinsic("base", "lidar", std::numeric_limits<std::int64_t>::max()));
}

// Odometry that fell silent says nothing about how the sensor is mounted.
TEST(TransformTree, AnOldPlaceInTheWorldDoesNotMatter) {
  TransformTree tree;
  take(&tree, {{"odom", "base", {70, 0, 0}}, {"map", "odom", {9, 9, 9}}}, false, 0);
  take(&tree, {{"base", "lidar", {1, 0, 0}}}, true, 0);
  expect_extrinsic(tree.extrinsic("base", "lidar", kLater_ns), {1, 0, 0, 0, 0, 0});
}

TEST(TransformTree, TwoBranchesMeetBelowAnOldRoot) {
  TransformTree tree;
  take(&tree, {{"world", "body", {5, 0, 0}}}, false, 0);
  take(&tree, {{"body", "base", {1, 0, 0}}, {"body", "lidar", {1, 2, 3}}}, true, 0);
  expect_extrinsic(tree.extrinsic("base", "lidar", kLater_ns), {0, 2, 3, 0, 0, 0});
}

TEST(TransformTree, RingsEnd) {
  TransformTree tree;
  take(&tree, {{"a", "b"}, {"b", "c"}, {"c", "a"}, {"lidar", "lidar"}, {"b", "lidar"}});
  EXPECT_FALSE(tree.extrinsic("base", "lidar", 0));
  EXPECT_TRUE(tree.extrinsic("c", "lidar", 0));
}

TEST(TransformTree, WhatIsNoRotationOrNoNumberIsPassedOver) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  TransformTree tree;
  take(&tree, {{"base", "zero", {}, {0, 0, 0, 0}},
               {"base", "long", {}, {0, 0, 0, 1.1}},
               {"base", "nan", {nan, 0, 0}},
               {"", "nameless"},
               {"base", ""},
               {"base", "sound", {1, 0, 0}}});
  for (const char* frame : {"zero", "long", "nan", "nameless"}) EXPECT_FALSE(tree.extrinsic("base", frame, 0)) << frame;
  EXPECT_TRUE(tree.extrinsic("base", "sound", 0));
}

TEST(TransformTree, CutMessagesAreRefusedWholeAndCountsAreNotBelieved) {
  const std::string whole = tf_message({{"base", "lidar", {1, 0, 0}}});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    TransformTree tree;
    EXPECT_THROW(tree.take(MessageEncoding::kRos1, view_of(whole.substr(0, size)), true, 0), FrameError) << size;
    EXPECT_FALSE(tree.extrinsic("base", "lidar", 0)) << size;
  }
  std::string many = whole;
  many.replace(0, 4, "\xff\xff\xff\xff");
  TransformTree tree;
  EXPECT_THROW(tree.take(MessageEncoding::kRos1, view_of(many), true, 0), FrameError);
}

TEST(TransformTree, NamesOfOthersDoNotFillTheMemory) {
  TransformTree tree;
  take(&tree, {{"base", "lidar", {1, 0, 0}}});
  std::vector<TfLink> many;
  for (std::size_t i = 0; i < TransformTree::kLinksMost; ++i) many.push_back({"base", "x" + std::to_string(i)});
  take(&tree, many);
  EXPECT_FALSE(tree.extrinsic("base", "x" + std::to_string(TransformTree::kLinksMost - 1), 0));
  take(&tree, {{"base", "lidar", {2, 0, 0}}});
  expect_extrinsic(tree.extrinsic("base", "lidar", 0), {2, 0, 0, 0, 0, 0});
}

#ifdef POSE_WALL_TEST_HAS_TF2
Eigen::Isometry3d pose_of(const Extrinsic& e) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = (Eigen::AngleAxisd(e.yaw_rad, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(e.pitch_rad, Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(e.roll_rad, Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  pose.translation() = Eigen::Vector3d(e.x_m, e.y_m, e.z_m);
  return pose;
}

// Random trees of seven frames, asked for each pair of them.
TEST(TransformTree, SaysWhatTf2Says) {
  std::mt19937 random(35);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int round = 0; round < 50; ++round) {
    tf2::BufferCore buffer;
    TransformTree tree;
    std::vector<std::string> frames = {"f0"};
    for (int i = 1; i < 7; ++i) {
      const Eigen::Vector4d q = Eigen::Vector4d(any(random), any(random), any(random), any(random)).normalized();
      const TfLink link{frames[random() % frames.size()],
                        "f" + std::to_string(i),
                        {3 * any(random), 3 * any(random), 3 * any(random)},
                        {q[0], q[1], q[2], q[3]}};
      geometry_msgs::TransformStamped stamped;
      stamped.header.frame_id = link.parent;
      stamped.child_frame_id = link.child;
      stamped.transform.translation.x = link.position_m[0];
      stamped.transform.translation.y = link.position_m[1];
      stamped.transform.translation.z = link.position_m[2];
      stamped.transform.rotation.x = q[0];
      stamped.transform.rotation.y = q[1];
      stamped.transform.rotation.z = q[2];
      stamped.transform.rotation.w = q[3];
      ASSERT_TRUE(buffer.setTransform(stamped, "test", true));
      take(&tree, {link});
      frames.push_back(link.child);
    }
    for (const std::string& base : frames) {
      for (const std::string& lidar : frames) {
        const geometry_msgs::Transform tf = buffer.lookupTransform(base, lidar, ros::Time(0)).transform;
        const std::optional<Extrinsic> ours = tree.extrinsic(base, lidar, 0);
        ASSERT_TRUE(ours.has_value());
        const Eigen::Quaterniond q(tf.rotation.w, tf.rotation.x, tf.rotation.y, tf.rotation.z);
        const Eigen::Isometry3d pose = pose_of(*ours);
        // Up to six products on either side, and angles that are turned into a matrix again.
        EXPECT_LT((pose.linear() - q.toRotationMatrix()).cwiseAbs().maxCoeff(), 1e-7) << base << " " << lidar;
        EXPECT_NEAR(pose.translation().x(), tf.translation.x, 1e-10);
        EXPECT_NEAR(pose.translation().y(), tf.translation.y, 1e-10);
        EXPECT_NEAR(pose.translation().z(), tf.translation.z, 1e-10);
      }
    }
  }
}
#endif

}  // namespace
}  // namespace pose_wall::tools::live
