// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/drive/drive_scanner.hpp"

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

std::uint64_t scanner_bytes(const pose_wall_planar_scanner_settings& settings) {
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_scanner_memory_needed(&settings, &bytes), translatable("the settings of the scan"));
  return bytes;
}

constexpr std::int64_t kFloorEach_ns = 290'000'000;  // of three frames: less than the scanner holds a floor

// The plane that the tracks stand on.
pose_wall_planar_floor own_plane() {
  pose_wall_planar_floor floor{};
  floor.struct_size = sizeof floor;
  floor.measured = 1;
  floor.normal[2] = 1.0;
  floor.height_m = kBaseHeight_m;
  floor.tilt_sigma_rad = 0.01;  // humps of 3 cm under 3 m of tracks
  floor.tilt_level_rad = 0.017;
  floor.reach_m = 3.0;
  return floor;
}

}  // namespace

pose_wall_cloud cloud_of(const sim::Frame& frame, std::int64_t stamp_ns) {
  constexpr std::uint32_t kFloats = 4;
  constexpr std::size_t kNoReturns = 64;
  static const std::vector<float> covered(kFloats * kNoReturns, 0.0F);
  const std::vector<float>& points = frame.count() > 0 ? frame.xyz_intensity : covered;
  pose_wall_cloud cloud{};
  cloud.struct_size = sizeof cloud;
  cloud.data = points.data();
  cloud.data_bytes = points.size() * sizeof(float);
  cloud.width = static_cast<std::uint32_t>(points.size() / kFloats);
  cloud.height = 1;
  cloud.point_step = kFloats * sizeof(float);
  cloud.stamp_ns = stamp_ns;
  cloud.x = {0, POSE_WALL_FIELD_FLOAT32};
  cloud.y = {sizeof(float), POSE_WALL_FIELD_FLOAT32};
  cloud.z = {2 * sizeof(float), POSE_WALL_FIELD_FLOAT32};
  return cloud;
}

DriveScanner::DriveScanner(const sim::SensorModel& model)
    : config_(drive_config(model)), block_(scanner_bytes(drive_scanner_settings())) {
  const pose_wall_planar_scanner_settings settings = drive_scanner_settings();
  require_ok(engine_.open(config_), translatable("the settings of the drive"));
  require_ok(pose_wall_planar_scanner_open(config_.get(), &settings, block_.data(), block_.bytes(), &scanner_),
             translatable("the settings of the scan"));
}

pose_wall_planar_floor DriveScanner::floor_of(const pose_wall_cloud& cloud) {
  pose_wall_planar_floor floor{};
  floor.struct_size = sizeof floor;
  if (frames_ > 1 && cloud.stamp_ns - floor_ns_ < kFloorEach_ns) return floor;  // the scanner holds the last one
  floor_ns_ = cloud.stamp_ns;
  pose_wall_result result = api::make_result();
  require_ok(engine_.process(cloud, result), translatable("the floor"));
  require_ok(pose_wall_planar_floor_of(&result, &floor), translatable("the floor"));
  ++floors_;
  // As the scanner judges it.
  if (floor.measured != 0 && floor.tilt_level_rad <= drive_scanner_settings().tilt_level_max_rad) return floor;
  ++own_planes_;
  return own_plane();
}

const pose_wall_planar_scan& DriveScanner::scan(const pose_wall_cloud& cloud) {
  ++frames_;
  const pose_wall_planar_floor floor = floor_of(cloud);
  scan_.struct_size = sizeof scan_;
  require_ok(pose_wall_planar_scanner_process(scanner_, &cloud, &floor, &scan_, nullptr), translatable("the scan"));
  return scan_;
}

}  // namespace pose_wall::tools
