// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "walls/doubts/doubts.hpp"

#include <cmath>

#include "base/math/elementary.hpp"
#include "base/math/larger.hpp"
#include "trace/trace.hpp"

namespace pose_wall {
namespace {

constexpr double kRivalStretch = 1.05;
constexpr double kRivalMargin_m = 0.03;
constexpr double kSilentMax = 0.025;
constexpr double kOpenDoubt = 0.01;
constexpr double kOpenMax = 0.1;
// What passes through small gaps ends right behind them, on whatever is there, and what is hardly seen may be anything:
// the wall may be this far behind.
constexpr double kMayBeBehind_m = 2.0;
constexpr double kToplessMax = 0.08;

#ifdef POSE_WALL_TRACE
void note_sight(const WallSight& sight, const WallEdges& edges, bool grooved) {
  trace::gate(POSE_WALL_TRACE_WALL_BRIGHT, !sight.dim);
  trace::gate(POSE_WALL_TRACE_WALL_TOP_SEEN, !edges.top_unseen);
  trace::gate(POSE_WALL_TRACE_WALL_OPEN_DOUBT, sight.open, kOpenDoubt, !(sight.open > kOpenDoubt));
  trace::gate(POSE_WALL_TRACE_WALL_GROOVES, !grooved);
  trace::gate(POSE_WALL_TRACE_WALL_SILENT, sight.silent, kSilentMax, sight.silent <= kSilentMax);
  trace::gate(POSE_WALL_TRACE_WALL_OPEN, sight.open, kOpenMax, sight.open <= kOpenMax);
  trace::gate(POSE_WALL_TRACE_WALL_TOPLESS, sight.topless, kToplessMax, sight.topless <= kToplessMax);
  trace::gate(POSE_WALL_TRACE_WALL_ISLAND, !edges.island);
  trace::gate(POSE_WALL_TRACE_WALL_LOW, !edges.low);
  trace::gate(POSE_WALL_TRACE_WALL_LAYER, !edges.layer_behind);
}
#endif

// How far what is seen on the other side of the road runs apart from a wall that stands alone: what was chosen there
// and was no wall after all, what its fit came to, and whatever else could be a wall by itself, be it much weaker.
// Radians.
double apart_from_other_side(const WallCandidate& wall, const WallCandidate* chosen, const WallResult& fitted,
                             const WallCandidates& seen, const Settings& s) {
  constexpr double kWeakestShare = 0.1;
  double apart = chosen != nullptr ? angle_in_plan(wall.plane, chosen->plane) : 0.0;
  if (fitted.fit.found) apart = larger(apart, angle_in_plan(wall.plane, fitted.fit.plane));
  for (std::uint32_t i = 0; i < seen.count; ++i) {
    const WallCandidate& c = seen.item[i];
    // Few points are no excuse: they are enough to doubt which way the road runs.
    const std::uint32_t faults = c.faults & ~static_cast<std::uint32_t>(POSE_WALL_R_WALL_FEW_INLIERS);
    if (faults != 0 || !(c.evidence.length_m >= s.wall_alone_length_min)) continue;
    if (!(c.evidence.score_m2 >= kWeakestShare * wall.evidence.score_m2)) continue;
    apart = larger(apart, angle_in_plan(wall.plane, c.plane));
  }
  return apart;
}

// What is left of a pair of which the other one was no wall after all must be as long as a wall that stands alone.
void doubt_what_is_left(const WallCandidate& left, const Settings& s, WallResult* out) {
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_LEFT_ALONE, left.evidence.length_m, s.wall_alone_length_min,
                             left.evidence.length_m >= s.wall_alone_length_min));
  if (left.evidence.length_m >= s.wall_alone_length_min) return;
  out->fit.refuse(POSE_WALL_R_WALL_SHORT);
}

}  // namespace

void reach_to_rival(const WallScene& scene, const Plane& rival, int side, WallResult* wall) {
  const double yaw = yaw_of(along_of(rival, scene.forward_level), scene.forward_level);
  wall->yaw_to_rival_rad = larger(wall->yaw_to_rival_rad, std::fabs(yaw - wall->yaw_rad));
  for (int end = 0; end < 2; ++end) {
    const double distance = distance_at(rival, scene.sample_level_m[side][end]);
    // The rival was looked at in passing: it is not known to the centimetre.
    wall->distance_bound_m[end][POSE_WALL_PART_RIVAL] +=
        kRivalStretch * std::fabs(distance - wall->distance_m[end]) + kRivalMargin_m;
  }
  wall->fit.reasons |= POSE_WALL_R_WALL_AMBIGUOUS;
}

