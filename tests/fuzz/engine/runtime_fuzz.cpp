// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: the runtime. Options by the input, then pushes of good, bad and garbage clouds, time that passes, stops
// and starts, a disk that fails. The counters balance, what is published keeps the contract, and every whole record of
// the black box computes to the bits that were recorded.

#include <atomic>

#include "fuzz/cloud_from_input.hpp"
#include "fuzz/config_from_input.hpp"
#include "fuzz/fuzz_target.hpp"
#include "fuzz/garbage_from_input.hpp"
#include "fuzz/road_from_input.hpp"
#include "pose_wall_box.h"
#include "pose_wall_runtime.h"
#include "support/contract.hpp"

namespace {

using namespace pose_wall::test;  // NOLINT(google-build-using-namespace): one target, one file

// The largest box_bytes that an input can choose fits.
constexpr std::uint64_t kDiskBytes = 1U << 20U;
// Bounds the time of an input.
constexpr int kEventsMax = 12;
constexpr std::int64_t kMs = 1000000;

struct World {
  std::atomic<std::int64_t> now_ns{1000 * kMs};
  std::atomic<bool> disk_broken{false};
  std::uint64_t disk_end = 0;
  unsigned char disk[kDiskBytes];
  ContractLimits limits{};
};

std::int64_t now(void* world) {
  return static_cast<World*>(world)->now_ns;
}

std::int32_t to_disk(void* self, std::uint64_t offset, const void* bytes, std::uint64_t count) {
  World& world = *static_cast<World*>(self);
  require(offset <= kDiskBytes && count <= kDiskBytes - offset, "the ring keeps within its size");
  if (world.disk_broken) return 5;
  std::memcpy(world.disk + offset, bytes, static_cast<std::size_t>(count));
  if (offset + count > world.disk_end) world.disk_end = offset + count;
  return 0;
}

void on_result(void* self, const pose_wall_publication* publication) {
  const World& world = *static_cast<World*>(self);
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value& v = publication->result.quantity[q];
    require(publication->thinning == 1 || v.state != POSE_WALL_VALID, "nothing thinned is valid");
    const char* const broken = broken_promise(v, q, world.limits);
    // What was thinned is degraded without a reason of its own: its publication says why.
    const bool by_thinning = publication->thinning > 1 && std::strcmp(broken, "not valid, without a reason") == 0;
    require(broken[0] == '\0' || by_thinning, broken);
  }
}

pose_wall_runtime_options options_by(Input* input, World* world) {
  pose_wall_runtime_options o;
  require_ok(pose_wall_runtime_options_init(&o), "options");
  o.queue_frames = 1 + input->below(4);
  o.cloud_points_max = 500 + 30U * input->byte();
  o.point_bytes_max = 12 + input->below(3) * 4;
  o.thinning_max = 1U << input->below(5);
  o.frame_period_max_ns = (1 + input->byte()) * kMs;
  o.watchdog_ns = input->byte() * 10 * kMs;
  o.watchdog_every_ns = (1 + input->byte()) * kMs;
  o.box_clouds = input->below(2);
  o.box_backlog = 1 + input->below(4);
  o.box_bytes = 8192 + 4000U * input->byte();
  o.clock = now;
  o.clock_user = world;
  o.callback = on_result;
  o.callback_user = world;
  o.sink = input->below(8) == 0 ? nullptr : to_disk;
  o.sink_user = world;
  return o;
}

// Anything that a caller may describe, over points that are there.
void push_described(Input* input, pose_wall_runtime* runtime, bool any) {
  pose_wall_cloud cloud = description_by(input, any);
  cloud.data = road_points();
  cloud.data_bytes = kRoadPointsMax * sizeof road_points()[0];
  const std::int32_t checked = pose_wall_cloud_check(&cloud), pushed = pose_wall_runtime_push(runtime, &cloud);
  const bool too_large = checked == POSE_WALL_OK && pushed == POSE_WALL_RUNTIME_E_LARGE;
  require(pushed == checked || too_large || pushed == POSE_WALL_RUNTIME_E_STATE, "push says what the check says");
}

pose_wall_inputs inputs_by(std::uint8_t what) {
  pose_wall_inputs inputs{};
  inputs.struct_size = what == 254 ? 8 : sizeof inputs;
  inputs.given = what % 8U;
  inputs.speed_m_s = (what - 128) * 0.5;
  inputs.speed_sigma_m_s = (what - 64) * 0.01;
  inputs.turn_rate_rad_s = (what - 128) * 0.1;
  inputs.turn_rate_sigma_rad_s = 0.01 * what;
  for (int k = 0; k < 6; ++k) inputs.body_box[what % 4U][k] = (k % 2 == 0 ? -0.01 : 0.01) * what;
  return inputs;
}

