// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stage 6b: smoothing, holding and the states. The only memory across frames besides last planes.

#pragma once

#include "config.hpp"
#include "pose_wall.h"
#include "types.hpp"

namespace pose_wall {

// The last time a quantity was valid.
struct LastGood {
  bool exists = false;
  double raw = 0.0;
  double raw_protection = 0.0;
  double value = 0.0;  // smoothed
  double value_protection = 0.0;
  double age_s = 0.0;
};

// What is remembered of one quantity.
struct Track {
  bool has_value = false;
  double value = 0.0;  // smoothed
  double raw = 0.0;    // of the last frame it was measured in
  double raw_protection = 0.0;
  double sigma = 0.0;
  double protection = 0.0;  // of value in that frame
  double age_s = 0.0;       // since that frame
  bool expired = false;     // held for too long, or the clock jumped: the filter starts afresh
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

// Greatest change per second of one of the seven quantities, by the config.
double fastest(std::uint32_t quantity, const Settings& settings);

// Places the frame in time. Does not change the state.
FrameTiming time_frame(const TemporalState& state, std::int64_t stamp_ns, const Settings& settings);

// Takes the frame's measurements into the state and fills values, one per quantity.
void smooth_and_hold(const Measurements& measured, const FrameTiming& timing, std::int64_t stamp_ns,
                     const Settings& settings, TemporalState* state, pose_wall_value (*values)[POSE_WALL_QUANTITIES]);

// What a frame that measures nothing would give, elapsed_s after the last one. Of it only this is kept: what has
// expired stays so.
void age_values(double elapsed_s, std::uint32_t reasons, const Settings& settings, TemporalState* state,
                pose_wall_value (*values)[POSE_WALL_QUANTITIES]);

}  // namespace pose_wall
