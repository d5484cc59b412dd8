// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The localisation of pose_wall_planar in a saved map.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pose_wall_planar_localise.h"
#include "study/planar/known_map.hpp"
#include "study/planar/part_block.hpp"
#include "study/planar/setting_words.hpp"

namespace pose_wall::tools {

// Without tiles_most, which follows from the map.
const SettingRows& localise_setting_rows();

// The library's; map_is_whole 0.
pose_wall_planar_localise_settings default_localise_settings();

// The defaults, with the settings that `words` holds; these are taken out of it. Throws std::invalid_argument.
pose_wall_planar_localise_settings take_localise_settings(std::vector<std::string>* words);

// The larger standard deviation of the position; infinity without a pose.
double position_sigma_m(const pose_wall_planar_localise_result& where);

class MapLocaliser {
 public:
  // Takes as much memory as the map needs. Throws PlanarError for a map that is too large or empty.
  MapLocaliser(const KnownMap& map, const pose_wall_planar_localise_settings& settings);

  // odometry may be nullptr. Throws PlanarError for a scan that the library refuses.
  const pose_wall_planar_localise_result& process(const pose_wall_planar_scan& scan,
                                                  const pose_wall_planar_pose* odometry);
  // Base stands about there.
  void place(const pose_wall_planar_pose& base);
  void forget();

  const pose_wall_planar_localise_result& last() const { return last_; }
  // Of the last search, while no place is tracked; as poses of base now.
  std::vector<pose_wall_planar_candidate> candidates() const;

  std::uint64_t block_bytes() const { return block_.bytes(); }
  // Processor time of a scan.
  double mean_ms() const { return scans_ == 0 ? 0.0 : ms_sum_ / static_cast<double>(scans_); }
  double worst_ms() const { return worst_ms_; }

 private:
  // False: the map needs more tiles.
  bool open(const KnownMap& map, const pose_wall_planar_localise_settings& settings);

  PartBlock block_;
  pose_wall_planar_localise* localise_ = nullptr;
  pose_wall_planar_localise_result last_{};
  std::size_t scans_ = 0;
  double ms_sum_ = 0.0, worst_ms_ = 0.0;
};

}  // namespace pose_wall::tools
