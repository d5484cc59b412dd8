// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/scan/scan_settings.hpp"

#include <cmath>

#include "base/math/elementary.hpp"
#include "part/struct_sizes.hpp"

namespace pose_wall::planar {
namespace {

constexpr StructSizes kSettingsSizes = {0, sizeof(pose_wall_planar_scanner_settings),
                                        sizeof(pose_wall_planar_scanner_settings)};
constexpr double kTurn_rad = 2.0 * kPi;  // all the way round
constexpr double kRounding = 1e-6;       // of a step: angles are written with few digits

std::int32_t refuse(const char* member, const char* rule, pose_wall_planar_fault* fault) {
  if (fault != nullptr) {  // member by member: on ARMv7 GCC keeps a pair in memory that could be written to
    fault->member = member;
    fault->rule = rule;
  }
  return POSE_WALL_E_VALUE_RANGE;
}

double steps_of(const pose_wall_planar_scanner_settings& s) {
  return (s.angle_max_rad - s.angle_min_rad) / s.angle_step_rad;
}

}  // namespace

pose_wall_planar_scanner_settings default_scan_settings() {
  pose_wall_planar_scanner_settings s{};
  s.struct_size = sizeof(s);
  s.alone = POSE_WALL_PLANAR_ALONE_IS_THING;
  s.ground_clearance_m = 0.25;
  s.machine_height_m = 1.8;
  s.margin_m = 0.1;
  s.floor_tolerance_m = 0.06;
  s.overhead_m = 0.3;
  s.thing_m = 0.2;
  s.clear_reach_m = 10.0;
  s.angle_min_rad = -kPi;
  s.angle_max_rad = kPi;
  s.angle_step_rad = 0.001;
  s.range_min_m = 0.3;
  s.range_max_m = 30.0;
  s.fill_rad = 0.0065;
  s.hold_max_s = 0.5;
  s.tilt_level_max_rad = 0.0175;
  s.bend_rad = 0.02;
  return s;
}

std::int32_t check_scan_settings(const pose_wall_planar_scanner_settings* settings, pose_wall_planar_fault* fault) {
  if (settings == nullptr) return POSE_WALL_E_NULL;
  const std::int32_t status = check_struct_size(settings->struct_size, kSettingsSizes);
  if (status != POSE_WALL_OK) return status;
  const pose_wall_planar_scanner_settings& s = *settings;
  const double band_low_m = s.ground_clearance_m - s.margin_m;
  const struct {
    double value, least, most;
    const char *member, *rule;
  } rows[] = {
      {static_cast<double>(s.alone), 0.0, 1.0, "alone", "alone must be 0 or 1"},
      {s.ground_clearance_m, 0.0, 5.0, "ground_clearance_m", "ground_clearance_m must be from 0 to 5"},
      {s.margin_m, 0.0, 2.0, "margin_m", "margin_m must be from 0 to 2"},
      {s.machine_height_m, s.ground_clearance_m + 0.05, 20.0, "machine_height_m",
       "machine_height_m must be from 5 cm above ground_clearance_m to 20"},
      {s.floor_tolerance_m, 0.01, band_low_m, "floor_tolerance_m",
       "floor_tolerance_m must be from 0.01 to ground_clearance_m - margin_m"},
      {s.overhead_m, 0.0, 10.0, "overhead_m", "overhead_m must be from 0 to 10"},
      {s.thing_m, s.floor_tolerance_m + 0.01, 2.0, "thing_m", "thing_m must be from 1 cm above floor_tolerance_m to 2"},
      {s.clear_reach_m, 1.0, 50.0, "clear_reach_m", "clear_reach_m must be from 1 to 50"},
      {s.angle_min_rad, -kPi, kPi, "angle_min_rad", "angle_min_rad must be from -pi to pi"},
      {s.angle_max_rad, s.angle_min_rad + 1e-4, s.angle_min_rad + kTurn_rad + kRounding, "angle_max_rad",
       "angle_max_rad must be above angle_min_rad, by at most a turn"},
      {s.angle_step_rad, 1e-4, 0.1, "angle_step_rad", "angle_step_rad must be from 0.0001 to 0.1"},
      {steps_of(s), 0.0, POSE_WALL_PLANAR_BEAMS_MAX - 1.0 + 0.5, "angle_step_rad",
       "angle_step_rad must not make more than POSE_WALL_PLANAR_BEAMS_MAX beams"},
      {s.range_min_m, 0.0, 10.0, "range_min_m", "range_min_m must be from 0 to 10"},
      {s.range_max_m, s.range_min_m + 0.1, 200.0, "range_max_m",
       "range_max_m must be from 0.1 above range_min_m to 200"},
      {s.fill_rad, 0.0, 0.05, "fill_rad", "fill_rad must be from 0 to 0.05"},
      {s.hold_max_s, 0.0, 10.0, "hold_max_s", "hold_max_s must be from 0 to 10"},
      {s.tilt_level_max_rad, 0.001, 0.2, "tilt_level_max_rad", "tilt_level_max_rad must be from 0.001 to 0.2"},
      {s.bend_rad, 0.0, 0.2, "bend_rad", "bend_rad must be from 0 to 0.2"},
  };
  for (const auto& row : rows) {
    if (row.value >= row.least && row.value <= row.most) continue;
    return refuse(row.member, row.rule, fault);
  }
  return POSE_WALL_OK;
}

std::uint32_t beams_of(const pose_wall_planar_scanner_settings& settings) {
  return static_cast<std::uint32_t>(steps_of(settings) + kRounding) + 1U;
}

ScanSettings scan_settings_of(const pose_wall_planar_scanner_settings& s) {
  ScanSettings out;
  out.clearance_m = s.ground_clearance_m;
  out.machine_m = s.machine_height_m;
  out.margin_m = s.margin_m;
  out.tolerance_m = s.floor_tolerance_m;
  out.overhead_m = s.overhead_m;
  out.thing_m = s.thing_m;
  out.angle_min_rad = s.angle_min_rad;
  out.step_rad = s.angle_step_rad;
  out.range_min_m = s.range_min_m;
  out.range_max_m = s.range_max_m;
  out.beams = beams_of(s);
  out.fill_beams = static_cast<std::uint32_t>(s.fill_rad / s.angle_step_rad + kRounding);
  if (out.fill_beams < 1) out.fill_beams = 1;  // beside each other there is nothing between them
  out.steps_of_turn = kTurn_rad / s.angle_step_rad;
  out.goes_round = out.beams + 1.0 > out.steps_of_turn;
  out.alone_is_apart = s.alone == POSE_WALL_PLANAR_ALONE_IS_APART;
  // A thing at the end of the guarantee covers two sectors, so at least one of them wholly. None narrower than a beam.
  const double sectors = std::floor(kTurn_rad / (0.5 * s.thing_m / s.clear_reach_m)) + 1.0;
  const double most = std::floor(out.steps_of_turn);
  out.sectors = static_cast<std::uint32_t>(sectors < most ? sectors : most);
  const double sector_rad = kTurn_rad / out.sectors, reach_m = 0.5 * s.thing_m / sector_rad;
  out.reach_m = reach_m < s.clear_reach_m ? reach_m : s.clear_reach_m;
  out.hold_max_s = s.hold_max_s;
  out.tilt_level_max_rad = s.tilt_level_max_rad;
  out.bend_rad = s.bend_rad;
  return out;
}

void read_sensor(const pose_wall_config& config, ScanSettings* settings) {
  settings->mount = mount_of(config);
  settings->sigma_m = number_of(config, "range_noise");
  settings->hold_rate_rad_s = number_of(config, "hold_rate_angle");
}

}  // namespace pose_wall::planar
