// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: rows of the motion table, of the TUM path and the map's PLY say what the library said, in columns that keep
// their places; a frame that is lost or could not be read has no pose.

#include "study/motion/motion_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "study/motion/motion_table.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using test::contains;
using test::raw;

MotionOutcome measured_outcome() {
  MotionOutcome outcome;
  outcome.frame = 12;
  outcome.source = "a,b.pcd";
  outcome.stamp_ns = 1'234'567'890'123'456'789;
  outcome.total_ms = 2.5;
  pose_wall_motion_result& r = outcome.result.emplace();
  r.along_state = POSE_WALL_ALONG_MEASURED;
  r.reasons = POSE_WALL_MOTION_R_NO_GROUND | POSE_WALL_MOTION_R_FIRST;
  const double position_m[] = {1.5, -2.0, 0.25}, quaternion[] = {0.0, 0.0, 0.6, 0.8};
  std::copy(std::begin(position_m), std::end(position_m), r.position_m);
  std::copy(std::begin(quaternion), std::end(quaternion), r.quaternion);
  for (std::size_t d = 0; d < POSE_WALL_MOTION_DIRECTIONS; ++d) {
    const auto number = static_cast<double>(d);
    r.sigma[d] = 0.01 + number;
    r.protection_level[d] = 0.05 + number;
    r.step_sigma[d] = 0.001 + number;
    r.step_protection_level[d] = 0.005 + number;
  }
  for (std::size_t k = 0; k < 3; ++k) r.step_m[k] = 0.1 * static_cast<double>(k + 1);
  for (std::size_t k = 0; k < 3; ++k) r.step_rad[k] = 0.01 * static_cast<double>(k + 1);
  r.along_m = 7.0;
  r.contrast = 0.9;
  r.second_m = std::numeric_limits<double>::quiet_NaN();
  r.points_used = 101;
  r.tiles = 9;
  return outcome;
}

std::string cell_of(const MotionOutcome& outcome, const std::string& name) {
  const std::vector<std::string> head = motion_head(), cells = motion_cells(outcome);
  EXPECT_EQ(head.size(), cells.size());
  const auto column = std::find(head.begin(), head.end(), name);
  EXPECT_NE(column, head.end()) << name;
  return cells[static_cast<std::size_t>(column - head.begin())];
}

TEST(MotionRows, ColumnsKeepTheirPlaces) {
  const std::string promised =
      "frame,source,stamp_ns,x,y,z,qx,qy,qz,qw,along_state,along_m,along_sigma,along_pl,across_pl,up_pl,roll_pl,"
      "pitch_pl,yaw_pl,reason,total_ms,step_x,step_y,step_z,step_rx,step_ry,step_rz,step_along_pl,step_across_pl,"
      "step_up_pl,step_yaw_pl,contrast,patches,halves_m,second_m,second_gain,points,ground,clusters,edges,planes,"
      "matched,tiles,";
  EXPECT_EQ(csv_line(motion_head()).substr(0, promised.size()), promised);
}

TEST(MotionRows, CellsAreWhatTheLibrarySaid) {
  const MotionOutcome outcome = measured_outcome();
  const std::pair<const char*, const char*> expected[] = {{"frame", "12"},
                                                          {"source", "a,b.pcd"},
                                                          {"stamp_ns", "1234567890123456789"},
                                                          {"x", "1.5"},
                                                          {"y", "-2"},
                                                          {"z", "0.25"},
                                                          {"qz", "0.6"},
                                                          {"qw", "0.8"},
                                                          {"along_state", "measured"},
                                                          {"along_m", "7"},
                                                          {"along_sigma", "0.01"},
                                                          {"along_pl", "0.05"},
                                                          {"across_pl", "1.05"},
                                                          {"up_pl", "2.05"},
                                                          {"roll_pl", "3.05"},
                                                          {"pitch_pl", "4.05"},
                                                          {"yaw_pl", "5.05"},
                                                          {"reason", "first|no_ground"},
                                                          {"total_ms", "2.5"},
                                                          {"step_y", "0.2"},
                                                          {"step_rz", "0.03"},
                                                          {"step_along_pl", "0.005"},
                                                          {"step_yaw_pl", "5.005"},
                                                          {"step_roll_pl", "3.005"},
                                                          {"yaw_sigma", "5.01"},
                                                          {"step_up_sigma", "2.001"},
                                                          {"contrast", "0.9"},
                                                          {"second_m", ""},
                                                          {"points", "101"},
                                                          {"tiles", "9"},
                                                          {"error", ""}};
  for (const auto& [name, text] : expected) EXPECT_EQ(cell_of(outcome, name), text) << name;
}

