// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/scan/scan_settings.hpp"

#include <cmath>

#include "base/math/elementary.hpp"

namespace pose_wall::planar {
namespace {

constexpr double pi = kPi;  // NOLINT(readability-identifier-naming): as the table writes it
constexpr SettingRow kRows[] = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_scanner_settings, __VA_ARGS__)
#include "pose_wall_planar_scanner_settings.def"
};

constexpr double kTurn_rad = 2.0 * kPi;  // all the way round
constexpr double kRounding = 1e-6;       // of a step: angles are written with few digits

double steps_of(const pose_wall_planar_scanner_settings& s) {
  return (s.angle_max_rad - s.angle_min_rad) / s.angle_step_rad;
}

}  // namespace

SettingRows ScannerTable::rows() {
  return rows_of(kRows);
}

SettingFault ScannerTable::broken_rule() const {
  const struct {
    bool holds;
    SettingFault fault;
  } rules[] = {
      {machine_height_m >= ground_clearance_m + 0.05,
       {"machine_height_m", "machine_height_m must be from 5 cm above ground_clearance_m to 20"}},
      {floor_tolerance_m <= ground_clearance_m - margin_m,
       {"floor_tolerance_m", "floor_tolerance_m must be from 0.01 to ground_clearance_m - margin_m"}},
      {thing_m >= floor_tolerance_m + 0.01, {"thing_m", "thing_m must be from 1 cm above floor_tolerance_m to 2"}},
      {angle_max_rad >= angle_min_rad + 1e-4 && angle_max_rad <= angle_min_rad + kTurn_rad + kRounding,
       {"angle_max_rad", "angle_max_rad must be above angle_min_rad, by at most a turn"}},
      {steps_of(*this) <= POSE_WALL_PLANAR_BEAMS_MAX - 1.0 + 0.5,
       {"angle_step_rad", "angle_step_rad must not make more than POSE_WALL_PLANAR_BEAMS_MAX beams"}},
      {range_max_m >= range_min_m + 0.1, {"range_max_m", "range_max_m must be from 0.1 above range_min_m to 200"}},
  };
  for (const auto& rule : rules) {
    if (!rule.holds) return rule.fault;
  }
  return {};
}

std::uint32_t beams_of(const pose_wall_planar_scanner_settings& settings) {
  return static_cast<std::uint32_t>(steps_of(settings) + kRounding) + 1U;
}

ScanSettings scan_settings_of(const pose_wall_planar_scanner_settings& s) {
  ScanSettings out{s};
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
  return out;
}

void read_sensor(const pose_wall_config& config, ScanSettings* settings) {
  settings->mount = mount_of(config);
  settings->sigma_m = number_of(config, "range_noise");
  settings->hold_rate_rad_s = number_of(config, "hold_rate_angle");
}

}  // namespace pose_wall::planar
