// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "floor/candidates.hpp"

#include "base/containers/even_share.hpp"
#include "base/estimation/irls.hpp"
#include "base/estimation/mlesac.hpp"
#include "floor/below.hpp"
#include "floor/notes.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kQuickPointsMax = 500;
constexpr double kGhostShare = 0.4;
constexpr double kBelowShareMax = 0.05;
// Neither a floor nor a rival of one, whose score is at most twice its area: where no floor is within the radius, all
// planes are such splinters.
constexpr double kTellsNothing_m2 = 0.5 * kRivalShareOfFloor * kFloorAreaMin_m2;
constexpr double kOutlierSpan_m = 4.0;

// The lowest percentile by z, off a histogram of centimetres.
std::uint32_t lowest_part(const PointSet& points, double percentile, Span<std::uint32_t> out) {
  constexpr std::uint32_t kBins = 2048;
  constexpr float kFloor_m = -10.24F;
  std::uint32_t bins[kBins + 1] = {};  // the last: of none
  const auto bins_of = [](FourFloats z) {
    const FourFloats place = (z - kFloor_m) * 100.0F;
    return cut_off(smaller_of(larger_of(place, FourFloats{}), all_four(kBins - 1.0F)));
  };
  for_each_four(points.count, [&](std::uint32_t k, FourTruths counts) {
    const FourInts bin = counts ? bins_of(load_four(&points.z[k])) : all_four_ints(kBins);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) ++bins[static_cast<std::uint32_t>(bin[lane])];
  });
  const double wanted = percentile / 100.0 * static_cast<double>(points.count);
  double below = 0.0;
  std::int32_t limit = 0;
  for (; limit < static_cast<std::int32_t>(kBins) && below < wanted; ++limit) below += static_cast<double>(bins[limit]);
  std::uint32_t count = 0;
  for_each_four(points.count, [&](std::uint32_t k, FourTruths counts) {
    counts &= bins_of(load_four(&points.z[k])) < limit;
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (counts[lane] != 0) out[count++] = k + lane;
    }
  });
  return count;
}

// Refines what the search left, merges what became alike, and looks at each as a floor.
void weigh(const FloorSearch& in, const Settings& s, const Axes& axes, FloorShortlist* list, FloorScratch* scratch,
           FloorCandidates* out) {
  const PointSet& within = in.within_base;
  const Eigen::Vector3d& sensor = in.sensor_base_m;
  const FloorLimits limits(s);
  const IrlsSettings quick = quick_irls(2.0 * s.ground_ransac_thresh, 0.005, s.ground_ransac_thresh, 2);
  // The low points have done their work; their room holds a part of all, enough to refine a hypothesis.
  std::uint32_t of_part = 0;
  for_even_share(within.count, kQuickPointsMax, [&](std::uint32_t k) { scratch->low[of_part++] = k; });
  const Span<const std::uint32_t> part = scratch->low.first(of_part);
  out->count = 0;
  for (std::uint32_t k = 0; k < list->count() && !scratch->work.is_spent(); ++k) {
    const IrlsResult refined =
        irls_tukey(within, part, (*list)[k].plane, Eigen::Vector3d::UnitX(), quick, &scratch->points);
    scratch->work.add(steps::kFloorRefined);
    POSE_WALL_NOTE(note_refined_floor(refined, 1.0 - (*list)[k].cost, s, sensor));
    if (!refined.solved || !may_be_floor(refined.plane, limits, sensor)) continue;
    bool repeats = false;
    for (const FloorCandidate& c : out->all()) repeats = repeats || same_floor(c.plane, refined.plane);
    POSE_WALL_NOTE(if (repeats) trace::fate(refined.plane, POSE_WALL_TRACE_REPEATS));
    if (repeats) continue;
    POSE_WALL_NOTE(trace::fate(refined.plane, POSE_WALL_TRACE_UNSUPPORTED));
    scratch->work.add(within.count, steps::kPointWeighed);
    if (mlesac_score(within, refined.plane, s.ground_ransac_thresh / 2.0, kOutlierSpan_m).cost >= 0.0) continue;
    scratch->grid.mark(within, refined.plane, s.ground_ransac_thresh);
    const FloorEvidence evidence = scratch->grid.evidence(axes);
    scratch->work.add(steps::kFloorWeighed);
    if (evidence.area_m2 < kTellsNothing_m2) continue;
    POSE_WALL_NOTE(trace::fate(refined.plane, POSE_WALL_TRACE_MUCH_BELOW));
    if (!in.are_left_over &&
        has_much_below(scratch->grid, refined.plane, in.cloud_base, s.ground_roi_radius_max, sensor, kBelowShareMax))
      continue;
    out->item[out->count++] = {refined.plane, evidence, false};
  }
}

bool is_below(const Plane& above, const Plane& below, const Eigen::Vector3d& sensor_base_m) {
  constexpr double kBelow_m = 0.1;
  return below.signed_distance(sensor_base_m) > above.signed_distance(sensor_base_m) + kBelow_m;
}

// Planes below another one, seen through its open floor, are reflections in wet ground.
void mark_ghosts(const PointSet& within, const Settings& s, const Eigen::Vector3d& sensor, FloorScratch* scratch,
                 Span<FloorCandidate> candidates) {
  for (const FloorCandidate& above : candidates) {
    if (above.evidence.area_m2 < kFloorAreaMin_m2) continue;
    bool marked = false;
    for (FloorCandidate& below : candidates) {
      if (scratch->work.is_spent()) return;
      if (!is_below(above.plane, below.plane, sensor)) continue;
      scratch->work.add(within.count, steps::kPointWeighed);
      if (!marked) scratch->grid.mark(within, above.plane, s.ground_ransac_thresh);
      marked = true;
      below.ghost = below.ghost || is_reflection(within, above.plane, below.plane, s, sensor, scratch->grid);
    }
  }
}

}  // namespace

const FloorCandidate* FloorCandidates::best() const {
  const FloorCandidate* best = nullptr;
  for (const FloorCandidate& c : all()) {
    if (c.ghost) continue;
    if (best == nullptr || c.evidence.score_m2 > best->evidence.score_m2) best = &c;
  }
  return best;
}

bool is_reflection(const PointSet& open_base, const Plane& above, const Plane& below, const Settings& settings,
                   const Eigen::Vector3d& sensor_base_m, const FloorGrid& grid) {
  return is_below(above, below, sensor_base_m) &&
         share_seen_through(grid, above, below, open_base, sensor_base_m, settings.ground_ransac_thresh) > kGhostShare;
}

std::uint32_t find_candidates(const FloorSearch& in, const Settings& s, const Axes& axes, Random* random,
                              FloorScratch* scratch, FloorCandidates* out) {
  const std::uint32_t low = lowest_part(in.within_base, s.ground_z_percentile, scratch->low);
  FloorShortlist list;
  const FloorDraw drawn_from{in.within_base, scratch->low.first(low), in.sensor_base_m, in.last_floor};
  const std::uint32_t scored = search_floor(drawn_from, s, random, &scratch->subset, &list);
  scratch->work.add(scored, steps::kFloorDrawn);
  weigh(in, s, axes, &list, scratch, out);
  mark_ghosts(in.within_base, s, in.sensor_base_m, scratch, Span<FloorCandidate>(out->item, out->count));
  return scored;
}

}  // namespace pose_wall
