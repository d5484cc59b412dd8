// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/floor/rivals.hpp"

#include <cmath>

#include "base/estimation/near_plane.hpp"
#include "base/math/finite.hpp"
#include "base/math/rotation.hpp"
#include "engine/gates/gate.hpp"

namespace pose_wall {
namespace {

// A smaller floor must stand alone: where there is no floor, many small planes are as good.
constexpr double kSmallArea_m2 = 5.0;  // swept: half 9 moved, twice 1 lost 1 won
// Through so large a floor only reflections are seen; swept: half 1 won, twice nothing.
constexpr double kSureArea_m2 = 10.0;
constexpr double kSteep_rad = 0.17;  // 10 degrees; a heap's flanks lay at 11 and 15 (hard_day, seed 648, 2026-11-22)

// Parallel planes give the same roll and pitch, whichever of them is the floor.
bool lie_alike(const Plane& a, const Plane& b) {
  constexpr double kAlike_rad = 0.0175;  // 1 degree, the default alert limit; swept: half 2 moved, twice 2 moved
  return a.n.cross(b.n).squaredNorm() <= kAlike_rad * kAlike_rad;
}

// A rival is not fitted in full; half a degree, as 2 to 3 m of rough ground err.
constexpr double kRivalMargin_rad = 0.0087;  // swept: half 12 moved, twice 1 lost
// A fifth of the points may be strays where both planes meet; swept: half 5 lost, twice nothing.
constexpr double kOneSide = 0.8;
// Accuracy of the line in which two floors meet; swept: half and twice change nothing.
constexpr double kNearLine_m = 0.3;
constexpr double kLower_m = 0.3;  // a belt's or a table's height, more than a kerb's; 0.5 before a review, 2026-11-23
constexpr double kAlike = 0.3;    // slope of a table over a floor, 17 degrees; 0.1 before a review, 2026-11-23
constexpr std::uint32_t kPointsMin = 20;  // fewer left-over points draw no plane; swept: half and twice change nothing
// The plane was looked at only in passing: the angle to it counts a quarter and 1.5 degrees more:
constexpr double kStretch = 1.25;      // swept: half and twice change nothing
constexpr double kMargin_rad = 0.026;  // swept: half and twice change nothing

// Half the length of a machine and the slope that its tracks span. No key of the search: a wider one must not hide
// ramps.
constexpr double kNear_m = 4.5;  // swept: half 1 moved, twice nothing

// Points on all sides: the machine stands on them; its body hides a quarter of a turn.
constexpr std::uint32_t kGapOfBody = 2;  // swept: half 5 lost, twice 11 moved
constexpr std::uint32_t kAnyPart = 100;  // one point in a hundred is there; swept: half 2 lost, twice 3 moved
// Ground is most of what lies about its plane. A plane that is prolonged past its ground meets strays among other
// things. Behind the machine a ramp's plane had 46 % at most (judge, 8300745). Floors that a VLP-16 sees to both sides
// have 53 % at least on working days, and 84 % in a recorded corridor; half.
constexpr std::uint32_t kGroundPart = 2;  // swept: half 175 lost, twice 5 won
// Ruts and waves lie so far off a floor's plane; swept: half and twice change nothing.
constexpr double kAbout_m = 0.35;
constexpr std::uint32_t kRealPart = 20;  // strays alone are no ground either; swept: half and twice change nothing
// Half a turn: the machine stands at the edge of what is seen. Beyond, all of it lies ahead, behind or to one side.
constexpr std::uint32_t kGapOfHalf = 4;
// Ramps that were taken for the floor before floor_near was a gate lay up to 4.7 degrees otherwise. Twice as much, 10
// degrees, is more than any usual alert limit.
constexpr double kUnseenRamp_rad = 0.17;  // swept: half 3 won, twice 7 moved

// Number of points in each eighth of a turn around the machine.
struct Eighths {
  std::uint32_t count[8] = {}, total = 0;  // on the floor
  std::uint32_t about[8] = {};             // within kAbout_m of its plane
  std::uint32_t near = 0;                  // on the floor, within kNear_m

