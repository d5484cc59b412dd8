// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "walls/propose/candidates.hpp"

#include <cmath>

#include "base/containers/even_share.hpp"
#include "base/estimation/irls.hpp"
#include "base/estimation/near_plane.hpp"
#include "base/math/elementary.hpp"
#include "gates/gate.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kThinMost = 4096;    // judgement, 2026-11-21: of the band, to score hypotheses; half of a fit's
constexpr double kWideInThresholds = 5.0;    // the fit sees the lean of a wall that a vertical hypothesis cuts
constexpr double kNarrowInThresholds = 3.0;  // judgement, 2026-11-21: the lean is known; as near lies on a wall
constexpr int kQuickRounds = 3;              // judgement, 2026-11-21: they refine a hypothesis to within the threshold
constexpr std::uint32_t kQuickPointsMax = 500;  // 800 at first; 250 missed rivals that cast doubt (bench/README.md)

#ifdef POSE_WALL_TRACE
std::uint32_t subject_of(const WallScene& scene, const SideView& view) {
  const double left = view.side_level.dot(scene.left_level), ahead = view.side_level.dot(scene.forward_level);
  if (left * left > 0.5) return left > 0.0 ? POSE_WALL_TRACE_LEFT : POSE_WALL_TRACE_RIGHT;
  return ahead > 0.0 ? POSE_WALL_TRACE_AHEAD : POSE_WALL_TRACE_BEHIND;
}

// Before it is refined: what comes to nothing stays so.
void note_drawn_wall(const Plane& plane) {
  trace::candidate(POSE_WALL_TRACE_UNSUPPORTED, plane);
}

// The one that was noted last, refined, and what it is if it does not go on from here.
void note_refined_wall(const Plane& plane, pose_wall_trace_fate fate) {
  trace::refined(fate, plane);
}

void note_weighed_wall(const WallCandidate& c) {
  pose_wall_trace_candidate* const noted = trace::noted(c.plane);
  if (noted == nullptr) return;
  noted->fate = c.failed != 0 ? POSE_WALL_TRACE_GATES_FAILED : POSE_WALL_TRACE_WEAKER;
  noted->reasons = c.failed;
  noted->tilt_rad = lean_of(c.plane);
  noted->score_m2 = c.evidence.score_m2;
  noted->area_m2 = c.evidence.area_m2;
  noted->length_m = c.evidence.length_m;
  noted->seen_through = c.evidence.seen_through;
  noted->inliers = c.evidence.inliers;
}
#endif

bool holds_one_like(const WallCandidates& list, const SameWall& same, const Plane& plane) {
  bool holds = false;
  for (std::uint32_t i = 0; i < list.count; ++i) holds = holds || same(list.item[i].plane, plane);
  POSE_WALL_NOTE(if (holds) trace::fate(plane, POSE_WALL_TRACE_REPEATS));
  return holds;
}

Span<std::uint32_t> points_near(const BoundedPoints& points, const Plane& plane, double gate_m,
                                Span<std::uint32_t> out) {
  std::uint32_t count = 0;
  for_each_in(points, Slab(plane, gate_m), [&](std::uint32_t i, float) { out[count++] = i; });
  return out.first(count);
}

}  // namespace

const WallCandidate* WallCandidates::strongest() const {
  const WallCandidate* best = nullptr;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (best == nullptr || item[i].evidence.score_m2 > best->evidence.score_m2) best = &item[i];
  }
  return best;
}

void ProposeScratch::lay_out(Arena& arena, std::uint32_t points_max) {
  for (WallSearch& s : search) s.lay_out(arena, points_max);
  thin_level.lay_out(arena, kThinMost);
}

void thin_out(const WallScene& scene, ProposeScratch* scratch) {
  BoundedPoints* const thin = &scratch->thin_level;
  scratch->work->add(scene.band_level.count, steps::kPointParted);
  const PointSet& band = scene.band_level;
  thin->count = 0;
  for (const bool left : {true, false}) {
    for_even_share(band.count, kThinMost, [&](std::uint32_t i) {
      const Eigen::Vector3d p = band.at(i);
      if ((scene.left_level.dot(p) > 0.0) == left) thin->set(thin->count++, p, band.weight[i]);
    });
  }
  thin->bound();
}

