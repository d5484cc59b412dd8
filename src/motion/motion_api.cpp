// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The only extern "C" file of pose_wall_motion: checks arguments, translates, calls.

#include <cstddef>
#include <cstring>

#include "base/estimation/protection.hpp"
#include "motion/motion_image.hpp"
#include "motion/motion_report.hpp"
#include "motion/odometry.hpp"
#include "part/image_words.hpp"
#include "part/shell.hpp"
#include "part/struct_versions.hpp"
#include "pose_wall_motion.h"

namespace pose_wall::motion {
namespace {

constexpr StructSizes kMotionResultSizes = {0, offsetof(pose_wall_motion_result, run), sizeof(pose_wall_motion_result)};
constexpr std::uint32_t kMark = 0x4E544F4DU;  // the letters 'MOTN'

constexpr const char* kStates[] = {"lost", "unobservable", "ambiguous", "measured"};
constexpr const char* kDirections[POSE_WALL_MOTION_DIRECTIONS] = {"along", "across", "up", "roll", "pitch", "yaw"};
constexpr const char* kReasons[POSE_WALL_MOTION_REASON_COUNT][2] = {
    {"first", "The map begins with this frame."},
    {"few_points", "Too few points have a surface around them."},
    {"few_matches", "Too few points lie on the surfaces of the map."},
    {"smooth", "The relief of the rock tells no place along the road from its neighbours."},
    {"few_patches", "Too few patches of rock tell the place along the road."},
    {"halves_differ", "Two halves of the rock tell different places along the road."},
    {"second_peak", "Another place along the road fits nearly as well."},
    {"at_edge", "The best place lies further off than the machine can have moved."},
    {"no_ground", "Walls and roof alone tell roll, pitch and height, for little ground is seen."},
    {"stamp", "The stamp stood still or went back, so nothing is taken from this frame."},
    {"gap", "Frames are missing before this one."},
    {"prior", "The machine's own inputs contradict what was measured, and were not used."},
    {"map_full", "The oldest part of the map gave way to the newest."},
    {"repeated", "Points that came before came again, so sensor or driver hang, and the frame is not used."}};

constexpr double pi = kPi;  // NOLINT(readability-identifier-naming): as the table writes it
constexpr SettingRow kRows[] = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_motion_settings, __VA_ARGS__)
#include "pose_wall_motion_settings.def"
};

struct MotionTable : SettingsTable<pose_wall_motion_settings> {
  using SettingsTable::SettingsTable;
  static SettingRows rows() { return rows_of(kRows); }
  SettingFault broken_rule() const {
    if (reserved == 0) return {};
    return {"reserved", "reserved must be 0"};
  }
};

// What a motion's block holds.
struct Body {
  std::uint32_t config_crc32 = 0, source_id = 0;
  std::uint64_t frames = 0;
  std::int64_t last_stamp_ns = 0;
  Odometry odometry;

  void lay_out(Arena& arena) { odometry.lay_out(arena); }
};
using HeldMotion = Held<Body, 0x6E6F69746F6D5750ULL>;

// The common part of all results of a motion.
pose_wall_motion_result begun(const Body& body) {
  pose_wall_motion_result result{};
  result.mark = kMark;
  result.config_crc32 = body.config_crc32;
  result.source_id = body.source_id;
  return result;
}

MotionSettings settings_of(const pose_wall_config& config, const Mount& mount,
                           const pose_wall_motion_settings& settings) {
  MotionSettings out;
  out.speed_max_m_s = settings.speed_max_m_s;
  out.turn_max_rad_s = settings.turn_max_rad_s;
  out.keyframe_m = settings.keyframe_m;
  out.protection_sigmas = sigmas_at_risk(number_of(config, "integrity_risk"));
  out.forward_base << mount.forward_base, 0.0;
  return out;
}

}  // namespace

