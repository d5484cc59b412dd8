// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "options.hpp"

#include "box_layout.hpp"
#include "box_writer.hpp"
#include "frame_slot.hpp"
#include "status.hpp"

namespace pose_wall::runtime {
namespace {

constexpr std::int64_t kMillisecond_ns = 1000000;
constexpr std::int64_t kHour_ns = 3600000 * kMillisecond_ns;
constexpr std::uint32_t kWishes = POSE_WALL_RUNTIME_PRIORITY | POSE_WALL_RUNTIME_AFFINITY | POSE_WALL_RUNTIME_LOCK;

template <typename T>
bool within(T value, T low, T high) {
  return value >= low && value <= high;
}

bool is_thinning(std::uint32_t n) {
  return within(n, 1U, 16U) && (n & (n - 1)) == 0;
}

bool counts_are_good(const pose_wall_runtime_options& o) {
  return within(o.queue_frames, 1U, 64U) && within(o.cloud_points_max, 1U, 1U << 26) &&
         within(o.point_bytes_max, 12U, 32U) && is_thinning(o.thinning_max) && o.box_clouds <= 1 &&
         within(o.box_backlog, 1U, 64U) && o.reserved == 0;
}

bool wishes_are_good(const pose_wall_runtime_options& o) {
  return within(o.worker_priority, 0, 99) && within(o.worker_cpu, -1, 1023) && o.lock_memory <= 1 &&
         (o.required & ~kWishes) == 0;
}

bool times_are_good(const pose_wall_runtime_options& o) {
  return within(o.frame_period_max_ns, kMillisecond_ns, kHour_ns) && within<std::int64_t>(o.watchdog_ns, 0, kHour_ns) &&
         within(o.watchdog_every_ns, kMillisecond_ns, kHour_ns);
}

bool box_is_good(const pose_wall_runtime_options& o) {
  if (o.sink == nullptr) return true;
  const std::uint64_t cloud = o.box_clouds != 0 ? cloud_bytes_max(o) : 0;
  return machine_is_little_endian() && o.box_bytes >= BoxWriter::box_bytes_min(cloud);
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

std::int32_t check_options(const pose_wall_runtime_options& options) {
  if (options.struct_size != sizeof(options)) return POSE_WALL_E_STRUCT_SIZE;
  const bool good =
      counts_are_good(options) && wishes_are_good(options) && times_are_good(options) && box_is_good(options);
  return ok_if(good, POSE_WALL_RUNTIME_E_OPTION);
}

std::uint32_t slots_of(const pose_wall_runtime_options& o) {
  // Waiting, one being filled, one in work; and what waits for the sink, with the one it is at.
  return o.queue_frames + 2 + (o.sink != nullptr ? o.box_backlog : 0);
}

std::uint64_t cloud_bytes_max(const pose_wall_runtime_options& o) {
  return static_cast<std::uint64_t>(o.cloud_points_max) * o.point_bytes_max;
}

}  // namespace pose_wall::runtime
