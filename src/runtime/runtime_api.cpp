// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// extern "C": checks arguments, translates, calls.

#include <new>

#include "box_layout.hpp"
#include "options.hpp"
#include "pose_wall_runtime.h"
#include "runtime.hpp"
#include "runtime_export.hpp"
#include "status.hpp"

using pose_wall::runtime::ok_if;
using pose_wall::runtime::Runtime;

namespace {

bool is_aligned(const void* block) {
  return reinterpret_cast<std::uintptr_t>(block) % POSE_WALL_BLOCK_ALIGNMENT == 0;
}

Runtime* runtime_of(pose_wall_runtime* handle) {
  return reinterpret_cast<Runtime*>(handle);
}
// Reading takes a lock, which is no change that a caller could see.
Runtime* runtime_of(const pose_wall_runtime* handle) {
  return reinterpret_cast<Runtime*>(const_cast<pose_wall_runtime*>(handle));
}

int32_t check(const pose_wall_runtime* handle) {
  if (handle == nullptr) return POSE_WALL_E_NULL;
  return ok_if(runtime_of(handle)->is_open(), POSE_WALL_RUNTIME_E_HANDLE);
}

// The engine's own need, once all else was found good.
int32_t engine_bytes(const pose_wall_config* config, const pose_wall_runtime_options* options, uint64_t* bytes) {
  if (config == nullptr || options == nullptr) return POSE_WALL_E_NULL;
  const int32_t status = pose_wall::runtime::check_options(*options, nullptr);
  return status == POSE_WALL_OK ? pose_wall_memory_needed(config, bytes) : status;
}

}  // namespace

extern "C" {

POSE_WALL_EXPORT uint32_t pose_wall_runtime_abi_version(void) {
  return POSE_WALL_RUNTIME_ABI_VERSION;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_options_init(pose_wall_runtime_options* options) {
  if (options == nullptr) return POSE_WALL_E_NULL;
  pose_wall::runtime::set_defaults(options);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_options_check(const pose_wall_runtime_options* options,
                                                         const char** option) {
  return options != nullptr ? pose_wall::runtime::check_options(*options, option) : POSE_WALL_E_NULL;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_memory_needed(const pose_wall_config* config,
                                                         const pose_wall_runtime_options* options, uint64_t* bytes) {
  if (bytes == nullptr) return POSE_WALL_E_NULL;
  uint64_t of_engine = 0;
  const int32_t status = engine_bytes(config, options, &of_engine);
  if (status == POSE_WALL_OK) *bytes = Runtime::lay_out(nullptr, of_engine, *options, nullptr);
  return status;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_open(const pose_wall_config* config,
                                                const pose_wall_runtime_options* options, void* block,
                                                uint64_t block_bytes, pose_wall_runtime** runtime) {
  if (block == nullptr || runtime == nullptr) return POSE_WALL_E_NULL;
  uint64_t of_engine = 0;
  int32_t status = engine_bytes(config, options, &of_engine);
  if (status != POSE_WALL_OK) return status;
  if (!is_aligned(block)) return POSE_WALL_E_BLOCK_ALIGN;
  const uint64_t needed = Runtime::lay_out(nullptr, of_engine, *options, nullptr);
  if (block_bytes < needed) return POSE_WALL_E_BLOCK_SMALL;
  Runtime* const placed = new (block) Runtime(*config, *options);
  Runtime::lay_out(block, of_engine, *options, placed);
  status = placed->open(needed);
  if (status == POSE_WALL_OK) *runtime = reinterpret_cast<pose_wall_runtime*>(placed);
  return status;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_start(pose_wall_runtime* runtime) {
  const int32_t status = check(runtime);
  return status == POSE_WALL_OK ? runtime_of(runtime)->start() : status;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_wait_idle(pose_wall_runtime* runtime) {
  const int32_t status = check(runtime);
  return status == POSE_WALL_OK ? runtime_of(runtime)->wait_idle() : status;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_request_stop(pose_wall_runtime* runtime) {
  const int32_t status = check(runtime);
  return status == POSE_WALL_OK ? runtime_of(runtime)->request_stop() : status;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_stop(pose_wall_runtime* runtime) {
  const int32_t status = check(runtime);
  return status == POSE_WALL_OK ? runtime_of(runtime)->stop() : status;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_close(pose_wall_runtime* runtime) {
  const int32_t status = check(runtime);
  return status == POSE_WALL_OK ? runtime_of(runtime)->close() : status;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_push(pose_wall_runtime* runtime, const pose_wall_cloud* cloud) {
  if (cloud == nullptr) return POSE_WALL_E_NULL;
  const int32_t status = check(runtime);
  return status == POSE_WALL_OK ? runtime_of(runtime)->push(*cloud) : status;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_latest(const pose_wall_runtime* runtime,
                                                  pose_wall_publication* publication) {
  if (publication == nullptr) return POSE_WALL_E_NULL;
  const int32_t status = check(runtime);
  if (status != POSE_WALL_OK) return status;
  if (publication->struct_size != sizeof(*publication)) return POSE_WALL_E_STRUCT_SIZE;
  return runtime_of(runtime)->latest(publication);
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_tick(pose_wall_runtime* runtime) {
  const int32_t status = check(runtime);
  return status == POSE_WALL_OK ? runtime_of(runtime)->tick() : status;
}

POSE_WALL_EXPORT int32_t pose_wall_runtime_statistics_now(const pose_wall_runtime* runtime,
                                                          pose_wall_runtime_statistics* statistics) {
  if (statistics == nullptr) return POSE_WALL_E_NULL;
  const int32_t status = check(runtime);
  if (status != POSE_WALL_OK) return status;
  if (statistics->struct_size != sizeof(*statistics)) return POSE_WALL_E_STRUCT_SIZE;
  runtime_of(runtime)->statistics(statistics);
  return POSE_WALL_OK;
}

}  // extern "C"