  bool has_any(std::uint32_t eighth) const { return total > 0 && count[eighth] * kAnyPart >= total; }
  bool has_ground(std::uint32_t eighth) const {
    return total > 0 && count[eighth] * kRealPart >= total && count[eighth] * kGroundPart >= about[eighth];
  }
  // Of the floor, near the machine. None speaks for it where other ground is seen, on which the machine may stand: what
  // lies about the plane but off it, in all eighths that do not show the floor.
  double near_share() const {
    std::uint32_t other = 0;
    for (std::uint32_t k = 0; k < 8; ++k) other += has_ground(k) ? 0 : about[k] - count[k];
    return total > 0 && other * kRealPart < total ? static_cast<double>(near) / total : 0.0;
  }
};

// Counts points within reach of the plane and below the sensor. Prolonged, a steep plane meets the roof.
Eighths eighths_of(const PointSet& points, const Plane& plane, const Settings& s, double sensor_z_base_m) {
  constexpr std::uint8_t kEighth[] = {0, 1, 7, 6, 3, 2, 4, 5};  // by signs of x and y and which of them is larger
  const FourDistances heights(plane);
  const FourFloats reach = all_four(static_cast<float>(s.ground_ransac_thresh)), none{};
  const FourFloats near2 = all_four(static_cast<float>(kNear_m * kNear_m));
  const FourFloats far = all_four(static_cast<float>(kAbout_m));
  const auto highest = static_cast<float>(sensor_z_base_m);
  Eighths out;
  for_each_four_points(points, [&](std::uint32_t, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
    const FourFloats off = magnitude_of(heights.of(x, y, z));
    const FourTruths about = counts & (z < highest) & (off <= far);
    if (!any_of(about)) return;
    const FourTruths on_floor = about & (off <= reach);
    const FourInts which = ((x < none) & 4) | ((y < none) & 2) | ((magnitude_of(x) < magnitude_of(y)) & 1);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      const std::uint8_t eighth = kEighth[static_cast<std::uint32_t>(which[lane])];
      out.about[eighth] += about[lane] != 0 ? 1 : 0;
      out.count[eighth] += on_floor[lane] != 0 ? 1 : 0;
    }
    out.total += sum_of_lanes(-on_floor);
    out.near += sum_of_lanes(-(on_floor & (x * x + y * y <= near2)));
  });
  return out;
}

// Eighths of a turn side by side that do not hold the floor.
template <typename Holds>
std::uint32_t widest_gap(const Holds& holds) {
  std::uint32_t empty = 0, widest = 0;
  for (std::uint32_t k = 0; k < 16; ++k) {
    empty = holds(k % 8) ? 0 : empty + 1;
    widest = empty > widest ? empty : widest;
  }
  return widest;
}

// Ground that is seen on one side only, and not where the machine stands, may be a ramp before or behind it. Nothing of
// the machine's own ground is left over to show that.
void reach_to_unseen_ground(const Eighths& seen, const Settings& s, FloorResult* floor) {
  if (widest_gap([&](std::uint32_t eighth) { return seen.has_ground(eighth); }) <= kGapOfHalf) return;
  if (demand<gate::FLOOR_NEAR>(&floor->fit, seen.near_share(), s)) return;
  floor->reach_to_rival(kUnseenRamp_rad, kUnseenRamp_rad);
}

// Copies open points off the floor and below the sensor. Over the floor they may be as high as the sensor. In base they
// may be higher, but not as high as a roof: flat ground lies high over a steep plane that is prolonged.
void copy_left_over(const PointSet& open, const Plane& floor, double off_m, const Eigen::Vector3d& sensor_base_m,
                    PointSet* out) {
  // Heights of the sensor; higher points are roof; swept: half 8 moved, twice 2 moved.
  constexpr float kBelowRoof = 1.6F;
  const FourDistances heights(floor);
  const FourFloats off = all_four(static_cast<float>(off_m));
  const FourFloats highest = all_four(static_cast<float>(floor.signed_distance(sensor_base_m)));
  const FourFloats sensor_z = all_four(static_cast<float>(sensor_base_m.z()));
  copy_where(open, out, [&](FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
    const FourFloats height = heights.of(x, y, z);
    return counts & (magnitude_of(height) > off) &
           ((height < highest) | ((z < sensor_z) & (height < kBelowRoof * highest)));
  });
}

// Of the open points on one plane and off the other: the share that lies above the other.
double share_above(const PointSet& open, const Plane& on, const Plane& other, double thresh_m) {
  const FourDistances from_own(on), from_other(other);
  const FourFloats thresh = all_four(static_cast<float>(thresh_m));
  const FourFloats off = all_four(static_cast<float>(kOwnInThresholds * thresh_m));
  FourInts of_own{}, above{};  // true is -1
  for_each_four_points(open, [&](std::uint32_t, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
    const FourFloats height = from_other.of(x, y, z);
    counts &= (magnitude_of(from_own.of(x, y, z)) <= thresh) & (magnitude_of(height) > off);
    of_own -= counts;
    above -= counts & (height > FourFloats{});
  });
  const std::uint32_t count = sum_of_lanes(of_own);
  return count > 0 ? static_cast<double>(sum_of_lanes(above)) / count : 0.5;
}

// Where ground rises in a line, each surface is the higher one of the two planes. Where it falls, each is the lower
// one. So each plane has its points on its own side of the line, and the machine stands on the plane of its side.
bool may_stand_on(const PointSet& open, const Plane& other, const Plane& floor, double thresh_m) {
  const double other_above = share_above(open, other, floor, thresh_m);
  const double floor_above = share_above(open, floor, other, thresh_m);
  const bool other_is_higher = other_above >= kOneSide, other_is_lower = other_above <= 1.0 - kOneSide;
  const bool floor_is_higher = floor_above >= kOneSide, floor_is_lower = floor_above <= 1.0 - kOneSide;
  const auto slope = [](const Plane& p) { return Eigen::Vector2d(p.n.x() / p.n.z(), p.n.y() / p.n.z()); };
  const double unlike = std::sqrt((slope(other) - slope(floor)).squaredNorm());
  const double step_m = floor.d / floor.n.z() - other.d / other.n.z();  // up to the other one, at the machine
  if (other_is_higher && floor_is_higher) return step_m > -kNearLine_m * unlike;
  if (other_is_lower && floor_is_lower) return step_m < kNearLine_m * unlike;
  return other_is_lower && floor_is_higher && step_m < -kLower_m && unlike < kAlike;
}

// What a rival shows of what the floor shows, where only one of the two planes has points. What both show speaks for
// neither: a tilted plane through rough ground meets much of the floor's ground as well, and the fit's errors cover it.
double share_apart(const FloorScene& scene, const PointSet& within_base, const Plane& rival, const Plane& floor,
                   FloorScratch* scratch) {
  const double thresh_m = scene.settings.ground_ransac_thresh;
  scratch->work.add(within_base.count, steps::kPointApart);
  const auto only_on_m2 = [&](const Plane& plane, const Plane& other) {
    scratch->grid.mark_apart(within_base, plane, other, thresh_m);
    return scratch->grid.evidence(scene.axes).score_m2;
  };
  const double of_rival_m2 = only_on_m2(rival, floor), of_floor_m2 = only_on_m2(floor, rival);
  return of_floor_m2 > 0.0 ? of_rival_m2 / of_floor_m2 : 1.0;
}

}  // namespace

