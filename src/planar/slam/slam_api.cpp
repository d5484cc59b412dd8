// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The only extern "C" file of SLAM: checks arguments, translates, calls.

#include "part/shell.hpp"
#include "planar/slam/slam.hpp"
#include "planar/slam/trail_image.hpp"
#include "pose_wall_planar_slam.h"

namespace pose_wall::planar {
namespace {

constexpr const char* kStates[] = {"first", "tracked", "doubtful", "blind"};

using Opened = Held<Slam, 0x6D616C736C6E616CULL>;

constexpr SettingRow kRows[] = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_slam_settings, __VA_ARGS__)
#include "pose_wall_planar_slam_settings.def"
};

struct SlamTable : SettingsTable<SlamSettings> {
  using SettingsTable::SettingsTable;
  static SettingRows rows() { return rows_of(kRows); }
};

std::uint32_t state_of(const SlamStep& step, bool is_first) {
  if (is_first) return POSE_WALL_PLANAR_SLAM_FIRST;
  if (!step.is_valid) return POSE_WALL_PLANAR_SLAM_BLIND;
  return step.is_trusted ? std::uint32_t{POSE_WALL_PLANAR_SLAM_TRACKED} : std::uint32_t{POSE_WALL_PLANAR_SLAM_DOUBTFUL};
}

}  // namespace

