// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The extern "C" file of the tracker: checks arguments, translates, calls.

#include "base/math/finite.hpp"
#include "part/export.hpp"
#include "part/shell.hpp"
#include "part/struct_sizes.hpp"
#include "planar/route/tracker.hpp"
#include "pose_wall_planar_track.h"

namespace {

using pose_wall::is_finite;
using pose_wall::planar::is_pose;
using pose_wall::planar::route::Tracker;
using HeldTracker = pose_wall::Held<Tracker, 0x6B6361725440504CULL>;

HeldTracker* held_of(pose_wall_planar_tracker* tracker) {
  return reinterpret_cast<HeldTracker*>(tracker);
}

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

constexpr pose_wall::SettingRow kRows[] = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_track_settings, __VA_ARGS__)
#include "pose_wall_planar_track_settings.def"
};

struct TrackTable : pose_wall::SettingsTable<pose_wall_planar_track_settings> {
  using SettingsTable::SettingsTable;
  static pose_wall::SettingRows rows() { return pose_wall::rows_of(kRows); }
  pose_wall::SettingFault broken_rule() const {
    if (speed_min_m_s <= speed_max_m_s) return {};
    return {"speed_min_m_s", "speed_min_m_s must be from 0.01 to speed_max_m_s"};
  }
};

constexpr const char* kStates[] = {"idle", "following", "turning", "stopping", "done", "off_path", "no_pose"};

}  // namespace

extern "C" {

POSE_WALL_EXPORT int32_t pose_wall_planar_track_settings_init(pose_wall_planar_track_settings* settings) {
  return pose_wall::init_settings<TrackTable>(settings);
}

POSE_WALL_EXPORT int32_t pose_wall_planar_track_settings_check(const pose_wall_planar_track_settings* settings,
                                                               pose_wall_planar_fault* fault) {
  return pose_wall::check_settings<TrackTable>(settings, fault);
}

POSE_WALL_EXPORT int32_t pose_wall_planar_track_memory_needed(const pose_wall_planar_track_settings* settings,
                                                              uint64_t* bytes) {
  return pose_wall::part_memory_needed<HeldTracker, TrackTable>(settings, bytes);
}

POSE_WALL_EXPORT int32_t pose_wall_planar_track_open(const pose_wall_planar_track_settings* settings, void* block,
                                                     uint64_t block_bytes, pose_wall_planar_tracker** tracker) {
  return pose_wall::open_part<HeldTracker, TrackTable>(settings, block, block_bytes, tracker,
                                                       [](auto& body, const auto&) { body.open(); });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_track_route(pose_wall_planar_tracker* tracker,
                                                      const pose_wall_planar_path_pose* poses, uint32_t count,
                                                      pose_wall_planar_clearance clearance, void* context) {
  if (tracker == nullptr || poses == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<HeldTracker> inside(held_of(tracker));
  std::int32_t status = inside.status();
  if (status == POSE_WALL_OK && !(count >= 1 && count <= inside->body().path_max())) status = POSE_WALL_E_VALUE_RANGE;
  if (status == POSE_WALL_OK) status = check_route(poses, count);
  if (status == POSE_WALL_OK) inside->body().take_route(poses, count, clearance, context);
  return status;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_track_step(pose_wall_planar_tracker* tracker,
                                                     const pose_wall_planar_track_input* input,
                                                     pose_wall_planar_track_command* command) {
  if (tracker == nullptr || input == nullptr || command == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<HeldTracker> inside(held_of(tracker));
  if (inside.status() != POSE_WALL_OK) return inside.status();
  if (const std::int32_t size = pose_wall::check_struct(*input); size != POSE_WALL_OK) return size;
  if (const std::int32_t size = pose_wall::check_struct(*command); size != POSE_WALL_OK) return size;
  inside->body().step(*input, command);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_track_obeyed(pose_wall_planar_tracker* tracker, double speed_m_s,
                                                       double turn_rad_s) {
  if (tracker == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<HeldTracker> inside(held_of(tracker));
  if (inside.status() != POSE_WALL_OK) return inside.status();
  constexpr double kMost = 1000.0;  // no machine: more is a wrong unit
  const bool is_sound = speed_m_s >= -kMost && speed_m_s <= kMost && turn_rad_s >= -kMost && turn_rad_s <= kMost;
  if (!is_sound) return POSE_WALL_E_VALUE_RANGE;
  inside->body().obeyed({speed_m_s, turn_rad_s});
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT const char* pose_wall_planar_track_state_name(uint32_t state) {
  return state < sizeof(kStates) / sizeof(kStates[0]) ? kStates[state] : "unknown";
}

}  // extern "C"
