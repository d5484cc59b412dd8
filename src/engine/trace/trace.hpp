// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Notes on the reasons for a frame's result, of the traced library alone (base/gates/note.hpp).

#pragma once

#include "base/gates/note.hpp"

#ifdef POSE_WALL_TRACE
#include <cstdint>

#include "base/estimation/plane.hpp"
#include "pose_wall_trace.h"

namespace pose_wall::trace {

// On this thread, until NULL is given. Without a trace, notes are lost.
void write_to(pose_wall_trace* trace);

// Sets the subject of the following notes and returns the one before.
std::uint32_t subject(std::uint32_t subject);
// Sets the subject for its lifetime.
class About {
 public:
  explicit About(std::uint32_t about) : before_(subject(about)) {}
  ~About() { subject(before_); }

 private:
  std::uint32_t before_;
};
// While it lives gates judge without notes. Of many planes only those that count are judged again with notes.
class Silence {
 public:
  Silence();
  ~Silence();

 private:
  bool before_;
};

void note_gate(std::uint32_t id, double value, double limit, bool passed);
// Another plane took the place of the subject's. What failed with this effect (pose_wall_trace_effect) no longer
// counts.
void answered(std::uint32_t effect);
// The limit of this gate from pose_wall_trace_set_limit, or the table's.
double limit_or(std::uint32_t id, double of_table);
void set_limit(std::uint32_t id, double limit);
// True after let_pass: the gate judges, notes the outcome, and stops nothing.
bool lets_pass(std::uint32_t id);
void let_pass(std::uint32_t id);
void forget_limits();
// The following notes belong to this attempt; 0 at a frame's start.
void attempt(std::uint32_t attempt);
void floor_radius(std::uint32_t attempt, double radius_m);
void floor_attempt_taken(std::uint32_t attempt);

// The caller fills in the candidate's figures. The last one is the caller's until the next.
pose_wall_trace_candidate* candidate(pose_wall_trace_fate fate, const Plane& plane);
// Replaces the plane of the last candidate.
void refined(pose_wall_trace_fate fate, const Plane& plane);
// The note on a plane in this attempt, or nullptr.
pose_wall_trace_candidate* noted(const Plane& plane);
void fate(const Plane& plane, pose_wall_trace_fate fate);

inline std::uint32_t side_subject(int side) {
  return side == 0 ? POSE_WALL_TRACE_LEFT : POSE_WALL_TRACE_RIGHT;
}

}  // namespace pose_wall::trace
#endif
