// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/scan/scanner.hpp"

#include <limits>

#include "base/math/elementary.hpp"
#include "base/math/finite.hpp"
#include "base/math/rotation.hpp"
#include "part/status.hpp"
#include "place/pose2.hpp"

namespace pose_wall::planar {
namespace {

constexpr double kEndless_m = 1e6;  // longer than any range, and a float
// The floor's tilt is within so many of its standard deviations, where its protection level is within a degree, the
// default of the engine's alert limit. Beyond, other readings of the floor weigh more than noise, and the whole level
// counts: heights are then less sure the further away, and fewer beams know a thing from the ground.
constexpr double kTiltSigmas = 3.0, kByNoise_rad = 0.0175;

double tilt_of(const pose_wall_planar_floor& floor) {
  const double by_noise_rad = kTiltSigmas * floor.tilt_sigma_rad;
  return floor.tilt_level_rad > kByNoise_rad ? larger(floor.tilt_level_rad, by_noise_rad) : by_noise_rad;
}

}  // namespace

std::int32_t check_floor(const pose_wall_planar_floor& floor) {
  constexpr double kUnit = 0.001, kLeastUp = 0.5, kHighest_m = 20.0, kTiltMost_rad = 0.5;  // the header's limits
  const double* const n = floor.normal;
  const double length2 = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
  const bool fits = is_within(length2, 1.0 - 2.0 * kUnit, 1.0 + 2.0 * kUnit) &&
                    is_within(n[2], kLeastUp, 1.0 + kUnit) && is_within(floor.height_m, -kHighest_m, kHighest_m) &&
                    is_within(floor.tilt_sigma_rad, 0.0, kTiltMost_rad) && floor.tilt_level_rad >= 0.0 &&
                    floor.reach_m >= 0.0;
  return ok_if(fits, POSE_WALL_PLANAR_E_POSE);
}

void Scanner::lay_out(Arena& arena, const pose_wall_planar_scanner_settings& given) {
  const ScanSettings settings = scan_settings_of(given);
  evidence_.lay_out(arena, settings.beams, settings.sectors);
  ranges_.lay_out(arena, settings.beams);
  clear_alone_ = arena.take<ClearRange>(settings.sectors);
  clear_ = arena.take<ClearRange>(settings.sectors);
  clear_from_m_ = arena.take<float>(settings.beams);
  clear_m_ = arena.take<float>(settings.beams);
}

void Scanner::open(const pose_wall_planar_scanner_settings& given, const pose_wall_config& config) {
  settings_ = scan_settings_of(given);
  read_sensor(config, &settings_);
  reset();
}

void Scanner::process(const pose_wall_cloud& cloud, const pose_wall_planar_floor* floor, pose_wall_planar_scan* scan,
                      pose_wall_planar_scan_view* view) {
  const std::uint32_t floor_state = take_floor(floor, cloud.stamp_ns);
  if (floor_state == POSE_WALL_PLANAR_FLOOR_NONE) {
    show_nothing();
  } else {
    gather_evidence(cloud, settings_, floor_, &evidence_);
    find_ranges(settings_, statistics_, &evidence_, &ranges_);
    const double sensor_m = sensor_level_m(settings_, floor_).z();
    find_clear(evidence_, clear_scene(sensor_m), edges_, clear_alone_, clear_);
    end_beams();
    show_clear();
  }
  describe(cloud.stamp_ns, scan);
  describe(floor_state, cloud.stamp_ns, view);
}

std::uint32_t Scanner::take_floor(const pose_wall_planar_floor* floor, std::int64_t stamp_ns) {
  const bool counts = floor != nullptr && floor->measured != 0 && floor->tilt_level_rad <= settings_.tilt_level_max_rad;
  // By unsigned numbers: stamps may be anything, and what went back is as old as can be.
  const std::uint64_t age_ns = static_cast<std::uint64_t>(stamp_ns) - static_cast<std::uint64_t>(floor_stamp_ns_);
  const double age_s = static_cast<double>(age_ns) * kNanosecond_s;
  const bool can_hold = has_floor_ && age_s <= settings_.hold_max_s;
  const double held_rad = tilt_measured_rad_ + settings_.hold_rate_rad_s * age_s;
  const bool held_is_better = can_hold && counts && floor->tilt_level_rad > kByNoise_rad && held_rad < tilt_of(*floor);
  if (counts && !held_is_better) {
    const Eigen::Vector3d up(floor->normal[0], floor->normal[1], floor->normal[2]);
    floor_.R_level_base = level_rotation(up);
    floor_.base_height_m = floor->height_m;
    floor_.reach_m = floor->reach_m < kEndless_m ? floor->reach_m : kEndless_m;
    tilt_measured_rad_ = floor_.tilt_rad = tilt_of(*floor);
    floor_stamp_ns_ = stamp_ns;
    has_floor_ = true;
    return POSE_WALL_PLANAR_FLOOR_MEASURED;
  }
  if (!can_hold) {
    has_floor_ = false;
    return POSE_WALL_PLANAR_FLOOR_NONE;
  }
  floor_.tilt_rad = held_rad;
  return POSE_WALL_PLANAR_FLOOR_HELD;
}

ClearScene Scanner::clear_scene(double sensor_m) const {
  ClearScene scene;
  scene.sensor_m = sensor_m;
  scene.tolerance_m = settings_.floor_tolerance_m;
  scene.high_m = settings_.high_m();
  scene.thing_m = settings_.thing_m;
  scene.tilt_rad = floor_.tilt_rad;
  scene.reach_m = settings_.reach_m;
  return scene;
}

// Thing, open or unknown. What is free in front of a thing ends at it, and nothing between two beams is free without
// rays of its own, unless a surface joins them.
void Scanner::end_beams() {
  const auto nearest_m = static_cast<float>(settings_.range_min_m), most_m = static_cast<float>(settings_.range_max_m);
  const auto nan = static_cast<float>(not_a_number());
  for (std::uint32_t beam = 0; beam < settings_.beams; ++beam) {
    float& range_m = ranges_.range_m[beam];
    float& free_m = evidence_.free_m[beam];
    const bool is_thing = range_m < kNothing_m;              // NaN fails
    if (is_thing) free_m = range_m > 0.0F ? range_m : 0.0F;  // its bias may be longer than a tiny range
    if (free_m > most_m) free_m = most_m;
    if (is_thing && !(range_m >= nearest_m)) {
      range_m = nan;
    } else if (free_m >= most_m) {
      range_m = std::numeric_limits<float>::infinity();
    }
    float& low_m = evidence_.low_m[beam];
    float& overhead_m = evidence_.overhead_m[beam];
    if (!(low_m < kNothing_m)) low_m = nan;
    if (!(overhead_m < kNothing_m)) overhead_m = nan;
    if (range_m < kNothing_m) continue;  // a range, for NaN and infinity fail
    ranges_.returns[beam] = 0;
    ranges_.bias_m[beam] = 0.0F;
    ranges_.sigma_m[beam] = nan;
  }
}

void Scanner::show_clear() {
  const auto nan = static_cast<float>(not_a_number());
  const double sectors_per_step = settings_.sectors / settings_.steps_of_turn;
  for (std::uint32_t beam = 0; beam < settings_.beams; ++beam) {
    const auto sector = static_cast<std::uint32_t>((beam + 0.5) * sectors_per_step);
    const ClearRange& clear = clear_[sector < settings_.sectors ? sector : settings_.sectors - 1];
    const bool is_clear = clear.from_m < clear.to_m;
    clear_from_m_[beam] = is_clear ? clear.from_m : nan;
    clear_m_[beam] = is_clear ? clear.to_m : nan;
  }
}

void Scanner::show_nothing() {
  const auto nan = static_cast<float>(not_a_number());
  evidence_.clear();
  for (const Span<float>& values : {ranges_.range_m, ranges_.sigma_m, ranges_.alone_m, ranges_.behind_m,
                                    evidence_.low_m, evidence_.overhead_m, clear_from_m_, clear_m_}) {
    values.fill(nan);
  }
  ranges_.bias_m.fill(0.0F);
  ranges_.returns.fill(0);
}

void Scanner::describe(std::int64_t stamp_ns, pose_wall_planar_scan* scan) const {
  const Eigen::Vector3d place_m = has_floor_ ? sensor_level_m(settings_, floor_) : settings_.mount.sensor_base_m;
  scan->struct_size = sizeof(*scan);
  scan->beams = settings_.beams;
  scan->stamp_ns = stamp_ns;
  scan->sensor = {place_m.x(), place_m.y(), 0.0};
  scan->angle_min_rad = settings_.angle_min_rad;
  scan->angle_step_rad = settings_.angle_step_rad;
  scan->range_min_m = settings_.range_min_m;
  scan->range_max_m = settings_.range_max_m;
  scan->sigma_m = settings_.sigma_m;
  scan->range_m = ranges_.range_m.data();
  scan->free_m = evidence_.free_m.data();
}

void Scanner::describe(std::uint32_t floor_state, std::int64_t stamp_ns, pose_wall_planar_scan_view* view) const {
  const double nan = not_a_number(), endless = std::numeric_limits<double>::infinity();
  const bool none = floor_state == POSE_WALL_PLANAR_FLOOR_NONE;
  const double sensor_m = none ? nan : sensor_level_m(settings_, floor_).z();
  const std::uint64_t age_ns = static_cast<std::uint64_t>(stamp_ns) - static_cast<std::uint64_t>(floor_stamp_ns_);
  view->struct_size = sizeof(*view);
  view->floor_state = floor_state;
  view->floor_age_s = none ? nan : static_cast<double>(age_ns) * kNanosecond_s;
  view->sensor_height_m = sensor_m;
  view->min_height_m = settings_.low_m() - sensor_m;
  view->max_height_m = settings_.high_m() - sensor_m;
  const double room_m = settings_.low_m() - settings_.floor_tolerance_m;
  view->low_reach_m = none ? nan : floor_.tilt_rad > 0.0 ? room_m / floor_.tilt_rad : endless;
  view->free_m = evidence_.free_m.data();
  view->bias_m = ranges_.bias_m.data();
  view->sigma_m = ranges_.sigma_m.data();
  view->low_m = evidence_.low_m.data();
  view->overhead_m = evidence_.overhead_m.data();
  view->alone_m = ranges_.alone_m.data();
  view->behind_m = ranges_.behind_m.data();
  view->clear_from_m = clear_from_m_.data();
  view->clear_m = clear_m_.data();
  view->returns = ranges_.returns.data();
  const PassCounts& counts = evidence_.counts;
  view->points_in = counts.points_in;
  view->dropped = counts.dropped;
  view->of_body = counts.of_body;
  view->of_floor = counts.of[kFloor];
  view->of_low = counts.of[kLow];
  view->of_band = counts.of[kBand];
  view->of_overhead = counts.of[kHigh] + counts.of[kOverhead];
  view->of_roof = counts.of[kRoof];
  view->out_of_scan = counts.out_of_scan;
  view->uncounted = counts.uncounted;
}

}  // namespace pose_wall::planar