std::uint32_t failed_gates(const Plane& plane, const WallEvidence& evidence, const Settings& s) {
  Verdict verdict;
  demand<gate::WALL_INLIERS>(&verdict, evidence.inliers, s);
  demand<gate::WALL_LENGTH>(&verdict, evidence.length_m, s);
  demand<gate::WALL_SOLID>(&verdict, evidence.seen_through, s);
  demand<gate::WALL_LEAN>(&verdict, std::fabs(lean_of(plane)), s);
  return verdict.reasons;
}

bool refine_hypothesis(const BoundedPoints& band_level, double thresh_m, const Eigen::Vector3d& along_level,
                       RefineWidth width, Span<std::uint32_t> near, TangentPoints* points, Plane* plane) {
  const IrlsSettings quick = quick_irls(kNarrowInThresholds * thresh_m, kFitScaleMin_m, thresh_m, kQuickRounds);
  const double gate_m = (width == RefineWidth::kWide ? kWideInThresholds : kNarrowInThresholds) * thresh_m;
  const Span<std::uint32_t> part = thinned(points_near(band_level, *plane, gate_m, near), kQuickPointsMax);
  const IrlsResult refined = irls_tukey(band_level, part, *plane, along_level, quick, points);
  if (refined.solved) *plane = refined.plane;
  return refined.solved;
}

void weigh_walls(const WallScene& scene, const SideView& view, WallSearch* search, ProposeScratch* scratch,
                 WallCandidates* out) {
  const SameWall same{view}, surely_same{view, 0.5 * SameWall::kApart_m};
  const WallLimits limits(radians(scene.settings.yaw_max_deg + kRefineSlack_deg), 0.5 * kPi);
  const auto refine = [&](RefineWidth width, Plane* plane) {
    const double thresh_m = scene.settings.wall_ransac_thresh;
    scratch->work->add(steps::kWallRefined);
    const bool holds = refine_hypothesis(scratch->thin_level, thresh_m, view.along_level, width, scratch->near,
                                         scratch->points, plane);
    POSE_WALL_NOTE(if (holds) note_refined_wall(
        *plane, width == RefineWidth::kWide ? POSE_WALL_TRACE_UNSUPPORTED : POSE_WALL_TRACE_OUT_OF_RANGE));
    return holds;
  };
  POSE_WALL_NOTE(const trace::About about(subject_of(scene, view)));
  POSE_WALL_NOTE(const trace::Silence until_chosen);
  out->count = 0;
  scratch->work->add(scene.band_level.count, steps::kPointSided);
  scratch->work->add(search->scored(), steps::kWallDrawn);
  for (std::uint32_t k = 0; k < search->list().count() && !scratch->work->is_spent(); ++k) {
    Plane plane = search->list()[k].plane;
    POSE_WALL_NOTE(note_drawn_wall(plane));
    if (!refine(RefineWidth::kWide, &plane)) continue;
    // What is this near one that is there already would come still nearer.
    if (holds_one_like(*out, surely_same, plane)) continue;
    if (!refine(RefineWidth::kNarrow, &plane)) continue;
    if (!may_be_wall(plane, view, limits) || holds_one_like(*out, same, plane)) continue;
    mark_wall(scene, plane, along_of(plane, view.along_level), MarkWidth::kThreshold, scratch->grid);
    const WallEvidence evidence = scratch->grid->evidence();
    scratch->work->add(steps::kWallWeighed);
    scratch->work->add(scene.band_level.count, steps::kPointMarked);
    out->item[out->count++] = {plane, evidence, failed_gates(plane, evidence, scene.settings)};
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

void propose_walls(const WallScene& scene, const SideView (&views)[2], const Plane* const last[2], Random* random,
                   ProposeScratch* scratch, WallCandidates (*out)[2]) {
  for (int side = 0; side < 2; ++side) draw_walls(scene, views[side], last[side], random, &scratch->search[side]);
  exchange_directions(scratch->search);
  for (int side = 0; side < 2; ++side) weigh_walls(scene, views[side], &scratch->search[side], scratch, &(*out)[side]);
}

}  // namespace pose_wall
