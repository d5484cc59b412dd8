// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Chooses the walls among the candidates, a pair or one alone, and their rivals.

#pragma once

#include "engine/walls/propose/candidates.hpp"
#include "engine/walls/scene.hpp"

namespace pose_wall {

struct WallChoice {
  const WallCandidate* side[2] = {nullptr, nullptr};  // left, right
  std::uint32_t rivals[2] = {0, 0};                   // other planes that may be the wall: bit i is item i of the side
  Verdict verdict[2];                                 // why a side has no wall, or a doubtful one
  double score_m2 = 0.0;                              // of the chosen walls together

  bool any() const { return side[0] != nullptr || side[1] != nullptr; }
  bool is_rival(int of_side, std::uint32_t item) const { return (rivals[of_side] >> item & 1U) != 0; }
  // beside: the planes of that side. nullptr if no plane is a rival.
  const WallCandidate* strongest_rival(int of_side, const WallCandidates& beside) const {
    static_assert(kWallShortlist <= 32, "rivals has a bit for each plane");
    return beside.strongest_of([&](std::uint32_t i) { return is_rival(of_side, i); });
  }
};

WallChoice choose_walls(const WallCandidates& left, const WallCandidates& right, const Settings& settings);

// ahead and behind: the planes across the road. If they make a better roadway than the sides, the machine stands
// across, and the planes that look like side walls are faces. Without a chosen side any such pair is the explanation.
void refuse_if_across(const WallCandidates& ahead, const WallCandidates& behind, const Settings& settings,
                      WallChoice* choice);

}  // namespace pose_wall
