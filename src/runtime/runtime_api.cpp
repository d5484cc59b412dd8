// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// extern "C": checks arguments, translates, calls.

#include <new>

#include "base/containers/arena.hpp"
#include "box_layout.hpp"
#include "options.hpp"
#include "part/export.hpp"
#include "part/status.hpp"
#include "pose_wall_runtime.h"
#include "runtime.hpp"
#include "struct_versions.hpp"

namespace pose_wall::runtime {
namespace {

constexpr const char* kActivities[POSE_WALL_RUNTIME_ACTIVITIES] = {"nothing", "wait",    "choice",
                                                                   "frame",   "silence", "callback"};
constexpr const char* kDrops[POSE_WALL_RUNTIME_DROPS] = {"description", "large",  "busy", "overtaken",
                                                         "stopped",     "engine", "late"};

// Reading takes a lock, which is no change that a caller could see.
template <typename Call>
int32_t with_runtime(const pose_wall_runtime* handle, const Call& call) {
  if (handle == nullptr) return POSE_WALL_E_NULL;
  Runtime* const runtime = reinterpret_cast<Runtime*>(const_cast<pose_wall_runtime*>(handle));
  return runtime->is_open() ? call(*runtime) : POSE_WALL_RUNTIME_E_HANDLE;
}

// The memory of engine and motion, after all other checks; and the options as this version reads them.
int32_t inner_bytes(const pose_wall_config* config, const pose_wall_runtime_options* options,
                    pose_wall_runtime_options* whole, InnerBytes* bytes) {
  if (config == nullptr) return POSE_WALL_E_NULL;
  int32_t status = POSE_WALL_OK;
  if (options == nullptr) {
    set_defaults(whole);
  } else {
    status = read_options(*options, nullptr, whole);
  }
  if (status == POSE_WALL_OK) status = pose_wall_memory_needed(config, &bytes->engine);
  if (status != POSE_WALL_OK) return status;
  const bool moves = whole->motion != nullptr && config_wants_motion(*config);
  bytes->motion = moves ? whole->motion->memory_needed() : 0;
  return POSE_WALL_OK;
}

}  // namespace

extern "C" {

POSE_WALL_EXPORT uint32_t pose_wall_runtime_abi_version(void) {
  return POSE_WALL_RUNTIME_ABI_VERSION;
}

POSE_WALL_EXPORT const char* pose_wall_runtime_status_text(int32_t status) {
  return pose_wall_status_text(status);
}

POSE_WALL_EXPORT const char* pose_wall_runtime_activity_name(uint32_t activity) {
  return activity < POSE_WALL_RUNTIME_ACTIVITIES ? kActivities[activity] : "unknown";
}

POSE_WALL_EXPORT const char* pose_wall_runtime_drop_name(uint32_t drop) {
  return drop < POSE_WALL_RUNTIME_DROPS ? kDrops[drop] : "unknown";
}

#undef pose_wall_runtime_options_init
POSE_WALL_EXPORT int32_t pose_wall_runtime_options_init(pose_wall_runtime_options* /*options*/) {
  return POSE_WALL_E_ABI;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_options_init_3(pose_wall_runtime_options* options) {
  if (options == nullptr) return POSE_WALL_E_NULL;
  set_defaults(options);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_options_check(const pose_wall_runtime_options* options,
                                                         const char** option) {
  pose_wall_runtime_options whole;
  return options != nullptr ? read_options(*options, option, &whole) : POSE_WALL_E_NULL;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_memory_needed(const pose_wall_config* config,
                                                         const pose_wall_runtime_options* options, uint64_t* bytes) {
  if (bytes == nullptr) return POSE_WALL_E_NULL;
  InnerBytes inner;
  pose_wall_runtime_options whole;
  const int32_t status = inner_bytes(config, options, &whole, &inner);
  if (status == POSE_WALL_OK) *bytes = Runtime::lay_out(nullptr, inner, whole, nullptr);
  return status;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_open(const pose_wall_config* config,
                                                const pose_wall_runtime_options* options, void* block,
                                                uint64_t block_bytes, pose_wall_runtime** runtime) {
  if (block == nullptr || runtime == nullptr) return POSE_WALL_E_NULL;
  InnerBytes inner;
  pose_wall_runtime_options whole;
  int32_t status = inner_bytes(config, options, &whole, &inner);
  if (status != POSE_WALL_OK) return status;
  if (!is_aligned(block)) return POSE_WALL_E_BLOCK_ALIGN;
  const uint64_t needed = Runtime::lay_out(nullptr, inner, whole, nullptr);
  if (block_bytes < needed) return POSE_WALL_E_BLOCK_SMALL;
  if (Runtime::is_started_in(block)) return POSE_WALL_E_BUSY;
  Runtime* const placed = new (block) Runtime(*config, whole);
  Runtime::lay_out(block, inner, whole, placed);
  status = placed->open(needed);
  if (status == POSE_WALL_OK) *runtime = reinterpret_cast<pose_wall_runtime*>(placed);
  return status;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_start(pose_wall_runtime* runtime) {
  return with_runtime(runtime, [&](Runtime& own) { return own.start(); });
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_wait_idle(pose_wall_runtime* runtime) {
  return with_runtime(runtime, [&](Runtime& own) { return own.wait_idle(); });
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_request_stop(pose_wall_runtime* runtime) {
  return with_runtime(runtime, [&](Runtime& own) { return own.request_stop(); });
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_stop(pose_wall_runtime* runtime) {
  return with_runtime(runtime, [&](Runtime& own) { return own.stop(); });
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_close(pose_wall_runtime* runtime) {
  return with_runtime(runtime, [&](Runtime& own) { return own.close(); });
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_save(pose_wall_runtime* runtime, const pose_wall_moment* now, void* memento,
                                                uint64_t bytes) {
  if (memento == nullptr) return POSE_WALL_E_NULL;
  return with_runtime(runtime, [&](Runtime& own) { return own.save(now, memento, bytes); });
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_last_points(const pose_wall_runtime* runtime, pose_wall_points* points) {
  if (points == nullptr) return POSE_WALL_E_NULL;
  return with_runtime(runtime, [&](Runtime& own) { return own.last_points(points); });
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_load(pose_wall_runtime* runtime, const pose_wall_moment* now,
                                                const void* memento, uint64_t bytes) {
  if (memento == nullptr) return POSE_WALL_E_NULL;
  return with_runtime(runtime, [&](Runtime& own) { return own.load(now, memento, bytes); });
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_push(pose_wall_runtime* runtime, const pose_wall_cloud* cloud) {
  if (cloud == nullptr) return POSE_WALL_E_NULL;
  return with_runtime(runtime, [&](Runtime& own) { return own.push(*cloud); });
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_latest(const pose_wall_runtime* runtime,
                                                  pose_wall_publication* publication) {
  if (publication == nullptr) return POSE_WALL_E_NULL;
  return with_runtime(runtime, [&](Runtime& own) {
    const uint32_t size = publication->struct_size;
    int32_t status = check_struct_size(size, kPublicationSizes);
    if (status != POSE_WALL_OK) return status;
    pose_wall_publication whole;
    status = own.latest(&whole);
    write_publication(whole, size, publication);
    return status;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_image(const pose_wall_runtime* runtime, pose_wall_image* image) {
  if (image == nullptr) return POSE_WALL_E_NULL;
  return with_runtime(runtime, [&](Runtime& own) { return own.image(image); });
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_image2(const pose_wall_runtime* runtime, pose_wall_image2* image) {
  if (image == nullptr) return POSE_WALL_E_NULL;
  return with_runtime(runtime, [&](Runtime& own) { return own.image2(image); });
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_motion_image(const pose_wall_runtime* runtime,
                                                        pose_wall_motion_image* image) {
  if (image == nullptr) return POSE_WALL_E_NULL;
  return with_runtime(runtime, [&](Runtime& own) { return own.motion_image(image); });
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_tick(pose_wall_runtime* runtime) {
  return with_runtime(runtime, [&](Runtime& own) { return own.tick(); });
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_statistics_now(const pose_wall_runtime* runtime,
                                                          pose_wall_runtime_statistics* statistics) {
  if (statistics == nullptr) return POSE_WALL_E_NULL;
  return with_runtime(runtime, [&](Runtime& own) {
    const uint32_t size = statistics->struct_size;
    const int32_t status = check_struct_size(size, kStatisticsSizes);
    if (status != POSE_WALL_OK) return status;
    pose_wall_runtime_statistics whole;
    own.statistics(&whole);
    write_struct(whole, size, statistics);
    return status;
  });
}

}  // extern "C"

}  // namespace pose_wall::runtime
