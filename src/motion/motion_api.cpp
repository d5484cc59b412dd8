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
#include "part/export.hpp"
#include "part/held.hpp"
#include "part/settings.hpp"
#include "part/struct_sizes.hpp"
#include "part/struct_versions.hpp"
#include "pose_wall_motion.h"

namespace {

using pose_wall::number_of;
using pose_wall::StructSizes;
using pose_wall::motion::MotionSettings;
using pose_wall::motion::Odometry;

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

constexpr double pi = pose_wall::kPi;  // NOLINT(readability-identifier-naming): as the table writes it
constexpr pose_wall::SettingRow kRows[] = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_motion_settings, __VA_ARGS__)
#include "pose_wall_motion_settings.def"
};

struct MotionTable : pose_wall::SettingsTable<pose_wall_motion_settings> {
  using SettingsTable::SettingsTable;
  static pose_wall::SettingRows rows() { return pose_wall::rows_of(kRows); }
  pose_wall::SettingFault broken_rule() const {
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

  void lay_out(pose_wall::Arena& arena) { odometry.lay_out(arena); }
};
using Held = pose_wall::Held<Body, 0x6E6F69746F6D5750ULL>;
using Inside = pose_wall::Inside<Held>;

Held* held_of(pose_wall_motion* motion) {
  return reinterpret_cast<Held*>(motion);
}
const Held* held_of(const pose_wall_motion* motion) {
  return reinterpret_cast<const Held*>(motion);
}

// The common part of all results of a motion.
pose_wall_motion_result begun(const Body& body) {
  pose_wall_motion_result result{};
  result.mark = kMark;
  result.config_crc32 = body.config_crc32;
  result.source_id = body.source_id;
  return result;
}

void forget_frames(Body* body) {
  body->frames = 0;
  body->last_stamp_ns = 0;
}

MotionSettings settings_of(const pose_wall_config& config, const pose_wall::Mount& mount,
                           const pose_wall_motion_settings& settings) {
  MotionSettings out;
  out.speed_max_m_s = settings.speed_max_m_s;
  out.turn_max_rad_s = settings.turn_max_rad_s;
  out.keyframe_m = settings.keyframe_m;
  out.protection_sigmas = pose_wall::sigmas_at_risk(number_of(config, "integrity_risk"));
  out.forward_base << mount.forward_base, 0.0;
  return out;
}

}  // namespace

extern "C" {

POSE_WALL_EXPORT uint32_t pose_wall_motion_abi_version(void) {
  return POSE_WALL_MOTION_ABI_VERSION;
}

POSE_WALL_EXPORT int32_t pose_wall_motion_settings_init(pose_wall_motion_settings* settings) {
  return pose_wall::init_settings<MotionTable>(settings);
}

POSE_WALL_EXPORT int32_t pose_wall_motion_settings_check(const pose_wall_motion_settings* settings,
                                                         pose_wall_motion_fault* fault) {
  return pose_wall::check_settings<MotionTable>(settings, fault);
}

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
  return Held::bytes();
}

