// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: what reads planar scans. A drive through a hall, garbage, silence and odometry that is anything go to
// SLAM, map, match and localisation. What is refused changes nothing. Every result keeps the contract of its header,
// and a second SLAM on another block gives the same bits. The localisation's map is the trail, at whatever moment.

#include "fuzz/fuzz_target.hpp"
#include "fuzz/scans_from_input.hpp"
#include "fuzz/stamps_from_input.hpp"
#include "pose_wall_planar_localise.h"
#include "pose_wall_planar_map.h"
#include "pose_wall_planar_match.h"
#include "pose_wall_planar_slam.h"

namespace {

using namespace pose_wall::test;  // NOLINT(google-build-using-namespace): one target, one file

constexpr int kEventsMax = 12;  // bounds the time of an input
constexpr std::uint32_t kKeyframes = 16, kTiles = 16;

struct Parts {
  pose_wall_planar_slam *slam, *other;
  pose_wall_planar_map* map;
  pose_wall_planar_localise* localise;
  pose_wall_planar_matcher* matcher;
  bool is_placed;  // the localisation has a map
  std::uint32_t saves, saves_refused_every;
};

struct Drive {
  Hall hall;
  pose_wall_planar_pose base{0.0, 0.0, 0.0};
  std::int64_t stamp_ns = 0;
  ScanOfInput seen;
};

template <typename Part, typename Settings, typename Needed, typename Open>
Part* opened(const Settings& settings, Needed needed, Open open, KeptBlock* block, int garbage) {
  std::uint64_t bytes = 0;
  Part* part = nullptr;
  require_ok(needed(&settings, &bytes), "memory needed");
  require_ok(open(&settings, block->filled(bytes, garbage), bytes, &part), "open");
  return part;
}

pose_wall_planar_slam* open_slam(KeptBlock* block, int garbage) {
  pose_wall_planar_slam_settings settings;
  require_ok(pose_wall_planar_slam_settings_init(&settings), "settings");
  settings.keyframes_most = kKeyframes;
  return opened<pose_wall_planar_slam>(settings, pose_wall_planar_slam_memory_needed, pose_wall_planar_slam_open, block,
                                       garbage);
}

pose_wall_planar_map* open_map(KeptBlock* block) {
  pose_wall_planar_map_settings settings;
  require_ok(pose_wall_planar_map_settings_init(&settings), "settings");
  settings.tiles = kTiles;
  return opened<pose_wall_planar_map>(settings, pose_wall_planar_map_memory_needed, pose_wall_planar_map_open, block,
                                      0xA5);
}

pose_wall_planar_localise* open_localise(KeptBlock* block) {
  pose_wall_planar_localise_settings settings;
  require_ok(pose_wall_planar_localise_settings_init(&settings), "settings");
  settings.tiles_most = 64;
  settings.work = 5000;
  return opened<pose_wall_planar_localise>(settings, pose_wall_planar_localise_memory_needed,
                                           pose_wall_planar_localise_open, block, 0xA5);
}

pose_wall_planar_matcher* open_match(KeptBlock* block) {
  std::uint64_t bytes = 0;
  pose_wall_planar_matcher* matcher = nullptr;
  require_ok(pose_wall_planar_match_memory_needed(&bytes), "memory needed");
  require_ok(pose_wall_planar_match_open(block->filled(bytes, 0xA5), bytes, &matcher), "open");
  return matcher;
}

std::int32_t take_tile(void* context, const pose_wall_planar_tile* tile) {
  auto* const parts = static_cast<Parts*>(context);
  require(tile->struct_size == sizeof *tile, "a tile that is whole");
  pose_wall_planar_box box{};
  box.struct_size = sizeof box;
  require(pose_wall_planar_map_box(parts->map, &box) == POSE_WALL_E_BUSY, "a call from the callback is refused");
  return ++parts->saves % parts->saves_refused_every == 0 ? 1 : 0;
}

void require_slam(const pose_wall_planar_slam_result& r) {
  require(r.state <= POSE_WALL_PLANAR_SLAM_BLIND, "a known state");
  require(is_result(r.pose) && is_finite(r.in_keyframe), "a pose that is a number");
  require(r.explained >= 0.0 && r.explained <= 1.0, "a share");
  require(r.misfit_m >= 0.0 && r.misfit_m < 1e3, "a misfit that is one");
  require(r.keyframes <= kKeyframes && r.keyframe < r.keyframes, "keyframes that there are");
}

void require_localise(const pose_wall_planar_localise_result& r) {
  require(r.state <= POSE_WALL_PLANAR_LOCALISE_DOUBTFUL, "a known state");
  const bool placed = r.state >= POSE_WALL_PLANAR_LOCALISE_UNIQUE;
  require(placed ? is_result(r.pose) : is_none(r.pose), "a pose iff it is placed");
  for (int k = 0; k < 3; ++k) {
    const double variance = r.covariance[4 * k];
    require(placed ? variance > 0.0 && std::isfinite(variance) : std::isnan(variance), "a covariance iff placed");
  }
  require(r.progress >= 0.0 && r.progress <= 1.0, "progress is a share");
  require(r.candidates <= r.candidates_all && r.candidates <= 32, "as many candidates as can be asked for");
}

void require_candidates(const pose_wall_planar_localise* localise, std::uint32_t count) {
  double weights = 0.0;
  for (std::uint32_t k = 0; k < count; ++k) {
    pose_wall_planar_candidate candidate{};
    candidate.struct_size = sizeof candidate;
    require_ok(pose_wall_planar_localise_candidate(localise, k, &candidate), "candidate");
    require(is_result(candidate.pose), "a candidate is a pose");
    require(candidate.weight >= 0.0 && candidate.worse_by >= 0.0, "weights and errors are not negative");
    weights += candidate.weight;
  }
  require(count == 0 || weights < 1.0 + 1e-6, "weights are shares");
}

void to_slam(Parts* parts, const pose_wall_planar_scan& scan, const pose_wall_planar_pose* odometry, Drive* drive) {
  pose_wall_planar_slam_result one, other, untouched;
  std::memset(&one, 0x5A, sizeof one);
  one.struct_size = sizeof one;
  other = untouched = one;
  const std::int32_t status = pose_wall_planar_slam_process(parts->slam, &scan, odometry, &one);
  require(pose_wall_planar_slam_process(parts->other, &scan, odometry, &other) == status, "the same status");
  require(std::memcmp(&one, &other, sizeof one) == 0, "the same bits");
  if (status == POSE_WALL_OK) return require_slam(one);
  require(status == POSE_WALL_PLANAR_E_SCAN || status == POSE_WALL_PLANAR_E_POSE, "a refusal that the header knows");
  require(std::memcmp(&one, &untouched, sizeof one) == 0, "a refusal changes nothing");
  require(!drive->seen.is_hall || odometry != nullptr, "a good scan is taken");
}

void to_map(Parts* parts, const pose_wall_planar_scan& scan, const pose_wall_planar_pose& base) {
  pose_wall_planar_map_report report{};
  report.struct_size = sizeof report;
  const std::int32_t status = pose_wall_planar_map_insert(parts->map, &scan, &base, &report);
  require(status == POSE_WALL_OK || status == POSE_WALL_PLANAR_E_SCAN || status == POSE_WALL_PLANAR_E_POSE,
          "a known refusal");
  require(report.tiles <= kTiles, "no more tiles than there are");
  pose_wall_planar_ray ray{};
  ray.struct_size = sizeof ray;
  const pose_wall_planar_pose inside{0.0, 0.0, base.yaw_rad};
  const std::int32_t asked = pose_wall_planar_map_ray(parts->map, &inside, 0.3, 20.0, 0, &ray);
  require(asked == POSE_WALL_PLANAR_E_POSE || (ray.range_m >= 0.0 && ray.range_m <= 20.0 + 1e-9),
          "a range within the way");
}

void to_localise(Parts* parts, const pose_wall_planar_scan& scan, const pose_wall_planar_pose* odometry) {
  if (!parts->is_placed) return;
  pose_wall_planar_localise_result result{};
  result.struct_size = sizeof result;
  const std::int32_t status = pose_wall_planar_localise_process(parts->localise, &scan, odometry, &result);
  require(status == POSE_WALL_OK || status == POSE_WALL_PLANAR_E_SCAN || status == POSE_WALL_PLANAR_E_POSE,
          "a known refusal");
  if (status != POSE_WALL_OK) return;
  require_localise(result);
  require_candidates(parts->localise, result.candidates);
}

// The scan is matched with itself, from a guess and by a prior that may be anything.
void to_match(Input* input, Parts* parts, const pose_wall_planar_scan& scan, const pose_wall_planar_pose& base) {
  if (pose_wall_planar_match_begin(parts->matcher, base.x_m, base.y_m) != POSE_WALL_OK) return;
  const std::int32_t added = pose_wall_planar_match_add(parts->matcher, &scan, &base);
  require(added == POSE_WALL_OK || added == POSE_WALL_PLANAR_E_SCAN || added == POSE_WALL_PLANAR_E_POSE,
          "a known refusal");
  pose_wall_planar_match_input how;
  require_ok(pose_wall_planar_match_input_init(&how), "input");
  const std::uint8_t with = input->byte();
  how.guess = with % 16U == 15U ? any_pose(input) : base;
  how.reach_m = input->between(0.0, 2.0);
  how.has_prior = (with & 16U) != 0 ? 1 : 0;
  for (double& value : how.covariance) value = (with & 32U) != 0 ? input->take<double>() : 0.0;
  if ((with & 64U) != 0) how.covariance[0] = how.covariance[4] = how.covariance[8] = input->between(0.0, 1.0);
  pose_wall_planar_match_result result{};
  result.struct_size = sizeof result;
  const std::int32_t status = pose_wall_planar_match_scan(parts->matcher, &scan, &how, &result);
  require(status == POSE_WALL_OK || status == POSE_WALL_PLANAR_E_SCAN || status == POSE_WALL_PLANAR_E_POSE,
          "a known refusal");
  if (status != POSE_WALL_OK) return;
  const bool found = result.state == POSE_WALL_PLANAR_MATCH_FOUND;
  require(found ? is_result(result.pose) : is_none(result.pose), "a pose iff it is found");
  for (int k = 0; k < 3; ++k) {
    const double variance = result.covariance[4 * k];
    require(found ? variance > 0.0 && std::isfinite(variance) : std::isnan(variance), "a covariance iff it is found");
  }
  require(result.explained >= 0.0 && result.explained <= 1.0, "a share");
}

// The trail as it is becomes the localisation's map.
void place(Parts* parts) {
  static float xy_m[2 * POSE_WALL_PLANAR_BEAMS_MAX];
  require_ok(pose_wall_planar_localise_clear(parts->localise), "clear");
  parts->is_placed = false;
  pose_wall_planar_keyframe keyframe{};
  keyframe.struct_size = sizeof keyframe;
  std::uint32_t points = 0;
  for (std::uint32_t k = 0; pose_wall_planar_slam_keyframe(parts->slam, k, &keyframe) == POSE_WALL_OK; ++k) {
    require_ok(pose_wall_planar_slam_points(parts->slam, k, xy_m, POSE_WALL_PLANAR_BEAMS_MAX), "points");
    const std::int32_t status = pose_wall_planar_localise_add(parts->localise, &keyframe.pose, xy_m, keyframe.points);
    require(status == POSE_WALL_OK || status == POSE_WALL_E_BLOCK_SMALL, "a keyframe of a trail is taken");
    points += keyframe.points;
  }
  const std::int32_t status = pose_wall_planar_localise_finish(parts->localise);
  require(status == POSE_WALL_OK || (status == POSE_WALL_PLANAR_E_ORDER && points == 0),
          "a map that is not empty ends");
  parts->is_placed = status == POSE_WALL_OK;
}

void drive_on(Input* input, Drive* drive) {
  const double way_m = input->between(-0.4, 0.4), turn_rad = input->between(-0.3, 0.3);
  pose_wall_planar_pose& base = drive->base;
  base.yaw_rad += turn_rad;
  base.x_m += way_m * std::cos(base.yaw_rad);
  base.y_m += way_m * std::sin(base.yaw_rad);
  const double x_m = drive->hall.half_length_m - 0.5, y_m = drive->hall.half_width_m - 0.5;
  base.x_m = base.x_m > x_m ? x_m : base.x_m < -x_m ? -x_m : base.x_m;
  base.y_m = base.y_m > y_m ? y_m : base.y_m < -y_m ? -y_m : base.y_m;
}

void scan_event(Input* input, Parts* parts, Drive* drive, bool garbage) {
  begin_scan(input, &drive->seen);
  if (garbage) {
    see_garbage(input, &drive->seen);
  } else {
    drive_on(input, drive);
    see_hall(drive->hall, drive->base, &drive->seen);
  }
  const std::uint8_t with = input->byte();
  if ((with & 3U) == 3U) damage_scan(input, &drive->seen);
  drive->seen.scan.stamp_ns = drive->stamp_ns;
  pose_wall_planar_pose odometry = drive->base;
  if ((with & 12U) == 12U) odometry = any_pose(input);
  const pose_wall_planar_pose* const given = (with & 16U) != 0 ? &odometry : nullptr;
  to_slam(parts, drive->seen.scan, given, drive);
  to_map(parts, drive->seen.scan, odometry);
  to_localise(parts, drive->seen.scan, given);
  if ((with & 32U) != 0) to_match(input, parts, drive->seen.scan, odometry);
}

void event(Input* input, Parts* parts, Drive* drive) {
  const std::uint8_t what = input->byte();
  move_stamp(input, {180, 210, 225}, &drive->stamp_ns);
  switch (what % 8U) {
    case 5:
      return scan_event(input, parts, drive, true);
    case 6:
      return place(parts);
    case 7: {
      if (!parts->is_placed) return;
      const pose_wall_planar_pose base = any_pose(input);
      const std::int32_t status = pose_wall_planar_localise_place(parts->localise, &base, 0.1, 0.1);
      return require(status == POSE_WALL_OK || status == POSE_WALL_PLANAR_E_POSE, "a known refusal");
    }
    default:
      return scan_event(input, parts, drive, false);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static KeptBlock blocks[5];
  Input input(data, size);
  Parts parts{open_slam(&blocks[0], 0xA5),
              open_slam(&blocks[1], 0x00),
              open_map(&blocks[2]),
              open_localise(&blocks[3]),
              open_match(&blocks[4]),
              false,
              0,
              1 + input.below(4)};
  require_ok(pose_wall_planar_map_on_save(parts.map, take_tile, &parts), "on_save");
  static Drive drive;
  drive = Drive();
  drive.hall = hall_by(&input);
  for (int k = 0; k < kEventsMax && !input.empty(); ++k) event(&input, &parts, &drive);
  require_ok(pose_wall_planar_slam_settle(parts.slam), "settle");
  return 0;
}
