// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/place_scan.hpp"

#include <cmath>

#include "motion/far_match.hpp"
#include "motion/frame_steps.hpp"
#include "motion/wide_start.hpp"

namespace pose_wall::motion {
namespace {

constexpr std::uint32_t kAskedOfGuess = 400;  // of these the ones on walls: a share is then known to within 0.05
// A wide start looks as far as the machine comes in so long. This binds slow machines alone: from 1.4 m/s and 0.17
// rad/s on the grid ends before (kStartsMost).
constexpr double kSearchMost_s = 5.0;
// Of the fine steps; all of a sparse sensor's count. With half as many the yaw rate's level is 30 % wider in the sweep,
// with twice as many 24 % narrower.
constexpr std::uint32_t kEquationsMost = 2048;
// Of coarse steps, which end by themselves where they stand still. One would do on a road, where the sweep measured
// as many frames; after a gap there is further to go.
constexpr int kPassesMost = 4;
// Of the curve, however little the machine can have slipped. With 0.1 the sweep measured 326 frames and not 348. With
// 0.4 rock further off is taken for this one: the 95th percentile of step errors is 48 mm and not 17.
constexpr double kReachLeast_m = 0.2;

// Where the search along the road begins, and whether the scan fits there at all.
struct Entry {
  Pose pose;
  bool wide, fits;
};

// Where the scan lies once its place along the road is matched, and what that tells.
struct Way {
  Curve curve;
  Eigen::Vector3d t;
  std::uint32_t state = POSE_WALL_ALONG_MEASURED, reasons = 0;
  bool is_guessed = false;
};

class Placing {
 public:
  Placing(const Road& road, const Frame& frame, const Seen& seen, PlaceScratch* scratch, Work* work)
      : road_(road),
        frame_(frame),
        observations_(seen.observations),
        scan_{&road.map, seen.observations, road.sensor_base_m.cast<float>()},
        s_(*scratch),
        work_(*work) {}

  // The expected place; after a gap, which any guess may be off by, the one that a wide search finds.
  Entry enter(const Pose& expected) {
    const std::uint32_t stride = observations_.size() / kAskedOfGuess + 1;
    if (passes<gate::IN_TIME>(frame_.dt_s) &&
        passes<gate::ON_MAP_IN_TIME>(share_on_map(road_.map, observations_, expected, stride))) {
      return {expected, false, true};
    }
    Pose at = expected;
    at.R = orthonormal(upright(observations_, at.R, road_.sensor_base_m) * at.R);
    face(at.R, observations_);
    const double reach_s = frame_.dt_s < kSearchMost_s ? frame_.dt_s : kSearchMost_s;
    const WideReach reach = {road_.settings.turn_max_rad_s * reach_s, road_.settings.speed_max_m_s * reach_s};
    const bool fits = search_wide(road_.map, observations_, reach, &s_.starts, &work_, &at);
    return {at, true, fits};
  }

  // By the planes, with the axes of the road there.
  void fit_planes(const Pose& at, Alignment* a) {
    a->pose = at;
    a->axes = road_.course.axes;
    const Eigen::Vector3d forward = at.R * road_.settings.forward_base;
    a->axes = find_axes(scan_, a->pose, forward, a->axes);
    StepOptions coarse;
    coarse.every = 4;
    bool moves = true;
    for (int pass = 0; pass < kPassesMost && moves; ++pass) {
      work_.add(observations_.size() / coarse.every, steps::kEquation);
      moves = take_steps(scan_, coarse, &s_.steps, a);
    }
    a->axes = find_axes(scan_, a->pose, forward, a->axes);
  }

