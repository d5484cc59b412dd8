// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "floor/floor.hpp"

#include <cmath>

#include "base/estimation/protection.hpp"
#include "base/math/elementary.hpp"
#include "base/math/larger.hpp"
#include "base/math/rotation.hpp"
#include "floor/beside.hpp"
#include "floor/candidates.hpp"
#include "floor/fit.hpp"
#include "floor/notes.hpp"

namespace pose_wall {
namespace {

constexpr double kRadiusGrowth = 2.25;
constexpr int kRadiusSteps = 6;  // from the least first radius to the greatest last
// Wider looks fit fewer points: each tells the same floor once more.
constexpr std::uint32_t kOpenMost = 4 * kFloorFitPoints, kOpenMostAgain = kOpenMost / 4;
// A wider radius with hardly more in it would tell the same once more.
constexpr double kWorthALook = 1.02;
// A small floor must stand alone: where nothing is floor, many little planes through this and that are about as good.
constexpr double kSmallArea_m2 = 5.0;
// Through a floor of this size only reflections are seen.
constexpr double kSureArea_m2 = 10.0;
constexpr double kEqualShare = 0.7;
constexpr double kAcrossSpreadMin_m = 0.2;
constexpr double kSteep_rad = 0.17;  // 10 degrees; a radius takes in part of a flank, which lies at 30 to 40
// A floor this good needs no wider look: the wider, the less "local" the floor is.
constexpr double kGoodEnough = 0.3;

void copy_within(const PointSet& open, double radius_m, PointSet* out) {
  const FourFloats limit = all_four(static_cast<float>(radius_m * radius_m));
  copy_where(open, out, [limit](FourFloats x, FourFloats y, FourFloats, FourTruths counts) {
    return counts & (x * x + y * y <= limit);
  });
}

// A machine stands about upright: where the best plane does not lie so, weaker ones may be the floor as well.
double rival_share_of(const Plane& floor) {
  constexpr double kShareOfSteep = 0.4;
  return tilt_of_up(floor.n) > kSteep_rad ? kShareOfSteep : kRivalShareOfFloor;
}

// Rival floors nearly as good: the truth may be any, so the protection levels reach to the furthest. Where the floor
// itself is small, what is seen through it may be no reflection but the floor.
void reach_to_rivals(const FloorCandidate& best, Span<const FloorCandidate> candidates, FloorResult* out) {
  const RollPitch a = roll_pitch_of_up(best.plane.n);
  const double share = rival_share_of(best.plane);
  double roll = 0.0, pitch = 0.0;
  for (const FloorCandidate& rival : candidates) {
    if (&rival == &best || rival.evidence.score_m2 < share * best.evidence.score_m2) continue;
    if (rival.ghost && best.evidence.area_m2 >= kSureArea_m2) continue;
    POSE_WALL_NOTE(trace::fate(rival.plane, POSE_WALL_TRACE_RIVAL));
    POSE_WALL_NOTE(
        trace::gate(POSE_WALL_TRACE_FLOOR_RIVAL, rival.evidence.score_m2 / best.evidence.score_m2, share, false));
    const RollPitch b = roll_pitch_of_up(rival.plane.n);
    roll = larger(roll, std::fabs(a.roll_rad - b.roll_rad));
    pitch = larger(pitch, std::fabs(a.pitch_rad - b.pitch_rad));
    out->fit.reasons |= POSE_WALL_R_FLOOR_AMBIGUOUS;
  }
  out->roll_bound_rad[POSE_WALL_PART_RIVAL] += roll;
  out->pitch_bound_rad[POSE_WALL_PART_RIVAL] += pitch;
}

void gate(const Settings& s, const Eigen::Vector3d& sensor, const FloorCandidate& best, FloorResult* out) {
  const auto refuse_unless = [&](bool holds, std::uint32_t reason) {
    if (!holds) out->fit.refuse(reason);
  };
  // The fit may have wandered off on a few points of something else.
  const bool stayed = may_be_floor(out->fit.plane, FloorLimits(s), sensor) && same_floor(out->fit.plane, best.plane);
  POSE_WALL_NOTE(note_floor_gates(s, sensor, best.plane, out->fit));
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_FLOOR_AREA, best.evidence.area_m2, kFloorAreaMin_m2,
                             best.evidence.area_m2 >= kFloorAreaMin_m2));
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_FLOOR_SPREAD, best.evidence.across_spread_m, kAcrossSpreadMin_m,
                             best.evidence.across_spread_m >= kAcrossSpreadMin_m));
  refuse_unless(stayed, POSE_WALL_R_FLOOR_NOT_FOUND);
  refuse_unless(out->fit.inliers >= s.ground_inlier_min, POSE_WALL_R_FLOOR_FEW_INLIERS);
  refuse_unless(best.evidence.area_m2 >= kFloorAreaMin_m2, POSE_WALL_R_FLOOR_THIN);
  refuse_unless(best.evidence.across_spread_m >= kAcrossSpreadMin_m, POSE_WALL_R_FLOOR_THIN);
}

