// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/trace.hpp"

#include "base/gates/overrides.hpp"

namespace pose_wall::motion::trace {
namespace {

// The stages are free functions of their arguments, and notes must change none of these.
thread_local pose_wall_motion_trace* writer = nullptr;

GateOverrides<POSE_WALL_MOTION_TRACE_GATES> overrides;

}  // namespace

void write_to(pose_wall_motion_trace* frame) {
  writer = frame;
}

void note_gate(std::uint32_t id, bool passed) {
  if (writer == nullptr) return;
  ++writer->asked[id];
  if (!passed) ++writer->failed[id];
}

double limit_or(std::uint32_t id, double of_table) {
  return overrides.limit_or(id, of_table);
}

void set_limit(std::uint32_t id, double limit) {
  overrides.set(id, limit);
}

bool lets_pass(std::uint32_t id) {
  return overrides.lets_pass(id);
}

void let_pass(std::uint32_t id) {
  overrides.let_pass(id);
}

void forget_limits() {
  overrides.forget();
}

}  // namespace pose_wall::motion::trace
