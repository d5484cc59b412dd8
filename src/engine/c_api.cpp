// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The calls of pose_wall.h but for those of config.cpp and names.cpp: checks arguments, translates, calls.

#include <cstring>

#include "engine/config.hpp"
#include "engine/engine.hpp"
#include "engine/engine_memento.hpp"
#include "engine/image.hpp"
#include "engine/self_test.hpp"
#include "engine/self_test_digest.hpp"
#include "lidar/cloud_reader.hpp"
#include "part/export.hpp"
#include "part/image_words.hpp"
#include "part/status.hpp"
#include "part/struct_sizes.hpp"
#include "part/struct_versions.hpp"
#include "pose_wall.h"

#define POSE_WALL_TEXT_OF(number) POSE_WALL_TEXT_OF_(number)
#define POSE_WALL_TEXT_OF_(number) #number

namespace pose_wall {
namespace {

std::int32_t check_inputs(const pose_wall_inputs* inputs) {
  // The bits of pose_wall_inputs.given; others are of a later version.
  constexpr std::uint32_t kKnown =
      POSE_WALL_INPUT_STANDING | POSE_WALL_INPUT_SPEED | POSE_WALL_INPUT_TURN_RATE | POSE_WALL_INPUT_ODOMETRY;
  if (inputs == nullptr) return POSE_WALL_OK;
  const std::int32_t status = check_struct_size(inputs->struct_size, kInputsSizes);
  if (status != POSE_WALL_OK) return status;
  return ok_if((inputs->given & ~kKnown) == 0, POSE_WALL_E_INPUT);
}

std::int32_t check_moment(const pose_wall_moment* moment) {
  // The bits of pose_wall_moment.known; others are of a later version.
  constexpr std::uint32_t kKnown = POSE_WALL_MOMENT_BOOT | POSE_WALL_MOMENT_WALL | POSE_WALL_MOMENT_SAME_CLOCK;
  if (moment == nullptr) return POSE_WALL_OK;
  const std::int32_t status = check_struct_size(moment->struct_size, kMomentSizes);
  if (status != POSE_WALL_OK) return status;
  // An identity that somebody forgot to fill in is the same after each start.
  constexpr unsigned char kForgotten[sizeof(moment->boot_id)] = {};
  const bool forgotten =
      (moment->known & POSE_WALL_MOMENT_BOOT) != 0 && std::memcmp(moment->boot_id, kForgotten, sizeof(kForgotten)) == 0;
  return ok_if((moment->known & ~kKnown) == 0 && !forgotten, POSE_WALL_E_INPUT);
}

// Of a checked moment; for none, one of which nothing is known.
pose_wall_moment whole_moment(const pose_wall_moment* given) {
  return given != nullptr ? read_struct<pose_wall_moment>(given, given->struct_size) : pose_wall_moment{};
}

// Struct size, description, inputs: all that is wrong with a cloud before a point is looked at.
std::int32_t check_whole_cloud(const pose_wall_cloud& cloud) {
  std::int32_t status = check_struct_size(cloud.struct_size, kCloudSizes);
  if (status != POSE_WALL_OK) return status;
  status = check_cloud(read_struct<pose_wall_cloud>(&cloud, cloud.struct_size));
  return status == POSE_WALL_OK ? check_inputs(cloud.inputs) : status;
}

// The whole result in *whole, or why there is no image of it.
std::int32_t image_status(const pose_wall_result& result, std::uint32_t image_size, std::uint32_t known_size,
                          pose_wall_result* whole) {
  std::int32_t status = check_struct_size(result.struct_size, kResultSizes);
  if (status == POSE_WALL_OK) status = check_struct_size(image_size, {0, known_size, known_size});
  if (status != POSE_WALL_OK) return status;
  *whole = read_struct<pose_wall_result>(&result, result.struct_size);
  return ok_if(whole->mark == mark_of(*whole), POSE_WALL_E_RESULT);
}

}  // namespace

extern "C" {

POSE_WALL_EXPORT const char* pose_wall_version(void) {
  return POSE_WALL_TEXT_OF(POSE_WALL_VERSION_MAJOR) "." POSE_WALL_TEXT_OF(
      POSE_WALL_VERSION_MINOR) "." POSE_WALL_TEXT_OF(POSE_WALL_VERSION_PATCH);
}

POSE_WALL_EXPORT uint32_t pose_wall_abi_version(void) {
  return POSE_WALL_ABI_VERSION;
}

#undef pose_wall_cloud_xyz32
POSE_WALL_EXPORT int32_t pose_wall_cloud_xyz32(pose_wall_cloud* /*cloud*/, const void* /*data*/, uint32_t /*count*/,
                                               uint32_t /*point_step*/, int64_t /*stamp_ns*/) {
  return POSE_WALL_E_ABI;
}

POSE_WALL_EXPORT int32_t pose_wall_cloud_xyz32_2(pose_wall_cloud* cloud, const void* data, uint32_t count,
                                                 uint32_t point_step, int64_t stamp_ns) {
  pose_wall_cloud whole;
  const std::int32_t status = cloud != nullptr ? pose_wall_cloud_xyz32_3(&whole, data, count, point_step, stamp_ns)
                                               : std::int32_t{POSE_WALL_E_NULL};
  if (status == POSE_WALL_OK) write_struct(whole, kCloudSizes.first, cloud);
  return status;
}

POSE_WALL_EXPORT int32_t pose_wall_cloud_xyz32_3(pose_wall_cloud* cloud, const void* data, uint32_t count,
                                                 uint32_t point_step, int64_t stamp_ns) {
  if (cloud == nullptr || (data == nullptr && count > 0)) return POSE_WALL_E_NULL;
  *cloud = cloud_in_a_row(data, count, point_step, stamp_ns);
  cloud->x = {0, POSE_WALL_FIELD_FLOAT32};
  cloud->y = {4, POSE_WALL_FIELD_FLOAT32};
  cloud->z = {8, POSE_WALL_FIELD_FLOAT32};
  cloud->big_endian = machine_is_big_endian() ? 1 : 0;  // native floats
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_cloud_check(const pose_wall_cloud* cloud) {
  if (cloud == nullptr) return POSE_WALL_E_NULL;
  return check_whole_cloud(*cloud);
}

POSE_WALL_EXPORT int32_t pose_wall_memory_needed(const pose_wall_config* config, uint64_t* bytes) {
  if (config == nullptr || bytes == nullptr) return POSE_WALL_E_NULL;
  const int32_t status = pose_wall_config_check(config, nullptr);
  if (status != POSE_WALL_OK) return status;
  *bytes = Engine::lay_out(nullptr, read_settings(*config), nullptr);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_open(const pose_wall_config* config, void* block, uint64_t block_bytes,
                                        pose_wall_engine** engine) {
  if (config == nullptr || block == nullptr || engine == nullptr) return POSE_WALL_E_NULL;
  uint64_t needed = 0;
  const int32_t status = pose_wall_memory_needed(config, &needed);
  if (status != POSE_WALL_OK) return status;
  if (!is_aligned(block)) return POSE_WALL_E_BLOCK_ALIGN;
  if (block_bytes < needed) return POSE_WALL_E_BLOCK_SMALL;
  if (Engine::is_inside(block)) return POSE_WALL_E_BUSY;
  const Settings settings = read_settings(*config);
  // The engine's sum covers padding too. It may hold anything, but must be written.
  std::memset(block, 0, sizeof(Engine));
  Engine* placed = nullptr;
  Engine::lay_out(block, settings, &placed);
  uint32_t crc = 0;
  (void)pose_wall_config_crc(config, &crc);
  placed->open(settings, crc);
  *engine = reinterpret_cast<pose_wall_engine*>(placed);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_reset(pose_wall_engine* engine) {
  return with_inside<Engine>(engine, [](Engine& own) { own.reset(); });
}

POSE_WALL_EXPORT int32_t pose_wall_set_clock(pose_wall_engine* engine, pose_wall_clock clock, void* user) {
  return with_inside<Engine>(engine, [&](Engine& own) { own.set_clock(clock, user); });
}

POSE_WALL_EXPORT int32_t pose_wall_process(pose_wall_engine* engine, const pose_wall_cloud* cloud,
                                           pose_wall_result* result) {
  if (cloud == nullptr || result == nullptr) return POSE_WALL_E_NULL;
  return with_inside<Engine>(engine, [&](Engine& own) {
    std::int32_t status = check_struct_size(result->struct_size, kResultSizes);
    if (status == POSE_WALL_OK) status = check_whole_cloud(*cloud);
    if (status != POSE_WALL_OK) return status;
    pose_wall_result whole{};
    whole.struct_size = sizeof(whole);
    own.process(WholeCloud(*cloud).cloud, &whole);
    write_struct(whole, result->struct_size, result);
    return status;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_age(pose_wall_engine* engine, int64_t stamp_ns, pose_wall_result* result) {
  if (result == nullptr) return POSE_WALL_E_NULL;
  return with_inside<Engine>(engine, [&](Engine& own) {
    const std::int32_t status = check_struct_size(result->struct_size, kResultSizes);
    if (status != POSE_WALL_OK) return status;
    pose_wall_result whole{};
    whole.struct_size = sizeof(whole);
    own.age(stamp_ns, &whole);
    write_struct(whole, result->struct_size, result);
    return status;
  });
}

POSE_WALL_EXPORT uint64_t pose_wall_memento_bytes(void) {
  return memento_bytes();
}

POSE_WALL_EXPORT int32_t pose_wall_save(const pose_wall_engine* engine, const pose_wall_moment* now, void* memento,
                                        uint64_t bytes) {
  if (memento == nullptr) return POSE_WALL_E_NULL;
  return with_inside<Engine>(engine, [&](const Engine& own) -> std::int32_t {
    if (const std::int32_t status = check_moment(now); status != POSE_WALL_OK) return status;
    if (bytes < memento_bytes()) return POSE_WALL_E_BUFFER_SMALL;
    save_memory(own.memory(), whole_moment(now), own.config_crc32(), memento);
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_load(pose_wall_engine* engine, const pose_wall_moment* now, const void* memento,
                                        uint64_t bytes) {
  if (memento == nullptr) return POSE_WALL_E_NULL;
  return with_inside<Engine>(engine, [&](Engine& own) -> std::int32_t {
    if (const std::int32_t status = check_moment(now); status != POSE_WALL_OK) return status;
    if (bytes < memento_bytes()) return POSE_WALL_E_MEMENTO;  // cut off
    Memory memory;
    std::memset(static_cast<void*>(&memory), 0, sizeof(memory));  // padding, too: see pose_wall_open
    pose_wall_moment then{};
    if (!load_memory(memento, own.config_crc32(), &then, &memory)) return POSE_WALL_E_MEMENTO;
    take_up(memory, then, whole_moment(now), &own);
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_last_points(const pose_wall_engine* engine, pose_wall_points* points) {
  if (points == nullptr) return POSE_WALL_E_NULL;
  return with_inside<Engine>(engine, [&](const Engine& own) { *points = own.points(); });
}

POSE_WALL_EXPORT uint64_t pose_wall_self_test_bytes(void) {
  return self_test_bytes();
}

POSE_WALL_EXPORT int32_t pose_wall_self_test(void* block, uint64_t bytes, pose_wall_self_test_report* report) {
  if (block == nullptr || report == nullptr) return POSE_WALL_E_NULL;
  if (const std::int32_t size = check_struct(*report); size != POSE_WALL_OK) return size;
  if (!is_aligned(block)) return POSE_WALL_E_BLOCK_ALIGN;
  if (bytes < self_test_bytes()) return POSE_WALL_E_BLOCK_SMALL;
  return self_test(kSelfTestDigest, block, report);
}

POSE_WALL_EXPORT int32_t pose_wall_image_fill(const pose_wall_result* result, pose_wall_image* image) {
  if (result == nullptr || image == nullptr) return POSE_WALL_E_NULL;
  pose_wall_result whole;
  const std::int32_t status = image_status(*result, image->struct_size, sizeof(*image), &whole);
  if (status == POSE_WALL_OK) fill_image(whole, image);
  return status;
}

POSE_WALL_EXPORT int32_t pose_wall_image2_fill(const pose_wall_result* result, const pose_wall_image_source* source,
                                               pose_wall_image2* image) {
  if (result == nullptr || image == nullptr) return POSE_WALL_E_NULL;
  pose_wall_result whole;
  std::int32_t status = image_status(*result, image->struct_size, sizeof(*image), &whole);
  if (status == POSE_WALL_OK && source != nullptr) {
    status = check_struct_size(source->struct_size, kSourceSizes);
  }
  if (status != POSE_WALL_OK) return status;
  const auto told =
      source == nullptr ? source_of(whole) : read_struct<pose_wall_image_source>(source, source->struct_size);
  fill_image(whole, told, image);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_image_check(const pose_wall_image* image) {
  return check_image(image, POSE_WALL_IMAGE_VERSION, &pose_wall_image::crc32, kCrcIeee);
}

POSE_WALL_EXPORT int32_t pose_wall_image2_check(const pose_wall_image2* image) {
  return check_image(image, POSE_WALL_IMAGE2_VERSION, &pose_wall_image2::crc32c, kCrcCastagnoli);
}

}  // extern "C"

}  // namespace pose_wall
