// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/floor/floor.hpp"

#include "base/math/elementary.hpp"
#include "base/math/rotation.hpp"
#include "engine/floor/candidates.hpp"
#include "engine/floor/fit.hpp"
#include "engine/floor/rivals.hpp"
#include "engine/gates/gate.hpp"

namespace pose_wall {
namespace {

constexpr double kRadiusGrowth = 2.25;  // as many valid values as with 1.5, in fewer looks (bench/README.md)
constexpr int kRadiusSteps = 6;  // the smallest first radius, 0.5 m, times 2.25^5 is 28.8 m: beyond any last radius
// Bounds the work (2026-11-25): the first fit selects from four times its points, later ones from as many.
constexpr std::uint32_t kOpenMost = 4 * kFloorFitPoints, kOpenMostAgain = kOpenMost / 4;
constexpr double kWorthALook = 1.02;  // with 5 % roll on rough rock was valid 2 points less often (bench/README.md)
constexpr double kGoodEnough = 0.3;   // of the alert limit; with 0.7 slivers passed (README, tried and dropped)

void copy_within(const PointSet& open, double radius_m, PointSet* out) {
  const FourFloats limit = all_four(static_cast<float>(radius_m * radius_m));
  copy_where(open, out, [limit](FourFloats x, FourFloats y, FourFloats, FourTruths counts) {
    return counts & (x * x + y * y <= limit);
  });
}

#ifdef POSE_WALL_TRACE
void note_choice(Span<const FloorCandidate> candidates, const FloorCandidate* best) {
  for (const FloorCandidate& c : candidates) {
    pose_wall_trace_candidate* const noted = trace::noted(c.plane);
    if (noted == nullptr) continue;
    noted->fate = c.much_below ? POSE_WALL_TRACE_MUCH_BELOW
                  : c.ghost    ? POSE_WALL_TRACE_REFLECTION
                               : POSE_WALL_TRACE_WEAKER;
    if (&c == best) noted->fate = POSE_WALL_TRACE_CHOSEN;
    if (c.much_below && best == nullptr) continue;  // its area tells something beside a floor only
    noted->score_m2 = c.evidence.score_m2;
    noted->area_m2 = c.evidence.area_m2;
  }
}
#endif

// The fit's own gates. It may have wandered off on a few points of another surface.
void judge_fit(const FloorScene& scene, const FloorCandidate& best, PlaneFit* fit) {
  const Settings& s = scene.settings;
  const double height_m = fit->plane.signed_distance(scene.sensor_base_m);
  demand<gate::FLOOR_TILT>(fit, tilt_of_up(fit->plane.n), s);
  demand<gate::FLOOR_HEIGHT_MIN>(fit, height_m, s);
  demand<gate::FLOOR_HEIGHT_MAX>(fit, height_m, s);
  demand<gate::FLOOR_STAYED>(fit, same_floor(fit->plane, best.plane));
  demand<gate::FLOOR_INLIERS>(fit, fit->inliers, s);
  demand<gate::FLOOR_AREA>(fit, best.evidence.area_m2, s);
}

// One look: the best candidate within the radius, its fit, its rivals.
FloorResult floor_within(const FloorScene& scene, const FloorLook& look, Random* random, FloorScratch* scratch) {
  const PointSet& within = look.within_base;
  FloorResult none;
  none.roi_radius_m = look.radius_m;
  none.open_points = within.count;
  if (!demand<gate::FLOOR_POINTS>(&none.fit, within.count, scene.settings)) return none;
  FloorCandidates found;
  none.fit.iterations = find_candidates(scene, within, Among::kOpen, random, scratch, &found);
  const FloorCandidate* const best = found.best();
  POSE_WALL_NOTE(note_choice(found.all(), best));
  if (!demand<gate::FLOOR_PLANES>(&none.fit, found.plausible(), scene.settings)) return none;

  FloorResult out = fit_floor(scene, look, best->plane, scratch);
  out.fit.iterations = none.fit.iterations;
  out.open_points = within.count;
  out.roi_radius_m = look.radius_m;
  out.area_m2 = best->evidence.area_m2;
  reach_to_rivals(scene, within, found, scratch, &out);
  judge_fit(scene, *best, &out.fit);
  // A fit that failed or wandered off says less about the floor than its start.
  if ((out.fit.reasons & POSE_WALL_R_FLOOR_NOT_FOUND) != 0) out.fit.plane = best->plane;
  return out;
}

// The results of the radii, in the order of trial.
struct Looks {
  FloorResult at[kRadiusSteps];
  int tried = 0, best = 0;

