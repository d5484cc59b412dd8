// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What many verdicts come to, and tables of it. The first frame of a road is named apart: nothing came before it.

#pragma once

#include <string>
#include <vector>

#include "judge/court.hpp"

namespace pose_wall::judge {

// Of one quantity.
struct Tally {
  void add(const Finding& finding);
  double share_valid() const { return frames == 0 ? 0.0 : static_cast<double>(valid) / frames; }
  double share_valid_first() const { return first == 0 ? 0.0 : static_cast<double>(first_valid) / first; }
  double share_valid_later() const {
    return frames == first ? 0.0 : static_cast<double>(valid - first_valid) / (frames - first);
  }

  int frames = 0, valid = 0, degraded = 0, held = 0;
  int first = 0, first_valid = 0;                    // of frame 0
  int misleading_road = 0, misleading_surveyed = 0;  // by one truth alone
  int beyond_valid = 0, beyond_degraded = 0, beyond_held = 0, raw_beyond = 0, misleading = 0;
  double closest = 0.0;                                 // largest share of its level that an error took
  double z2_sum = 0.0;                                  // of their squared errors over squared sigma
  std::vector<double> errors, levels, levels_in_sigma;  // of measured values: raw ones
  std::vector<double> valid_road_errors, valid_surveyed_errors;
  std::vector<double> told_levels;                     // of what is told and not invalid, from frame 1 on
  std::vector<int> reasons = std::vector<int>(32, 0);  // of values that are not valid
};
using Tallies = std::vector<Tally>;  // one a quantity

void add(Tallies* tallies, const Verdict& verdict);
// A row a quantity: frames, valid share, errors, levels, what is beyond.
std::string table(const Tallies& tallies);
// Valid values against each of the two truths.
std::string truths_table(const Tallies& tallies);
// Why values are not valid, most frequent first.
std::string reasons_table(const Tallies& tallies);

// Of frames.
struct WorkTally {
  void add(const Verdict& verdict);
  double share_limited() const {
    return steps.empty() ? 0.0 : static_cast<double>(limited) / static_cast<double>(steps.size());
  }
  std::string text() const;

  std::vector<double> steps;
  int limited = 0, roads_limited = 0;
};

}  // namespace pose_wall::judge
