// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Which of the planes found around the machine are the two side walls.

#pragma once

#include "types.hpp"
#include "walls/propose/evidence.hpp"
#include "walls/propose/search.hpp"
#include "walls/scene.hpp"

namespace pose_wall {

struct WallCandidate {
  Plane plane;
  WallEvidence evidence;
  std::uint32_t faults = 0;  // pose_wall_reason bits of the gates it fails
};

struct WallCandidates {
  WallCandidate item[kWallShortlist];
  std::uint32_t count = 0;
};

// The one of the best score, faults or not; nullptr if there is none.
const WallCandidate* strongest(const WallCandidates& list);

struct WallChoice {
  const WallCandidate* side[2] = {nullptr, nullptr};   // left, right
  const WallCandidate* rival[2] = {nullptr, nullptr};  // another wall on that side that is nearly as good
  std::uint32_t reasons[2] = {0, 0};                   // why a side has none, or is to be doubted
  bool refused[2] = {false, false};
  double score_m2 = 0.0;  // of the chosen, together

  bool any() const { return side[0] != nullptr || side[1] != nullptr; }
};

// Seen from above: walls lean as they like.
double angle_in_plan(const Plane& a, const Plane& b);

WallChoice choose_walls(const WallCandidates& left, const WallCandidates& right, const Settings& settings);

// ahead and behind: the planes across the road. A pair of them that makes a better roadway than the sides do means
// that the machine stands across, and that what looks like side walls are faces. Where no side was chosen, any such
// pair tells why.
void refuse_if_across(const WallCandidates& ahead, const WallCandidates& behind, const Settings& settings,
                      WallChoice* choice);

}  // namespace pose_wall
