// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the planar part of the daemon tells the sinks: the obstacle stop's answer, and where the machine is on its map.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pose_wall_planar_grid.h"
#include "pose_wall_planar_stop.h"
#include "pose_wall_planar_types.h"

namespace pose_wall::tools::live {

// An answer of the obstacle stop, to a frame or to a moment without one.
struct StopNews {
  pose_wall_planar_stop_result result{};
  std::uint64_t rounds = 0;          // answers since the start: the heartbeat
  std::int64_t answered_ns = 0;      // by the clock that nobody sets
  std::int64_t header_stamp_ns = 0;  // of the newest frame
  std::int64_t cause_since_ns = 0;   // since when its cause is the same (stop_line.hpp), by the clock of answered_ns

  // 0 before the first answer.
  double cause_for_s() const {
    return answered_ns > cause_since_ns ? static_cast<double>(answered_ns - cause_since_ns) * 1e-9 : 0.0;
  }
  std::int64_t allowed_mm_s() const { return static_cast<std::int64_t>(result.allowed_speed_m_s * 1e3); }
};

// The same for controllers. Bytes of 0 where it cannot be filled: no image, which permits nothing.
pose_wall_planar_stop_image image_of(const StopNews& news);

// The answer of this very moment, from any thread.
class StopBoard {
 public:
  StopBoard() = default;
  StopBoard(const StopBoard&) = delete;
  StopBoard& operator=(const StopBoard&) = delete;
  virtual ~StopBoard() = default;

  // Whatever was answered before: where nobody has answered for a while, the state is stop and the heartbeat stands.
  virtual StopNews stop_now() const = 0;
  // How long each state has been told so far, by pose_wall_planar_stop_state. Without an answer it was stop.
  virtual std::vector<std::int64_t> state_ns() const { return {}; }
  pose_wall_planar_stop_image image_now() const { return image_of(stop_now()); }
};

// Cells as nav_msgs/OccupancyGrid has them.
struct RoadwayMap {
  std::uint64_t version = 0;  // another one for another map, from 1
  std::int64_t header_stamp_ns = 0;
  std::uint32_t width = 0, height = 0;
  double resolution_m = 0.0, origin_x_m = 0.0, origin_y_m = 0.0;
  std::vector<std::int8_t> cells;

  pose_wall_planar_grid grid() const {
    return {sizeof(pose_wall_planar_grid), width, height, 0, resolution_m, origin_x_m, origin_y_m, cells.data()};
  }
};

// One frame as a planar scan, and the place that it was taken from.
struct RoadwayNews {
  std::int64_t header_stamp_ns = 0;
  bool has_scan = false;
  pose_wall_planar_scan scan{};  // without its ranges
  std::vector<float> range_m;
  std::string state;                              // of SLAM or localisation: "tracked", "ambiguous"
  std::optional<pose_wall_planar_pose> pose;      // of base in map; nothing where the state vouches for none
  double covariance[9] = {};                      // of x, y, yaw; all zero: not known
  std::optional<pose_wall_planar_pose> odometry;  // of base, by motion
  std::vector<pose_wall_planar_pose> candidates;  // places that are left, where there is no one place
  std::shared_ptr<const std::vector<pose_wall_planar_pose>> track;  // the way so far, thinned; with the map
  std::shared_ptr<const RoadwayMap> map;                            // the newest; none yet
};

}  // namespace pose_wall::tools::live
