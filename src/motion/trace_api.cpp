// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/gates.hpp"
#include "motion/trace.hpp"
#include "part/export.hpp"
#include "pose_wall_motion_trace.h"

namespace {

using pose_wall::GateSense;
namespace trace = pose_wall::motion::trace;

constexpr const char* sense_name(GateSense sense) {
  switch (sense) {
    case GateSense::AT_LEAST:
      return "at least";
    case GateSense::AT_MOST:
      return "at most";
    case GateSense::ABOVE:
      return "above";
    case GateSense::BELOW:
      return "below";
    default:
      return "is so";
  }
}

#define GATE(id, name, sense, limit, unit, origin, asks) \
  {name, sense_name(GateSense::sense), #limit, unit, origin, asks},
constexpr pose_wall_motion_trace_info kGates[] = {
#include "motion/gates.def"
};
#undef GATE
static_assert(pose_wall::motion::gate::kCount == POSE_WALL_MOTION_TRACE_GATES, "gates.def and the header differ");

}  // namespace

extern "C" {

POSE_WALL_EXPORT int32_t pose_wall_motion_trace_gate_info(uint32_t gate, pose_wall_motion_trace_info* info) {
  if (info == nullptr) return POSE_WALL_E_NULL;
  if (gate >= POSE_WALL_MOTION_TRACE_GATES) return POSE_WALL_E_INDEX;
  *info = kGates[gate];
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_motion_trace_set_limit(uint32_t gate, double limit) {
  constexpr double kMost = 1e9;  // a limit of counts is held as 32 bits
  if (gate >= POSE_WALL_MOTION_TRACE_GATES) return POSE_WALL_E_INDEX;
  if (!(limit >= 0.0 && limit <= kMost)) return POSE_WALL_E_VALUE_RANGE;
  trace::set_limit(gate, limit);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_motion_trace_let_pass(uint32_t gate) {
  if (gate >= POSE_WALL_MOTION_TRACE_GATES) return POSE_WALL_E_INDEX;
  trace::let_pass(gate);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT void pose_wall_motion_trace_forget_limits(void) {
  trace::forget_limits();
}

POSE_WALL_EXPORT int32_t pose_wall_motion_trace_open(const pose_wall_config* config,
                                                     const pose_wall_motion_settings* settings, void* block,
                                                     uint64_t block_bytes, pose_wall_motion** motion) {
  return pose_wall_motion_open(config, settings, block, block_bytes, motion);
}

POSE_WALL_EXPORT int32_t pose_wall_motion_trace_frame(pose_wall_motion* motion, const pose_wall_cloud* cloud,
                                                      pose_wall_motion_result* result, pose_wall_motion_trace* trace) {
  if (trace == nullptr) return POSE_WALL_E_NULL;
  *trace = pose_wall_motion_trace{};
  trace::write_to(trace);
  const std::int32_t status = pose_wall_motion_process(motion, cloud, result);
  trace::write_to(nullptr);
  return status;
}

}  // extern "C"