// Through a small floor the real floor may show instead of a reflection.
void reach_to_rivals(const FloorScene& scene, const PointSet& within_base, const FloorCandidates& candidates,
                     FloorScratch* scratch, FloorResult* floor) {
  const Settings& s = scene.settings;
  const FloorCandidate& best = *candidates.best();
  // On a small floor a few centimetres are many degrees, so what both planes show counts. So it does where the fit
  // failed or wandered off to the rival.
  const Plane& fitted = floor->fit.plane;
  const bool is_sure = floor->fit.found && same_floor(fitted, best.plane) && best.evidence.area_m2 >= kSmallArea_m2;
  const RollPitch a = roll_pitch_of_up(best.plane.n);
  double roll = 0.0, pitch = 0.0;
  for (const FloorCandidate& rival : candidates.all()) {
    if (&rival == &best || (!rival.may_carry() && best.evidence.area_m2 >= kSureArea_m2)) continue;
    if (scratch->work.stops()) break;
    double share = rival.evidence.score_m2 / best.evidence.score_m2;
    if (is_sure && share >= limit_of<gate::FLOOR_RIVAL>(s)) {
      const double apart = share_apart(scene, within_base, rival.plane, fitted, scratch);
      share = apart < share ? apart : share;
    }
    if (passes<gate::FLOOR_RIVAL>(share, s)) continue;
    POSE_WALL_NOTE(trace::fate(rival.plane, POSE_WALL_TRACE_RIVAL));
    const RollPitch b = roll_pitch_of_up(rival.plane.n);
    roll = larger(roll, std::fabs(a.roll_rad - b.roll_rad) + kRivalMargin_rad);
    pitch = larger(pitch, std::fabs(a.pitch_rad - b.pitch_rad) + kRivalMargin_rad);
    floor->fit.reasons |= POSE_WALL_R_FLOOR_AMBIGUOUS;
    const bool must_stand_alone = best.evidence.area_m2 < kSmallArea_m2 && !rival.ghost;
    if (must_stand_alone && !lie_alike(best.plane, rival.plane)) demand<gate::FLOOR_ALONE>(&floor->fit, share, s);
  }
  floor->reach_to_rival(roll, pitch);
}