// Planes that lie alike say the same of roll and pitch, whichever of them is the floor.
bool lie_alike(const Plane& a, const Plane& b) {
  constexpr double kAlike_rad = 0.0175;  // 1 degree
  return a.n.cross(b.n).squaredNorm() <= kAlike_rad * kAlike_rad;
}

bool stands_alone(const FloorCandidate& best, Span<const FloorCandidate> candidates) {
  if (best.evidence.area_m2 >= kSmallArea_m2) return true;
  for (const FloorCandidate& rival : candidates) {
    if (&rival == &best || rival.ghost || rival.evidence.score_m2 < kEqualShare * best.evidence.score_m2) continue;
    POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_FLOOR_ALONE, rival.evidence.score_m2 / best.evidence.score_m2,
                               kEqualShare, lie_alike(best.plane, rival.plane)));
    if (!lie_alike(best.plane, rival.plane)) return false;
  }
  return true;
}

FloorResult floor_within(const FloorLook& look, const BoundedPoints& cloud, const Settings& s, const Axes& axes,
                         const Eigen::Vector3d& sensor, const Plane* last_floor, Random* random,
                         FloorScratch* scratch) {
  const double radius_m = look.radius_m;
  const PointSet& within = look.within_base;
  FloorResult none;
  none.fit.refuse(POSE_WALL_R_FLOOR_NOT_FOUND);
  none.roi_radius_m = radius_m;
  none.candidates = within.count;
  POSE_WALL_NOTE(
      trace::gate(POSE_WALL_TRACE_FLOOR_POINTS, within.count, kFloorPointsMin, within.count >= kFloorPointsMin));
  if (within.count < kFloorPointsMin) return none;
  FloorCandidates found;
  none.fit.iterations = find_candidates({within, cloud, sensor, last_floor, false}, s, axes, random, scratch, &found);
  const FloorCandidate* best = found.best();
  POSE_WALL_NOTE(note_floor_choice(found.all(), best));
  if (best == nullptr) return none;

  FloorResult out = fit_floor(look, best->plane, s, sensor, scratch);
  out.fit.iterations = none.fit.iterations;
  out.candidates = within.count;
  out.roi_radius_m = radius_m;
  out.area_m2 = best->evidence.area_m2;
  reach_to_rivals(*best, found.all(), &out);
  out.fit.refused = out.fit.refused || !stands_alone(*best, found.all());
  gate(s, sensor, *best, &out);
  // A fit that came to nothing, or wandered off, says less of the floor than what it began with.
  if ((out.fit.reasons & POSE_WALL_R_FLOOR_NOT_FOUND) != 0) out.fit.plane = best->plane;
  return out;
}