  // The place along the road and its uncertainty.
  Way match_way(const Alignment& a) {
    // Along a road a wide start has placed the scan beside it alone.
    const bool far = !passes<gate::IN_TIME>(frame_.dt_s) && !a.axes.tell_along();
    const FarPlace place = far ? match_far(scan_, road_.settings.speed_max_m_s * frame_.dt_s, a, &s_.curve, &work_)
                               : FarPlace{match_near(a), a.pose.t};
    Way out;
    out.curve = place.curve;
    out.t = a.pose.t;
    if (!is_evidence(out.curve)) {
      const bool smooth = !passes<gate::CONTRAST>(out.curve.contrast);
      out.reasons = smooth ? POSE_WALL_MOTION_R_SMOOTH : POSE_WALL_MOTION_R_FEW_PATCHES;
      out.state = POSE_WALL_ALONG_UNOBSERVABLE;
      // Not worth a claim, but a better guess than the last speed: without it a sparse sensor that starts on the move
      // never gets a map to claim by.
      out.is_guessed = !smooth && passes<gate::GUESS>(out.curve.patches);
      if (!out.is_guessed) return out;
    } else if (out.curve.apart_m > 0.0) {
      out.reasons = POSE_WALL_MOTION_R_SECOND_PEAK;
      out.state = POSE_WALL_ALONG_AMBIGUOUS;
    }
    out.t = place.t + out.curve.best_m * a.axes.along;
    return out;
  }

  // By the relief of the rock, and where planes hold along, by these.
  void fit_relief(bool with_along, Alignment* a) {
    StepOptions fine;
    fine.use_relief = true;
    fine.every = (observations_.size() + kEquationsMost - 1) / kEquationsMost;
    fine.rounds = 3;
    fine.with_along = with_along;
    work_.add(observations_.size() / fine.every, steps::kEquation);
    take_steps(scan_, fine, &s_.steps, a);
  }

  // The last centimetres along the road.
  FinePlace refine(const Alignment& a) {
    work_.add(steps::of_curve(observations_.size(), kRowsMost, kFineShifts));
    return refine_along(scan_, a, &s_.curve);
  }

  // A fit that needs more motion than the machine is capable of is none. Dust turned it upside down, frame by frame.
  bool is_in_reach(const Alignment& a) const {
    const Pose& last = road_.course.pose;
    const Eigen::Vector3d moved_m = a.pose.t - last.t, beside_m = moved_m - a.axes.along * a.axes.along.dot(moved_m);
    const double turned_rad = std::sqrt(turn_of(last.R.transpose() * a.pose.R).squaredNorm());
    return passes_of<gate::REACH>(std::sqrt(beside_m.squaredNorm()), road_.settings.speed_max_m_s * frame_.dt_s) &&
           passes_of<gate::REACH>(turned_rad, road_.settings.turn_max_rad_s * frame_.dt_s);
  }

 private:
  // The curve about the expected place.
  Curve match_near(const Alignment& a) {
    const double start_m =
        road_.course.frames == 0 ? limit_of<gate::REACH>() * road_.settings.speed_max_m_s * frame_.dt_s : 0.0;
    double reach = road_.course.slipped.m() + start_m;
    reach = reach < kReachLeast_m ? kReachLeast_m : reach > kReachMost_m ? kReachMost_m : reach;
    const std::uint32_t shifts = 2 * static_cast<std::uint32_t>(reach / kCurveStep_m + 0.5) + 1;
    work_.add(steps::of_curve(observations_.size(), kRowsMost, shifts));
    return match_along(scan_, a, reach, shifts, &s_.curve);
  }

