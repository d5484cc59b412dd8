// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The extern "C" file of the planar scan: checks arguments, translates, calls.

#include "base/math/finite.hpp"
#include "part/shell.hpp"
#include "part/struct_versions.hpp"
#include "place/beams.hpp"
#include "planar/scan/laserscan.hpp"
#include "planar/scan/scanner.hpp"

namespace pose_wall::planar {
namespace {

using HeldScanner = Held<Scanner, 0x6E6163732D6C7070ULL>;

constexpr StructSizes kScanSizes = {0, offsetof(pose_wall_planar_scan, free_m), sizeof(pose_wall_planar_scan)};

// Both measured this frame's floor, and their levels are finite.
bool has_floor(const pose_wall_result& result) {
  const pose_wall_value &roll = result.quantity[POSE_WALL_ROLL], &pitch = result.quantity[POSE_WALL_PITCH];
  const bool measured = roll.state >= POSE_WALL_DEGRADED && pitch.state >= POSE_WALL_DEGRADED;
  return result.floor.found == 1 && measured && roll.raw_protection_level >= 0.0 && pitch.raw_protection_level >= 0.0 &&
         roll.sigma >= 0.0 && pitch.sigma >= 0.0;
}

}  // namespace

extern "C" {

POSE_WALL_EXPORT int32_t pose_wall_planar_floor_of(const pose_wall_result* result, pose_wall_planar_floor* floor) {
  if (result == nullptr || floor == nullptr) return POSE_WALL_E_NULL;
  std::int32_t status = check_struct(*floor);
  if (status == POSE_WALL_OK) status = check_struct_size(result->struct_size, kResultSizes);
  if (status != POSE_WALL_OK) return status;
  const auto whole = read_struct<pose_wall_result>(result, result->struct_size);
  pose_wall_planar_floor found{};
  found.struct_size = sizeof(found);
  if (has_floor(whole)) {
    const pose_wall_value &roll = whole.quantity[POSE_WALL_ROLL], &pitch = whole.quantity[POSE_WALL_PITCH];
    for (int i = 0; i < 3; ++i) found.normal[i] = whole.floor.normal[i];
    found.height_m = whole.floor.d_m;
    found.tilt_sigma_rad = larger(roll.sigma, pitch.sigma);
    found.tilt_level_rad = larger(roll.raw_protection_level, pitch.raw_protection_level);
    found.reach_m = whole.floor.extent_max_m;
    found.measured = check_floor(found) == POSE_WALL_OK ? 1 : 0;
  }
  write_struct(found, floor->struct_size, floor);
  return POSE_WALL_OK;
}

POSE_WALL_SETTINGS_CALLS(pose_wall_planar_scanner, ScannerTable, pose_wall_planar_fault)

POSE_WALL_EXPORT int32_t pose_wall_planar_scanner_memory_needed(const pose_wall_planar_scanner_settings* settings,
                                                                uint64_t* bytes) {
  return part_memory_needed<HeldScanner, ScannerTable>(settings, bytes);
}

POSE_WALL_EXPORT int32_t pose_wall_planar_scanner_open(const pose_wall_config* config,
                                                       const pose_wall_planar_scanner_settings* settings, void* block,
                                                       uint64_t block_bytes, pose_wall_planar_scanner** scanner) {
  if (config == nullptr || block == nullptr || scanner == nullptr) return POSE_WALL_E_NULL;
  const std::int32_t status = pose_wall_config_check(config, nullptr);
  if (status != POSE_WALL_OK) return status;
  return open_part<HeldScanner, ScannerTable>(
      settings, block, block_bytes, scanner,
      [&](Scanner& own, const pose_wall_planar_scanner_settings& chosen) { own.open(chosen, *config); });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_scanner_reset(pose_wall_planar_scanner* scanner) {
  return with_part<HeldScanner>(scanner, [](Scanner& own) { own.reset(); });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_scanner_process(pose_wall_planar_scanner* scanner,
                                                          const pose_wall_cloud* cloud,
                                                          const pose_wall_planar_floor* floor,
                                                          pose_wall_planar_scan* scan,
                                                          pose_wall_planar_scan_view* view) {
  if (cloud == nullptr || scan == nullptr) return POSE_WALL_E_NULL;
  return with_part<HeldScanner>(scanner, [&](Scanner& own) -> std::int32_t {
    std::int32_t status = pose_wall_cloud_check(cloud);
    if (status == POSE_WALL_OK) status = check_struct_size(scan->struct_size, kScanSizes);
    if (status == POSE_WALL_OK && view != nullptr) status = check_struct(*view);
    if (status == POSE_WALL_OK && floor != nullptr) status = check_struct(*floor);
    if (status == POSE_WALL_OK && floor != nullptr && floor->measured != 0) status = check_floor(*floor);
    if (status != POSE_WALL_OK) return status;
    const WholeCloud whole(*cloud);
    pose_wall_planar_scan found_scan{};
    pose_wall_planar_scan_view found_view{};
    own.process(whole.cloud, floor, &found_scan, &found_view);
    write_struct(found_scan, scan->struct_size, scan);
    if (view != nullptr) write_struct(found_view, view->struct_size, view);
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_laserscan_of(const pose_wall_planar_scan* scan,
                                                       pose_wall_planar_laserscan* message) {
  if (message == nullptr) return POSE_WALL_E_NULL;
  const std::int32_t status = check_scan(scan);
  if (status != POSE_WALL_OK) return status;
  *message = laserscan_of(*scan);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_scan_of_laserscan(const pose_wall_planar_laserscan* message,
                                                            const pose_wall_planar_pose* sensor, double sigma_m,
                                                            int64_t stamp_ns, uint32_t infinite_is_open,
                                                            float* ranges_m, pose_wall_planar_scan* scan) {
  if (message == nullptr || sensor == nullptr || scan == nullptr) return POSE_WALL_E_NULL;
  if (infinite_is_open == 0 && ranges_m == nullptr) return POSE_WALL_E_NULL;
  pose_wall_planar_scan found = scan_of(*message);
  found.sensor = *sensor;
  found.sigma_m = sigma_m;
  found.stamp_ns = stamp_ns;
  const std::int32_t status = check_scan(&found);
  if (status != POSE_WALL_OK) return status;
  if (infinite_is_open == 0) {
    copy_without_infinity(message->ranges, message->count, ranges_m);
    found.range_m = ranges_m;
  }
  *scan = found;
  return POSE_WALL_OK;
}

}  // extern "C"

}  // namespace pose_wall::planar