  Looks() {
    for (FloorResult& floor : at) floor.fit.refused = true;
  }

  void add(const FloorResult& seen, const Settings& s) {
    at[tried] = seen;
    // If all are refused, the last one with a fit gives the reason.
    const bool tells_more = at[best].fit.refused && seen.fit.refused && seen.fit.found;
    if (tells_more || protections_of(seen, s).worse() < protections_of(at[best], s).worse()) best = tried;
    ++tried;
  }

  // The best one, with levels that reach to the others.
  FloorResult taken(const Settings& s) const {
    FloorResult out = at[best];
    std::uint32_t claims = 0;
    for (const FloorResult& other : at) {
      reach_to_other_look(other, s, &out);
      claims += other.fit.refused ? 0U : 1U;
    }
    // The first radius is the configured one, so it was not picked for its small level.
    if (best > 0) widen_by_claims(claims, s, &out);
    return out;
  }
};

// Widens the radius until a floor is good enough.
Looks look_wider(const FloorScene& scene, Random* random, FloorScratch* scratch) {
  const Settings& s = scene.settings;
  Looks looks;
  const PointSet& open = scratch->open_base;
  double worth_a_look = 0.0;  // so many points
  const double good_enough = kGoodEnough * radians(s.alert_limit_angle_deg);
  double radius_m = s.ground_roi_radius;
  bool widest = false;
  for (; !widest && looks.tried < kRadiusSteps && !scratch->work.stops(); radius_m *= kRadiusGrowth) {
    widest = !(radius_m < s.ground_roi_radius_max);
    if (widest) radius_m = s.ground_roi_radius_max;
    if (!widest) copy_within(open, radius_m, &scratch->within_base);
    const PointSet& within = widest ? open : scratch->within_base;
    if (static_cast<double>(within.count) < worth_a_look) continue;
    if (within.count >= limit_of<gate::FLOOR_POINTS>(s)) worth_a_look = kWorthALook * static_cast<double>(within.count);
    POSE_WALL_NOTE(trace::floor_radius(static_cast<std::uint32_t>(looks.tried), radius_m));
    const FloorLook look{radius_m, open, within, looks.tried == 0 ? kOpenMost : kOpenMostAgain};
    looks.add(floor_within(scene, look, random, scratch), s);
    scratch->work.add(open.count + within.count, steps::kPointWithin / 2);
    if (protections_of(looks.at[looks.best], s).worse() <= good_enough) break;
  }
  return looks;
}

// A missing look could have shown a rival, or another floor.
void refuse_unfinished(const Work& work, [[maybe_unused]] int attempt, FloorResult* out) {
  if (!work.is_cut_off()) return;
  POSE_WALL_NOTE(trace::attempt(static_cast<std::uint32_t>(attempt)));
  demand_work_left(work, &out->fit);
  POSE_WALL_NOTE(trace::attempt(0));
}

}  // namespace

FloorResult find_floor(const FloorScene& scene, Random* random, FloorScratch* scratch) {
  scratch->grid.find_open(scene.cloud_base, scene.settings.ground_roi_radius_max, scene.sensor_base_m.z(), scratch->low,
                          &scratch->open_base);
  scratch->work.add(scene.cloud_base.count, steps::kVoxelOpened);
  const Looks looks = look_wider(scene, random, scratch);
  POSE_WALL_NOTE(trace::floor_attempt_taken(static_cast<std::uint32_t>(looks.best)));
  FloorResult out = looks.taken(scene.settings);
  if (!out.fit.refused && !scratch->work.stops()) reach_to_floors_beside(scene, random, scratch, &out);
  reach_to_upright(&out);
  refuse_unfinished(scratch->work, looks.best, &out);
  return out;
}

}  // namespace pose_wall
