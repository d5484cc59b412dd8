// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/map_localiser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/language/language.hpp"
#include "study/planar/plane_pose.hpp"
#include "study/planar/thread_clock.hpp"

namespace pose_wall::tools {
namespace {

using LocaliseSettings = pose_wall_planar_localise_settings;

constexpr std::uint32_t kMapTilesMost = 16384;  // of pose_wall_planar_localise_settings

// False: the map needs more tiles.
bool has_room(std::int32_t status) {
  if (status == POSE_WALL_E_BLOCK_SMALL) return false;
  require_ok(status, translatable("the map"));
  return true;
}

// A keyframe's points that still are surfaces.
std::vector<float> standing_points(const KnownMap& map, const pose_wall_planar_pose& pose,
                                   const std::vector<float>& xy_m) {
  std::vector<float> kept;
  for (std::size_t k = 0; k + 1 < xy_m.size(); k += 2) {
    const auto at = combined(pose, {static_cast<double>(xy_m[k]), static_cast<double>(xy_m[k + 1]), 0.0});
    if (map.has_moved(at.x_m, at.y_m)) continue;
    kept.insert(kept.end(), {xy_m[k], xy_m[k + 1]});
  }
  return kept;
}

bool add_trail(const KnownMap& map, pose_wall_planar_localise* localise) {
  for (std::uint32_t k = 0; k < map.trail->keyframes(); ++k) {
    const pose_wall_planar_pose pose = map.trail->keyframe(k).pose;
    const std::vector<float> xy_m = standing_points(map, pose, map.trail->points(k));
    if (xy_m.empty()) continue;
    const auto points = static_cast<std::uint32_t>(xy_m.size() / 2);
    if (!has_room(pose_wall_planar_localise_add(localise, &pose, xy_m.data(), points))) return false;
  }
  return true;
}

bool add_cells(const MapFile& cells, pose_wall_planar_localise* localise) {
  const pose_wall_planar_grid grid = cells.grid();
  return has_room(pose_wall_planar_localise_add_grid(localise, &grid));
}

}  // namespace

const SettingRows& localise_setting_rows() {
  static const SettingRows rows = without({"tiles_most"}, {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_localise_settings, __VA_ARGS__)
#include "pose_wall_planar_localise_settings.def"
                                                          });
  return rows;
}

pose_wall_planar_localise_settings default_localise_settings() {
  pose_wall_planar_localise_settings settings{};
  require_ok(pose_wall_planar_localise_settings_init(&settings), translatable("the settings of localisation"));
  return settings;
}

pose_wall_planar_localise_settings take_localise_settings(std::vector<std::string>* words) {
  pose_wall_planar_localise_settings settings = default_localise_settings();
  take_settings(localise_setting_rows(), pose_wall_planar_localise_settings_check, words, &settings);
  return settings;
}

double position_sigma_m(const pose_wall_planar_localise_result& where) {
  return larger_sigma_m(where.covariance[0], where.covariance[1], where.covariance[4]);
}

MapLocaliser::MapLocaliser(const KnownMap& map, const pose_wall_planar_localise_settings& settings) : block_(0) {
  last_.struct_size = sizeof last_;
  LocaliseSettings sized = settings;
  while (!open(map, sized)) {
    if (sized.tiles_most >= kMapTilesMost) {
      throw PlanarError(say("{}: the map is too large: it does not fit into {} tiles of 6.4 m in a square of 4 km",
                            map.file.string(), kMapTilesMost));
    }
    sized.tiles_most = std::min(2 * sized.tiles_most, kMapTilesMost);
  }
}

bool MapLocaliser::open(const KnownMap& map, const pose_wall_planar_localise_settings& settings) {
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_localise_memory_needed(&settings, &bytes), translatable("the settings of localisation"));
  block_ = PartBlock(bytes);
  require_ok(pose_wall_planar_localise_open(&settings, block_.data(), block_.bytes(), &localise_),
             translatable("the settings of localisation"));
  if (!(map.trail ? add_trail(map, localise_) : add_cells(map.cells, localise_))) return false;
  const std::int32_t status = pose_wall_planar_localise_finish(localise_);
  if (status == POSE_WALL_PLANAR_E_ORDER) {
    throw PlanarError(say("{}: the map is empty: nothing was seen in it", map.file.string()));
  }
  require_ok(status, translatable("the map"));
  return true;
}

const pose_wall_planar_localise_result& MapLocaliser::process(const pose_wall_planar_scan& scan,
                                                              const pose_wall_planar_pose* odometry) {
  const double started_ms = thread_ms();
  const std::int32_t status = pose_wall_planar_localise_process(localise_, &scan, odometry, &last_);
  const double ms = thread_ms() - started_ms;
  require_ok(status, translatable("the scan"));
  ++scans_;
  ms_sum_ += ms;
  worst_ms_ = std::max(worst_ms_, ms);
  return last_;
}

void MapLocaliser::place(const pose_wall_planar_pose& base) {
  constexpr double kSigma_m = 0.5, kSigma_rad = 0.2;  // by eye, on a plan
  require_ok(pose_wall_planar_localise_place(localise_, &base, kSigma_m, kSigma_rad), translatable("the start"));
}

void MapLocaliser::forget() {
  require_ok(pose_wall_planar_localise_forget(localise_), translatable("the start"));
}

std::vector<pose_wall_planar_candidate> MapLocaliser::candidates() const {
  std::vector<pose_wall_planar_candidate> candidates;
  pose_wall_planar_candidate candidate{};
  candidate.struct_size = sizeof candidate;
  for (std::uint32_t k = 0; k < last_.candidates; ++k) {
    require_ok(pose_wall_planar_localise_candidate(localise_, k, &candidate), translatable("a candidate"));
    candidates.push_back(candidate);
  }
  return candidates;
}

}  // namespace pose_wall::tools
