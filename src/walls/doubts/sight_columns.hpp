// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What comes back from a plane, column of directions by column.

#pragma once

#include "cloud/direction_grid.hpp"
#include "walls/doubts/sight.hpp"
#include "walls/doubts/sight_lines.hpp"
#include "walls/scene.hpp"

namespace pose_wall {

// Numbers of cells, and of columns by their highest cell. Silent tops are those that chance does not explain.
struct SightTally {
  double cells = 0.0, silent = 0.0, silent_by_chance = 0.0, through = 0.0;
  double columns = 0.0, silent_tops = 0.0, tops_through = 0.0;

  // sign -1: takes it off.
  void add(const SightTally& other, double sign = 1.0);
};

struct SightColumn {
  SightTally tally;
  double along_m = 0.0;  // along the road from the sensor
  bool is_gap() const;
};

class SightColumns {
 public:
  // directions: noted by learn_directions(), and what has passed through the plane; what was kept is told when asked
  // for.
  SightColumns(const WallScene& scene, SightScratch* directions, const SightLines& lines)
      : scene_(scene), directions_(*directions), lines_(lines) {}

  // How much of the expected comes back where the plane is seen best, 0..1; negative where too little of it is looked
  // at. A wet wall answers less than a dry one, but all over.
  double brightness() const;

  // No cells: it does not look at the plane.
  SightColumn at(std::uint32_t column, double brightness, bool with_chance) const;

  // Shares of what is silent where the plane is not: a sensor may be blind here and there, look further up ahead than
  // aside, or spin about another axis than the expectation supposes. 1 where too little else is looked at to know.
  struct Blindness {
    double cells = 1.0;
    double tops = 1.0;  // of columns: the highest cell
  };
  Blindness elsewhere() const;

 private:
  // Numbers of cells by zone (beside, above, below), and of columns.
  struct SilenceElsewhere {
    double cells[SightLines::kAlong] = {}, silent[SightLines::kAlong] = {};
    double columns = 0.0, silent_tops = 0.0;
  };
  void count_elsewhere(std::uint32_t column, SilenceElsewhere* out) const;

  bool may_show(std::uint32_t column) const;
  bool can_tell(std::uint32_t row, std::uint32_t column) const;
  bool is_silent(std::uint32_t row, std::uint32_t column, double brightness) const;
  bool is_through(std::uint32_t row, std::uint32_t column) const;
  bool in_band(const SightLines::Crossing& crossing) const;

  const WallScene& scene_;
  SightScratch& directions_;
  const SightLines& lines_;
};

}  // namespace pose_wall