struct Protections {
  double roll_rad, pitch_rad;
  double worse() const { return larger(roll_rad, pitch_rad); }
};

Protections protections_of(const FloorResult& f, const Settings& s) {
  constexpr double kNone_rad = 1e9;
  if (f.fit.refused) return {kNone_rad, kNone_rad};
  const double k = protection_factor(s.protection_factor, f.dof);
  return {k * f.roll_sigma_rad + f.roll_bound_rad.sum(), k * f.pitch_sigma_rad + f.pitch_bound_rad.sum()};
}

// Within another radius the floor looks otherwise: the levels reach to that too, and beyond, for the other is not the
// truth either. A wider look that was refused may yet have found the truth, or taken it for a rival.
void reach_to_other(const FloorResult& other, const Settings& s, FloorResult* floor) {
  constexpr double kBeyond = 1.5;
  const bool wider_look = other.roi_radius_m > floor->roi_radius_m && other.area_m2 >= kFloorAreaMin_m2;
  if (other.fit.refused && !wider_look) return;
  const RollPitch a = roll_pitch_of_up(floor->fit.plane.n), b = roll_pitch_of_up(other.fit.plane.n);
  const Protections known = protections_of(*floor, s);
  // What was refused has no level of its own, but its bound tells of its rivals.
  const double roll =
      kBeyond * std::fabs(a.roll_rad - b.roll_rad) + (other.fit.refused ? other.roll_bound_rad.sum() : 0.0);
  const double pitch =
      kBeyond * std::fabs(a.pitch_rad - b.pitch_rad) + (other.fit.refused ? other.pitch_bound_rad.sum() : 0.0);
  floor->roll_bound_rad[POSE_WALL_PART_RIVAL] += larger(0.0, roll - known.roll_rad);
  floor->pitch_bound_rad[POSE_WALL_PART_RIVAL] += larger(0.0, pitch - known.pitch_rad);
}

// Who chooses the smallest of several claims chooses a claim that is too small, the more so the more there are.
void widen(const Settings& s, std::uint32_t claims, FloorResult* floor) {
  constexpr double kPerOtherClaim = 1.0 / 16.0;
  if (floor->fit.refused) return;
  const double curse = kPerOtherClaim * static_cast<double>(claims - 1);
  const Protections known = protections_of(*floor, s);
  floor->roll_bound_rad[POSE_WALL_PART_RIVAL] += curse * known.roll_rad;
  floor->pitch_bound_rad[POSE_WALL_PART_RIVAL] += curse * known.pitch_rad;
}

// The machine stands on its floor, and about upright. Where more than one plane may be that floor and this one is
// steep, it may be a heap's flank as well, and so may its rivals: the levels reach to upright, of roll and of pitch, as
// nothing tells which way the rivals lean.
void reach_to_upright(FloorResult* floor) {
  if (floor->fit.refused || (floor->fit.reasons & POSE_WALL_R_FLOOR_AMBIGUOUS) == 0) return;
  const double tilt_rad = tilt_of_up(floor->fit.plane.n);
  if (!(tilt_rad > kSteep_rad)) return;
  floor->roll_bound_rad[POSE_WALL_PART_RIVAL] += tilt_rad;
  floor->pitch_bound_rad[POSE_WALL_PART_RIVAL] += tilt_rad;
}

// The floor within one radius after another.
struct Looks {
  FloorResult at[kRadiusSteps];
  int tried = 0, best = 0;

  Looks() {
    for (FloorResult& floor : at) floor.fit.refused = true;
  }

  void add(const FloorResult& seen, const Settings& s) {
    at[tried] = seen;
    // Of refused ones the widest that got furthest tells why.
    const bool tells_more = at[best].fit.refused && seen.fit.refused && seen.fit.found;
    if (tells_more || protections_of(seen, s).worse() < protections_of(at[best], s).worse()) best = tried;
    ++tried;
  }

