// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stage 6b: smoothing, holding and the states. The only memory across frames besides last planes.

#pragma once

#include "config.hpp"
#include "output/measurements.hpp"
#include "output/temporal_motion.hpp"
#include "pose_wall.h"
#include "types.hpp"

namespace pose_wall {

// The last time a quantity was valid.
struct LastGood {
  bool exists = false;
  double raw = 0.0;
  double raw_protection = 0.0;
  double value = 0.0;          // smoothed
  ProtectionParts protection;  // of value
  Unknown grown;               // what the machine may have moved since, and nobody knows
  double age_s = 0.0;
};

// What is remembered of one quantity.
struct Track {
  bool has_value = false;
  double value = 0.0;                 // smoothed
  double rate = 0.0;                  // of value, per second
  std::uint32_t smoothed_frames = 0;  // since the filter started afresh, as far as that matters
  double raw = 0.0;                   // of the last frame it was measured in
  double raw_protection = 0.0;
  double sigma = 0.0;
  ProtectionParts protection;  // of value in that frame
  Unknown grown;               // what the machine may have moved since that frame, and nobody knows
  double age_s = 0.0;          // since that frame
  bool expired = false;        // held for too long, or the clock jumped: the filter starts afresh
  LastGood good;
  // After a jump the last good value stays in the protection level until the new one has come again and again; what was
  // refused before there was a good one must come again, too.
  std::uint32_t to_confirm = 0;
  // For so many frames more a rival wall that was seen stays in the level.
  std::uint32_t doubted_frames = 0;
};

struct TemporalState {
  Track track[POSE_WALL_QUANTITIES];
  bool has_stamp = false;
  std::uint32_t still_frames = 0;  // how often the last stamp has come again
  std::int64_t stamp_ns = 0;
  // Between two stamps that went on, leaps left out.
  double last_dt_s = 0.0;
  double dt_before_s = 0.0;  // the one before the last
};

// Places the frame in time. Does not change the state.
FrameTiming time_frame(const TemporalState& state, std::int64_t stamp_ns, const Settings& settings);

// Since the last frame: what its timing says, or as long as the last periods where its stamp stands still.
double elapsed_of(const TemporalState& state, const FrameTiming& timing);

// Whether a quantity was measured further from where this change allows it than both levels bridge.
bool contradict(const Change& change, const Measurements& measured, const FrameTiming& timing,
                const TemporalState& state);

// Takes the frame's measurements into the state and fills values, one per quantity.
void smooth_and_hold(const Measurements& measured, const FrameTiming& timing, std::int64_t stamp_ns,
                     const Change& change, const Settings& settings, TemporalState* state,
                     pose_wall_value (*values)[POSE_WALL_QUANTITIES]);

// What a frame that measures nothing would give, elapsed_s after the last one. Of it only this is kept: what has
// expired stays so.
void age_values(double elapsed_s, std::uint32_t reasons, const Settings& settings, TemporalState* state,
                pose_wall_value (*values)[POSE_WALL_QUANTITIES]);

// The stamps' clock was another one when the state was kept: elapsed_s before stamp_ns of the new one, or nobody knows
// how long ago, where it is negative. What cannot be dated is not held.
void rebase(double elapsed_s, std::int64_t stamp_ns, const Settings& settings, TemporalState* state);

}  // namespace pose_wall
