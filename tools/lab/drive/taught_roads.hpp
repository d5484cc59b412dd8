// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The teaching drive: a driver takes the machine through the network, SLAM makes the map on the way.

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/planar_files/map_files.hpp"
#include "lab/drive/machine.hpp"
#include "lab/sim/drive_route.hpp"
#include "lab/sim/network.hpp"

namespace pose_wall::tools {

struct TaughtRoads {
  // A keyframe's base, truly and in the map.
  struct Mark {
    pose_wall_planar_pose truth{}, map{};
  };

  MapFile map;
  std::string trail;  // as saved
  std::vector<Mark> marks;
  double driven_m = 0.0;
  std::uint32_t scans = 0, closures = 0;
  double worst_m = 0.0;  // of the marks, when the map's beginning is laid on the truth

  // Where the map has a true pose, and the other way round: by the nearest mark that looked from there.
  pose_wall_planar_pose in_map(const pose_wall_planar_pose& truth) const;
  pose_wall_planar_pose in_truth(const pose_wall_planar_pose& pose) const;
};

inline constexpr double kTaughtShare = 1.3;  // of the network's length: some of it is driven twice

// Begins at a junction, and drives at least this share of the network's length. `notice` gets the share that is done;
// false ends it, and no keyframe may then be there.
TaughtRoads teach_roads(const sim::Network& network, const sim::SensorModel& model, std::uint64_t seed,
                        const std::function<bool(double)>& notice, double share = kTaughtShare);

}  // namespace pose_wall::tools