extern "C" {

POSE_WALL_EXPORT const char* pose_wall_planar_slam_state_name(uint32_t state) {
  return state < sizeof(kStates) / sizeof(kStates[0]) ? kStates[state] : "unknown";
}

POSE_WALL_SETTINGS_CALLS(pose_wall_planar_slam, SlamTable, pose_wall_planar_fault)
POSE_WALL_BLOCK_CALLS(pose_wall_planar_slam, Opened, SlamTable, pose_wall_planar_slam)

POSE_WALL_EXPORT int32_t pose_wall_planar_slam_clear(pose_wall_planar_slam* slam) {
  return with_part<Opened>(slam, [](Slam& part) { part.clear(); });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_slam_process(pose_wall_planar_slam* slam, const pose_wall_planar_scan* scan,
                                                       const pose_wall_planar_pose* odometry,
                                                       pose_wall_planar_slam_result* result) {
  if (result == nullptr) return POSE_WALL_E_NULL;
  if (const std::int32_t size = check_struct(*result); size != POSE_WALL_OK) return size;
  const std::int32_t status = check_scan(scan);
  if (status != POSE_WALL_OK) return status;
  if (odometry != nullptr && !is_pose(*odometry)) return POSE_WALL_PLANAR_E_POSE;
  return with_part<Opened>(slam, [&](Slam& own) {
    const bool is_first = own.trail().size() == 0;
    const Pose2 given = odometry != nullptr ? pose_of(*odometry) : Pose2();
    const SlamStep step = own.process(read_beams(*scan, own.beams()), odometry != nullptr ? &given : nullptr);
    pose_wall_planar_slam_result out{};
    out.struct_size = sizeof(out);
    out.state = state_of(step, is_first);
    out.stamp_ns = scan->stamp_ns;
    out.pose = pose_for_caller(step.pose);
    out.in_keyframe = pose_for_caller(step.in_keyframe);
    out.keyframe = step.keyframe;
    out.is_keyframe = step.is_keyframe ? 1 : 0;
    out.explained = step.explained;
    out.misfit_m = step.rms_m;
    out.closures = own.loops().believed();
    out.taken_back = own.loops().taken_back();
    out.keyframes = own.trail().size();
    out.is_full = own.is_full() ? 1 : 0;
    out.solution = own.solution();
    out.is_settled = own.is_settled() ? 1 : 0;
    *result = out;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_slam_settle(pose_wall_planar_slam* slam) {
  return with_part<Opened>(slam, [](Slam& part) { part.settle(); });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_slam_keyframe(const pose_wall_planar_slam* slam, uint32_t number,
                                                        pose_wall_planar_keyframe* keyframe) {
  if (keyframe == nullptr) return POSE_WALL_E_NULL;
  if (const std::int32_t size = check_struct(*keyframe); size != POSE_WALL_OK) return size;
  return with_part<Opened>(slam, [&](const Slam& part) -> std::int32_t {
    const Trail& trail = part.trail();
    if (number >= trail.size()) return POSE_WALL_E_INDEX;
    const Keyframe& own = trail[number];
    *keyframe = {sizeof(*keyframe), own.count, own.stamp_ns, pose_for_caller(trail.pose(number)), own.travel_m};
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_slam_points(const pose_wall_planar_slam* slam, uint32_t number, float* xy_m,
                                                      uint32_t capacity) {
  if (xy_m == nullptr) return POSE_WALL_E_NULL;
  return with_part<Opened>(slam, [&](const Slam& part) -> std::int32_t {
    const Trail& trail = part.trail();
    if (number >= trail.size()) return POSE_WALL_E_INDEX;
    if (capacity < trail[number].count) return POSE_WALL_E_BUFFER_SMALL;
    float* to = xy_m;
    for (const ScanPoint& point : trail.points(number)) {
      *to++ = point.x_m;
      *to++ = point.y_m;
    }
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_slam_edge(const pose_wall_planar_slam* slam, uint32_t number,
                                                    pose_wall_planar_edge* edge) {
  if (edge == nullptr) return POSE_WALL_E_NULL;
  if (const std::int32_t size = check_struct(*edge); size != POSE_WALL_OK) return size;
  return with_part<Opened>(slam, [&](const Slam& part) -> std::int32_t {
    const Trail& trail = part.trail();
    if (number >= trail.edges().size()) return POSE_WALL_E_INDEX;
    const Edge& own = trail.edges()[number];
    pose_wall_planar_edge out{};
    out.struct_size = sizeof(out);
    out.from = own.from;
    out.to = own.to;
    out.is_closure = own.is_closure ? 1 : 0;
    out.step = pose_for_caller(own.step);
    for (int k = 0; k < 9; ++k) out.information[k] = own.information(k / 3, k % 3);
    *edge = out;
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_slam_save_bytes(const pose_wall_planar_slam* slam, uint64_t* bytes) {
  if (bytes == nullptr) return POSE_WALL_E_NULL;
  return with_part<Opened>(slam, [&](const Slam& part) { *bytes = TrailImage::bytes(part.trail()); });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_slam_save(const pose_wall_planar_slam* slam, void* buffer,
                                                    uint64_t buffer_bytes, uint64_t* bytes) {
  if (buffer == nullptr || bytes == nullptr) return POSE_WALL_E_NULL;
  return with_part<Opened>(slam, [&](const Slam& part) -> std::int32_t {
    const std::uint64_t needed = TrailImage::bytes(part.trail());
    if (buffer_bytes < needed) return POSE_WALL_E_BUFFER_SMALL;
    TrailImage::write(part.trail(), static_cast<unsigned char*>(buffer));
    *bytes = needed;
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_slam_load(pose_wall_planar_slam* slam, const void* saved, uint64_t bytes,
                                                    const pose_wall_planar_pose* base) {
  if (saved == nullptr) return POSE_WALL_E_NULL;
  if (base != nullptr && !is_pose(*base)) return POSE_WALL_PLANAR_E_POSE;
  return with_part<Opened>(slam, [&](Slam& part) -> std::int32_t {
    Trail& trail = part.trail();
    const std::int32_t status = TrailImage::read(static_cast<const unsigned char*>(saved), bytes, &trail);
    if (status != POSE_WALL_OK) return status;
    const Pose2 end = trail.size() > 0 ? trail.pose(trail.size() - 1) : Pose2();
    part.resume(base != nullptr ? pose_of(*base) : end);
    return POSE_WALL_OK;
  });
}

}  // extern "C"

}  // namespace pose_wall::planar
