// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Finds the place of each planar scan: by a SLAM that makes its map on the way (mapping.cpp), or in a saved map
// (localisation.cpp).

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/live/planar/planar_news.hpp"
#include "io/config_file/planar_settings.hpp"

namespace pose_wall::tools::live {

class PlaceFinder {
 public:
  PlaceFinder() = default;
  PlaceFinder(const PlaceFinder&) = delete;
  PlaceFinder& operator=(const PlaceFinder&) = delete;
  virtual ~PlaceFinder() = default;

  // Where base was at this scan: fills in state, pose, covariance and candidates. odometry may be nullptr. Throws
  // PlanarError.
  virtual void find(const pose_wall_planar_scan& scan, const pose_wall_planar_pose* odometry, RoadwayNews* news) = 0;
  // The map where it has changed since the last call, else nothing.
  virtual std::shared_ptr<const RoadwayMap> changed_map(std::int64_t header_stamp_ns) = 0;
  // The way so far, of kTrackMost places at most.
  virtual std::vector<pose_wall_planar_pose> track() const = 0;
  // Writes the map to its file, where there is one to write; `map` is what is shown of it, or nullptr. Throws
  // std::runtime_error.
  virtual void save(const RoadwayMap* /*map*/) {}
  // Names and values for health.
  virtual std::vector<std::pair<std::string, std::string>> facts() const = 0;

  static constexpr std::size_t kTrackMost = 500;
};

// For planar: map. Throws PlanarError.
std::unique_ptr<PlaceFinder> make_mapping(const PlanarSettings& settings);
// For planar: localise. Throws std::runtime_error that names the key, the file and what is wrong with it.
std::unique_ptr<PlaceFinder> make_localisation(const PlanarSettings& settings);

}  // namespace pose_wall::tools::live
