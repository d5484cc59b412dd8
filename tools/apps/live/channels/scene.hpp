// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Results as viewers draw them: poses, transforms and a scene of planes, distances, machine and stop. Messages are JSON
// of the well-known schemas. Lengths in m; stamps are those of the clouds' headers.

#pragma once

#include <Eigen/Core>
#include <string>

#include "apps/live/planar/planar_news.hpp"
#include "apps/live/sink.hpp"
#include "io/config_file/load_config.hpp"
#include "study/planar/stop_line.hpp"

namespace pose_wall::tools::live {

class SceneWriter {
 public:
  explicit SceneWriter(const LoadedConfig& loaded);

  // Of base in the road: on its floor, midway between the walls, abreast of base; x ahead along it, y left, z up.
  // Empty: this frame did not measure both walls, floor and angles.
  std::string pose(const LiveResult& result) const;
  // From base to the sensor, and where this frame measured them to base_frame + "_level" and base_frame + "_road".
  std::string transforms(const LiveResult& result) const;
  // Entity road, in base: floor, walls and distances. What this frame did not measure is not in it.
  std::string scene(const LiveResult& result) const;

  // Entity machine: its rectangle in the stop's colour, the way of the next two seconds by the measured motion, what
  // limits the speed most, and why.
  std::string scene(const StopNews& news) const;
  // From map to base. Empty: the place is not known.
  std::string transforms(const RoadwayNews& news) const;

 private:
  std::string base_frame_, lidar_frame_, map_frame_;
  PlanarSettings planar_;
  double wall_bottom_m_, wall_top_m_;
  Eigen::Vector3d ahead_base_;
  StopLine line_;
};

}  // namespace pose_wall::tools::live
