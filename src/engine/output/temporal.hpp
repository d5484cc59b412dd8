// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stage 6b: smoothing, holding and the states. Together with the last planes the only memory across frames.

#pragma once

#include "engine/config.hpp"
#include "engine/output/measurements.hpp"
#include "engine/output/road_memory.hpp"
#include "engine/output/temporal_motion.hpp"
#include "engine/types.hpp"
#include "pose_wall.h"

namespace pose_wall {

// The last time a quantity was valid.
struct LastGood {
  bool exists = false;
  double raw = 0.0;
  double raw_protection = 0.0;
  double value = 0.0;          // smoothed
  ProtectionParts protection;  // of value
  Unknown grown;               // the unknown motion of the machine since
  double age_s = 0.0;
};

// The memory of one quantity.
struct Track {
  bool has_value = false;
  double value = 0.0;                 // smoothed
  double rate = 0.0;                  // of value, per second
  std::uint32_t smoothed_frames = 0;  // since the filter started afresh, up to a cap
  double raw = 0.0;                   // of the last frame that measured it
  double raw_protection = 0.0;
  double sigma = 0.0;
  ProtectionParts protection;  // of value in that frame
  Unknown grown;               // the unknown motion of the machine since that frame
  double age_s = 0.0;          // since that frame
  bool expired = false;        // held for too long, or the clock jumped: the filter starts afresh
  LastGood good;
  // After a jump the last good value stays in the protection level until the new one has come several times more. A
  // value refused before there was a good one must come again, too.
  std::uint32_t to_confirm = 0;
  // Number of frames for which a rival wall that was seen stays in the level.
  std::uint32_t doubted_frames = 0;
  RoadMemory road;
};

struct TemporalState {
  Track track[POSE_WALL_QUANTITIES];
  bool has_stamp = false;
  std::uint32_t still_frames = 0;  // how often the last stamp has come again
  std::int64_t stamp_ns = 0;
  // Between two stamps that went forward, without leaps.
  double last_dt_s = 0.0;
  double dt_before_s = 0.0;  // the one before the last
};

// Places the frame in time. Does not change the state.
FrameTiming time_frame(const TemporalState& state, std::int64_t stamp_ns, const Settings& settings);

// Time since the last frame: by the stamps, or by the last periods if the stamp stands still.
double elapsed_of(const TemporalState& state, const FrameTiming& timing);

// By the stamps, or the sensor's own step where these jumped.
ScanStep scan_step_of(const TemporalState& state, const FrameTiming& timing, const Settings& settings);

// True if a quantity was measured further from its allowed change than both levels bridge.
bool contradict(const Change& change, const Measurements& measured, const FrameTiming& timing,
                const TemporalState& state);

// Takes the frame's measurements into the state and fills values, one for each quantity.
void smooth_and_hold(const Measurements& measured, const FrameTiming& timing, std::int64_t stamp_ns,
                     const Change& change, const Settings& settings, TemporalState* state,
                     pose_wall_value (*values)[POSE_WALL_QUANTITIES]);

// The result of a frame without measurements, elapsed_s after the last one. The state keeps one thing of it: expired
// values stay expired.
void age_values(double elapsed_s, std::uint32_t reasons, const Settings& settings, TemporalState* state,
                pose_wall_value (*values)[POSE_WALL_QUANTITIES]);

// For a state kept under another clock: it is of elapsed_s before stamp_ns of the new one, or of an unknown time if
// that is negative. Values of an unknown time are not held.
void rebase(double elapsed_s, std::int64_t stamp_ns, const Settings& settings, TemporalState* state);

}  // namespace pose_wall
