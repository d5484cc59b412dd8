// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A route from pose to pose, or the reason why there is none: read the grid, search, pull taut, round.

#pragma once

#include <cstdint>

#include "planar/route/bit_grid.hpp"
#include "planar/route/cost_to_go.hpp"
#include "planar/route/footprint.hpp"
#include "planar/route/lattice.hpp"
#include "planar/route/leg.hpp"
#include "planar/route/poses.hpp"
#include "planar/route/search.hpp"
#include "pose_wall_planar_plan.h"

namespace pose_wall::planar::route {

class Planner {
 public:
  void lay_out(Arena& arena, const pose_wall_planar_plan_settings& settings);
  void open(const pose_wall_planar_plan_settings& settings);

  // False for a grid of another resolution or one that is too large.
  bool read(const pose_wall_planar_grid& grid);
  void plan(const Pose2& start, const Pose2& goal, Span<pose_wall_planar_path_pose> poses,
            pose_wall_planar_plan_result* result);
  double clearance_m(const Eigen::Vector2d& at_m) const;
  std::uint64_t field_looks() const { return field_.looks(); }  // since it was opened

 private:
  static constexpr std::uint32_t kLevels = 2;          // lattices: a coarse one first, and one where that finds no way
  static constexpr std::uint32_t kCornersMost = 4096;  // of a way before it is drawn taut; more is told as list_full

  bool go_straight();
  std::uint32_t search(pose_wall_planar_plan_result* result);
  bool can_leave_goal(const Search::Task& task, pose_wall_planar_plan_result* result);
  bool spread(const Lattice& lattice, const Shape& circle, std::uint32_t longest);
  LatticeGrid seen_by(const Lattice& lattice) const { return {&grid_, &coarse_, lattice.step_cells()}; }
  void explain(pose_wall_planar_plan_result* result);
  bool is_wide_enough(double radius_cells);
  void find_bottleneck(double fits_cells, pose_wall_planar_plan_result* result);
  void finish(Span<pose_wall_planar_path_pose> poses, pose_wall_planar_plan_result* result);

  pose_wall_planar_plan_settings settings_{};
  Costs costs_;
  BitGrid grid_, coarse_;  // the coarse one: of the lattice that is searched
  Sweeps sweeps_;
  Lattice lattice_[kLevels];
  Shape narrow_;  // a circle smaller than the machine
  CostToGo field_;
  Search search_;
  Span<Corner> corners_;
  std::uint32_t count_ = 0;
  double lower_m_ = 0.0;
  Pose2 start_, goal_;
  bool has_grid_ = false, is_goal_tight_ = false;
};

}  // namespace pose_wall::planar::route
