// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the measure of relations gives errors computed by hand, does not depend on where the trajectory begins, and
// gives the published error of raw odometry on the ACES building.

#include "io/planar_files/relations.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "io/planar_files/carmen_log.hpp"
#include "support/said_by.hpp"
#include "test_files.hpp"

namespace pose_wall::tools::planar_relations {
namespace {

using test::contains;
using test::TempFolder;

constexpr double kPi = 3.14159265358979323846;

TimedPose pose(double t_s, double x, double y, double yaw) {
  return {t_s, Eigen::Translation3d(x, y, 0.0) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())};
}

template <typename Parse>
std::string refusal(Parse parse) {
  return test::said_by<RelationsError>([&] { parse(); });
}

TEST(PlanarRelations, ErrorsByHand) {
  // The machine looks along y and drives 3 m ahead, then turns by 90 degrees on the spot.
  const std::vector<TimedPose> poses = {pose(0, 5, 1, kPi / 2), pose(10, 5, 4, kPi / 2), pose(40, 5, 4, kPi)};
  const std::vector<Relation> relations = parse_relations(
      "0 10 3 0 0 0 0 0\n"        // exact
      "# comment\n\n"             //
      "0 10 2.6 0.3 0 0 0 0.1\n"  // 0.5 m off, 0.1 rad
      "10 40 0 0 0 0 0 1.5\n"     // pi/2 - 1.5
      "0 70 1 0 0 0 0 0\n");      // no pose at 70
  ASSERT_EQ(relations.size(), 4U);
  EXPECT_EQ(relations[1].line, 4U);
  const RelationReport report = judge_relations(poses, relations);
  EXPECT_EQ(report.unmatched, 1U);
  EXPECT_EQ(report.near.relations, 2U);
  EXPECT_NEAR(report.near.translation_m.mean, 0.25, 1e-12);
  EXPECT_NEAR(report.near.translation_m.sigma, 0.25, 1e-12);
  EXPECT_NEAR(report.near.translation_m.max, 0.5, 1e-12);
  EXPECT_EQ(report.near.translation_m.max_line, 4U);
  EXPECT_NEAR(report.near.rotation_rad.mean, 0.05, 1e-12);
  EXPECT_EQ(report.all.relations, 3U);
  EXPECT_NEAR(report.all.translation_m.mean, 0.5 / 3, 1e-12);
  EXPECT_NEAR(report.all.rotation_rad.mean, (0.1 + kPi / 2 - 1.5) / 3, 1e-12);
  EXPECT_EQ(report.all.rotation_rad.max_line, 4U);
}

TEST(PlanarRelations, RollAndPitchTurnInTheirOrder) {
  const Relation relation = parse_relations("0 1 0 0 0 0.1 0.2 0.3").front();
  const Eigen::Vector3d x = relation.T_1_2.linear() * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(x.z(), -std::sin(0.2), 1e-12);
  EXPECT_NEAR(std::atan2(x.y(), x.x()), 0.3, 1e-12);
  EXPECT_NEAR((relation.T_1_2.linear() * Eigen::Vector3d::UnitY()).z(), std::sin(0.1) * std::cos(0.2), 1e-12);
}

TEST(PlanarRelations, TheBeginningOfTheTrajectoryDoesNotCount) {
  std::vector<TimedPose> poses, moved;
  const Eigen::Isometry3d away = pose(0, -300, 70, 2.2).T_world_base;
  for (int i = 0; i < 50; ++i) {
    poses.push_back(pose(i, 0.3 * i, 0.02 * i * i, 0.05 * i));
    moved.insert(moved.begin(), {poses.back().t_s, away * poses.back().T_world_base});  // and in another order
  }
  const std::vector<Relation> relations = parse_relations("0 10 3 0 0 0 0 0.2\n5 45 1 2 0 0 0 3\n20 21 0 0 0 0 0 0\n");
  const RelationReport a = judge_relations(poses, relations);
  const RelationReport b = judge_relations(moved, relations);
  EXPECT_NEAR(a.all.translation_m.mean, b.all.translation_m.mean, 1e-9);
  EXPECT_NEAR(a.all.rotation_rad.sigma, b.all.rotation_rad.sigma, 1e-9);
  EXPECT_GT(a.all.translation_m.mean, 0.1);
  EXPECT_EQ(a.near.relations, 2U);
}

TEST(PlanarRelations, TakesTheNearestPoseInTime) {
  const std::vector<TimedPose> poses = {pose(0, 0, 0, 0), pose(0.98, 1, 0, 0), pose(1.03, 2, 0, 0)};
  EXPECT_NEAR(judge_relations(poses, parse_relations("0 1 0 0 0 0 0 0")).all.translation_m.mean, 1.0, 1e-12);
  EXPECT_NEAR(judge_relations(poses, parse_relations("0 1.01 0 0 0 0 0 0")).all.translation_m.mean, 2.0, 1e-12);
  EXPECT_EQ(judge_relations(poses, parse_relations("0 1.2 0 0 0 0 0 0")).unmatched, 1U);
  EXPECT_EQ(judge_relations({}, parse_relations("0 1.2 0 0 0 0 0 0")).unmatched, 1U);
}

TEST(PlanarRelations, WithoutRelationsThereIsNoError) {
  const RelationReport report = judge_relations({pose(0, 0, 0, 0)}, {});
  EXPECT_EQ(report.all.relations, 0U);
  EXPECT_TRUE(std::isnan(report.all.translation_m.mean));
}

TEST(PlanarRelations, FaultsNameLineAndFile) {
  EXPECT_TRUE(contains(refusal([] { parse_relations("0 1 0 0 0 0 0\n"); }), "line 1: 7 numbers instead of 8"));
  EXPECT_TRUE(contains(refusal([] { parse_relations("\n0 1 0 0 0 0 0 0 5\n"); }), "line 2: more than 8 numbers"));
  EXPECT_TRUE(contains(refusal([] { parse_tum("1 2 3 4 0 0 0 x\n"); }), "line 1: 'x' is no finite number"));
  EXPECT_TRUE(contains(refusal([] { parse_tum("1 2 nan 4 0 0 0 1\n"); }), "'nan' is no finite number"));
  EXPECT_TRUE(contains(refusal([] { parse_tum("# t x y z\n1 2 3 4 0 0 0 0\n"); }), "line 2: qx, qy, qz, qw"));
  const TempFolder folder;
  const std::string file = folder.write("a.tum", "1 2\n");
  EXPECT_TRUE(contains(refusal([&file] { read_tum(file); }), file + ": line 1"));
  EXPECT_TRUE(contains(refusal([&folder] { read_relations(folder.file("none")); }), folder.file("none")));
}

TEST(PlanarRelations, TumRowsOfATurn) {
  const double half = 0.25;
  const TimedPose read = parse_tum(fmt::format("7.5 1 2 3 0 0 {} {}\n", std::sin(half), std::cos(half))).front();
  EXPECT_EQ(read.t_s, 7.5);
  EXPECT_EQ(read.T_world_base.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(Eigen::AngleAxisd(read.T_world_base.linear()).angle(), 0.5, 1e-12);
}

// The authors' table has 0.038 m over the near relations and 0.55 m over all for raw odometry.
TEST(PlanarRelations, RawOdometryOfTheAcesBuildingHasItsPublishedError) {
  const char* data = std::getenv("POSE_WALL_DATA");
  const std::string folder = std::string(data == nullptr ? "" : data) + "/planar_aces/";
  if (data == nullptr || !std::filesystem::exists(folder + "aces.relations")) {
    GTEST_SKIP() << "POSE_WALL_DATA names no folder with planar_aces";
  }
  std::vector<TimedPose> odometry;
  for (const CarmenScan& scan : read_carmen_log(folder + "aces.clf.gz").scans) {
    const pose_wall_planar_pose& at = scan.odometry;
    odometry.push_back(pose(static_cast<double>(scan.stamp_ns) * 1e-9, at.x_m, at.y_m, at.yaw_rad));
  }
  const RelationReport report = judge_relations(odometry, read_relations(folder + "aces.relations"));
  EXPECT_EQ(report.unmatched, 0U);
  EXPECT_EQ(report.all.relations, 1279U);
  EXPECT_NEAR(report.near.translation_m.mean, 0.038, 0.0006);
  EXPECT_NEAR(report.all.translation_m.mean, 0.55, 0.001);
}

}  // namespace
}  // namespace pose_wall::tools::planar_relations