// The levels reach to the floor within another radius, and beyond, since that one is not the truth either. A wider look
// that was refused may still have found the truth, or taken it for a rival.
void reach_to_other_look(const FloorResult& other, const Settings& s, FloorResult* floor) {
  constexpr double kBeyond = 1.5;  // the other look is not the truth either; swept: half 12 moved, twice 1 lost
  const bool wider_look = other.roi_radius_m > floor->roi_radius_m && other.area_m2 >= limit_of<gate::FLOOR_AREA>(s);
  if (other.fit.refused && !wider_look) return;
  const RollPitch a = roll_pitch_of_up(floor->fit.plane.n), b = roll_pitch_of_up(other.fit.plane.n);
  const Protections known = protections_of(*floor, s);
  // A refused floor has no level of its own, but its bound covers its rivals.
  const auto of_rivals = [&](const ProtectionParts& bound) { return other.fit.refused ? bound.sum() : 0.0; };
  const double roll = kBeyond * std::fabs(a.roll_rad - b.roll_rad) + of_rivals(other.roll.bound_rad);
  const double pitch = kBeyond * std::fabs(a.pitch_rad - b.pitch_rad) + of_rivals(other.pitch.bound_rad);
  floor->reach_to_rival(larger(0.0, roll - known.roll_rad), larger(0.0, pitch - known.pitch_rad));
}

void widen_by_claims(std::uint32_t claims, const Settings& s, FloorResult* floor) {
  constexpr double kPerOtherClaim = 1.0 / 16.0;  // a quarter at first; fewer radii, less choice (bench/README.md)
  if (floor->fit.refused) return;
  const double curse = kPerOtherClaim * static_cast<double>(claims - 1);
  const Protections known = protections_of(*floor, s);
  floor->reach_to_rival(curse * known.roll_rad, curse * known.pitch_rad);
}

