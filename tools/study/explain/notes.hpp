// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Notes on a frame, by subject.

#pragma once

#include <cstdint>
#include <vector>

#include "pose_wall.h"
#include "pose_wall_trace.h"

namespace pose_wall::tools::explain {

struct Note {
  pose_wall_trace_gate gate;
  pose_wall_trace_info info;

  bool passed() const { return gate.passed == POSE_WALL_TRACE_PASSED; }
  // It failed on the endless plane, and the value is of the region's.
  bool answered() const { return gate.passed == POSE_WALL_TRACE_ANSWERED; }
  bool is(pose_wall_trace_gate_id id) const { return gate.gate == static_cast<std::uint32_t>(id); }
};

// In the order of the pipeline. Of the floor one radius counts: the one that was taken, or the widest where no plane
// was found in any. The trace must outlive it.
class Notes {
 public:
  explicit Notes(const pose_wall_trace& trace);

  std::vector<Note> all() const;
  std::vector<Note> of(std::uint32_t subject) const;
  // Failed notes of this effect (pose_wall_trace_effect), without those that were answered.
  std::vector<Note> failed(std::uint32_t subject, std::uint32_t effect) const;
  std::vector<Note> answered(std::uint32_t subject) const;
  bool refused(std::uint32_t subject) const { return !failed(subject, POSE_WALL_TRACE_REFUSES).empty(); }

  // Strongest first; of the floor those of the radius that counts.
  std::vector<pose_wall_trace_candidate> candidates(std::uint32_t subject) const;
  double floor_radius_m(std::uint32_t attempt) const { return trace_->floor_radius_m[attempt]; }
  std::uint32_t floor_attempt() const { return floor_attempt_; }
  std::uint32_t floor_attempts() const { return trace_->floor_attempts; }
  std::uint32_t dropped() const { return trace_->dropped; }

 private:
  bool counts(const pose_wall_trace_gate& gate) const;

  const pose_wall_trace* trace_;
  std::uint32_t floor_attempt_;
};

}  // namespace pose_wall::tools::explain