  // The best, with levels that reach to what the others say.
  FloorResult taken(const Settings& s) const {
    FloorResult out = at[best];
    std::uint32_t claims = 0;
    for (const FloorResult& other : at) {
      reach_to_other(other, s, &out);
      claims += other.fit.refused ? 0U : 1U;
    }
    // The first radius is the configured one: it was not picked for its claim.
    if (best > 0) widen(s, claims, &out);
    return out;
  }
};

// Wider and wider, until a floor is good enough.
void look_wider(const BoundedPoints& cloud_base, const Settings& s, const Axes& axes,
                const Eigen::Vector3d& sensor_base_m, const Plane* last_floor, Random* random, FloorScratch* scratch,
                Looks* looks) {
  const PointSet& open = scratch->open_base;
  double worth_a_look = 0.0;  // so many points
  const double good_enough = kGoodEnough * radians(s.alert_limit_angle_deg);
  double radius_m = s.ground_roi_radius;
  bool widest = false;
  for (; !widest && looks->tried < kRadiusSteps && !scratch->work.is_spent(); radius_m *= kRadiusGrowth) {
    widest = !(radius_m < s.ground_roi_radius_max);
    if (widest) radius_m = s.ground_roi_radius_max;
    if (!widest) copy_within(open, radius_m, &scratch->within_base);
    const PointSet& within = widest ? open : scratch->within_base;
    if (static_cast<double>(within.count) < worth_a_look) continue;
    if (within.count >= kFloorPointsMin) worth_a_look = kWorthALook * static_cast<double>(within.count);
    POSE_WALL_NOTE(trace::floor_radius(static_cast<std::uint32_t>(looks->tried), radius_m));
    const FloorLook look{radius_m, open, within, looks->tried == 0 ? kOpenMost : kOpenMostAgain};
    looks->add(floor_within(look, cloud_base, s, axes, sensor_base_m, last_floor, random, scratch), s);
    scratch->work.add(open.count + within.count, steps::kPointWithin / 2);
    if (protections_of(looks->at[looks->best], s).worse() <= good_enough) return;
  }
}

}  // namespace

void FloorScratch::lay_out(Arena& arena, std::uint32_t points_max) {
  open_base.lay_out(arena, points_max);
  within_base.lay_out(arena, points_max);
  low = arena.take<std::uint32_t>(points_max + kFour);
  points.lay_out(arena, kFloorFitPoints);
  subset.lay_out(arena, kFloorSubset);
  grid.lay_out(arena);
  patches.lay_out(arena);
  surface.lay_out(arena);
  uneven.lay_out(arena);
}

FloorResult find_floor(const BoundedPoints& cloud_base, const Settings& settings, const Axes& axes,
                       const Eigen::Vector3d& sensor_base_m, const Plane* last_floor, Random* random,
                       FloorScratch* scratch) {
  scratch->grid.find_open(cloud_base, settings.ground_roi_radius_max, sensor_base_m.z(), scratch->low,
                          &scratch->open_base);
  scratch->work.add(cloud_base.count, steps::kVoxelOpened);
  Looks looks;
  look_wider(cloud_base, settings, axes, sensor_base_m, last_floor, random, scratch, &looks);
  POSE_WALL_NOTE(trace::floor_attempt_taken(static_cast<std::uint32_t>(looks.best)));
  FloorResult out = looks.taken(settings);
  if (!out.fit.refused && !scratch->work.is_spent()) {
    reach_to_floors_beside(cloud_base, settings, axes, sensor_base_m, random, scratch, &out);
  }
  reach_to_upright(&out);
  // What another look would have shown is not known: a rival, or that the floor is another one.
  if (scratch->work.is_spent()) {
    out.fit.refuse(POSE_WALL_R_WORK_LIMIT);
    POSE_WALL_NOTE(note_floor_unfinished(scratch->work, static_cast<std::uint32_t>(looks.best)));
  }
  return out;
}

}  // namespace pose_wall
