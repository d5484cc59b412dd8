// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What the traced library notes of planes that may be walls. Nothing in the engine that is delivered.

#pragma once

#include "trace/trace.hpp"

#ifdef POSE_WALL_TRACE

#include "walls/choose/choose.hpp"
#include "walls/propose/search.hpp"
#include "walls/scene.hpp"

namespace pose_wall {

inline std::uint32_t subject_of(const WallScene& scene, const SideView& view) {
  const double left = view.side_level.dot(scene.left_level), ahead = view.side_level.dot(scene.forward_level);
  if (left * left > 0.5) return left > 0.0 ? POSE_WALL_TRACE_LEFT : POSE_WALL_TRACE_RIGHT;
  return ahead > 0.0 ? POSE_WALL_TRACE_AHEAD : POSE_WALL_TRACE_BEHIND;
}

// Before it is refined: what comes to nothing stays so.
inline void note_drawn_wall(const Plane& plane) {
  trace::candidate(POSE_WALL_TRACE_UNSUPPORTED, plane);
}

// The one that was noted last, refined, and what it is if it does not go on from here.
inline void note_refined_wall(const Plane& plane, pose_wall_trace_fate fate) {
  trace::refined(fate, plane);
}

inline void note_weighed_wall(const WallCandidate& c) {
  pose_wall_trace_candidate* const noted = trace::noted(c.plane);
  if (noted == nullptr) return;
  noted->fate = c.faults != 0 ? POSE_WALL_TRACE_GATES_FAILED : POSE_WALL_TRACE_WEAKER;
  noted->reasons = c.faults;
  noted->tilt_rad = lean_of(c.plane);
  noted->score_m2 = c.evidence.score_m2;
  noted->area_m2 = c.evidence.area_m2;
  noted->length_m = c.evidence.length_m;
  noted->seen_through = c.evidence.seen_through;
  noted->inliers = c.evidence.inliers;
}

inline void note_chosen(const WallCandidate& c, const WallChoice& choice, int side) {
  if (choice.side[side] != nullptr && c.plane.d == choice.side[side]->plane.d) {
    trace::fate(c.plane, POSE_WALL_TRACE_CHOSEN);
  }
  if (choice.rival[side] != nullptr && c.plane.d == choice.rival[side]->plane.d) {
    trace::fate(c.plane, POSE_WALL_TRACE_RIVAL);
  }
}

}  // namespace pose_wall

#endif
