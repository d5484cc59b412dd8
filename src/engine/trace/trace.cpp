// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/trace/trace.hpp"

#include "base/gates/overrides.hpp"

namespace pose_wall::trace {
namespace {

struct Writer {
  pose_wall_trace* to;
  std::uint32_t subject;
  std::uint32_t attempt;
  bool floor_taken;
  bool silent;
  pose_wall_trace_candidate* last;
};

// The stages are free functions of their arguments, and notes must change none of these.
thread_local Writer writer = {nullptr, 0, 0, false, false, nullptr};

GateOverrides<POSE_WALL_TRACE_GATES> overrides;

// Used if there is no room or no trace.
thread_local pose_wall_trace_candidate nowhere;

}  // namespace

void write_to(pose_wall_trace* trace) {
  writer = {trace, POSE_WALL_TRACE_FRAME, 0, false, false, nullptr};
}

std::uint32_t subject(std::uint32_t subject) {
  const std::uint32_t before = writer.subject;
  writer.subject = subject;
  return before;
}

Silence::Silence() : before_(writer.silent) {
  writer.silent = true;
}

Silence::~Silence() {
  writer.silent = before_;
}

void attempt(std::uint32_t attempt) {
  writer.attempt = attempt;
}

void note_gate(std::uint32_t id, double value, double limit, bool passed) {
  if (writer.to == nullptr) return;
  static_assert(POSE_WALL_TRACE_GATES <= 128, "failed has a bit for each gate");
  if (!passed) writer.to->failed[id / 64] |= 1ULL << id % 64;
  if (writer.silent) return;
  if (writer.to->gates == POSE_WALL_TRACE_GATES_MAX) {
    ++writer.to->dropped;
    return;
  }
  const bool of_floor_taken = writer.subject == POSE_WALL_TRACE_FLOOR && writer.floor_taken;
  const std::uint32_t attempt = of_floor_taken ? writer.to->floor_attempt : writer.attempt;
  writer.to->gate[writer.to->gates++] = {writer.subject, id, attempt, passed ? 1U : 0U, value, limit};
}

void answered(std::uint32_t effect) {
  if (writer.to == nullptr) return;
  for (std::uint32_t i = 0; i < writer.to->gates; ++i) {
    pose_wall_trace_gate& g = writer.to->gate[i];
    pose_wall_trace_info info{};
    pose_wall_trace_gate_info(g.gate, &info);
    const bool counts = g.subject == writer.subject && info.effect == effect;
    if (counts && g.passed == POSE_WALL_TRACE_FAILED) g.passed = POSE_WALL_TRACE_ANSWERED;
  }
}

void set_limit(std::uint32_t id, double limit) {
  overrides.set(id, limit);
}

void let_pass(std::uint32_t id) {
  overrides.let_pass(id);
}

bool lets_pass(std::uint32_t id) {
  return overrides.lets_pass(id);
}

void forget_limits() {
  overrides.forget();
}

double limit_or(std::uint32_t id, double of_table) {
  return overrides.limit_or(id, of_table);
}

void floor_radius(std::uint32_t attempt, double radius_m) {
  writer.attempt = attempt;
  writer.subject = POSE_WALL_TRACE_FLOOR;
  if (writer.to == nullptr || attempt >= POSE_WALL_TRACE_ATTEMPTS_MAX) return;
  writer.to->floor_radius_m[attempt] = radius_m;
  writer.to->floor_attempts = attempt + 1;
}

void floor_attempt_taken(std::uint32_t attempt) {
  writer.attempt = 0;
  writer.floor_taken = true;  // all later notes on the floor belong to this one
  if (writer.to != nullptr) writer.to->floor_attempt = attempt;
}

pose_wall_trace_candidate* candidate(pose_wall_trace_fate fate, const Plane& plane) {
  pose_wall_trace_candidate* out = &nowhere;
  if (writer.to != nullptr && writer.to->candidates < POSE_WALL_TRACE_CANDIDATES_MAX) {
    out = &writer.to->candidate[writer.to->candidates++];
  } else if (writer.to != nullptr) {
    ++writer.to->dropped;
  }
  *out = pose_wall_trace_candidate{};
  writer.last = out;
  out->subject = writer.subject;
  out->attempt = writer.attempt;
  out->fate = fate;
  for (int k = 0; k < 3; ++k) out->normal[k] = plane.n[k];
  out->d_m = plane.d;
  return out;
}

void refined(pose_wall_trace_fate fate, const Plane& plane) {
  if (writer.last == nullptr) return;
  writer.last->fate = fate;
  for (int k = 0; k < 3; ++k) writer.last->normal[k] = plane.n[k];
  writer.last->d_m = plane.d;
}

pose_wall_trace_candidate* noted(const Plane& plane) {
  if (writer.to == nullptr) return nullptr;
  for (std::uint32_t i = writer.to->candidates; i-- > 0;) {
    pose_wall_trace_candidate* const c = &writer.to->candidate[i];
    const bool same = c->d_m == plane.d && c->normal[0] == plane.n.x() && c->normal[1] == plane.n.y();
    if (same && c->subject == writer.subject && c->attempt == writer.attempt) return c;
  }
  return nullptr;
}

void fate(const Plane& plane, pose_wall_trace_fate fate) {
  if (pose_wall_trace_candidate* const c = noted(plane)) c->fate = fate;
}

}  // namespace pose_wall::trace
