// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The C ABI of the stop: pointers and sizes are checked here, once.

#include "base/estimation/protection.hpp"
#include "lidar/mount.hpp"
#include "part/image_words.hpp"
#include "part/shell.hpp"
#include "planar/stop/stop.hpp"
#include "planar/stop/stop_image.hpp"
#include "pose_wall_planar_stop.h"

namespace pose_wall::planar {
namespace {

using Mine = Held<Stop, 0x706F74735F6E6C70ULL>;

constexpr const char* kStates[] = {"stop", "slow", "go"};
constexpr const char* kReasons[POSE_WALL_PLANAR_STOP_REASON_COUNT][2] = {
    {"stale", "The last frame is too old, there was none, or the clock stands still."},
    {"blind", "A place in the way was not seen free."},
    {"invalid", "The clock or the stamp went back, the stamp lies in the future, or the frame has hardly a return."},
    {"frozen", "The frame is the same as the one before it."},
    {"missing", "The machine's motion was not given, so every motion is assumed."},
    {"thing", "A thing is in the way."},
    {"low", "The thing in the way is a low one."},
    {"nearing", "The thing may walk into the way."},
    {"speed", "The machine is faster than it can stop."},
    {"dust", "Doubtful returns near the way are dust, or a thin thing."},
    {"no_floor", "The floor was not seen, so the machine's own plane is used."},
    {"restart", "The way is clear, but not for long enough yet."}};

std::int32_t check_motion(const pose_wall_planar_stop_motion& motion) {
  if (const std::int32_t size = check_struct(motion); size != POSE_WALL_OK) return size;
  // The bits of this header:
  constexpr std::uint32_t kKnown = POSE_WALL_PLANAR_STOP_MEASURED | POSE_WALL_PLANAR_STOP_COMMANDED;
  return ok_if((motion.given & ~kKnown) == 0, POSE_WALL_E_INPUT);
}

}  // namespace

extern "C" {

POSE_WALL_SETTINGS_CALLS(pose_wall_planar_stop, StopTable, pose_wall_planar_fault)

POSE_WALL_EXPORT int32_t pose_wall_planar_stop_rectangle(pose_wall_planar_stop_settings* settings, double x_min_m,
                                                         double x_max_m, double y_min_m, double y_max_m) {
  if (settings == nullptr) return POSE_WALL_E_NULL;
  if (const std::int32_t size = check_struct(*settings); size != POSE_WALL_OK) return size;
  set_rectangle(settings, x_min_m, x_max_m, y_min_m, y_max_m);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT const char* pose_wall_planar_stop_state_name(uint32_t state) {
  return state <= POSE_WALL_PLANAR_STOP_GO ? kStates[state] : "unknown";
}
POSE_WALL_EXPORT const char* pose_wall_planar_stop_reason_name(uint32_t bit_index) {
  return bit_index < POSE_WALL_PLANAR_STOP_REASON_COUNT ? kReasons[bit_index][0] : "unknown";
}
POSE_WALL_EXPORT const char* pose_wall_planar_stop_reason_text(uint32_t bit_index) {
  return bit_index < POSE_WALL_PLANAR_STOP_REASON_COUNT ? kReasons[bit_index][1] : "unknown reason";
}

POSE_WALL_EXPORT int32_t pose_wall_planar_stop_memory_needed(uint64_t* bytes) {
  if (bytes == nullptr) return POSE_WALL_E_NULL;
  *bytes = Mine::bytes();
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_stop_open(const pose_wall_config* config,
                                                    const pose_wall_planar_stop_settings* settings, void* block,
                                                    uint64_t block_bytes, pose_wall_planar_stop** stop) {
  if (config == nullptr || block == nullptr || stop == nullptr) return POSE_WALL_E_NULL;
  pose_wall_planar_stop_settings given;
  Mine* opened = nullptr;
  std::int32_t status = pose_wall_config_check(config, nullptr);
  if (status == POSE_WALL_OK) status = choose_settings<StopTable>(settings, &given);
  if (status == POSE_WALL_OK) status = Mine::place(block, block_bytes, &opened);
  if (status != POSE_WALL_OK) return status;
  const double sigmas = sigmas_at_risk(number_of(*config, "integrity_risk"));
  opened->body().open(given, mount_of(*config), sigmas, settings_crc(*config, given));
  *stop = reinterpret_cast<pose_wall_planar_stop*>(opened);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_stop_reset(pose_wall_planar_stop* stop) {
  return with_part<Mine>(stop, [](Stop& own) { own.reset(); });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_stop_confirm(pose_wall_planar_stop* stop) {
  return with_part<Mine>(stop, [](Stop& own) { own.confirm(); });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_stop_note_odometry(pose_wall_planar_stop* stop,
                                                             const pose_wall_odometry* odometry, int64_t stamp_ns) {
  if (odometry == nullptr) return POSE_WALL_E_NULL;
  return with_part<Mine>(stop, [&](Stop& own) { return ok_if(own.note(*odometry, stamp_ns), POSE_WALL_E_INPUT); });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_stop_process(pose_wall_planar_stop* stop, const pose_wall_cloud* cloud,
                                                       const pose_wall_planar_stop_motion* motion, int64_t now_ns,
                                                       pose_wall_planar_stop_result* result) {
  if (cloud == nullptr || result == nullptr) return POSE_WALL_E_NULL;
  return with_part<Mine>(stop, [&](Stop& own) {
    std::int32_t status = pose_wall_cloud_check(cloud);
    if (status == POSE_WALL_OK && motion != nullptr) status = check_motion(*motion);
    if (status == POSE_WALL_OK) status = check_struct(*result);
    if (status != POSE_WALL_OK) return status;
    const auto whole = read_struct<pose_wall_cloud>(cloud, cloud->struct_size);
    own.process(whole, motion != nullptr ? *motion : pose_wall_planar_stop_motion{}, now_ns, result);
    return status;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_stop_tick(pose_wall_planar_stop* stop, int64_t now_ns,
                                                    pose_wall_planar_stop_result* result) {
  if (result == nullptr) return POSE_WALL_E_NULL;
  return with_part<Mine>(stop, [&](Stop& own) {
    const std::int32_t size = check_struct(*result);
    if (size == POSE_WALL_OK) own.tick(now_ns, result);
    return size;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_stop_settings_crc(const pose_wall_config* config,
                                                            const pose_wall_planar_stop_settings* settings,
                                                            uint32_t* crc) {
  if (config == nullptr || crc == nullptr) return POSE_WALL_E_NULL;
  if (settings != nullptr && settings->struct_size != sizeof(*settings)) return POSE_WALL_E_STRUCT_SIZE;
  std::uint32_t config_crc = 0;
  const std::int32_t status = pose_wall_config_crc(config, &config_crc);
  if (status != POSE_WALL_OK) return status;
  *crc = settings_crc(*config, settings != nullptr ? *settings : default_settings<StopTable>());
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_stop_image_fill(const pose_wall_planar_stop_result* result,
                                                          pose_wall_planar_stop_image* image) {
  if (result == nullptr || image == nullptr) return POSE_WALL_E_NULL;
  std::int32_t status = check_struct(*result);
  if (status == POSE_WALL_OK && image->struct_size != sizeof(*image)) status = POSE_WALL_E_STRUCT_SIZE;
  if (status == POSE_WALL_OK && result->mark != kStopMark) status = POSE_WALL_E_RESULT;
  if (status == POSE_WALL_OK) fill_image(*result, image);
  return status;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_stop_image_check(const pose_wall_planar_stop_image* image) {
  return check_image(image, POSE_WALL_PLANAR_STOP_IMAGE_VERSION, &pose_wall_planar_stop_image::crc32c, kCrcCastagnoli);
}

}  // extern "C"

}  // namespace pose_wall::planar
