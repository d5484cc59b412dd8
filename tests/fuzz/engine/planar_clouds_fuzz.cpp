// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: what of the planar library reads clouds. Roads, damage, garbage and silence go to the scanner and to the
// obstacle stop, under floors, motions and times that are anything. Every scan keeps the contract of its header. The
// stop never lets a machine drive that it told to stand, nor by garbage, old frames or the past. A second pair on
// other blocks gives the same bits.

#include "fuzz/config_from_input.hpp"
#include "fuzz/fuzz_target.hpp"
#include "fuzz/road_from_input.hpp"
#include "fuzz/scans_from_input.hpp"
#include "fuzz/stamps_from_input.hpp"
#include "pose_wall_planar_scan.h"
#include "pose_wall_planar_stop.h"

namespace {

using namespace pose_wall::test;  // NOLINT(google-build-using-namespace): one target, one file

constexpr int kEventsMax = 10;  // bounds the time of an input

struct Pair {
  pose_wall_planar_scanner *scanner, *other_scanner;
  pose_wall_planar_stop *stop, *other_stop;
  pose_wall_planar_stop_settings settings;
  std::int64_t stamp_ns, now_ns;
  std::uint32_t points;  // in road_points()
  roadway road;
  std::uint32_t frame;
};

pose_wall_planar_scanner* open_scanner(const pose_wall_config& config, std::uint8_t with, KeptBlock* block,
                                       int garbage) {
  pose_wall_planar_scanner_settings settings;
  require_ok(pose_wall_planar_scanner_settings_init(&settings), "settings");
  settings.angle_step_rad = 0.01;
  settings.alone = with & 1U;
  settings.bend_rad = (with & 2U) != 0 ? 0.0 : 0.02;
  settings.fill_rad = (with & 4U) != 0 ? 0.05 : 0.0065;
  std::uint64_t bytes = 0;
  pose_wall_planar_scanner* scanner = nullptr;
  require_ok(pose_wall_planar_scanner_memory_needed(&settings, &bytes), "memory needed");
  require_ok(pose_wall_planar_scanner_open(&config, &settings, block->filled(bytes, garbage), bytes, &scanner), "open");
  return scanner;
}

pose_wall_planar_stop* open_stop(const pose_wall_config& config, const pose_wall_planar_stop_settings& settings,
                                 KeptBlock* block, int garbage) {
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_stop_memory_needed(&bytes), "memory_needed");
  pose_wall_planar_stop* stop = nullptr;
  require_ok(pose_wall_planar_stop_open(&config, &settings, block->filled(bytes, garbage), bytes, &stop), "open");
  return stop;
}

pose_wall_planar_stop_settings settings_by(Input* input) {
  pose_wall_planar_stop_settings settings;
  require_ok(pose_wall_planar_stop_settings_init(&settings), "settings");
  const pose_wall_planar_stop_settings plain = settings;
  const std::uint8_t with = input->byte();
  if ((with & 1U) != 0) settings.speed_max_m_s = input->between(0.05, 3.0);
  if ((with & 2U) != 0) settings.approach_m_s = input->between(0.0, 3.0);
  if ((with & 4U) != 0) settings.delay_s = input->between(0.1, 2.0);
  if ((with & 8U) != 0) settings.thing_height_m = input->between(0.1, 1.0);
  if ((with & 16U) != 0) settings.floor_z_m = input->between(-3.0, 1.0);
  if ((with & 32U) != 0) settings.restart_s = input->between(0.0, 1.0);
  if ((with & 64U) != 0) settings.top_m = input->between(0.5, 6.0);
  return pose_wall_planar_stop_settings_check(&settings, nullptr) == POSE_WALL_OK ? settings : plain;
}

// ---------------------------------------------------------------------------------------------- the scan

