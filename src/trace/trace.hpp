// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Notes on why a frame comes out as it does. Only the traced library takes them (POSE_WALL_TRACE); in the engine that
// is delivered a note is nothing at all: not even its arguments are computed. No note changes what is computed.

#pragma once

#ifdef POSE_WALL_TRACE
#define POSE_WALL_NOTE(...) __VA_ARGS__

#include <cstdint>

#include "base/estimation/plane.hpp"
#include "pose_wall_trace.h"

namespace pose_wall::trace {

// On this thread, until NULL is given; without one, notes are lost.
void write_to(pose_wall_trace* trace);

// What the notes that follow are about. Returns what they were about before.
std::uint32_t subject(std::uint32_t subject);
// The same while it lives.
class About {
 public:
  explicit About(std::uint32_t about) : before_(subject(about)) {}
  ~About() { subject(before_); }

 private:
  std::uint32_t before_;
};
// While it lives gates judge and are not noted: of many planes that are asked alike, those that count are asked again.
class Silence {
 public:
  Silence();
  ~Silence();

 private:
  bool before_;
};

void note_gate(std::uint32_t id, double value, double limit, bool passed);
// The limit that pose_wall_trace_set_limit gave this gate, or the one of the table.
double limit_or(std::uint32_t id, double of_table);
void set_limit(std::uint32_t id, double limit);
void forget_limits();
// Notes that follow are of this attempt; 0 at a frame's start.
void attempt(std::uint32_t attempt);
void floor_radius(std::uint32_t attempt, double radius_m);
void floor_attempt_taken(std::uint32_t attempt);

// The caller fills in what it knows of the candidate; the last one is the caller's until the next.
pose_wall_trace_candidate* candidate(pose_wall_trace_fate fate, const Plane& plane);
// The last one is this plane now.
void refined(pose_wall_trace_fate fate, const Plane& plane);
// What was noted of a plane in this attempt; nullptr if nothing was.
pose_wall_trace_candidate* noted(const Plane& plane);
void fate(const Plane& plane, pose_wall_trace_fate fate);

inline std::uint32_t side_subject(int side) {
  return side == 0 ? POSE_WALL_TRACE_LEFT : POSE_WALL_TRACE_RIGHT;
}

}  // namespace pose_wall::trace

#else
#define POSE_WALL_NOTE(...) static_cast<void>(0)
#endif
