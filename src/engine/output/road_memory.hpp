// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What earlier looks tell of a quantity. An odometry carries it to the machine's place, and each new look is weighed in
// so that the level is the narrowest of all mixtures (README, Memory of the road).

#pragma once

#include <cstdint>

#include "engine/config.hpp"
#include "engine/output/measurements.hpp"
#include "engine/output/temporal_motion.hpp"
#include "engine/types.hpp"

namespace pose_wall {

// The mean of the looks so far, of one quantity, at the last frame's place. Its error has a random part and bounds, as
// a look's level has.
struct RoadMemory {
  bool exists = false;
  std::uint32_t contradicted = 0;  // by so many looks in a row
  std::uint32_t frames = 0;        // behind the usual variance
  double value = 0.0;
  double variance = 0.0;    // of the random part: protection_sigmas deviations of it are the level's
  double way_sigma = 0.0;   // what the surface's direction adds to it, over the way since the looks were taken
  double with_rock = 0.0;   // covariance with what the rock in view does to a look, as one of that's deviations
  ProtectionParts bound;    // the other parts; what the odometry does not know counts as age
  double last_share = 1.0;  // of the last look in the value
  double stretch = 1.0;     // of deviations: looks differ by more than chance
  double noise = 0.0;       // variance of what differs from look to look at the same rock
  // By which a look enters: a look at other rock weighs 1.
  double weight = 1.0, weight_here = 1.0;  // of all looks, and of those at the rock in view
  double looks_here = 1.0;                 // number of these
  // Of looks that are alike, and their number at other rock:
  double usual_variance = 0.0, usual_dof = 1.0, looks = 0.0;
};

// What a value and its level are after this frame.
struct Recalled {
  double value;
  ProtectionParts protection;
};

// To the place of this frame, once a frame. A change that no odometry tells ends the memory.
void carry_on(const Change& change, std::uint32_t quantity, const Settings& settings, RoadMemory* memory);

// Weighs a look in. The level is never wider than the look's own, and is that where nothing is remembered. change: the
// one that the memory was carried on by; last_raw: the quantity's last look, carried on as well.
Recalled look_again(const Measurement& look, double last_raw, const Change& change, std::uint32_t quantity,
                    const Settings& settings, RoadMemory* memory);

// To the digits that a memento holds, so that a frame that is computed again has the same bits.
void round_off(RoadMemory* memory);

}  // namespace pose_wall
