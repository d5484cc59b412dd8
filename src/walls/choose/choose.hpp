// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Which candidates are the walls: a pair, or one alone; and which other ones may be the wall as well.

#pragma once

#include "walls/propose/candidates.hpp"
#include "walls/scene.hpp"

namespace pose_wall {

struct WallChoice {
  const WallCandidate* side[2] = {nullptr, nullptr};   // left, right
  const WallCandidate* rival[2] = {nullptr, nullptr};  // another wall on that side that is nearly as good
  Verdict verdict[2];                                  // why a side has none, or is to be doubted
  double score_m2 = 0.0;                               // of the chosen, together

  bool any() const { return side[0] != nullptr || side[1] != nullptr; }
};

WallChoice choose_walls(const WallCandidates& left, const WallCandidates& right, const Settings& settings);

// ahead and behind: the planes across the road. A pair of them that makes a better roadway than the sides do means
// that the machine stands across, and that what looks like side walls are faces. Where no side was chosen, any such
// pair tells why.
void refuse_if_across(const WallCandidates& ahead, const WallCandidates& behind, const Settings& settings,
                      WallChoice* choice);

// In a cavern or a hall full of things, two flat spots may happen to be parallel, but they explain next to nothing of
// what is seen. Where that is so both sides are refused, and yet measured.
void refuse_unexplained(const WallScene& scene, WallChoice* choice);

}  // namespace pose_wall