void push(Input* input, pose_wall_runtime* runtime, std::int64_t stamp_ns) {
  const std::uint8_t what = input->byte();
  if (what % 8U == 1) return push_described(input, runtime, what >= 128);
  const std::uint32_t points =
      what % 4U == 0 ? garbage_points(input, road_points(), 4000) : scan_road(plain_road(), what);
  pose_wall_cloud cloud;
  require_ok(pose_wall_cloud_xyz32(&cloud, road_points(), points, 12, stamp_ns), "xyz32");
  if (what > 240) cloud.x.type = what % 10U;
  pose_wall_inputs inputs = inputs_by(what);
  if (what % 3U == 2) cloud.inputs = &inputs;
  (void)pose_wall_runtime_push(runtime, &cloud);  // it may be stopped, or say no
}

void require_balance(pose_wall_runtime* runtime) {
  pose_wall_runtime_statistics s;
  std::memset(&s, 0, sizeof s);
  s.struct_size = sizeof s;
  require_ok(pose_wall_runtime_statistics_now(runtime, &s), "statistics");
  std::uint64_t sum = s.processed + s.in_work + s.waiting + s.filling;
  for (const std::uint64_t dropped : s.dropped) sum += dropped;
  require(sum == s.pushed, "the counters balance");
  require(s.dropped[POSE_WALL_RUNTIME_DROP_ENGINE] == 0, "the engine refuses nothing that push took");
}

void event(Input* input, pose_wall_runtime* runtime, World* world) {
  pose_wall_publication latest;
  std::memset(&latest, 0, sizeof latest);
  latest.struct_size = sizeof latest;
  const std::uint8_t what = input->byte();
  switch (what % 8U) {
    case 5:
      require_ok(pose_wall_runtime_stop(runtime), "stop");
      break;
    case 6:
      world->disk_broken = !world->disk_broken;
      break;
    case 7:
      if ((what & 128U) != 0) world->now_ns -= input->byte() * 50 * kMs;
      (void)pose_wall_runtime_tick(runtime);
      break;
    default:
      push(input, runtime, world->now_ns);
  }
  const std::int32_t started = pose_wall_runtime_start(runtime);
  require(started == POSE_WALL_OK || started == POSE_WALL_RUNTIME_E_STATE, "it starts, or runs");
  if ((what & 64U) == 0) (void)pose_wall_runtime_wait_idle(runtime);
  const std::int32_t status = pose_wall_runtime_latest(runtime, &latest);
  for (const pose_wall_value& v : latest.result.quantity) {
    require(status == POSE_WALL_OK || v.state == POSE_WALL_INVALID, "what is refused is invalid");
  }
  world->now_ns += input->byte() * kMs;
  require_balance(runtime);
}

void read_back(const World& world, const pose_wall_config& config) {
  static KeptBlock block;
  if (world.disk_end < POSE_WALL_BOX_HEADER_BYTES) return;
  pose_wall_engine* const engine = open_engine(config, &block, 0x00);
  std::uint64_t offset = POSE_WALL_BOX_HEADER_BYTES;
  pose_wall_box_record record;
  while (pose_wall_box_next(world.disk, world.disk_end, &offset, &record) == POSE_WALL_OK) {
    if (record.damaged != 0) continue;  // begun to be overwritten by one that the disk then refused
    pose_wall_result computed = empty_result();
    const std::int32_t status = pose_wall_box_compute(&record, engine, &computed);
    if (status == POSE_WALL_BOX_E_EMPTY) continue;
    require_ok(status, "compute");
    // But for the times: this clock may have moved while the frame was in work, and computing again has none.
    pose_wall_result recorded;
    std::memcpy(&recorded, record.result, sizeof recorded);
    std::memcpy(recorded.stage_ns, computed.stage_ns, sizeof recorded.stage_ns);
    require(std::memcmp(&computed, &recorded, sizeof computed) == 0, "the record computes to the same bits");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static KeptBlock block;
  static World world;
  static const pose_wall_config config = small_config_for_fuzzing();
  world.limits = limits_of(config);
  world.now_ns = 1000 * kMs;
  world.disk_broken = false;
  world.disk_end = 0;
  Input input(data, size);
  const pose_wall_runtime_options options = options_by(&input, &world);
  std::uint64_t bytes = 0;
  if (pose_wall_runtime_memory_needed(&config, &options, &bytes) != POSE_WALL_OK) return 0;
  const std::uint64_t lines = (bytes + POSE_WALL_BLOCK_ALIGNMENT - 1) / POSE_WALL_BLOCK_ALIGNMENT;
  pose_wall_runtime* runtime = nullptr;
  require_ok(
      pose_wall_runtime_open(&config, &options, block.filled(lines * POSE_WALL_BLOCK_ALIGNMENT, 0xA5), bytes, &runtime),
      "open");
  for (int i = 0; i < kEventsMax && !input.empty(); ++i) event(&input, runtime, &world);
  require_ok(pose_wall_runtime_stop(runtime), "stop");
  require_balance(runtime);
  require_ok(pose_wall_runtime_close(runtime), "close");
  read_back(world, config);
  return 0;
}
