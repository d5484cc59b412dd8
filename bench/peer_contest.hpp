// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall and PCL on the same frames in the same run, turn by turn, so that all meet the same machine.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "pose_wall.h"

namespace pose_wall::bench {

struct Turn {
  double total_ms;
  std::array<double, POSE_WALL_STAGES> stage_ms;
  std::array<double, POSE_WALL_QUANTITIES> error;  // NaN where nothing was measured
};

struct Contestant {
  std::string name;
  std::vector<Turn> turns;  // one a frame, road by road

  double median_total_ms() const;
  double median_stage_ms(std::size_t stage) const;
  double values_per_frame() const;
  // Of the errors of quantities first to last, where they were measured.
  double rmse(std::size_t first, std::size_t last) const;
  double median_error(std::size_t first, std::size_t last) const;
};

struct ContestPlan {
  std::uint32_t roads = 10;
  std::uint32_t frames = 3;          // of each road, by one engine
  float pcl_ground_radius_m = 0.0F;  // 0: the best for each sensor and method
};

struct Contest {
  std::string sensor;
  ContestPlan plan;
  std::vector<double> points, voxels, least_ms;  // one a frame
  std::vector<Contestant> contestants;           // pose_wall first
};

// All times are processor time. Throws std::runtime_error when the engine refuses.
Contest hold_contest(const std::string& sensor, const ContestPlan& plan);

}  // namespace pose_wall::bench