POSE_WALL_EXPORT int32_t pose_wall_motion_open(const pose_wall_config* config,
                                               const pose_wall_motion_settings* settings, void* block,
                                               uint64_t block_bytes, pose_wall_motion** motion) {
  if (config == nullptr || block == nullptr || motion == nullptr) return POSE_WALL_E_NULL;
  pose_wall_motion_settings chosen;
  std::int32_t status = pose_wall_config_check(config, nullptr);
  if (status == POSE_WALL_OK) status = pose_wall::choose_settings<MotionTable>(settings, &chosen);
  if (status != POSE_WALL_OK) return status;
  Held* held = nullptr;
  status = Held::place(block, block_bytes, &held);
  if (status != POSE_WALL_OK) return status;
  Body& body = held->body();
  pose_wall::Mount mount = pose_wall::mount_of(*config);
  mount.range_max_m = chosen.range_max_m;
  body.odometry.open(mount, settings_of(*config, mount, chosen));
  (void)pose_wall_config_crc(config, &body.config_crc32);
  body.source_id = static_cast<std::uint32_t>(number_of(*config, "source_id"));
  *motion = reinterpret_cast<pose_wall_motion*>(held);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_motion_reset(pose_wall_motion* motion) {
  if (motion == nullptr) return POSE_WALL_E_NULL;
  const Inside inside(held_of(motion));
  if (inside.status() != POSE_WALL_OK) return inside.status();
  inside->body().odometry.reset();
  forget_frames(&inside->body());
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_motion_process(pose_wall_motion* motion, const pose_wall_cloud* cloud,
                                                  pose_wall_motion_result* result) {
  if (motion == nullptr || cloud == nullptr || result == nullptr) return POSE_WALL_E_NULL;
  const Inside inside(held_of(motion));
  std::int32_t status = inside.status();
  if (status == POSE_WALL_OK) status = pose_wall_cloud_check(cloud);
  if (status == POSE_WALL_OK) status = pose_wall::check_struct_size(result->struct_size, kMotionResultSizes);
  if (status != POSE_WALL_OK) return status;
  const auto whole = pose_wall::read_struct<pose_wall_cloud>(cloud, cloud->struct_size);
  Body& body = inside->body();
  pose_wall_motion_result found = begun(body);
  body.odometry.process(whole, &found);
  found.run = found.along_state != POSE_WALL_ALONG_LOST ? body.odometry.run() : 0;
  body.frames = found.frame_index + 1;
  body.last_stamp_ns = found.stamp_ns;
  pose_wall::write_struct(found, result->struct_size, result);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_motion_give(const pose_wall_motion* motion, pose_wall_inputs* inputs) {
  if (motion == nullptr || inputs == nullptr) return POSE_WALL_E_NULL;
  if (const std::int32_t size = pose_wall::check_struct(*inputs); size != POSE_WALL_OK) return size;
  const Inside inside(held_of(motion));
  if (inside.status() != POSE_WALL_OK) return inside.status();
  const bool told = inside->body().odometry.tell(&inputs->odometry);
  const std::uint32_t bit = POSE_WALL_INPUT_ODOMETRY;
  inputs->given = told ? inputs->given | bit : inputs->given & ~bit;
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_motion_process_both(pose_wall_motion* motion, pose_wall_engine* engine,
                                                       const pose_wall_cloud* cloud,
                                                       pose_wall_motion_result* motion_result,
                                                       pose_wall_result* result) {
  if (engine == nullptr || result == nullptr) return POSE_WALL_E_NULL;
  // All that the engine refuses of these arguments, before motion takes the frame.
  std::int32_t status = pose_wall::check_struct_size(result->struct_size, pose_wall::kResultSizes);
  if (status != POSE_WALL_OK) return status;
  status = pose_wall_motion_process(motion, cloud, motion_result);
  if (status != POSE_WALL_OK) return status;
  auto whole = pose_wall::read_struct<pose_wall_cloud>(cloud, cloud->struct_size);
  pose_wall_inputs inputs{};
  if (whole.inputs != nullptr) {
    inputs = pose_wall::read_struct<pose_wall_inputs>(whole.inputs, whole.inputs->struct_size);
  }
  inputs.struct_size = sizeof(inputs);
  status = pose_wall_motion_give(motion, &inputs);
  if (status != POSE_WALL_OK) return status;
  whole.struct_size = sizeof(whole);
  whole.inputs = &inputs;
  return pose_wall_process(engine, &whole, result);
}

POSE_WALL_EXPORT int32_t pose_wall_motion_blank(const pose_wall_motion* motion, pose_wall_motion_result* result) {
  if (motion == nullptr || result == nullptr) return POSE_WALL_E_NULL;
  const Inside inside(held_of(motion));
  std::int32_t status = inside.status();
  if (status == POSE_WALL_OK) status = pose_wall::check_struct_size(result->struct_size, kMotionResultSizes);
  if (status != POSE_WALL_OK) return status;
  const Body& body = inside->body();
  pose_wall_motion_result none = begun(body);
  pose_wall::motion::report_nothing(&none);
  none.frame_index = body.frames - 1;
  none.stamp_ns = body.last_stamp_ns;
  pose_wall::write_struct(none, result->struct_size, result);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_motion_image_fill(const pose_wall_motion_result* result,
                                                     const pose_wall_image_source* source,
                                                     pose_wall_motion_image* image) {
  if (result == nullptr || image == nullptr) return POSE_WALL_E_NULL;
  std::int32_t status = pose_wall::check_struct_size(result->struct_size, kMotionResultSizes);
  if (status == POSE_WALL_OK) status = pose_wall::check_struct(*image);
  if (status == POSE_WALL_OK && source != nullptr) {
    status = pose_wall::check_struct_size(source->struct_size, pose_wall::kSourceSizes);
  }
  if (status != POSE_WALL_OK) return status;
  const auto whole = pose_wall::read_struct<pose_wall_motion_result>(result, result->struct_size);
  if (whole.mark != kMark) return POSE_WALL_E_RESULT;
  pose_wall_image_source told{sizeof(told), 0, 0, 0, whole.frame_index + 1, -1};
  if (source != nullptr) told = pose_wall::read_struct<pose_wall_image_source>(source, source->struct_size);
  pose_wall::motion::fill_image(whole, told, image);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_motion_image_check(const pose_wall_motion_image* image) {
  return image != nullptr ? pose_wall::motion::check_image(*image) : POSE_WALL_E_NULL;
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
  if (motion == nullptr || total == nullptr || (xyz_m == nullptr && capacity > 0)) return POSE_WALL_E_NULL;
  const Inside inside(held_of(motion));
  if (inside.status() == POSE_WALL_OK) *total = inside->body().odometry.map_points(first, capacity, xyz_m);
  return inside.status();
}

}  // extern "C"