  const Road& road_;
  const Frame& frame_;
  Span<Observation> observations_;
  const Scan scan_;
  PlaceScratch& s_;
  Work& work_;
};

// One frame's own estimate of it has heavy tails, and the rock does not change from frame to frame.
double pooled(double own_m2, double before_m2) {
  return before_m2 > 0.0 ? 0.5 * (own_m2 + before_m2) : own_m2;
}

// Variance of the refined way.
double variance_along(const Road& road, const Curve& curve, double rock_variance_m2) {
  // Shifts further off than the curve's own steps resolve, which the patches do not exclude, are within the level.
  const double around_m = curve.around_m > 2.5 * kCurveStep_m ? curve.around_m : 0.0;
  const double sigma_m = around_m / road.settings.protection_sigmas;
  const double variance_m2 = sigma_m * sigma_m > rock_variance_m2 ? sigma_m * sigma_m : rock_variance_m2;
  // The place in a cell where one scan met the rock is chance, the same for all rows that one ring drew. So a young map
  // errs as a whole. Of a start in motion 8 of 8 roads erred by 5 to 30 mm, and patches indicated 5.
  const double cell_m = 1.0 / kAlongCells, of_map_m = cell_m / road.map.keyframes();
  return variance_m2 + of_map_m * of_map_m / 12.0;
}

// Of its own: what the steps say of along beside across and yaw is not of this estimate.
void set_along(double variance_m2, SixBySix* covariance) {
  covariance->row(POSE_WALL_MOTION_ALONG).setZero();
  covariance->col(POSE_WALL_MOTION_ALONG).setZero();
  (*covariance)(POSE_WALL_MOTION_ALONG, POSE_WALL_MOTION_ALONG) = variance_m2;
}

std::uint32_t bit(bool is_set, std::uint32_t reason) {
  return is_set ? reason : 0U;
}

}  // namespace

void PlaceScratch::lay_out(Arena& arena) {
  const std::uint64_t place = arena.place();
  steps.lay_out(arena);
  curve.lay_out(arena);
  arena.go_back(place);
  starts.lay_out(arena);
  arena.go_behind_all();
}

Placed place_scan(const Road& road, const Frame& frame, const Pose& expected, const Seen& seen, PlaceScratch* scratch,
                  Work* work) {
  Placed out;
  out.reasons = bit(!passes<gate::IN_TIME>(frame.dt_s) && frame.is_late, POSE_WALL_MOTION_R_GAP);
  out.rock_variance_m2 = road.course.rock_variance_m2;
  Placing placing(road, frame, seen, scratch, work);
  const Entry entry = placing.enter(expected);
  out.wide = entry.wide;
  if (!entry.fits) {
    out.reasons |= POSE_WALL_MOTION_R_FEW_MATCHES;
    out.state = POSE_WALL_ALONG_LOST;
    return out;
  }
  Alignment& a = out.alignment;
  placing.fit_planes(entry.pose, &a);
  const Way way = placing.match_way(a);
  out.curve = way.curve;
  out.is_guessed = way.is_guessed;
  out.state = way.state;
  out.reasons |= way.reasons;
  a.pose.t = way.t;
  placing.fit_relief(a.axes.tell_along() && !out.is(POSE_WALL_ALONG_UNOBSERVABLE), &a);
  if (!out.is(POSE_WALL_ALONG_UNOBSERVABLE)) {
    const FinePlace fine = placing.refine(a);
    if (fine.told && passes<gate::HALVES>(fine.halves_m)) {
      a.pose.t += fine.best_m * a.axes.along;
      out.rock_variance_m2 = pooled(fine.sigma_m * fine.sigma_m, out.rock_variance_m2);
      set_along(variance_along(road, out.curve, out.rock_variance_m2), &a.covariance);
      out.halves_m = fine.halves_m;
    } else {
      out.reasons |= POSE_WALL_MOTION_R_HALVES_DIFFER;
      out.state = POSE_WALL_ALONG_UNOBSERVABLE;
    }
  }
  const bool few = !passes<gate::MATCHED>(a.matched) || !a.told, far = !placing.is_in_reach(a);
  out.reasons |= bit(!a.ground_alone, POSE_WALL_MOTION_R_NO_GROUND) | bit(few, POSE_WALL_MOTION_R_FEW_MATCHES) |
                 bit(far, POSE_WALL_MOTION_R_AT_EDGE);
  if (few || far) out.state = POSE_WALL_ALONG_LOST;
  return out;
}

}  // namespace pose_wall::motion
