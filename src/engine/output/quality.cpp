// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/output/quality.hpp"

#include <cmath>

#include "base/estimation/protection.hpp"
#include "base/estimation/wave_models.hpp"
#include "base/math/elementary.hpp"
#include "base/math/finite.hpp"
#include "engine/gates/gate.hpp"
#include "engine/region/region_plane.hpp"

namespace pose_wall {
namespace {

// Parallel walls differ by more in 0.3 % of cases; swept: half 12 moved, twice 9 moved.
constexpr double kSplayInSigmas = 3.0;
// Walls may differ by so much by chance. Beyond, up to kSplayInSigmas, the rock is known less well than it seems, and
// the standard deviation is stretched to fit (Birge 1932). In seed 647 yaw's protection ended 0.06 degrees short; of
// 6400 frames no more are degraded (2026-11-22).
constexpr double kLikelyInSigmas = 2.0;
// No standard deviation is below about a thousandth of the alert limits:
constexpr double kSigmaMinAngle_rad = 1e-5;   // swept: half 287 moved, twice 287 moved
constexpr double kSigmaMinDistance_m = 1e-4;  // swept: half 279 moved, twice 279 moved

// Dof / (dof - 2) stretches a variance by 2 at most; swept: half 1 moved, twice 32 moved.
constexpr double kDofMin = 4.0;

double with_floor(double sigma, double least) {
  return std::sqrt(sigma * sigma + least * least);
}

// A standard deviation estimated from few pieces: the errors follow Student's t, whose own is larger.
double predictive(double sigma, double dof) {
  return dof > kDofMin ? sigma * std::sqrt(dof / (dof - 2.0)) : sigma * std::sqrt(kDofMin / (kDofMin - 2.0));
}

Measurement measurement(double raw, double sigma, const ProtectionParts& bound, double dof, const Settings& s) {
  Measurement m;
  m.raw = raw;
  m.sigma = predictive(sigma, dof);
  m.dof = dof;
  m.protection = bound;
  m.protection[POSE_WALL_PART_RANDOM] += protection_factor(s.protection_sigmas, dof) * sigma;
  // A measurement without a finite bound is none.
  m.measured = is_finite(m.raw) && is_finite(m.sigma) && is_finite(m.protection.sum());
  if (!m.measured) m.reasons = POSE_WALL_R_ALERT_LIMIT;
  return m;
}

void measure_floor(const FloorResult& floor, const Levelling& levelling, const Settings& s, Measurement* roll,
                   Measurement* pitch) {
  if (!floor.fit.refused) {
    *roll = measurement(levelling.roll_rad, with_floor(floor.roll.sigma_rad, kSigmaMinAngle_rad), floor.roll.bound_rad,
                        floor.roll.dof, s);
    *pitch = measurement(levelling.pitch_rad, with_floor(floor.pitch.sigma_rad, kSigmaMinAngle_rad),
                         floor.pitch.bound_rad, floor.pitch.dof, s);
  }
  for (Measurement* m : {roll, pitch}) m->reasons |= floor.fit.reasons;
}

void measure_distances(const JudgedWall& wall, const Settings& s, Measurement* front, Measurement* back) {
  Measurement* const ends[2] = {front, back};
  for (int end = 0; end < 2; ++end) {
    Measurement& m = *ends[end];
    if (!wall.fit.refused) {
      ProtectionParts bound = wall.distance_bound_m[end];
      bound[POSE_WALL_PART_BEND] += kLayerFactor * wall.layer_sigma_m;
      m = measurement(wall.distance_m[end], with_floor(wall.distance_sigma_m[end], kSigmaMinDistance_m), bound,
                      wall.distance_dof[end], s);
      m.sigma = with_floor(m.sigma, wall.layer_sigma_m);
      if (wall.extrapolated[end]) m.reasons |= POSE_WALL_R_EXTRAPOLATED;
    }
    m.reasons |= wall.fit.reasons;
  }
}

// Share of a floor's error that turns into yaw. With a leaning wall, or a machine that looks up or down, part of a tilt
// about the road is a turn about the vertical.
double tilt_to_yaw(const JudgedWall& wall, const Levelling& levelling) {
  const double lean = sine(wall.lean_rad) / cosine(wall.lean_rad);
  const double up = levelling.forward_up;
  return std::fabs(lean) + std::fabs(up) / std::sqrt(1.0 - up * up);
}

// A wall's own bound and the larger one of the floor.
ProtectionParts yaw_bound_of(const JudgedWall& wall, const FloorResult& floor, const Levelling& levelling) {
  const bool by_roll = floor.roll.bound_rad.sum() > floor.pitch.bound_rad.sum();
  ProtectionParts bound = wall.yaw_bound_rad;
  bound.add(by_roll ? floor.roll.bound_rad : floor.pitch.bound_rad, tilt_to_yaw(wall, levelling));
  return bound;
}

// Adds the floor's tilt error as yaw: one error, whatever the number of walls.
Measurement yaw_measurement(double raw, double walls_variance, const ProtectionParts& bound, double dof,
                            double tilt_share, const FloorResult& floor, const Settings& s) {
  const AngleErrors& worse = floor.roll.sigma_rad > floor.pitch.sigma_rad ? floor.roll : floor.pitch;
  const double tilt = worse.sigma_rad * tilt_share;
  // Without the degrees of freedom of the floor, which are then no number, yaw has no bound.
  const Spread both = sum_of({walls_variance, dof}, {tilt * tilt, worse.dof});
  return measurement(raw, with_floor(std::sqrt(both.variance), kSigmaMinAngle_rad), bound, both.dof, s);
}

// Of a wall by itself: nothing of it cancels.
ProtectionParts bound_alone(const JudgedWall& wall, const FloorResult& floor, const Levelling& levelling,
                            const Settings& s) {
  ProtectionParts bound = yaw_bound_of(wall, floor, levelling);
  bound[POSE_WALL_PART_RIVAL] += wall.yaw_to_rival_rad;
  bound[POSE_WALL_PART_RANGE_BIAS] += s.range_bias_max * std::fabs(wall.yaw_bias_rad_per_m);
  return bound;
}

Measurement yaw_by_one(const JudgedWall& wall, const FloorResult& floor, const Levelling& levelling,
                       const Settings& s) {
  return yaw_measurement(wall.yaw_rad, wall.yaw_sigma_rad * wall.yaw_sigma_rad, bound_alone(wall, floor, levelling, s),
                         wall.yaw_dof, tilt_to_yaw(wall, levelling), floor, s);
}

// Mean of both directions, weighted by their information. A range bias turns the walls against each other and cancels
// in the mean as far as the weights are alike. The signed responses give the rest.
Measurement yaw_by_both(const JudgedWall (&walls)[2], const FloorResult& floor, const Levelling& levelling,
                        const Settings& s) {
  double variance[2] = {}, information = 0.0;
  for (int side = 0; side < 2; ++side) {
    const double sigma = with_floor(walls[side].yaw_sigma_rad, kSigmaMinAngle_rad);
    variance[side] = sigma * sigma;
    information += 1.0 / variance[side];
  }
  const double w[2] = {1.0 / (variance[0] * information), 1.0 / (variance[1] * information)};
  const double raw = w[0] * walls[0].yaw_rad + w[1] * walls[1].yaw_rad;
  const double bias = w[0] * walls[0].yaw_bias_rad_per_m + w[1] * walls[1].yaw_bias_rad_per_m;
  ProtectionParts bound;
  bound[POSE_WALL_PART_RANGE_BIAS] = s.range_bias_max * std::fabs(bias);
  for (int side = 0; side < 2; ++side) bound.add(yaw_bound_of(walls[side], floor, levelling), w[side]);
  // If a road bends ahead, both walls may be those behind the bend, so neither supports the other.
  bound[POSE_WALL_PART_RIVAL] += larger(walls[0].yaw_to_rival_rad, walls[1].yaw_to_rival_rad);
  const double difference = std::fabs(walls[0].yaw_rad - walls[1].yaw_rad);
  const double biased_apart = s.range_bias_max * std::fabs(walls[0].yaw_bias_rad_per_m - walls[1].yaw_bias_rad_per_m);
  const double apart_in_sigmas = (difference - biased_apart) / std::sqrt(variance[0] + variance[1]);
  const bool splayed = apart_in_sigmas > kSplayInSigmas;
  // The road's own direction lies between the walls', and the mean may lie at either.
  if (splayed) bound[POSE_WALL_PART_BEND] += larger(w[0], w[1]) * difference;
  const double stretch = larger(1.0, (splayed ? kSplayInSigmas : apart_in_sigmas) / kLikelyInSigmas);
  // A wall that looks precise by chance must not lend the other its degrees of freedom.
  const double dof = 1.0 / (w[0] * w[0] / walls[0].yaw_dof + w[1] * w[1] / walls[1].yaw_dof);
  const double tilt_share = larger(tilt_to_yaw(walls[0], levelling), tilt_to_yaw(walls[1], levelling));
  return yaw_measurement(raw, stretch * stretch / information, bound, dof, tilt_share, floor, s);
}

// The direction may be that of one wall alone.
void reach_to_one(const JudgedWall& wall, const FloorResult& floor, const Levelling& levelling, const Settings& s,
                  Measurement* yaw) {
  const Measurement alone = yaw_by_one(wall, floor, levelling, s);
  yaw->protection.reach(std::fabs(yaw->raw - alone.raw) + alone.protection.sum(), POSE_WALL_PART_RIVAL);
}

// If one of two walls is none, the other one alone gives the direction (solution separation: Blanch et al. 2015). If
// nothing but things that may be no wall is left, the direction is that of a thing.
void reach_without_things(const FloorResult& floor, const Levelling& levelling, const JudgedWall (&walls)[2],
                          const Settings& s, Measurement* yaw) {
  // 25 degrees; as far as a road may bend before a wall; swept: half 2 moved, twice 2 moved.
  constexpr double kThing_rad = 0.44;
  for (int side = 0; side < 2; ++side) {
    if (walls[side].fit.refused || !walls[side].may_be_no_wall) continue;
    const JudgedWall& other = walls[1 - side];
    if (other.fit.refused || other.may_be_no_wall) {
      yaw->protection[POSE_WALL_PART_RIVAL] += kThing_rad;
      return;
    }
    reach_to_one(other, floor, levelling, s, yaw);
  }
}

Measurement yaw_by_endless(const FloorResult& floor, const Levelling& levelling, const JudgedWall (&walls)[2],
                           const Settings& s) {
  const bool left = !walls[0].fit.refused, right = !walls[1].fit.refused;
  Measurement m;
  if (left && right) {
    m = yaw_by_both(walls, floor, levelling, s);
  } else if (left || right) {
    m = yaw_by_one(walls[left ? 0 : 1], floor, levelling, s);
  }
  if (m.measured) reach_without_things(floor, levelling, walls, s, &m);
  for (const JudgedWall& wall : walls) {
    // If one wall is left, the reasons of the other do not count against yaw. If none is, they explain it.
    if (!wall.fit.refused || !m.measured) m.reasons |= wall.fit.reasons;
  }
  return m;
}

// Of a side whose region is not known the endless wall stands for it, or the one that faces it.
const JudgedWall* directing_wall(const MeasuredWalls& walls, int side) {
  const RegionWall& region = walls.region[side];
  if (region.has_plane()) return &region.wall;
  if (region.is_known()) return nullptr;
  for (const int of : {side, 1 - side}) {
    if (!walls.endless[of].fit.refused) return &walls.endless[of];
  }
  return nullptr;
}

// By the definition the road's direction is the mean of both regions' walls, or that of one where the other side is
// none (include/DEFINITIONS.md). A side that may be none is both.
Measurement yaw_by_regions(const FloorResult& floor, const Levelling& levelling, const MeasuredWalls& found,
                           const Settings& s) {
  const JudgedWall* const wall[2] = {directing_wall(found, 0), directing_wall(found, 1)};
  const double walls = (wall[0] != nullptr ? 1.0 : 0.0) + (wall[1] != nullptr ? 1.0 : 0.0);
  if (walls == 0.0) return {};
  const double w = 1.0 / walls;
  double raw = 0.0, variance = 0.0, per_dof = 0.0, tilt_share = 0.0;
  ProtectionParts bound;
  for (const JudgedWall* const of : wall) {
    if (of == nullptr) continue;
    raw += w * of->yaw_rad;
    variance += w * w * of->yaw_sigma_rad * of->yaw_sigma_rad;
    per_dof += w * w / of->yaw_dof;
    bound.add(bound_alone(*of, floor, levelling, s), w);
    tilt_share = larger(tilt_share, tilt_to_yaw(*of, levelling));
  }
  Measurement m = yaw_measurement(raw, variance, bound, 1.0 / per_dof, tilt_share, floor, s);
  for (int side = 0; side < 2; ++side) {
    if (found.region[side].is_sure()) continue;
    const RegionWall& other = found.region[1 - side];
    if (!other.has_plane()) return {};  // it may be that neither is a wall
    reach_to_one(other.wall, floor, levelling, s, &m);
  }
  return m;
}

// As of floor and walls: the endless one where it is known better.
Measurement measure_yaw(const FloorResult& floor, const Levelling& levelling, const MeasuredWalls& walls,
                        const Settings& s) {
  if (!walls.has_regions) return yaw_by_endless(floor, levelling, walls.side, s);
  const Measurement endless = yaw_by_endless(floor, levelling, walls.endless, s);
  const Measurement region = yaw_by_regions(floor, levelling, walls, s);
  if (!region.measured) return endless;
  bool is_same = endless.measured;
  for (const RegionWall& side : walls.region) is_same = is_same && (side.may_be_endless || !side.has_plane());
  return is_same && endless.protection.sum() <= region.protection.sum() ? endless : region;
}

}  // namespace

Measurements measure_quantities(const FloorResult& floor, const Levelling& levelling, const MeasuredWalls& found,
                                const Settings& settings) {
  const JudgedWall(&walls)[2] = found.side;
  Measurements out;
  Measurement* const q = out.quantity;
  measure_floor(floor, levelling, settings, &q[POSE_WALL_ROLL], &q[POSE_WALL_PITCH]);
  q[POSE_WALL_YAW] = measure_yaw(floor, levelling, found, settings);
  measure_distances(walls[0], settings, &q[POSE_WALL_D_LF], &q[POSE_WALL_D_LB]);
  measure_distances(walls[1], settings, &q[POSE_WALL_D_RF], &q[POSE_WALL_D_RB]);
  out.has_yaw_difference = !walls[0].fit.refused && !walls[1].fit.refused;
  out.left_right_yaw_difference_rad = walls[0].yaw_rad - walls[1].yaw_rad;
  for (std::uint32_t i = 0; i < POSE_WALL_QUANTITIES; ++i) {
    POSE_WALL_NOTE(const trace::About about(POSE_WALL_TRACE_QUANTITY + i));
    if (!q[i].measured && (q[i].reasons & POSE_WALL_R_ALERT_LIMIT) == 0) continue;
    if (!passes<gate::PROTECTION_RAW>(q[i].protection.sum(), alert_limit(i, settings))) {
      q[i].reasons |= POSE_WALL_R_ALERT_LIMIT;
    }
  }
  return out;
}

}  // namespace pose_wall
