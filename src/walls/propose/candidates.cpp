// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "walls/propose/candidates.hpp"

#include <cmath>

#include "base/containers/even_share.hpp"
#include "base/estimation/near_plane.hpp"
#include "base/math/elementary.hpp"
#include "walls/notes.hpp"

namespace pose_wall {
namespace {

constexpr double kSeenThroughMax = 0.5;

bool holds_one_like(const WallCandidates& list, const SameWall& same, const Plane& plane) {
  bool holds = false;
  for (std::uint32_t i = 0; i < list.count; ++i) holds = holds || same(list.item[i].plane, plane);
  POSE_WALL_NOTE(if (holds) trace::fate(plane, POSE_WALL_TRACE_REPEATS));
  return holds;
}

}  // namespace

void thin_out(const WallScene& scene, BoundedPoints* thin_level) {
  const PointSet& band = scene.band_level;
  thin_level->count = 0;
  for (const bool left : {true, false}) {
    for_even_share(band.count, kThinMost, [&](std::uint32_t i) {
      const Eigen::Vector3d p = band.at(i);
      if ((scene.left_level.dot(p) > 0.0) == left) thin_level->set(thin_level->count++, p, band.weight[i]);
    });
  }
  thin_level->bound();
}

std::uint32_t faults_of(const Plane& plane, const WallEvidence& evidence, const Settings& s) {
  std::uint32_t faults = 0;
  if (!(evidence.inliers >= s.wall_inlier_min)) faults |= POSE_WALL_R_WALL_FEW_INLIERS;
  if (!(evidence.length_m >= s.wall_length_min)) faults |= POSE_WALL_R_WALL_SHORT;
  if (!(evidence.seen_through <= kSeenThroughMax)) faults |= POSE_WALL_R_WALL_SEEN_THROUGH;
  if (!(std::fabs(lean_of(plane)) <= radians(s.wall_lean_max_deg))) faults |= POSE_WALL_R_WALL_LEANS;
  return faults;
}

#ifdef POSE_WALL_TRACE
// As faults_of() asks.
void note_faults(const Plane& plane, const WallEvidence& evidence, const Settings& s) {
  const double lean_rad = std::fabs(lean_of(plane));
  trace::gate(POSE_WALL_TRACE_WALL_INLIERS, evidence.inliers, s.wall_inlier_min, evidence.inliers >= s.wall_inlier_min);
  trace::gate(POSE_WALL_TRACE_WALL_LENGTH, evidence.length_m, s.wall_length_min,
              evidence.length_m >= s.wall_length_min);
  trace::gate(POSE_WALL_TRACE_WALL_SOLID, evidence.seen_through, kSeenThroughMax,
              evidence.seen_through <= kSeenThroughMax);
  trace::gate(POSE_WALL_TRACE_WALL_LEAN, lean_rad, radians(s.wall_lean_max_deg),
              lean_rad <= radians(s.wall_lean_max_deg));
}
#endif

void weigh_walls(const WallScene& scene, const SideView& view, WallSearch* search, WallsScratch* scratch,
                 WallCandidates* out) {
  const SameWall same{view}, surely_same{view, 0.5 * SameWall::kApart_m};
  const WallLimits limits(radians(scene.settings.yaw_max_deg + kRefineSlack_deg), 0.5 * kPi);
  const auto refine = [&](RefineWidth width, Plane* plane) {
    const double thresh_m = scene.settings.wall_ransac_thresh;
    scratch->fit.work.add(steps::kWallRefined);
    const bool holds = refine_hypothesis(scratch->thin_level, thresh_m, view.along_level, width, &scratch->fit, plane);
    POSE_WALL_NOTE(if (holds) note_refined_wall(
        *plane, width == RefineWidth::kWide ? POSE_WALL_TRACE_UNSUPPORTED : POSE_WALL_TRACE_OUT_OF_RANGE));
    return holds;
  };
  POSE_WALL_NOTE(trace::subject(subject_of(scene, view)));
  out->count = 0;
  scratch->fit.work.add(scene.band_level.count, steps::kPointSided);
  scratch->fit.work.add(search->scored(), steps::kWallDrawn);
  for (std::uint32_t k = 0; k < search->list().count() && !scratch->fit.work.is_spent(); ++k) {
    Plane plane = search->list()[k].plane;
    POSE_WALL_NOTE(note_drawn_wall(plane));
    if (!refine(RefineWidth::kWide, &plane)) continue;
    // What is this near one that is there already would come still nearer.
    if (holds_one_like(*out, surely_same, plane)) continue;
    if (!refine(RefineWidth::kNarrow, &plane)) continue;
    if (!may_be_wall(plane, view, limits) || holds_one_like(*out, same, plane)) continue;
    mark_wall(scene, plane, along_of(plane, view.along_level), MarkWidth::kThreshold, &scratch->grid);
    const WallEvidence evidence = scratch->grid.evidence();
    scratch->fit.work.add(steps::kWallWeighed);
    scratch->fit.work.add(scene.band_level.count, steps::kPointMarked);
    out->item[out->count++] = {plane, evidence, faults_of(plane, evidence, scene.settings)};
    POSE_WALL_NOTE(note_weighed_wall(out->item[out->count - 1]));
  }
}

void draw_walls(const WallScene& scene, const SideView& view, const Plane* last, Random* random, WallSearch* search) {
  search->begin(scene.band_level, view, scene.settings, random);
  if (last != nullptr) search->offer(*last);
  search->draw();
}

void exchange_directions(WallSearch (&search)[2]) {
  for (int side = 0; side < 2; ++side) {
    WallShortlist& other = search[1 - side].list();
    if (other.count() > 0) search[side].offer_offsets(other[0].plane.n);
  }
}

}  // namespace pose_wall
