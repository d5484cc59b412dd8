// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The extern "C" file of the tracker: checks arguments, translates, calls.

#include "base/math/finite.hpp"
#include "part/shell.hpp"
#include "planar/route/tracker.hpp"
#include "pose_wall_planar_track.h"

namespace pose_wall::planar::route {
namespace {

using HeldTracker = Held<Tracker, 0x6B6361725440504CULL>;

std::int32_t check_route(const pose_wall_planar_path_pose* poses, std::uint32_t count) {
  double along_m = 0.0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const pose_wall_planar_path_pose& at = poses[k];
    const bool is_whole = is_pose(at.pose) && is_finite(at.curvature_1_m) && is_finite(at.along_m) &&
                          at.along_m >= along_m && at.drive >= -1 && at.drive <= 1;
    if (!is_whole) return POSE_WALL_PLANAR_E_POSE;
    along_m = at.along_m;
  }
  return POSE_WALL_OK;
}

constexpr SettingRow kRows[] = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_track_settings, __VA_ARGS__)
#include "pose_wall_planar_track_settings.def"
};

struct TrackTable : SettingsTable<pose_wall_planar_track_settings> {
  using SettingsTable::SettingsTable;
  static SettingRows rows() { return rows_of(kRows); }
  SettingFault broken_rule() const {
    if (speed_min_m_s <= speed_max_m_s) return {};
    return {"speed_min_m_s", "speed_min_m_s must be from 0.01 to speed_max_m_s"};
  }
};

constexpr const char* kStates[] = {"idle", "following", "turning", "stopping", "done", "off_path", "no_pose"};

}  // namespace

extern "C" {

POSE_WALL_SETTINGS_CALLS(pose_wall_planar_track, TrackTable, pose_wall_planar_fault)
POSE_WALL_BLOCK_CALLS(pose_wall_planar_track, HeldTracker, TrackTable, pose_wall_planar_tracker)

POSE_WALL_EXPORT int32_t pose_wall_planar_track_route(pose_wall_planar_tracker* tracker,
                                                      const pose_wall_planar_path_pose* poses, uint32_t count,
                                                      pose_wall_planar_clearance clearance, void* context) {
  if (poses == nullptr) return POSE_WALL_E_NULL;
  return with_part<HeldTracker>(tracker, [&](Tracker& own) -> std::int32_t {
    if (count < 1 || count > own.path_max()) return POSE_WALL_E_VALUE_RANGE;
    const std::int32_t status = check_route(poses, count);
    if (status == POSE_WALL_OK) own.take_route(poses, count, clearance, context);
    return status;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_track_step(pose_wall_planar_tracker* tracker,
                                                     const pose_wall_planar_track_input* input,
                                                     pose_wall_planar_track_command* command) {
  if (input == nullptr || command == nullptr) return POSE_WALL_E_NULL;
  return with_part<HeldTracker>(tracker, [&](Tracker& own) {
    std::int32_t size = check_struct(*input);
    if (size == POSE_WALL_OK) size = check_struct(*command);
    if (size == POSE_WALL_OK) own.step(*input, command);
    return size;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_track_obeyed(pose_wall_planar_tracker* tracker, double speed_m_s,
                                                       double turn_rad_s) {
  return with_part<HeldTracker>(tracker, [&](Tracker& own) -> std::int32_t {
    constexpr double kMost = 1000.0;  // no machine: more is a wrong unit
    if (!is_within(speed_m_s, -kMost, kMost) || !is_within(turn_rad_s, -kMost, kMost)) return POSE_WALL_E_VALUE_RANGE;
    own.obeyed({speed_m_s, turn_rad_s});
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT const char* pose_wall_planar_track_state_name(uint32_t state) {
  return state < sizeof(kStates) / sizeof(kStates[0]) ? kStates[state] : "unknown";
}

}  // extern "C"

}  // namespace pose_wall::planar::route