pose_wall_planar_floor floor_by(Input* input) {
  pose_wall_planar_floor floor{};
  floor.struct_size = sizeof floor;
  const std::uint8_t how = input->byte();
  floor.measured = how % 4U != 0 ? 1 : 0;
  floor.normal[2] = 1.0;
  if (how % 4U == 1) {
    const double tilt_rad = input->between(-1.2, 1.2);
    floor.normal[0] = std::sin(tilt_rad);
    floor.normal[2] = std::cos(tilt_rad);
  }
  if (how % 64U == 2) floor.normal[how % 3U] = input->take<double>();
  floor.height_m = how == 255 ? input->take<double>() : input->between(0.0, 3.0);
  floor.tilt_sigma_rad = input->between(0.0, 0.02);
  floor.tilt_level_rad = 3.0 * floor.tilt_sigma_rad;
  floor.reach_m = input->between(0.0, 30.0);
  return floor;
}

void require_beam(const pose_wall_planar_scan& scan, const pose_wall_planar_scan_view& view, std::uint32_t k) {
  const float range_m = scan.range_m[k];
  const bool has_range = std::isfinite(range_m);
  require(std::isnan(range_m) || range_m > 0.0F, "a range is positive, infinite or none");
  require(!has_range || (static_cast<double>(range_m) >= scan.range_min_m - 1e-6 &&
                         static_cast<double>(range_m) <= scan.range_max_m + 1e-6),
          "a range within the scan's");
  require(view.free_m[k] >= 0.0F, "free is not negative");
  require(!std::isinf(range_m) || static_cast<double>(view.free_m[k]) >= scan.range_max_m - 1e-3,
          "open is what was seen free all along");
  require(std::isnan(view.clear_m[k]) || (view.clear_from_m[k] <= view.clear_m[k] + 1e-4F),
          "clear begins before it ends");
  require(has_range || (view.returns[k] == 0 && view.bias_m[k] == 0.0F && std::isnan(view.sigma_m[k])),
          "no range, nothing of it");
}

void to_scanner(Input* input, const Pair& pair, const pose_wall_cloud& cloud, bool is_empty) {
  const pose_wall_planar_floor floor = floor_by(input);
  pose_wall_planar_scan scan{}, other{};
  pose_wall_planar_scan_view view{}, other_view{};
  scan.struct_size = other.struct_size = sizeof scan;
  view.struct_size = other_view.struct_size = sizeof view;
  const std::int32_t status = pose_wall_planar_scanner_process(pair.scanner, &cloud, &floor, &scan, &view);
  require(pose_wall_planar_scanner_process(pair.other_scanner, &cloud, &floor, &other, &other_view) == status,
          "the same status");
  require(status == POSE_WALL_OK || status == POSE_WALL_PLANAR_E_POSE, "a refusal that the header knows");
  if (status != POSE_WALL_OK) return;
  require(scan.beams == other.beams && std::memcmp(scan.range_m, other.range_m, scan.beams * sizeof(float)) == 0 &&
              std::memcmp(view.clear_m, other_view.clear_m, scan.beams * sizeof(float)) == 0,
          "the same bits");
  const bool has_floor = view.floor_state != POSE_WALL_PLANAR_FLOOR_NONE;
  require(view.points_in == (has_floor ? pair.points : 0), "all points are looked at, or none");
  std::uint32_t ranges = 0;
  for (std::uint32_t k = 0; k < scan.beams; ++k) {
    require_beam(scan, view, k);
    if (std::isfinite(scan.range_m[k])) ++ranges;
  }
  require(ranges == 0 || (has_floor && !is_empty), "no floor, no ranges");
}

// ---------------------------------------------------------------------------------------------- the stop

pose_wall_planar_stop_motion motion_by(Input* input) {
  pose_wall_planar_stop_motion motion{};
  motion.struct_size = sizeof motion;
  const std::uint8_t how = input->byte();
  motion.given = how % 4U;
  motion.speed_m_s = how == 255 ? input->take<double>() : input->between(-1.5, 1.5);
  motion.turn_rad_s = how == 254 ? input->take<double>() : input->between(-1.0, 1.0);
  motion.command_speed_m_s = how == 253 ? input->take<double>() : input->between(-1.5, 1.5);
  motion.command_turn_rad_s = input->between(-1.0, 1.0);
  return motion;
}