void reach_to_floors_beside(const FloorScene& scene, Random* random, FloorScratch* scratch, FloorResult* floor) {
  const Settings& s = scene.settings;
  const Eigen::Vector3d& sensor_base_m = scene.sensor_base_m;
  const PointSet &open = scratch->open_base, &left_over = scratch->within_base;
  const Plane plane = floor->fit.plane;
  scratch->work.add(open.count, steps::kPointWithin);
  const Eighths seen = eighths_of(open, plane, s, sensor_base_m.z());
  reach_to_unseen_ground(seen, s, floor);
  if (widest_gap([&](std::uint32_t eighth) { return seen.has_any(eighth); }) <= kGapOfBody) return;
  const double off_m = kOwnInThresholds * s.ground_ransac_thresh;
  copy_left_over(open, plane, off_m, sensor_base_m, &scratch->within_base);
  if (left_over.count < kPointsMin) return;
  FloorCandidates found;
  POSE_WALL_NOTE(trace::attempt(POSE_WALL_TRACE_ATTEMPTS_MAX));  // outside the radii
  const FloorScene without_last{scene.cloud_base, s, scene.axes, sensor_base_m, nullptr};
  find_candidates(without_last, left_over, Among::kLeftOver, random, scratch, &found);
  POSE_WALL_NOTE(trace::attempt(0));
  scratch->grid.mark(open, plane, s.ground_ransac_thresh);
  const RollPitch a = roll_pitch_of_up(plane.n);
  for (const FloorCandidate& other : found.all()) {
    if (scratch->work.stops()) return;
    scratch->work.add(open.count, steps::kPointWeighed);
    if (other.ghost || is_reflection(scene, open, plane, other.plane, scratch->grid)) continue;
    if (!may_stand_on(open, other.plane, plane, s.ground_ransac_thresh)) continue;
    const RollPitch b = roll_pitch_of_up(other.plane.n);
    const double roll_rad = a.roll_rad - b.roll_rad, pitch_rad = a.pitch_rad - b.pitch_rad;
    if (demand<gate::FLOOR_BESIDE>(&floor->fit, larger(std::fabs(roll_rad), std::fabs(pitch_rad)), s)) continue;
    const auto reach_to = [](double apart_rad, ProtectionParts* bound_rad) {
      bound_rad->reach(kStretch * std::fabs(apart_rad) + kMargin_rad, POSE_WALL_PART_RIVAL);
    };
    reach_to(roll_rad, &floor->roll.bound_rad);
    reach_to(pitch_rad, &floor->pitch.bound_rad);
  }
}

// The machine stands on its floor, and about upright. If the floor has rivals and is steep, it may be a heap's flank,
// and so may the rivals. The levels of roll and pitch reach to upright, since nothing shows which way the rivals lean.
void reach_to_upright(FloorResult* floor) {
  if (floor->fit.refused || (floor->fit.reasons & POSE_WALL_R_FLOOR_AMBIGUOUS) == 0) return;
  const double tilt_rad = tilt_of_up(floor->fit.plane.n);
  if (!(tilt_rad > kSteep_rad)) return;
  floor->reach_to_rival(tilt_rad, tilt_rad);
}

FloorResult doubted_by_walls(const FloorResult& floor, const Eigen::Vector3d& tilt_level_rad, const Settings& s,
                             const Levelling& levelling) {
  FloorResult out = floor;
  POSE_WALL_NOTE(const trace::About about(POSE_WALL_TRACE_FLOOR));
  if (demand<gate::FLOOR_BY_WALLS>(&out.fit, std::sqrt(tilt_level_rad.squaredNorm()), s)) return out;
  // A turn about base X is roll, about base Y pitch.
  const Eigen::Vector3d tilt_base_rad = levelling.R_level_base.transpose() * tilt_level_rad;
  out.reach_to_rival(std::fabs(tilt_base_rad.x()), std::fabs(tilt_base_rad.y()));
  return out;
}

}  // namespace pose_wall