void extend_to_machine(double away_m, WallResult* wall) {
  constexpr double kAwayMax_m = 2.0;
  constexpr double kMayBend_rad = 0.44;  // 25 degrees
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_WALL_AWAY, away_m, kAwayMax_m, !(away_m > kAwayMax_m)));
  if (!(away_m > kAwayMax_m)) return;
  wall->fit.reasons |= POSE_WALL_R_EXTRAPOLATED;
  wall->yaw_to_rival_rad = kMayBend_rad;
}

void look_closely(const WallScene& scene, bool grooved, WallsScratch* scratch, WallResult* wall) {
  const Plane& plane = wall->fit.plane;
  const WallSight sight = look_at(scene, plane, wall->along_level, kWellBehind_m, &scratch->sight);
  const WallEdges edges = look_past(scene, plane, wall->along_level, on_wall_m(scene.settings), &scratch->edges);
  const bool little_seen = sight.dim || edges.top_unseen, shows_behind = sight.open > kOpenDoubt || edges.layer_behind;
  POSE_WALL_NOTE(note_sight(sight, edges, grooved));
  if (little_seen) wall->fit.reasons |= POSE_WALL_R_WALL_FEW_INLIERS;
  if (shows_behind) wall->fit.reasons |= POSE_WALL_R_WALL_SEEN_THROUGH;
  if (grooved) wall->fit.reasons |= POSE_WALL_R_WALL_AMBIGUOUS;
  if (little_seen || shows_behind || grooved) {
    const double behind_m = larger(kRivalStretch * sight.depth_m + kRivalMargin_m, kMayBeBehind_m);
    for (ProtectionParts& bound : wall->distance_bound_m) bound[POSE_WALL_PART_RIVAL] += behind_m;
  }
  const bool whole = sight.silent <= kSilentMax && sight.open <= kOpenMax && sight.topless <= kToplessMax;
  if (whole && !edges.island && !edges.low) return;
  wall->fit.refuse(POSE_WALL_R_WALL_SEEN_THROUGH);
}

void doubt_those_alone(const Settings& s, const WallChoice& choice, const WallCandidates (&beside)[2],
                       WallResult (*walls)[2]) {
  for (int side = 0; side < 2; ++side) {
    const int other = 1 - side;
    if (choice.side[side] == nullptr || !(*walls)[other].fit.refused) continue;
    const WallCandidate& wall = *choice.side[side];
    POSE_WALL_NOTE(trace::subject(trace::side_subject(side)));
    const double apart = apart_from_other_side(wall, choice.side[other], (*walls)[other], beside[other], s);
    POSE_WALL_NOTE(
        trace::gate(POSE_WALL_TRACE_ALONE_APART, apart, WallResult::kApart_rad, apart <= WallResult::kApart_rad));
    (*walls)[side].reach_to_other_side(apart);
    if (choice.side[other] != nullptr) doubt_what_is_left(wall, s, &(*walls)[side]);
  }
}

void doubt_short_ones_apart(const Settings& s, const WallChoice& choice, WallResult (*walls)[2]) {
  constexpr double kUnlike_rad = 0.14;  // 8 degrees: walls of one road rarely differ by four
  if (choice.side[0] == nullptr || choice.side[1] == nullptr) return;
  const double apart = angle_in_plan((*walls)[0].fit.plane, (*walls)[1].fit.plane);
  for (int side = 0; side < 2; ++side) {
    if (choice.side[side]->evidence.length_m >= s.wall_alone_length_min) continue;
    POSE_WALL_NOTE(trace::gate_of(trace::side_subject(side), POSE_WALL_TRACE_SHORT_APART, apart, kUnlike_rad,
                                  !(apart > kUnlike_rad)));
    if (!(apart > kUnlike_rad)) continue;
    (*walls)[side].fit.reasons |= POSE_WALL_R_WALLS_NOT_PARALLEL;
    for (ProtectionParts& bound : (*walls)[side].distance_bound_m) bound[POSE_WALL_PART_RIVAL] += kMayBeBehind_m;
  }
}

}  // namespace pose_wall