TEST(MotionRows, WhatIsWrittenIsReadBack) {
  const MotionOutcome outcome = measured_outcome();
  MotionOutcome unread = outcome;
  unread.frame = 13;
  unread.result.reset();
  std::istringstream file(csv_line(motion_head()) + csv_line(motion_cells(outcome)) + csv_line(motion_cells(unread)));
  const MotionTable table = read_motion_table(CsvTable::parse(file));
  ASSERT_EQ(table.rows.size(), 2U);
  const MotionRow& row = table.rows[0];
  EXPECT_EQ(row.frame, 12U);
  EXPECT_EQ(row.source, "a,b.pcd");
  EXPECT_EQ(row.stamp_ns, 1'234'567'890'123'456'789);
  EXPECT_EQ(row.along_state, POSE_WALL_ALONG_MEASURED);
  EXPECT_EQ(row.reason, "first|no_ground");
  ASSERT_TRUE(row.T_start_base && row.T_last_base);
  EXPECT_EQ(row.T_start_base->translation(), Eigen::Vector3d(1.5, -2.0, 0.25));
  // A quaternion of (0, 0, 0.6, 0.8) turns X by 2 atan(0.6 / 0.8): to (0.28, 0.96).
  EXPECT_NEAR((row.T_start_base->linear().col(0) - Eigen::Vector3d(0.28, 0.96, 0.0)).norm(), 0.0, 1e-12);
  const Eigen::AngleAxisd turn(row.T_last_base->linear());
  EXPECT_NEAR((turn.angle() * turn.axis() - Eigen::Vector3d(0.01, 0.02, 0.03)).norm(), 0.0, 1e-9);
  for (std::size_t d = 0; d < POSE_WALL_MOTION_DIRECTIONS; ++d) {
    EXPECT_DOUBLE_EQ(row.sigma[d], outcome.result->sigma[d]) << d;
    EXPECT_DOUBLE_EQ(row.level[d], outcome.result->protection_level[d]) << d;
    EXPECT_DOUBLE_EQ(row.step_sigma[d], outcome.result->step_sigma[d]) << d;
    EXPECT_DOUBLE_EQ(row.step_level[d], outcome.result->step_protection_level[d]) << d;
  }
  EXPECT_FALSE(table.rows[1].along_state || table.rows[1].T_start_base || table.rows[1].T_last_base);
}

TEST(MotionRows, ALevelWithoutBoundIsNotAMissingOne) {
  MotionOutcome outcome = measured_outcome();
  outcome.result->protection_level[POSE_WALL_MOTION_ALONG] = std::numeric_limits<double>::infinity();
  outcome.result->protection_level[POSE_WALL_MOTION_UP] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(cell_of(outcome, "along_pl"), "inf");
  EXPECT_EQ(cell_of(outcome, "up_pl"), "");
}

TEST(MotionRows, ALostFrameHasNoPose) {
  MotionOutcome outcome = measured_outcome();
  outcome.result->along_state = POSE_WALL_ALONG_LOST;
  for (const char* name : {"x", "y", "z", "qx", "qy", "qz", "qw", "along_m"}) EXPECT_EQ(cell_of(outcome, name), "");
  EXPECT_EQ(cell_of(outcome, "along_state"), "lost");
  EXPECT_EQ(tum_row(outcome), "");
}

TEST(MotionRows, AFrameThatCouldNotBeReadKeepsItsRow) {
  MotionOutcome outcome = measured_outcome();
  outcome.result.reset();
  outcome.error = "no cloud";
  EXPECT_EQ(cell_of(outcome, "along_state"), "unreadable");
  EXPECT_EQ(cell_of(outcome, "reason"), "unreadable");
  EXPECT_EQ(cell_of(outcome, "x"), "");
  EXPECT_EQ(cell_of(outcome, "total_ms"), "");
  EXPECT_EQ(cell_of(outcome, "frame"), "12");
  EXPECT_EQ(cell_of(outcome, "error"), "no cloud");
  EXPECT_EQ(tum_row(outcome), "");
}

TEST(MotionRows, TumHasAllDigitsOfTheStamp) {
  MotionOutcome outcome = measured_outcome();
  EXPECT_EQ(tum_row(outcome), "1234567890.123456789 1.5 -2 0.25 0 0 0.6 0.8\n");
  outcome.stamp_ns = -1;
  EXPECT_EQ(tum_row(outcome).substr(0, 13), "-0.000000001 ");
  outcome.stamp_ns = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(tum_row(outcome).substr(0, 22), "-9223372036.854775808 ");
  outcome.stamp_ns = 0;
  EXPECT_EQ(tum_row(outcome).substr(0, 12), "0.000000000 ");
}

TEST(MotionRows, EveryReasonHasItsName) {
  EXPECT_EQ(motion_reason_names(0), "");
  EXPECT_EQ(motion_reason_names(1U << 31U), "") << "a later library's";
  const std::string all = motion_reason_names((1U << POSE_WALL_MOTION_REASON_COUNT) - 1);
  EXPECT_EQ(std::count(all.begin(), all.end(), '|'), POSE_WALL_MOTION_REASON_COUNT - 1);
}

TEST(MotionRows, TheMapIsAPlyOfFloats) {
  const std::string file = map_as_ply({1.0F, 2.0F, 3.0F, -4.0F, 5.0F, 6.0F});
  EXPECT_TRUE(contains(file, "format binary_little_endian 1.0\n"));
  EXPECT_TRUE(contains(file, "element vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n"));
  EXPECT_EQ(file.substr(file.size() - 24), raw(1.0F) + raw(2.0F) + raw(3.0F) + raw(-4.0F) + raw(5.0F) + raw(6.0F));
  EXPECT_TRUE(contains(map_as_ply({}), "element vertex 0\n"));
}

}  // namespace
}  // namespace pose_wall::tools
