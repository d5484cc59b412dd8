// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "options.hpp"

#include "base/math/time_units.hpp"
#include "box_layout.hpp"
#include "box_writer.hpp"
#include "frame_slot.hpp"
#include "lidar/cloud_fields.hpp"
#include "struct_versions.hpp"

namespace pose_wall::runtime {
namespace {

// The bits of pose_wall_runtime.h; others are of a later version.
constexpr std::uint32_t kWishes = POSE_WALL_RUNTIME_PRIORITY | POSE_WALL_RUNTIME_AFFINITY | POSE_WALL_RUNTIME_LOCK;

template <typename T>
bool within(T value, T low, T high) {
  return value >= low && value <= high;
}

bool is_thinning(std::uint32_t n) {
  return within(n, 1U, 16U) && (n & (n - 1)) == 0;
}

bool box_is_large_enough(const pose_wall_runtime_options& o) {
  if (o.sink == nullptr) return true;
  const std::uint64_t cloud = o.box_clouds != 0 ? cloud_bytes_max(o) : 0;
  return o.box_bytes >= BoxWriter::box_bytes_min(cloud);
}

bool is_motion(const pose_wall_motion_functions* motion) {
  return motion == nullptr ||
         (motion->struct_size >= sizeof(*motion) && motion->abi_version == POSE_WALL_MOTION_ABI_VERSION);
}

bool are_motion_settings(const pose_wall_runtime_options& o) {
  return o.motion_settings == nullptr || o.motion == nullptr || !is_motion(o.motion) ||
         o.motion->settings_check(o.motion_settings, nullptr) == POSE_WALL_OK;
}

}  // namespace

void set_defaults(pose_wall_runtime_options* options) {
  *options = pose_wall_runtime_options{};
  options->struct_size = sizeof(*options);
  options->queue_frames = 2;
  options->cloud_points_max = 262144;
  options->point_bytes_max = 16;
  options->thinning_max = 1;
  options->box_clouds = 1;
  options->box_backlog = 2;
  options->worker_cpu = -1;
  options->frame_period_max_ns = 100 * kMillisecond_ns;
  options->watchdog_ns = 300 * kMillisecond_ns;
  options->watchdog_every_ns = 100 * kMillisecond_ns;
}

std::int32_t read_options(const pose_wall_runtime_options& options, const char** option,
                          pose_wall_runtime_options* whole) {
  const std::int32_t status = check_struct_size(options.struct_size, kOptionsSizes);
  if (status != POSE_WALL_OK) return status;
  *whole = read_struct<pose_wall_runtime_options>(&options, options.struct_size);
  const pose_wall_runtime_options& o = *whole;
  // In the order of the members.
  const struct {
    bool good;
    const char* name;
  } checked[] = {
      {within(o.queue_frames, 1U, 64U), "queue_frames"},
      {within(o.cloud_points_max, 1U, 1U << 26), "cloud_points_max"},
      {within(o.point_bytes_max, 12U, 48U), "point_bytes_max"},
      {is_thinning(o.thinning_max), "thinning_max"},
      {o.box_clouds <= 1, "box_clouds"},
      {within(o.box_backlog, 1U, 64U), "box_backlog"},
      {within(o.worker_priority, 0, 99), "worker_priority"},
      {within(o.worker_cpu, -1, 1023), "worker_cpu"},
      {o.lock_memory <= 1, "lock_memory"},
      {(o.required & ~kWishes) == 0, "required"},
      {o.reserved == 0, "reserved"},
      {within(o.frame_period_max_ns, kMillisecond_ns, kHour_ns), "frame_period_max_ns"},
      {within<std::int64_t>(o.watchdog_ns, 0, kHour_ns), "watchdog_ns"},
      {within(o.watchdog_every_ns, kMillisecond_ns, kHour_ns), "watchdog_every_ns"},
      {o.sink == nullptr || !machine_is_big_endian(), "sink"},
      {box_is_large_enough(o), "box_bytes"},
      {o.reserved_2 == 0, "reserved_2"},
      {is_motion(o.motion), "motion"},
      {are_motion_settings(o), "motion_settings"},
  };
  for (const auto& row : checked) {
    if (row.good) continue;
    if (option != nullptr) *option = row.name;
    return POSE_WALL_RUNTIME_E_OPTION;
  }
  return POSE_WALL_OK;
}

std::uint32_t slots_of(const pose_wall_runtime_options& o) {
  // Waiting, one being filled, one in work; and those that wait for the sink, with its current one.
  return o.queue_frames + 2 + (o.sink != nullptr ? o.box_backlog : 0);
}

std::uint64_t cloud_bytes_max(const pose_wall_runtime_options& o) {
  return static_cast<std::uint64_t>(o.cloud_points_max) * o.point_bytes_max;
}

}  // namespace pose_wall::runtime