extern "C" {

POSE_WALL_EXPORT uint32_t pose_wall_motion_abi_version(void) {
  return POSE_WALL_MOTION_ABI_VERSION;
}

POSE_WALL_SETTINGS_CALLS(pose_wall_motion, MotionTable, pose_wall_motion_fault)

POSE_WALL_EXPORT const char* pose_wall_motion_along_state_name(uint32_t state) {
  return state <= POSE_WALL_ALONG_MEASURED ? kStates[state] : "unknown";
}
POSE_WALL_EXPORT const char* pose_wall_motion_reason_name(uint32_t bit_index) {
  return bit_index < POSE_WALL_MOTION_REASON_COUNT ? kReasons[bit_index][0] : "unknown";
}
POSE_WALL_EXPORT const char* pose_wall_motion_reason_text(uint32_t bit_index) {
  return bit_index < POSE_WALL_MOTION_REASON_COUNT ? kReasons[bit_index][1] : "unknown reason";
}
POSE_WALL_EXPORT const char* pose_wall_motion_direction_name(uint32_t direction) {
  return direction < POSE_WALL_MOTION_DIRECTIONS ? kDirections[direction] : "unknown";
}

POSE_WALL_EXPORT uint64_t pose_wall_motion_memory_needed(void) {
  return HeldMotion::bytes();
}

POSE_WALL_EXPORT int32_t pose_wall_motion_open(const pose_wall_config* config,
                                               const pose_wall_motion_settings* settings, void* block,
                                               uint64_t block_bytes, pose_wall_motion** motion) {
  if (config == nullptr || block == nullptr || motion == nullptr) return POSE_WALL_E_NULL;
  pose_wall_motion_settings chosen;
  std::int32_t status = pose_wall_config_check(config, nullptr);
  if (status == POSE_WALL_OK) status = choose_settings<MotionTable>(settings, &chosen);
  if (status != POSE_WALL_OK) return status;
  HeldMotion* held = nullptr;
  status = HeldMotion::place(block, block_bytes, &held);
  if (status != POSE_WALL_OK) return status;
  Body& body = held->body();
  Mount mount = mount_of(*config);
  mount.range_max_m = chosen.range_max_m;
  body.odometry.open(mount, settings_of(*config, mount, chosen));
  (void)pose_wall_config_crc(config, &body.config_crc32);
  body.source_id = static_cast<std::uint32_t>(number_of(*config, "source_id"));
  *motion = reinterpret_cast<pose_wall_motion*>(held);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_motion_reset(pose_wall_motion* motion) {
  return with_part<HeldMotion>(motion, [](Body& body) {
    body.odometry.reset();
    body.frames = 0;
    body.last_stamp_ns = 0;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_motion_process(pose_wall_motion* motion, const pose_wall_cloud* cloud,
                                                  pose_wall_motion_result* result) {
  if (cloud == nullptr || result == nullptr) return POSE_WALL_E_NULL;
  return with_part<HeldMotion>(motion, [&](Body& body) {
    std::int32_t status = pose_wall_cloud_check(cloud);
    if (status == POSE_WALL_OK) status = check_struct_size(result->struct_size, kMotionResultSizes);
    if (status != POSE_WALL_OK) return status;
    const auto whole = read_struct<pose_wall_cloud>(cloud, cloud->struct_size);
    pose_wall_motion_result found = begun(body);
    body.odometry.process(whole, &found);
    found.run = found.along_state != POSE_WALL_ALONG_LOST ? body.odometry.run() : 0;
    body.frames = found.frame_index + 1;
    body.last_stamp_ns = found.stamp_ns;
    write_struct(found, result->struct_size, result);
    return status;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_motion_give(const pose_wall_motion* motion, pose_wall_inputs* inputs) {
  if (motion == nullptr || inputs == nullptr) return POSE_WALL_E_NULL;
  if (const std::int32_t size = check_struct(*inputs); size != POSE_WALL_OK) return size;
  return with_part<HeldMotion>(motion, [&](const Body& body) {
    const bool told = body.odometry.tell(&inputs->odometry);
    const std::uint32_t bit = POSE_WALL_INPUT_ODOMETRY;
    inputs->given = told ? inputs->given | bit : inputs->given & ~bit;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_motion_process_both(pose_wall_motion* motion, pose_wall_engine* engine,
                                                       const pose_wall_cloud* cloud,
                                                       pose_wall_motion_result* motion_result,
                                                       pose_wall_result* result) {
  if (engine == nullptr || result == nullptr) return POSE_WALL_E_NULL;
  // All that the engine refuses of these arguments, before motion takes the frame.
  std::int32_t status = check_struct_size(result->struct_size, kResultSizes);
  if (status != POSE_WALL_OK) return status;
  status = pose_wall_motion_process(motion, cloud, motion_result);
  if (status != POSE_WALL_OK) return status;
  WholeCloud whole(*cloud);
  whole.inputs.struct_size = sizeof(whole.inputs);
  status = pose_wall_motion_give(motion, &whole.inputs);
  if (status != POSE_WALL_OK) return status;
  whole.cloud.struct_size = sizeof(whole.cloud);
  whole.cloud.inputs = &whole.inputs;
  return pose_wall_process(engine, &whole.cloud, result);
}

POSE_WALL_EXPORT int32_t pose_wall_motion_blank(const pose_wall_motion* motion, pose_wall_motion_result* result) {
  if (result == nullptr) return POSE_WALL_E_NULL;
  return with_part<HeldMotion>(motion, [&](const Body& body) {
    const std::int32_t status = check_struct_size(result->struct_size, kMotionResultSizes);
    if (status != POSE_WALL_OK) return status;
    pose_wall_motion_result none = begun(body);
    report_nothing(&none);
    none.frame_index = body.frames - 1;
    none.stamp_ns = body.last_stamp_ns;
    write_struct(none, result->struct_size, result);
    return status;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_motion_image_fill(const pose_wall_motion_result* result,
                                                     const pose_wall_image_source* source,
                                                     pose_wall_motion_image* image) {
  if (result == nullptr || image == nullptr) return POSE_WALL_E_NULL;
  std::int32_t status = check_struct_size(result->struct_size, kMotionResultSizes);
  if (status == POSE_WALL_OK) status = check_struct(*image);
  if (status == POSE_WALL_OK && source != nullptr) {
    status = check_struct_size(source->struct_size, kSourceSizes);
  }
  if (status != POSE_WALL_OK) return status;
  const auto whole = read_struct<pose_wall_motion_result>(result, result->struct_size);
  if (whole.mark != kMark) return POSE_WALL_E_RESULT;
  pose_wall_image_source told{sizeof(told), 0, 0, 0, whole.frame_index + 1, -1};
  if (source != nullptr) told = read_struct<pose_wall_image_source>(source, source->struct_size);
  fill_image(whole, told, image);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_motion_image_check(const pose_wall_motion_image* image) {
  return check_image(image, POSE_WALL_MOTION_IMAGE_VERSION, &pose_wall_motion_image::crc32c, kCrcCastagnoli);
}

POSE_WALL_EXPORT const pose_wall_motion_functions* pose_wall_motion_functions_get(void) {
  static constexpr pose_wall_motion_functions kFunctions = {
      sizeof(pose_wall_motion_functions), POSE_WALL_MOTION_ABI_VERSION, pose_wall_motion_settings_check,
      pose_wall_motion_memory_needed,     pose_wall_motion_open,        pose_wall_motion_reset,
      pose_wall_motion_process,           pose_wall_motion_give,        pose_wall_motion_blank,
      pose_wall_motion_image_fill};
  return &kFunctions;
}

POSE_WALL_EXPORT int32_t pose_wall_motion_map(const pose_wall_motion* motion, uint32_t first, float* xyz_m,
                                              uint32_t capacity, uint32_t* total) {
  if (total == nullptr || (xyz_m == nullptr && capacity > 0)) return POSE_WALL_E_NULL;
  return with_part<HeldMotion>(motion,
                               [&](const Body& body) { *total = body.odometry.map_points(first, capacity, xyz_m); });
}

}  // extern "C"

}  // namespace pose_wall::motion
