// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/scan/scan_settings.hpp"

#include <gtest/gtest.h>

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

TEST(ScanSettings, TheDefaultsAreTheDocumentsTurnInStepsOfAMilliradian) {
  const ScanSettings read = scan_settings_of(standard());
  EXPECT_EQ(read.beams, static_cast<std::uint32_t>(POSE_WALL_PLANAR_BEAMS_MAX));
  EXPECT_TRUE(read.goes_round);
  EXPECT_NEAR(read.low_m(), 0.15, 1e-12);
  EXPECT_NEAR(read.high_m(), 1.9, 1e-12);
  // a thing of 0.2 m at 10 m covers two sectors
  EXPECT_LE(2.0 * kPi / read.sectors, 0.01);
  EXPECT_NEAR(read.reach_m, 10.0, 1e-9);
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
