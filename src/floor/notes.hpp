// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What the traced library notes of planes that may be the floor. Nothing in the engine that is delivered.

#pragma once

#include "trace/trace.hpp"

#ifdef POSE_WALL_TRACE

#include <cmath>

#include "base/containers/span.hpp"
#include "base/containers/work.hpp"
#include "base/estimation/irls.hpp"
#include "base/estimation/mlesac.hpp"
#include "base/math/elementary.hpp"
#include "base/math/rotation.hpp"
#include "config.hpp"
#include "floor/search.hpp"
#include "types.hpp"

namespace pose_wall {

inline void note_floor_plane(const Plane& plane, pose_wall_trace_fate fate, double support,
                             const Eigen::Vector3d& sensor_base_m) {
  pose_wall_trace_candidate* const noted = trace::candidate(fate, plane);
  noted->height_m = plane.signed_distance(sensor_base_m);
  noted->tilt_rad = tilt_of_up(plane.n);
  noted->support = support;
}

// Weaker, until more is known of it.
inline void note_refined_floor(const IrlsResult& refined, double support, const Settings& s,
                               const Eigen::Vector3d& sensor_base_m) {
  pose_wall_trace_fate fate = POSE_WALL_TRACE_WEAKER;
  if (!may_be_floor(refined.plane, FloorLimits(s), sensor_base_m)) fate = POSE_WALL_TRACE_OUT_OF_RANGE;
  if (!refined.solved) fate = POSE_WALL_TRACE_UNSUPPORTED;
  note_floor_plane(refined.plane, fate, support, sensor_base_m);
}

template <typename Candidate>
void note_floor_choice(Span<const Candidate> candidates, const Candidate* best) {
  std::uint32_t plausible = 0;
  for (const Candidate& c : candidates) {
    plausible += c.ghost ? 0U : 1U;
    pose_wall_trace_candidate* const noted = trace::noted(c.plane);
    if (noted == nullptr) continue;
    noted->fate = c.ghost ? POSE_WALL_TRACE_REFLECTION : POSE_WALL_TRACE_WEAKER;
    if (&c == best) noted->fate = POSE_WALL_TRACE_CHOSEN;
    noted->score_m2 = c.evidence.score_m2;
    noted->area_m2 = c.evidence.area_m2;
  }
  trace::gate(POSE_WALL_TRACE_FLOOR_PLANES, plausible, 1.0, best != nullptr);
}

// attempt: the radius that was taken.
inline void note_floor_unfinished(const Work& work, std::uint32_t attempt) {
  trace::attempt(attempt);
  trace::gate_of(POSE_WALL_TRACE_FLOOR, POSE_WALL_TRACE_WORK, static_cast<double>(work.done()),
                 static_cast<double>(work.most()), false);
  trace::attempt(0);
}

// What the fit has to hold: as may_be_floor and same_floor say, one by one.
inline void note_floor_gates(const Settings& s, const Eigen::Vector3d& sensor_base_m, const Plane& start,
                             const PlaneFit& fit) {
  const double height_m = fit.plane.signed_distance(sensor_base_m);
  trace::gate(POSE_WALL_TRACE_FLOOR_TILT, tilt_of_up(fit.plane.n), radians(s.ground_tilt_max_deg),
              fit.plane.n.z() >= cosine(radians(s.ground_tilt_max_deg)));
  trace::gate(POSE_WALL_TRACE_FLOOR_HEIGHT_MIN, height_m, s.ground_height_min, height_m >= s.ground_height_min);
  trace::gate(POSE_WALL_TRACE_FLOOR_HEIGHT_MAX, height_m, s.ground_height_max, height_m <= s.ground_height_max);
  trace::gate(POSE_WALL_TRACE_FLOOR_STAYED, same_floor(fit.plane, start));
  trace::gate(POSE_WALL_TRACE_FLOOR_INLIERS, fit.inliers, s.ground_inlier_min, fit.inliers >= s.ground_inlier_min);
}

// Of the planes that were drawn and lie too high, too low or too steep, those that explain most: what else may have
// been the floor.
class BestOutside {
 public:
  BestOutside(const PointSet& subset, const Settings& settings, const Eigen::Vector3d& sensor_base_m)
      : subset_(subset), settings_(settings), sensor_base_m_(sensor_base_m) {}

  void offer(const Plane& plane) {
    constexpr double kSteepest_rad = 1.05;  // what is steeper is a wall
    if (may_be_floor(plane, FloorLimits(settings_), sensor_base_m_) || tilt_of_up(plane.n) > kSteepest_rad) return;
    const bool steep = tilt_of_up(plane.n) > radians(settings_.ground_tilt_max_deg);
    Hypothesis& best = steep ? steep_ : displaced_;
    const double cost = truncated_cost(subset_, plane, settings_.ground_ransac_thresh, best.cost);
    if (cost < best.cost) best = {plane, cost};
  }

  void note() const {
    constexpr double kAnything = 0.9;  // what explains less is chance
    for (const Hypothesis* best : {&displaced_, &steep_}) {
      if (best->cost < kAnything) {
        note_floor_plane(best->plane, POSE_WALL_TRACE_OUT_OF_RANGE, 1.0 - best->cost, sensor_base_m_);
      }
    }
  }

 private:
  const PointSet& subset_;
  const Settings& settings_;
  const Eigen::Vector3d& sensor_base_m_;
  Hypothesis displaced_{Plane{}, 1.0}, steep_{Plane{}, 1.0};
};

}  // namespace pose_wall

#endif
