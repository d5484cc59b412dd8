// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "walls/walls.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "base/estimation/near_plane.hpp"
#include "base/math/elementary.hpp"
#include "base/math/larger.hpp"
#include "walls/choose/across.hpp"
#include "walls/doubts/doubts.hpp"
#include "walls/notes.hpp"
#include "walls/propose/candidates.hpp"
#include "walls/sample/measure.hpp"

namespace pose_wall {
namespace {

constexpr double kSeenThroughDoubt = 0.25;
constexpr double kExplainedMin = 0.3;

#ifdef POSE_WALL_TRACE
void note_fitted(const Plane& plane, const WallEvidence& evidence, const Settings& s, bool stayed) {
  note_faults(plane, evidence, s);
  trace::gate(POSE_WALL_TRACE_FIT_STAYED, stayed);
}

// The gates of the plane that is chosen, or of the one that shows most where none is.
void note_side(const WallChoice& choice, const WallCandidates (&beside)[2], int side, const Settings& s) {
  trace::subject(trace::side_subject(side));
  trace::attempt(0);
  const WallCandidate* const shown = choice.side[side] != nullptr ? choice.side[side] : strongest(beside[side]);
  trace::gate(POSE_WALL_TRACE_WALL_PLANES, beside[side].count, 1.0, shown != nullptr);
  if (shown != nullptr) note_faults(shown->plane, shown->evidence, s);
  for (std::uint32_t i = 0; i < beside[side].count; ++i) note_chosen(beside[side].item[i], choice, side);
  trace::attempt(1);
}

void note_explained(double share, bool explained) {
  trace::gate_of(POSE_WALL_TRACE_WALLS, POSE_WALL_TRACE_EXPLAINED, share, kExplainedMin, explained);
}
#endif

// Nothing is reported of a machine that stands across the road, nor of one that may, as long as nobody has looked.
void refuse_where_across(const WallScene& scene, Random* random, WallsScratch* scratch, WallChoice* choice) {
  if (scratch->fit.work.is_spent()) return;
  const double most_m2 = choice->any() ? most_area_across_m2(scene) : 0.0;
  if (!may_stand_across(2.0 * most_m2, *choice)) return;
  const Eigen::Vector3d f = scene.forward_level, l = scene.left_level;
  const SideView ends[2] = {{l, f}, {l, -f}};
  WallCandidates ahead, behind;
  draw_walls(scene, ends[0], nullptr, random, &scratch->search[0]);
  weigh_walls(scene, ends[0], &scratch->search[0], scratch, &ahead);
  if (scratch->fit.work.is_spent()) return;
  // With the most that could be behind, what is ahead may still be too little.
  const WallCandidate* const best = strongest(ahead);
  if (!is_behind_to_be_drawn(best != nullptr ? best->evidence.score_m2 : 0.0, most_m2, *choice)) return;
  draw_walls(scene, ends[1], nullptr, random, &scratch->search[1]);
  exchange_directions(scratch->search);
  weigh_walls(scene, ends[0], &scratch->search[0], scratch, &ahead);
  weigh_walls(scene, ends[1], &scratch->search[1], scratch, &behind);
  refuse_if_across(ahead, behind, scene.settings, choice);
}

// Planes that nobody weighed may be the better walls, and what one wall says of the road the other one may doubt: where
// the work was spent before the end, neither is finished.
void refuse_unfinished(const Work& work, WallsResult* out) {
  if (!work.is_spent()) return;
  for (int side = 0; side < 2; ++side) {
    out->side[side].fit.refuse(POSE_WALL_R_WORK_LIMIT);
    POSE_WALL_NOTE(trace::gate_of(trace::side_subject(side), POSE_WALL_TRACE_WORK, static_cast<double>(work.done()),
                                  static_cast<double>(work.most()), false));
  }
}

WallResult measure(const WallScene& scene, const SideView& view, const WallChoice& choice, int side,
                   WallsScratch* scratch) {
  const Settings& s = scene.settings;
  const WallCandidate& chosen = *choice.side[side];
  Work& work = scratch->fit.work;
  const WallSurface surface = fit_surface(scene, chosen.plane, &scratch->grid, &scratch->fit);
  work.add(steps::kWallLookedAt);
  work.add(scene.band_level.count, steps::kPointLookedAt);
  if (work.is_spent()) return {};
  WallResult wall = measure_wall(scene, surface, side, scratch->grid);
  wall.area_m2 = chosen.evidence.area_m2;
  wall.along_min_m = chosen.evidence.along_min_m;
  wall.along_max_m = chosen.evidence.along_max_m;
  extend_to_machine(chosen.evidence.away_m, &wall);
  if (choice.rival[side] != nullptr) reach_to_rival(scene, choice.rival[side]->plane, side, &wall);
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_WALL_SOLID_DOUBT, chosen.evidence.seen_through, kSeenThroughDoubt,
                             !(chosen.evidence.seen_through > kSeenThroughDoubt)));
  if (chosen.evidence.seen_through > kSeenThroughDoubt) wall.fit.reasons |= POSE_WALL_R_WALL_SEEN_THROUGH;
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_FIT_INLIERS, wall.fit.inliers, s.wall_inlier_min,
                             wall.fit.inliers >= s.wall_inlier_min));
  if (!(wall.fit.inliers >= s.wall_inlier_min)) wall.fit.refuse(POSE_WALL_R_WALL_FEW_INLIERS);
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_WALL_YAW, std::fabs(wall.yaw_rad), radians(s.yaw_max_deg),
                             std::fabs(wall.yaw_rad) <= radians(s.yaw_max_deg)));
  if (!(std::fabs(wall.yaw_rad) <= radians(s.yaw_max_deg))) wall.fit.refuse(POSE_WALL_R_YAW_OUT_OF_RANGE);
  if (!wall.fit.found) return wall;
  // The fit may have wandered off, or shrunk to what is no wall any more.
  const WallEvidence fitted = scratch->grid.evidence();
  const std::uint32_t faults = faults_of(wall.fit.plane, fitted, s);
  const bool stayed = faults == 0 && SameWall{view}(wall.fit.plane, chosen.plane);
  POSE_WALL_NOTE(note_fitted(wall.fit.plane, fitted, s, stayed));
  if (!stayed) wall.fit.refuse(POSE_WALL_R_WALL_NOT_FOUND | faults);
  look_closely(scene, surface.grooved, scratch, &wall);
  return wall;
}

