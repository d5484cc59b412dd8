// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/walls.hpp"

#include "engine/gates/gate.hpp"
#include "engine/walls/choose/across.hpp"
#include "engine/walls/choose/choose.hpp"
#include "engine/walls/direction.hpp"
#include "engine/walls/doubts/doubts.hpp"
#include "engine/walls/sample/measure.hpp"

namespace pose_wall {
namespace {

#ifdef POSE_WALL_TRACE
// Notes the gates of the chosen plane, or of the one with the best score.
void note_candidates(const WallChoice& choice, const WallCandidates& beside, int side, const Settings& s) {
  const WallCandidate* const chosen = choice.side[side];
  const WallCandidate* const shown = chosen != nullptr ? chosen : beside.strongest();
  passes<gate::WALL_PLANES>(beside.count, s);
  if (shown != nullptr) failed_gates(shown->plane, shown->evidence, s);
  if (chosen != nullptr) trace::fate(chosen->plane, POSE_WALL_TRACE_CHOSEN);
  const WallCandidate* const rival = choice.strongest_rival(side, beside);
  if (rival != nullptr) trace::fate(rival->plane, POSE_WALL_TRACE_RIVAL);
}
#endif

// Fits the surface of the chosen plane, and measures yaw and distances on it.
FittedWall fit_wall(const WallScene& scene, const WallCandidate& chosen, int side, WallsScratch* scratch) {
  Work& work = scratch->fit.work;
  const WallSurface surface = fit_surface(scene, chosen.plane, &scratch->grid, &scratch->fit);
  if (work.stops()) return {};
  work.add(steps::kWallLookedAt);
  work.add(scene.band_level.count, steps::kPointLookedAt);
  FittedWall wall = measure_wall(scene, surface, side, scratch->grid, &scratch->errors[side]);
  wall.area_m2 = chosen.evidence.area_m2;
  wall.along_min_m = chosen.evidence.along_min_m;
  wall.along_max_m = chosen.evidence.along_max_m;
  return wall;
}

}  // namespace

WallsResult find_walls(const WallScene& scene, const Plane* const last[2], Random* random, WallsScratch* scratch) {
  const Settings& s = scene.settings;
  Work& work = scratch->fit.work;
  const SideView views[2] = {{scene.forward_level, scene.left_level}, {scene.forward_level, -scene.left_level}};
  WallCandidates(&beside)[2] = scratch->beside;
  thin_out(scene, &scratch->propose);
  propose_walls(scene, views, last, random, &scratch->propose, &beside);
  // Read before the same searches run ahead and behind.
  const std::uint32_t scored[2] = {scratch->propose.search[0].scored(), scratch->propose.search[1].scored()};
  WallChoice choice = choose_walls(beside[0], beside[1], s);
  refuse_where_across(scene, random, &scratch->propose, &choice);
  if (!work.stops()) learn_directions(scene, &scratch->sight);
  WallsResult out;
  out.tilt_level_rad = tilt_by_walls(scene, beside);
  for (int side = 0; side < 2; ++side) {
    POSE_WALL_NOTE(const trace::About about(trace::side_subject(side)));
    POSE_WALL_NOTE(trace::attempt(0));
    POSE_WALL_NOTE(note_candidates(choice, beside[side], side, s));
    POSE_WALL_NOTE(trace::attempt(1));
    if (choice.side[side] != nullptr && !work.stops()) {
      const FittedWall fitted = fit_wall(scene, *choice.side[side], side, scratch);
      if (!work.is_cut_off())
        out.side[side] = judge_wall(scene, views[side], choice, beside[side], side, fitted, scratch);
    }
    // Neither wall is finished if a plane was left that may be the better wall. A wall that is finished stands alone.
    if (work.is_cut_off()) demand_work_left(work, &out.side[side].fit);
    out.side[side].fit.iterations = scored[side];
    out.side[side].fit.add(choice.verdict[side]);
  }
  doubt_those_alone(s, choice, beside, &out.side);
  refuse_blocked_sides(scene.counts, s, &out.side);
  set_sigmas(scratch->errors, s.protection_sigmas, &out.side);
  share_direction(scene, &out.side);
  return out;
}

}  // namespace pose_wall
