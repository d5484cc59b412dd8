// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/doubts/doubts.hpp"

#include <cmath>

#include "base/math/finite.hpp"
#include "engine/gates/gate.hpp"

namespace pose_wall {
namespace {

// A rival is not fitted in full: its distance may be 5 % and 3 cm more, and its direction half a degree.
constexpr double kRivalStretch = 1.05;   // swept: half 19 moved, twice 1 lost
constexpr double kRivalMargin_m = 0.03;  // the noise of a sensor; swept: half 19 moved, twice 19 moved
// 2 to 3 m of rough rock err by so much; swept: half 13 moved, twice 7 lost.
constexpr double kRivalMargin_rad = 0.0087;

// A wall seen only well ahead of the machine, or behind it: the road may bend in between.
Doubt by_distance(double away_m, const Settings& s) {
  constexpr double kMayBend_rad = 0.44;  // 25 degrees up to the wall; swept: half 8 moved, twice 8 moved
  Doubt doubt;
  if (!demand<gate::WALL_AWAY>(&doubt, away_m, s)) doubt.yaw_to_rival_rad = kMayBend_rad;
  return doubt;
}

// Each rival may be the wall: the protection levels reach to the farthest of them.
Doubt by_rivals(const WallScene& scene, const WallChoice& choice, const WallCandidates& beside, int side,
                const FittedWall& wall) {
  Doubt doubt;
  for (std::uint32_t i = 0; i < beside.count; ++i) {
    if (!choice.is_rival(side, i)) continue;
    doubt.reasons = POSE_WALL_R_WALL_AMBIGUOUS;
    const Plane& rival = beside.item[i].plane;
    const double turned_rad =
        std::fabs(yaw_of(along_of(rival, scene.forward_level), scene.forward_level) - wall.yaw_rad);
    doubt.yaw_to_rival_rad = larger(doubt.yaw_to_rival_rad, kRivalStretch * turned_rad + kRivalMargin_rad);
    for (int end = 0; end < 2; ++end) {
      const double off_m = std::fabs(distance_at(rival, scene.sample_level_m[side][end]) - wall.distance_m[end]);
      doubt.off_m[end] = larger(doubt.off_m[end], kRivalStretch * off_m + kRivalMargin_m);
    }
  }
  return doubt;
}

// The fit may have wandered off, or shrunk to a surface that is no wall any more.
Doubt by_wandering(const WallCandidate& chosen, const SideView& view, const Plane& fitted, const WallGrid& grid,
                   const Settings& s) {
  Doubt doubt;
  doubt.reasons = failed_gates(fitted, grid.evidence(), s);
  const bool stayed = doubt.reasons == 0 && SameWall{view}(fitted, chosen.plane);
  demand<gate::FIT_STAYED>(&doubt, stayed);
  return doubt;
}

// A plane that is hardly seen, or shows something behind it, may be no wall. The wall is then behind it.
Doubt by_close_look(const WallSight& sight, const WallEdges& edges, bool grooved, const Settings& s) {
  Doubt doubt;
  demand<gate::WALL_BRIGHT>(&doubt, !sight.dim);
  demand<gate::WALL_TOP_SEEN>(&doubt, !edges.top_unseen);
  demand<gate::WALL_OPEN_DOUBT>(&doubt, sight.open, s);
  demand<gate::WALL_GROOVES>(&doubt, !grooved);
  demand<gate::WALL_LAYER>(&doubt, !edges.layer_behind);
  doubt.may_be_no_wall = doubt.reasons != 0;
  if (doubt.may_be_no_wall) {
    doubt.off_m[0] = doubt.off_m[1] = larger(kRivalStretch * sight.depth_m + kRivalMargin_m, kMayStep_m);
  }
  demand<gate::WALL_SILENT>(&doubt, sight.silent, s);
  demand<gate::WALL_ISLAND>(&doubt, !edges.island);
  demand<gate::WALL_LOW>(&doubt, !edges.low);
  return doubt;
}

// Largest angle between a wall that stands alone and the planes on the other side of the road. They are the chosen one
// that was refused, the result of its fit, and any other plane that may be a wall by itself, however weak. Radians.
double apart_from_other_side(const WallCandidate& wall, const WallCandidate* chosen, const FittedWall& fitted,
                             const WallCandidates& seen, const Settings& s) {
  constexpr double kWeakestShare = 0.1;  // a lone wall was 13 degrees off its road (seed 517, 2026-11-22)
  double apart = chosen != nullptr ? angle_in_plan(wall.plane, chosen->plane) : 0.0;
  if (fitted.fit.found) apart = larger(apart, angle_in_plan(wall.plane, fitted.fit.plane));
  for (std::uint32_t i = 0; i < seen.count; ++i) {
    const WallCandidate& c = seen.item[i];
    // Planes of few points count: they are enough to doubt the road's direction.
    const std::uint32_t failed = c.failed & ~static_cast<std::uint32_t>(POSE_WALL_R_WALL_FEW_INLIERS);
    if (failed != 0 || !(c.evidence.length_m >= limit_of<gate::WALL_LENGTH_ALONE>(s))) continue;
    if (!(c.evidence.score_m2 >= kWeakestShare * wall.evidence.score_m2)) continue;
    apart = larger(apart, angle_in_plan(wall.plane, c.plane));
  }
  return apart;
}

// The other side runs apart from this wall. Within the gate that is the walls' own difference.
Doubt by_other_side(double apart_rad, const Settings& s) {
  Doubt doubt;
  if (!demand<gate::ALONE_APART>(&doubt, apart_rad, s)) doubt.yaw_rad = apart_rad;
  return doubt;
}

}  // namespace

JudgedWall judge_wall(const WallScene& scene, const SideView& view, const WallChoice& choice,
                      const WallCandidates& beside, int side, const FittedWall& fitted, WallsScratch* scratch) {
  const Settings& s = scene.settings;
  const WallCandidate& chosen = *choice.side[side];
  JudgedWall wall(fitted);
  wall.add(by_distance(chosen.evidence.away_m, s));
  wall.add(by_rivals(scene, choice, beside, side, fitted));
  demand<gate::FIT_INLIERS>(&wall.fit, fitted.fit.inliers, s);
  demand<gate::WALL_YAW>(&wall.fit, std::fabs(fitted.yaw_rad), s);
  if (!fitted.fit.found) return wall;
  wall.add(by_wandering(chosen, view, fitted.fit.plane, scratch->grid, s));
  const Plane& plane = fitted.fit.plane;
  const WallSight sight = look_at(scene, plane, fitted.along_level, kWellBehind_m, &scratch->sight);
  const WallEdges edges = look_past(scene, plane, fitted.along_level, on_wall_m(s), &scratch->edges);
  wall.add(by_close_look(sight, edges, fitted.grooved, s));
  return wall;
}

void doubt_those_alone(const Settings& s, const WallChoice& choice, const WallCandidates (&beside)[2],
                       JudgedWall (*walls)[2]) {
  for (int side = 0; side < 2; ++side) {
    const int other = 1 - side;
    if (choice.side[side] == nullptr || !(*walls)[other].fit.refused) continue;
    POSE_WALL_NOTE(const trace::About about(trace::side_subject(side)));
    const WallCandidate& wall = *choice.side[side];
    const double apart = apart_from_other_side(wall, choice.side[other], (*walls)[other], beside[other], s);
    (*walls)[side].add(by_other_side(apart, s));
    // The rest of a pair must be as long as a wall that stands alone.
    if (choice.side[other] != nullptr) demand<gate::WALL_LENGTH_ALONE>(&(*walls)[side].fit, wall.evidence.length_m, s);
  }
}

void refuse_blocked_sides(const IngestCounts& counts, const Settings& s, JudgedWall (*walls)[2]) {
  // Dust on the window gives fewer returns; swept: half and twice change nothing.
  constexpr double kShareOfReturns = 0.02;
  // Counts returns only: it must not matter whether the driver leaves no-returns out, or marks them as zero or not
  // finite.
  const double returns = static_cast<double>(counts.points_in - counts.dropped_not_finite - counts.dropped_zero);
  const Quadrant sides[2] = {kLeft, kRight};
  for (int side = 0; side < 2; ++side) {
    POSE_WALL_NOTE(const trace::About about(trace::side_subject(side)));
    JudgedWall& wall = (*walls)[side];
    JudgedWall& other = (*walls)[1 - side];
    const bool counted = wall.fit.found && !wall.fit.refused;
    const double near = counts.near_by_quadrant[sides[side]], kept = counts.kept_by_quadrant[sides[side]];
    if (demand<gate::WALL_NEAR>(&wall.fit, near, larger(kept, kShareOfReturns * returns))) continue;
    // A blocked wall may still have given the road's direction better than the other one.
    POSE_WALL_NOTE(const trace::About of_other(trace::side_subject(1 - side)));
    if (counted) other.add(by_other_side(std::fabs(wall.yaw_rad - other.yaw_rad), s));
  }
}

Eigen::Vector3d tilt_by_walls(const WallScene& scene, const WallCandidates (&beside)[2]) {
  constexpr double kLeansMin_rad = 0.2;          // 11.5 degrees: simulated and real walls lean by 10 at most
  constexpr double kWallsThemselves_rad = 0.17;  // 10 degrees of the lean may be the walls' own
  // Some 2 m of a wall, before its lean doubts the floor; swept: half and twice change nothing, nor does 0.
  constexpr double kAreaMin_m2 = 4.0;
  double lean[2] = {};
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  for (int side = 0; side < 2; ++side) {
    const WallCandidate* const best = beside[side].strongest();
    if (best == nullptr || !(best->evidence.area_m2 >= kAreaMin_m2)) return Eigen::Vector3d::Zero();
    lean[side] = lean_of(best->plane);
    along += 0.5 * along_of(best->plane, scene.forward_level);
  }
  const bool same_way = lean[0] * lean[1] < 0.0;
  if (!same_way || !(std::fabs(lean[0]) > kLeansMin_rad && std::fabs(lean[1]) > kLeansMin_rad)) {
    return Eigen::Vector3d::Zero();
  }
  return (0.5 * std::fabs(lean[0] - lean[1]) + kWallsThemselves_rad) * along;
}

}  // namespace pose_wall
