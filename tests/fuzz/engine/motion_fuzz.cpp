// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target and oracle of the motion library: settings and a config, then drives along roads, garbage, silence,
// repeats and resets, under stamps, rings, times and inputs that are anything. Every result keeps its contract, a level
// along never shrinks while nothing tells the way, garbage is never measured, and a second motion on another block
// gives the same bits.

#include <cmath>

#include "fuzz/config_from_input.hpp"
#include "fuzz/fuzz_target.hpp"
#include "fuzz/garbage_from_input.hpp"
#include "fuzz/road_from_input.hpp"
#include "fuzz/stamps_from_input.hpp"
#include "support/motion_contract.hpp"

namespace {

using namespace pose_wall::test;  // NOLINT(google-build-using-namespace): one target, one file

// Bounds the time of an input.
constexpr int kEventsMax = 8;

struct Pair {
  pose_wall_motion *one, *other;
  pose_wall_motion_result before;
  bool has_before;
  std::int64_t stamp_ns;
  std::uint32_t points;  // in road_points()
  roadway road;
  std::uint32_t frame;
};

pose_wall_motion* open_motion(const pose_wall_config& config, const pose_wall_motion_settings& settings,
                              KeptBlock* block, int garbage) {
  const std::uint64_t bytes = pose_wall_motion_memory_needed();
  pose_wall_motion* motion = nullptr;
  require_ok(pose_wall_motion_open(&config, &settings, block->filled(bytes, garbage), bytes, &motion), "open");
  return motion;
}

pose_wall_motion_settings settings_by(Input* input) {
  pose_wall_motion_settings settings;
  require_ok(pose_wall_motion_settings_init(&settings), "settings");
  const std::uint8_t with = input->byte();
  if ((with & 1U) != 0) settings.speed_max_m_s = input->between(0.01, 30.0);
  if ((with & 2U) != 0) settings.turn_max_rad_s = input->between(0.01, 10.0);
  if ((with & 4U) != 0) settings.range_max_m = input->between(3.0, 100.0);
  if ((with & 8U) != 0) settings.keyframe_m = input->between(0.05, 1.0);
  require_ok(pose_wall_motion_settings_check(&settings, nullptr), "settings that pass");
  return settings;
}

void require_contract(const Pair& pair, const pose_wall_motion_result& now) {
  const char* broken = broken_motion(now);
  require(broken == nullptr, broken);
  if (!pair.has_before) return;
  broken = broken_between(pair.before, now);
  require(broken == nullptr, broken);
}

// Fields that lie over the points' own bytes: numbers, and none of a scan.
void describe(Input* input, pose_wall_cloud* cloud) {
  const std::uint8_t with = input->byte();
  if ((with & 1U) != 0) cloud->time = {input->below(9), 1 + input->below(6)};
  if ((with & 2U) != 0) cloud->ring = {input->below(9), 1 + input->below(6)};
}

pose_wall_inputs inputs_by(Input* input) {
  pose_wall_inputs inputs;
  std::memset(&inputs, 0, sizeof inputs);
  inputs.struct_size = sizeof inputs;
  inputs.given = input->below(8);
  inputs.speed_m_s = input->between(-60.0, 60.0);
  inputs.speed_sigma_m_s = input->between(-0.1, 5.0);
  inputs.turn_rate_rad_s = input->between(-11.0, 11.0);
  inputs.turn_rate_sigma_rad_s = input->between(-0.1, 2.0);
  return inputs;
}

void process(Input* input, Pair* pair, bool may_be_measured) {
  pose_wall_cloud cloud;
  require_ok(pose_wall_cloud_xyz32(&cloud, road_points(), pair->points, 12, pair->stamp_ns), "xyz32");
  const std::uint8_t with = input->byte();
  pose_wall_inputs inputs;
  if ((with & 1U) != 0) {
    inputs = inputs_by(input);
    cloud.inputs = &inputs;
  }
  if ((with & 2U) != 0) {
    const pose_wall_cloud plain = cloud;
    describe(input, &cloud);
    if (pose_wall_cloud_check(&cloud) != POSE_WALL_OK) cloud = plain;
  }
  pose_wall_motion_result one, other;
  std::memset(&one, 0, sizeof one);
  std::memset(&other, 0, sizeof other);
  one.struct_size = other.struct_size = sizeof one;
  require_ok(pose_wall_motion_process(pair->one, &cloud, &one), "process");
  require_ok(pose_wall_motion_process(pair->other, &cloud, &other), "process");
  require(std::memcmp(&one, &other, sizeof one) == 0, "the same bits");
  require(one.points_in == pair->points, "all points are looked at");
  require_contract(*pair, one);
  const bool begins = (one.reasons & POSE_WALL_MOTION_R_FIRST) != 0;  // a map of whatever is seen
  require(may_be_measured || begins || one.along_state != POSE_WALL_ALONG_MEASURED, "garbage is not measured");
  pair->before = one;
  pair->has_before = true;
}

void reset(Pair* pair) {
  require_ok(pose_wall_motion_reset(pair->one), "reset");
  require_ok(pose_wall_motion_reset(pair->other), "reset");
  pair->has_before = false;
}

void look_at_map(const Pair& pair) {
  static float points[64][3];
  std::uint32_t total = 0, again = 0;
  require_ok(pose_wall_motion_map(pair.one, 0, points[0], 64, &total), "map");
  require_ok(pose_wall_motion_map(pair.one, total / 2, points[0], 64, &again), "map");
  require(total == again, "as many points");
  for (std::uint32_t i = 0; i < 64 && total / 2 + i < total; ++i) {
    for (const float c : points[i]) require(std::isfinite(c), "points of the map are numbers");
  }
}

void event(Input* input, Pair* pair) {
  const std::uint8_t what = input->byte();
  move_stamp(input, {180, 210, 225}, &pair->stamp_ns);
  switch (what % 8U) {
    case 0:
      pair->road = road_by(input);
      pair->frame = 0;
      [[fallthrough]];
    case 1:
    case 2:
    case 3:  // on along the same road
      pair->points = scan_road(pair->road, pair->frame++);
      if ((what & 64U) != 0) pair->points = damage_points(input, road_points(), pair->points);
      return process(input, pair, true);
    case 4:
      pair->points = garbage_points(input, road_points(), kRoadPointsMax);
      return process(input, pair, false);
    case 5:
      return process(input, pair, true);  // the very points of before
    case 6:
      pair->points = 0;
      return process(input, pair, false);
    default:
      look_at_map(*pair);
      return reset(pair);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static KeptBlock block_of_one, block_of_other;
  Input input(data, size);
  const pose_wall_config config = config_by(&input);
  const pose_wall_motion_settings settings = settings_by(&input);
  Pair pair{open_motion(config, settings, &block_of_one, 0xA5),
            open_motion(config, settings, &block_of_other, 0x00),
            {},
            false,
            0,
            0,
            plain_road(),
            0};
  for (int i = 0; i < kEventsMax && !input.empty(); ++i) event(&input, &pair);
  return 0;
}
