// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <cstring>

#include "engine/trace/trace.hpp"
#include "pose_wall.h"
#include "pose_wall_trace.h"

namespace pose_wall::trace {
namespace {

#define GATE(id, name, sense, limit, unit, key, effect, reasons, origin, asks) \
  {name, key, unit, asks, #limit, origin, POSE_WALL_TRACE_##sense, POSE_WALL_TRACE_##effect, reasons, 0},
constexpr pose_wall_trace_info kGates[] = {
#include "engine/gates/gates.def"
};
#undef GATE
static_assert(sizeof kGates / sizeof kGates[0] == POSE_WALL_TRACE_GATES, "gates.def and pose_wall_trace.h differ");

#define GATE(id, ...) POSE_WALL_TRACE_##id,
// The numbers of the rows, in their order.
constexpr std::uint32_t kIds[] = {
#include "engine/gates/gates.def"
};
#undef GATE

constexpr bool in_order() {
  for (std::uint32_t i = 0; i < POSE_WALL_TRACE_GATES; ++i) {
    if (kIds[i] != i) return false;
  }
  return true;
}
static_assert(in_order(), "gates.def is in another order than pose_wall_trace.h");

// The frame's stamp is of the memento's clock: it is computed again.
constexpr pose_wall_moment kSameClock = {sizeof(pose_wall_moment), POSE_WALL_MOMENT_SAME_CLOCK, {}, 0, 0};

std::int32_t open(const pose_wall_config* config, const void* memento, std::uint64_t memento_bytes, void* block,
                  std::uint64_t block_bytes, pose_wall_engine** engine) {
  const std::int32_t status = pose_wall_open(config, block, block_bytes, engine);
  if (status != POSE_WALL_OK || memento == nullptr) return status;
  return pose_wall_load(*engine, &kSameClock, memento, memento_bytes);
}

}  // namespace
}  // namespace pose_wall::trace

extern "C" {

__attribute__((visibility("default"))) int32_t pose_wall_trace_gate_info(uint32_t gate, pose_wall_trace_info* info) {
  if (info == nullptr) return POSE_WALL_E_NULL;
  if (gate >= POSE_WALL_TRACE_GATES) return POSE_WALL_E_INDEX;
  *info = pose_wall::trace::kGates[gate];
  return POSE_WALL_OK;
}

__attribute__((visibility("default"))) int32_t pose_wall_trace_set_limit(uint32_t gate, double limit) {
  if (gate >= POSE_WALL_TRACE_GATES) return POSE_WALL_E_INDEX;
  pose_wall::trace::set_limit(gate, limit);
  return POSE_WALL_OK;
}

__attribute__((visibility("default"))) int32_t pose_wall_trace_let_pass(uint32_t gate) {
  if (gate >= POSE_WALL_TRACE_GATES) return POSE_WALL_E_INDEX;
  if (gate == POSE_WALL_TRACE_FLOOR_PLANES) return POSE_WALL_E_VALUE_RANGE;
  pose_wall::trace::let_pass(gate);
  return POSE_WALL_OK;
}

__attribute__((visibility("default"))) void pose_wall_trace_forget_limits(void) {
  pose_wall::trace::forget_limits();
}

__attribute__((visibility("default"))) int32_t pose_wall_trace_frame(const pose_wall_config* config,
                                                                     const void* memento, uint64_t memento_bytes,
                                                                     const pose_wall_cloud* cloud, void* block,
                                                                     uint64_t block_bytes, pose_wall_result* result,
                                                                     pose_wall_trace* trace) {
  if (trace == nullptr) return POSE_WALL_E_NULL;
  *trace = pose_wall_trace{};
  pose_wall_engine* engine = nullptr;
  int32_t status = pose_wall::trace::open(config, memento, memento_bytes, block, block_bytes, &engine);
  if (status != POSE_WALL_OK) return status;
  pose_wall::trace::write_to(trace);
  status = pose_wall_process(engine, cloud, result);
  pose_wall::trace::write_to(nullptr);
  return status;
}

// An engine begins its block.
__attribute__((visibility("default"))) int32_t pose_wall_trace_save(const void* block, void* memento,
                                                                    uint64_t memento_bytes) {
  return pose_wall_save(static_cast<const pose_wall_engine*>(block), &pose_wall::trace::kSameClock, memento,
                        memento_bytes);
}

}  // extern "C"
