// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/scan/scan_settings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/math/elementary.hpp"

namespace {

using pose_wall::kPi;
using pose_wall::planar::scan_settings_of;
using pose_wall::planar::ScanSettings;

pose_wall_planar_scanner_settings standard() {
  pose_wall_planar_scanner_settings settings;
  EXPECT_EQ(pose_wall_planar_scanner_settings_init(&settings), POSE_WALL_OK);
  return settings;
}

std::string refused_member(const pose_wall_planar_scanner_settings& settings) {
  pose_wall_planar_fault fault{};
  const std::int32_t status = pose_wall_planar_scanner_settings_check(&settings, &fault);
  return status == POSE_WALL_OK ? "" : status == POSE_WALL_E_VALUE_RANGE ? fault.member : "another status";
}

TEST(ScanSettings, TheDefaultsAreTheDocumentsTurnInStepsOfAMilliradian) {
  const pose_wall_planar_scanner_settings settings = standard();
  EXPECT_EQ(refused_member(settings), "");
  const ScanSettings read = scan_settings_of(settings);
  EXPECT_EQ(read.beams, static_cast<std::uint32_t>(POSE_WALL_PLANAR_BEAMS_MAX));
  EXPECT_TRUE(read.goes_round);
  EXPECT_NEAR(read.low_m(), 0.15, 1e-12);
  EXPECT_NEAR(read.high_m(), 1.9, 1e-12);
  // a thing of 0.2 m at 10 m covers two sectors
  EXPECT_LE(2.0 * kPi / read.sectors, 0.01);
  EXPECT_NEAR(read.reach_m, 10.0, 1e-9);
}

TEST(ScanSettings, EachMemberOutOfItsRangeIsNamed) {
  const double nan = std::nan("");
  const auto with = [](auto change) {
    pose_wall_planar_scanner_settings settings = standard();
    change(settings);
    return refused_member(settings);
  };
  EXPECT_EQ(with([](auto& s) { s.alone = 2; }), "alone");
  EXPECT_EQ(with([&](auto& s) { s.ground_clearance_m = nan; }), "ground_clearance_m");
  EXPECT_EQ(with([](auto& s) { s.ground_clearance_m = -0.1; }), "ground_clearance_m");
  EXPECT_EQ(with([](auto& s) { s.machine_height_m = 0.2; }), "machine_height_m");
  EXPECT_EQ(with([&](auto& s) { s.margin_m = nan; }), "margin_m");
  EXPECT_EQ(with([](auto& s) { s.margin_m = 0.24; }), "floor_tolerance_m");
  EXPECT_EQ(with([&](auto& s) { s.floor_tolerance_m = nan; }), "floor_tolerance_m");
  EXPECT_EQ(with([&](auto& s) { s.overhead_m = nan; }), "overhead_m");
  EXPECT_EQ(with([](auto& s) { s.thing_m = 0.06; }), "thing_m");
  EXPECT_EQ(with([&](auto& s) { s.clear_reach_m = nan; }), "clear_reach_m");
  EXPECT_EQ(with([](auto& s) { s.angle_min_rad = 4.0; }), "angle_min_rad");
  EXPECT_EQ(with([](auto& s) { s.angle_max_rad = 4.0; }), "angle_max_rad");
  EXPECT_EQ(with([](auto& s) { s.angle_max_rad = s.angle_min_rad; }), "angle_max_rad");
  EXPECT_EQ(with([](auto& s) { s.angle_step_rad = 0.0009; }), "angle_step_rad");
  EXPECT_EQ(with([&](auto& s) { s.angle_step_rad = nan; }), "angle_step_rad");
  EXPECT_EQ(with([&](auto& s) { s.range_min_m = nan; }), "range_min_m");
  EXPECT_EQ(with([](auto& s) { s.range_max_m = 0.3; }), "range_max_m");
  EXPECT_EQ(with([&](auto& s) { s.fill_rad = nan; }), "fill_rad");
  EXPECT_EQ(with([&](auto& s) { s.hold_max_s = nan; }), "hold_max_s");
  EXPECT_EQ(with([&](auto& s) { s.tilt_level_max_rad = nan; }), "tilt_level_max_rad");
  EXPECT_EQ(with([&](auto& s) { s.bend_rad = nan; }), "bend_rad");
  pose_wall_planar_scanner_settings settings = standard();
  settings.struct_size -= 8;
  EXPECT_EQ(pose_wall_planar_scanner_settings_check(&settings, nullptr), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(pose_wall_planar_scanner_settings_check(nullptr, nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_planar_scanner_settings_init(nullptr), POSE_WALL_E_NULL);
}

TEST(ScanSettings, BeamsOfAPartOfATurnAreCountedWithBothEnds) {
  pose_wall_planar_scanner_settings settings = standard();
  settings.angle_min_rad = -1.0;
  settings.angle_max_rad = 1.0;
  settings.angle_step_rad = 0.01;
  const ScanSettings read = scan_settings_of(settings);
  EXPECT_EQ(read.beams, 201U);
  EXPECT_FALSE(read.goes_round);
}

TEST(ScanSettings, ATurnThatEndsBeforeItsFirstBeamGoesRoundToo) {
  pose_wall_planar_scanner_settings settings = standard();
  settings.angle_step_rad = 2.0 * kPi / 720.0;
  settings.angle_max_rad = kPi - settings.angle_step_rad;
  const ScanSettings read = scan_settings_of(settings);
  EXPECT_EQ(read.beams, 720U);
  EXPECT_TRUE(read.goes_round);
}

TEST(ScanSettings, WideBeamsShortenTheGuarantee) {
  pose_wall_planar_scanner_settings settings = standard();
  settings.angle_step_rad = 0.05;
  const ScanSettings read = scan_settings_of(settings);
  EXPECT_LE(read.sectors, read.beams);
  EXPECT_NEAR(read.reach_m, 2.0, 0.05);
}

}  // namespace
