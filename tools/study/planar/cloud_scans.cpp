// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/cloud_scans.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <utility>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"

namespace pose_wall::tools {
namespace {

using ScannerSettings = pose_wall_planar_scanner_settings;

std::uint64_t bytes_for(const ScannerSettings& settings) {
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_scanner_memory_needed(&settings, &bytes), translatable("the settings of the scan"));
  return bytes;
}

bool is_motion_on(const LoadedConfig& loaded) {
  char motion[POSE_WALL_TEXT_MAX] = {};
  return pose_wall_config_get_text(loaded.config.get(), "motion", motion, sizeof motion) == POSE_WALL_OK &&
         std::strcmp(motion, "on") == 0;
}

// A scan reaches further than the ground beside the machine, whose own waves would tilt its heights from frame to
// frame.
LoadedConfig with_floor_in_view(LoadedConfig loaded) {
  require_ok(pose_wall_config_set(loaded.config.get(), "region", "off"), translatable("the settings of the scan"));
  return loaded;
}

// Seconds with all digits.
std::string seconds_of(std::int64_t stamp_ns) {
  constexpr std::int64_t kNsPerS = 1'000'000'000;
  const bool is_negative = stamp_ns < 0;
  const std::uint64_t ns =
      is_negative ? std::uint64_t{0} - static_cast<std::uint64_t>(stamp_ns) : static_cast<std::uint64_t>(stamp_ns);
  return fmt::format("{}{}.{:09}", is_negative ? "-" : "", ns / kNsPerS, ns % kNsPerS);
}

// The engine may have measured a floor that is not known well enough to tell things from it.
std::string why_no_floor(const pose_wall_planar_floor& floor, double level_max_rad) {
  if (floor.measured == 0) return tr("no floor was measured: every beam is unknown");
  return say(
      "the floor was measured, but its tilt only within {:.1f}° and {:.1f}° is the most (tilt_level_max_rad): every "
      "beam "
      "is unknown. Show more of the floor, or see what widens it: explain",
      floor.tilt_level_rad * kDegPerRad, level_max_rad * kDegPerRad);
}

}  // namespace

std::optional<pose_wall_planar_pose> plane_odometry(const pose_wall_motion_result& moved) {
  if (moved.along_state == POSE_WALL_ALONG_LOST) return std::nullopt;
  const double* const q = moved.quaternion;  // x, y, z, w
  const double yaw_rad = std::atan2(2.0 * (q[3] * q[2] + q[0] * q[1]), 1.0 - 2.0 * (q[1] * q[1] + q[2] * q[2]));
  const pose_wall_planar_pose pose{moved.position_m[0], moved.position_m[1], yaw_rad};
  if (!std::isfinite(pose.x_m) || !std::isfinite(pose.y_m) || !std::isfinite(pose.yaw_rad)) return std::nullopt;
  return pose;
}

const SettingRows& scanner_setting_rows() {
  static const SettingRows rows = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_scanner_settings, __VA_ARGS__)
#include "pose_wall_planar_scanner_settings.def"
  };
  return rows;
}

pose_wall_planar_scanner_settings take_scanner_settings(std::vector<std::string>* words) {
  pose_wall_planar_scanner_settings settings{};
  require_ok(pose_wall_planar_scanner_settings_init(&settings), translatable("the settings of the scan"));
  take_settings(scanner_setting_rows(), pose_wall_planar_scanner_settings_check, words, &settings);
  return settings;
}

CloudScans::CloudScans(const FrameOptions& options, const pose_wall_planar_scanner_settings& settings)
    : CloudScans(options, settings, with_floor_in_view(options.load())) {}

CloudScans::CloudScans(const FrameOptions& options, const pose_wall_planar_scanner_settings& settings,
                       LoadedConfig loaded)
    : has_motion_(is_motion_on(loaded)),
      inputs_(options.open()),
      files_(options.files_read(inputs_)),
      stamps_(options.rate_hz),
      block_(bytes_for(settings)),
      settings_(settings) {
  const std::int32_t status = engine_.open(loaded.config, loaded.motion);
  if (status != POSE_WALL_OK) throw ConfigError(say("the engine: {}", pose_wall_status_text(status)));
  require_ok(pose_wall_planar_scanner_open(loaded.config.get(), &settings, block_.data(), block_.bytes(), &scanner_),
             translatable("the settings of the scan"));
  view_.struct_size = sizeof view_;
}

std::optional<SourcedScan> CloudScans::next() {
  std::optional<SourcedFrame> frame = inputs_.next();
  if (!frame) return std::nullopt;
  SourcedScan scan;
  scan.name = std::move(frame->name);
  const std::int64_t stamp_ns = stamps_.next(frame->stamp_ns);
  scan.time = seconds_of(stamp_ns);
  scan.error = std::move(frame->error);
  if (!frame->frame) return scan;
  pose_wall_cloud& cloud = frame->frame->cloud;
  cloud.stamp_ns = stamp_ns;
  pose_wall_result result = api::make_result();
  std::int32_t status = engine_.process(cloud, result);
  pose_wall_planar_floor floor{};
  floor.struct_size = sizeof floor;
  scan.scan.struct_size = sizeof scan.scan;
  if (status == POSE_WALL_OK) status = pose_wall_planar_floor_of(&result, &floor);
  if (status == POSE_WALL_OK) {
    status = pose_wall_planar_scanner_process(scanner_, &engine_.given(), &floor, &scan.scan, &view_);
  }
  if (status != POSE_WALL_OK) {
    scan.error = pose_wall_planar_status_text(status);
    return scan;
  }
  if (view_.floor_state == POSE_WALL_PLANAR_FLOOR_NONE) {
    scan.error = why_no_floor(floor, settings_.tilt_level_max_rad);
    return scan;
  }
  scan.range_m.assign(scan.scan.range_m, scan.scan.range_m + scan.scan.beams);
  if (engine_.moved()) scan.odometry = plane_odometry(*engine_.moved());
  return scan;
}

std::vector<std::string> CloudScans::notes() const {
  if (inputs_.frames() == 0) return {};
  return {say(
      "{} frames become scans: things from {:.2f} to {:.2f} m above the floor, steps of {:.2f}°, up to {:.0f} m",
      inputs_.frames(), settings_.ground_clearance_m - settings_.margin_m,
      settings_.machine_height_m + settings_.margin_m, settings_.angle_step_rad * kDegPerRad, settings_.range_max_m)};
}

}  // namespace pose_wall::tools