void require_verdict(const Pair& pair, const pose_wall_planar_stop_result& r) {
  require(r.state <= POSE_WALL_PLANAR_STOP_GO, "a known state");
  require((r.reasons >> POSE_WALL_PLANAR_STOP_REASON_COUNT) == 0, "no such reason");
  require(r.allowed_speed_m_s >= 0.0 && r.allowed_speed_m_s <= pair.settings.speed_max_m_s + 1e-9, "a speed allowed");
  require(r.state != POSE_WALL_PLANAR_STOP_STOP || r.allowed_speed_m_s == 0.0, "a stop allows no speed");
  require(r.state != POSE_WALL_PLANAR_STOP_STOP || r.reasons != 0, "a stop has a reason");
  const double age_s = 1e-9 * (static_cast<double>(r.now_ns) - static_cast<double>(r.stamp_ns));
  const bool is_fresh = r.frames > 0 && age_s <= pair.settings.stale_s * (1.0 + 1e-12) + 1e-9 && age_s >= -0.1;
  require(is_fresh || r.state == POSE_WALL_PLANAR_STOP_STOP, "no drive by old frames");
}

void to_stop(Input* input, Pair* pair, const pose_wall_cloud& cloud, bool may_go) {
  const pose_wall_planar_stop_motion motion = motion_by(input);
  const pose_wall_planar_stop_motion* const given = input->byte() < 250 ? &motion : nullptr;
  pose_wall_planar_stop_result one{}, other{};
  one.struct_size = other.struct_size = sizeof one;
  require_ok(pose_wall_planar_stop_process(pair->stop, &cloud, given, pair->now_ns, &one), "process");
  require_ok(pose_wall_planar_stop_process(pair->other_stop, &cloud, given, pair->now_ns, &other), "process");
  require(std::memcmp(&one, &other, sizeof one) == 0, "the same bits");
  require_verdict(*pair, one);
  require(may_go || one.state == POSE_WALL_PLANAR_STOP_STOP, "no drive by an empty cloud");
  const std::int64_t passed_ns = 1000000 * std::int64_t{input->byte()};
  pair->now_ns += passed_ns;
  const std::uint32_t beat = one.heartbeat;
  require_ok(pose_wall_planar_stop_tick(pair->stop, pair->now_ns, &one), "tick");
  require_ok(pose_wall_planar_stop_tick(pair->other_stop, pair->now_ns, &other), "tick");
  require(one.heartbeat == beat || passed_ns > 0, "no beat while the clock stands");
  require(one.heartbeat != beat || passed_ns <= 5000000, "the heart beats");  // so far a time may lag behind
  require_verdict(*pair, one);
}

void see(Input* input, Pair* pair, bool may_go) {
  pose_wall_cloud cloud;
  require_ok(pose_wall_cloud_xyz32(&cloud, road_points(), pair->points, 12, pair->stamp_ns), "xyz32");
  to_scanner(input, *pair, cloud, pair->points == 0);
  to_stop(input, pair, cloud, may_go);
}

void event(Input* input, Pair* pair) {
  const std::uint8_t what = input->byte();
  move_stamp(input, {200, 215, 230}, &pair->stamp_ns);
  pair->now_ns = (what & 128U) == 0 ? pair->stamp_ns : input->take<std::int64_t>() / 4;
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
      return see(input, pair, true);
    case 4:
      pair->points = garbage_points(input, road_points(), kRoadPointsMax);
      return see(input, pair, true);
    case 5:
      return see(input, pair, true);  // the very points of before
    case 6:
      pair->points = 0;
      return see(input, pair, false);
    default:
      require_ok(pose_wall_planar_stop_confirm(pair->stop), "confirm");
      require_ok(pose_wall_planar_stop_confirm(pair->other_stop), "confirm");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static KeptBlock blocks[4];
  Input input(data, size);
  const pose_wall_config config = config_by(&input);
  const std::uint8_t with = input.byte();
  const pose_wall_planar_stop_settings settings = settings_by(&input);
  Pair pair{open_scanner(config, with, &blocks[0], 0xA5),
            open_scanner(config, with, &blocks[1], 0x00),
            open_stop(config, settings, &blocks[2], 0xA5),
            open_stop(config, settings, &blocks[3], 0x00),
            settings,
            0,
            0,
            0,
            plain_road(),
            0};
  for (int k = 0; k < kEventsMax && !input.empty(); ++k) event(&input, &pair);
  return 0;
}