// Both sides lean the same way about the road: one out, the other in. Each wall may lean by itself, but where both do
// so by this much it is the level that is wrong: a heap's flank was taken for the floor. Returns the turn by which the
// level may be off, as a vector along the road, rad. Zero unless both are sure.
Eigen::Vector3d tilt_by_walls(const WallScene& scene, const WallCandidates (&beside)[2]) {
  constexpr double kLeansMin_rad = 0.2;          // 11.5 degrees: simulated and real walls lean by 10
  constexpr double kWallsThemselves_rad = 0.17;  // so much of it may yet be the walls' own
  constexpr double kAreaMin_m2 = 4.0;
  double lean[2] = {};
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  for (int side = 0; side < 2; ++side) {
    const WallCandidate* const best = strongest(beside[side]);
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

// Share of the band that lies on the chosen walls. In a cavern or a hall full of things, two flat spots may happen to
// be parallel, but they explain next to nothing of what is seen.
double explained_share(const WallScene& scene, const WallChoice& choice) {
  const auto slab = [&](const WallCandidate* wall) {
    if (wall == nullptr) return Slab::empty();
    return Slab(wall->plane, on_wall_m(scene.settings));
  };
  const Slab left = slab(choice.side[0]), right = slab(choice.side[1]);
  const PointSet& band = scene.band_level;
  FourInts explained{};  // true is -1
  for_each_four_points(band, [&](std::uint32_t, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
    explained -= counts & (left.holds(x, y, z) | right.holds(x, y, z));
  });
  return band.count > 0 ? static_cast<double>(sum_of_lanes(explained)) / static_cast<double>(band.count) : 0.0;
}

}  // namespace

WallsResult find_walls(const WallScene& scene, const Plane* const last[2], Random* random, WallsScratch* scratch) {
  const Eigen::Vector3d f = scene.forward_level, l = scene.left_level;
  const SideView sides[2] = {{f, l}, {f, -l}};
  thin_out(scene, &scratch->thin_level);
  scratch->fit.work.add(scene.band_level.count, steps::kPointParted);
  WallCandidates beside[2];
  for (int side = 0; side < 2; ++side) draw_walls(scene, sides[side], last[side], random, &scratch->search[side]);
  exchange_directions(scratch->search);
  for (int side = 0; side < 2; ++side) weigh_walls(scene, sides[side], &scratch->search[side], scratch, &beside[side]);
  // Before the same searches look ahead and behind.
  const std::uint32_t scored[2] = {scratch->search[0].scored(), scratch->search[1].scored()};
  WallChoice choice = choose_walls(beside[0], beside[1], scene.settings);
  refuse_where_across(scene, random, scratch, &choice);

  if (!scratch->fit.work.is_spent()) learn_directions(scene, &scratch->sight);  // for the fits
  const bool explained = explained_share(scene, choice) >= kExplainedMin;
  POSE_WALL_NOTE(note_explained(explained_share(scene, choice), explained));
  WallsResult out;
  out.tilt_level_rad = tilt_by_walls(scene, beside);
  for (int side = 0; side < 2; ++side) {
    POSE_WALL_NOTE(note_side(choice, beside, side, scene.settings));
    const bool goes_on = choice.side[side] != nullptr && !scratch->fit.work.is_spent();
    if (goes_on) out.side[side] = measure(scene, sides[side], choice, side, scratch);
    out.side[side].fit.iterations = scored[side];
    out.side[side].fit.refused = out.side[side].fit.refused || choice.refused[side];
    out.side[side].fit.reasons |= choice.reasons[side];
    if (!explained) out.side[side].fit.refuse(POSE_WALL_R_WALL_NOT_FOUND);
  }
  refuse_unfinished(scratch->fit.work, &out);
  doubt_those_alone(scene.settings, choice, beside, &out.side);
  doubt_short_ones_apart(scene.settings, choice, &out.side);
  return out;
}

}  // namespace pose_wall
