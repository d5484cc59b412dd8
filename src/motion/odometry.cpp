// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/odometry.hpp"

#include <cmath>
#include <limits>

#include "base/math/finite.hpp"
#include "motion/far_match.hpp"
#include "motion/frame_steps.hpp"
#include "motion/motion_report.hpp"
#include "motion/wide_start.hpp"

namespace pose_wall::motion {
namespace {

constexpr double kTwistLasts_s = 1.0, kPeriodMost_s = 10.0;
constexpr double kSameStamp_s = 1e-3;  // as the engine's POSE_WALL_R_STAMP_STILL
constexpr std::uint32_t kObservationsLeast = 150;
constexpr std::uint32_t kMatchedLeast = 80;
constexpr double kShareLost = 0.2;    // of the observations on the map: less, and the scan is elsewhere
constexpr double kShareFound = 0.45;  // more, and a guess needs no wide start
constexpr double kGap_s = 0.35;       // without a frame: longer, and a guess by the last speed is none
// Without evidence: the limits that separate smooth rock from few patches, and a guess from nothing.
constexpr double kContrastLeast = 0.15, kGuessPatchesLeast = 3.5;
// Two halves of the rock that differ widen sigma; that far apart one of them is wrong.
constexpr double kHalvesMost_m = 0.12;
constexpr std::uint32_t kEquationsMost = 2048;  // of the fine steps; all of a sparse sensor's count
constexpr int kPassesMost = 4;                  // of coarse steps; judgement
constexpr double kCurveStep_m = 0.025;
constexpr double kReachMargin = 1.5;  // of the range of top speed and turn: a place there is not the edge of the search
constexpr double kReachLeast_m = 0.2;  // of the curve, however little the machine can have slipped; judgement
constexpr double kSlipMost_m = 0.8;    // more, and the map's rock is somewhere else
constexpr double kBentShare = 0.1;     // of a step, while scans are bent: the difference of near and far rock
constexpr double kBent_m = 0.02, kBentAt_m = 5.0;  // a scan that its motion bends by less, so far off, is straight
// Slopes of a steady bend that spread by s over 20 m of map turn by 0.17 s a metre.
constexpr double kBendOfSpread = 0.17;
constexpr std::uint32_t kYoungFrames = 3;
constexpr double kKeyframeTurn_rad = 0.1;
constexpr double kNoTurn2 = 1e-10;     // (rad/s)²: keeps a turn of nothing from being divided by nothing
constexpr float kRockRange_m = 14.0F;  // further away, only rays that meet at 17 degrees and more make surfaces
constexpr float kFarIncidence = 0.3F;

std::uint32_t bit(bool is_set, std::uint32_t reason) {
  return is_set ? reason : 0U;
}

}  // namespace

void Odometry::lay_out(Arena& arena) {
  image_.lay_out(arena);
  segment_.lay_out(arena);
  choice_.lay_out(arena);
  observation_ = arena.take<Observation>(kObservationsMost);
  const std::uint64_t place = arena.place();
  steps_.lay_out(arena);
  curve_.lay_out(arena);
  arena.go_back(place);
  starts_.lay_out(arena);
  arena.go_behind_all();
  map_.lay_out(arena);
  print_ = arena.take_one<CloudPrint>();
}

void Odometry::open(const Mount& mount, const MotionSettings& settings) {
  mount_ = mount;
  settings_ = settings;
  reset();
}

void Odometry::reset() {
  map_.clear();
  freshness_ = Freshness{};
  pose_ = start_ = keyframe_ = Pose{};
  twist_ = Twist{};
  axes_ = RoadAxes{};
  travel_.reset();
  last_covariance_.setZero();
  last_alignment_.setZero();
  stamp_ns_ = 0;
  period_s_ = 0.0;
  frames_ = 0;
  back_ = 0;
  since_start_ = 0;
  slipped_m_ = lost_s_ = rock_variance_m2_ = 0.0;
  has_map_ = guesses_ = is_bent_ = has_pose_ = false;
  forget_motion();
}

// The first scan stands upright and square to the map's axes, so that surfaces face them.
void Odometry::begin_map(Frame* frame) {
  if (!has_map_) {  // not where the map begins anew
    const Eigen::Matrix3d R = frame->expected.R;
    const Eigen::Matrix3d level = upright(frame->observations, R, mount_.sensor_base_m) * R;
    frame->expected.R = turn_by(Eigen::Vector3d(0.0, 0.0, squaring_yaw_rad(frame->observations, level))) * level;
    start_ = frame->expected;
  }
  face(frame->expected.R, frame->observations);
  pose_ = frame->expected;
  frame->alignment.pose = pose_;
  axes_.along = pose_.R * settings_.forward_base;
  axes_.left = Eigen::Vector3d::UnitZ().cross(axes_.along).normalized();
  axes_.hold = 0.0;
  frame->alignment.axes = axes_;
  last_covariance_.setZero();
  last_alignment_.setZero();
  begin_map_here();
  begin_run(frame->cloud.stamp_ns);
  has_map_ = true;
  is_bent_ = frame->cloud.time.type != POSE_WALL_FIELD_NONE;
  since_start_ = 0;
}

// A number that no other map has, one of another motion that began at another time neither.
void Odometry::begin_run(std::int64_t stamp_ns) {
  constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ULL;  // 2^64 over the golden ratio: spreads neighbours apart
  run_ = (run_ + static_cast<std::uint64_t>(stamp_ns) + 1) * kGolden | 1U;
  forget_motion();
}

void Odometry::forget_motion() {
  scan_motion_.forget(settings_.speed_max_m_s, settings_.turn_max_rad_s);
}

void Odometry::begin_map_here() {
  rock_variance_m2_ = 0.0;
  map_.clear();
  map_.set_corner(pose_.t);
  take_in_scan();
}

void Odometry::take_in_scan() {
  keyframe_ = pose_;
  map_.begin_keyframe(pose_.R * mount_.sensor_base_m + pose_.t);
  const LocalPose local(pose_, map_.corner());
  const Eigen::Vector3f sensor = mount_.sensor_base_m.cast<float>();
  FacingWalk walk(image_, local.R);
  for (const std::uint16_t i : image_.cell.first(image_.rows * image_.columns)) {
    if (i == kNoPoint || (image_.flags[i] & kPlane) == 0 || !walk.go_to(i)) continue;
    const float range = image_.range[i];
    if (range > kRockRange_m && !(-walk.normal().dot(image_.point(i) - sensor) > kFarIncidence * range)) continue;
    map_.add(local(image_.point(i)), walk.facing());
  }
  work_.add(image_.count, steps::kPointTakenIn);
  work_.add(map_.end_keyframe(), steps::kTileSettled);
}

// The expected place, or after a gap the one that a wide search finds. False: the scan fits nowhere.
bool Odometry::place_scan(Frame* frame) {
  Pose& at = frame->expected;
  const std::uint32_t stride = frame->observations.size() / 400 + 1;
  const bool gap = frame->dt_s > kGap_s;
  frame->reasons |= bit(gap && frame->dt_s > 2.5 * period_s_ && period_s_ > 0.0, POSE_WALL_MOTION_R_GAP);
  const double share = share_on_map(map_, frame->observations, at, stride);
  if (share > (gap ? kShareFound : kShareLost)) return true;
  frame->wide = true;
  at.R = orthonormal(upright(frame->observations, at.R, mount_.sensor_base_m) * at.R);
  face(at.R, frame->observations);
  const double dt = frame->dt_s < 5.0 ? frame->dt_s : 5.0;
  const WideReach reach = {settings_.turn_max_rad_s * dt, settings_.speed_max_m_s * dt};
  return search_wide(map_, frame->observations, reach, &starts_, &work_, &at);
}

Scan Odometry::scan_of(const Frame& frame) const {
  return {&map_, frame.observations, mount_.sensor_base_m.cast<float>()};
}

void Odometry::align(Frame* frame) {
  Alignment& a = frame->alignment;
  a.pose = frame->expected;
  a.axes = axes_;
  const Scan scan = scan_of(*frame);
  const Eigen::Vector3d forward = a.pose.R * settings_.forward_base;
  find_axes(scan, forward, &a);
  StepOptions coarse;
  coarse.with_along = a.axes.hold > kHoldOfHall;
  coarse.every = 4;
  bool moves = true;
  for (int pass = 0; pass < kPassesMost && moves; ++pass) {
    work_.add(frame->observations.size() / coarse.every, steps::kEquation);
    moves = take_steps(scan, coarse, &steps_, &a);
  }
  find_axes(scan, forward, &a);
  match_way(frame);
  StepOptions fine;
  fine.use_relief = true;
  fine.every = (frame->observations.size() + kEquationsMost - 1) / kEquationsMost;
  fine.rounds = 3;
  work_.add(frame->observations.size() / fine.every, steps::kEquation);
  take_steps(scan, fine, &steps_, &a);
  if (!frame->is(POSE_WALL_ALONG_UNOBSERVABLE)) refine(scan, frame);
  frame->reasons |= bit(!a.ground_alone, POSE_WALL_MOTION_R_NO_GROUND);
  if (a.matched >= kMatchedLeast) return;
  frame->reasons |= POSE_WALL_MOTION_R_FEW_MATCHES;
  frame->state = POSE_WALL_ALONG_LOST;
}

// The last centimetres along the road, and their sigma.
void Odometry::refine(const Scan& scan, Frame* frame) {
  Alignment& a = frame->alignment;
  work_.add(steps::of_curve(frame->observations.size(), kRowsMost, kFineShifts));
  const FinePlace place = refine_along(scan, a, &curve_);
  if (!(place.told && place.halves_m < kHalvesMost_m)) {
    frame->reasons |= POSE_WALL_MOTION_R_HALVES_DIFFER;
    frame->state = POSE_WALL_ALONG_UNOBSERVABLE;
    return;
  }
  a.pose.t += place.best_m * a.axes.along;
  // Shifts further off than the curve's own steps resolve, which the patches do not exclude, are within the level.
  const double around_m = frame->curve.around_m > 2.5 * kCurveStep_m ? frame->curve.around_m : 0.0;
  const double sigma_m = around_m / settings_.protection_sigmas;
  // One frame's own estimate of it has heavy tails, and the rock does not change from frame to frame.
  const double own_m2 = place.sigma_m * place.sigma_m;
  rock_variance_m2_ = rock_variance_m2_ > 0.0 ? 0.5 * (own_m2 + rock_variance_m2_) : own_m2;
  a.covariance(0, 0) = sigma_m * sigma_m > rock_variance_m2_ ? sigma_m * sigma_m : rock_variance_m2_;
  // The place in a cell where one scan met the rock is chance, the same for all rows that one ring drew. So a young map
  // errs as a whole. Of a start in motion 8 of 8 roads erred by 5 to 30 mm, and patches indicated 5.
  const double cell_m = 1.0 / kAlongCells, of_map_m = cell_m / map_.keyframes();
  a.covariance(0, 0) += of_map_m * of_map_m / 12.0;
  frame->halves_m = place.halves_m;
}

// The curve about the expected place.
Curve Odometry::match_near(Frame* frame) {
  double reach = slipped_m_ + (since_start_ == 0 ? kReachMargin * settings_.speed_max_m_s * frame->dt_s : 0.0);
  reach = reach < kReachLeast_m ? kReachLeast_m : reach > kReachMost_m ? kReachMost_m : reach;
  const std::uint32_t shifts = 2 * static_cast<std::uint32_t>(reach / kCurveStep_m + 0.5) + 1;
  work_.add(steps::of_curve(frame->observations.size(), kRowsMost, shifts));
  return match_along(scan_of(*frame), frame->alignment, reach, shifts, &curve_);
}

// The place along the road and its uncertainty.
void Odometry::match_way(Frame* frame) {
  Alignment& a = frame->alignment;
  // Where planes face along, the wide start has placed the scan; along a road nothing has yet.
  const bool far = frame->dt_s > kGap_s && a.axes.hold < kHoldOfRoad;
  const double far_m = settings_.speed_max_m_s * frame->dt_s;
  const Curve curve = far ? match_far(scan_of(*frame), far_m, frame->wide, &curve_, &work_, &a) : match_near(frame);
  frame->curve = curve;
  if (!is_evidence(curve)) {
    const bool smooth = !(curve.contrast > kContrastLeast);
    frame->reasons |= smooth ? POSE_WALL_MOTION_R_SMOOTH : POSE_WALL_MOTION_R_FEW_PATCHES;
    frame->state = POSE_WALL_ALONG_UNOBSERVABLE;
    // Not worth a claim, but a better guess than the last speed: without it a sparse sensor that starts on the move
    // never gets a map to claim by.
    frame->guessed = !smooth && curve.patches > kGuessPatchesLeast;
    if (frame->guessed) a.pose.t += curve.best_m * a.axes.along;
    return;
  }
  if (curve.apart_m > 0.0) {
    frame->reasons |= POSE_WALL_MOTION_R_SECOND_PEAK;
    frame->state = POSE_WALL_ALONG_AMBIGUOUS;
  }
  a.pose.t += curve.best_m * a.axes.along;
}

// A motion of base in the directions of the road, and back.
Six Odometry::in_road(const RoadAxes& axes, const Twist& twist) const {
  const Eigen::Vector3d* const about[] = {&axes.along, &axes.left, &axes.up};
  const Eigen::Vector3d move = pose_.R * twist.velocity_m_s, turn = pose_.R * twist.turn_rad_s;
  Six rate;
  for (int k = 0; k < 3; ++k) {
    rate[k] = about[k]->dot(move);
    rate[POSE_WALL_MOTION_ROLL + k] = about[k]->dot(turn);
  }
  return rate;
}

Twist Odometry::in_base(const RoadAxes& axes, const Six& rate) const {
  const Eigen::Vector3d* const about[] = {&axes.along, &axes.left, &axes.up};
  Eigen::Vector3d move = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    move += *about[k] * rate[k];
    turn += *about[k] * rate[POSE_WALL_MOTION_ROLL + k];
  }
  return {pose_.R.transpose() * move, pose_.R.transpose() * turn};
}

// The given way stands alone without evidence of the rock. Otherwise it is weighed in or refused.
void Odometry::use_prior(Frame* frame) const {
  if (!frame->prior.has_way()) return;
  Alignment& a = frame->alignment;
  const double towards = (pose_.R * settings_.forward_base).dot(a.axes.along);
  const double way_m = (a.pose.t - pose_.t).dot(a.axes.along);
  if (!frame->is(POSE_WALL_ALONG_MEASURED)) {
    a.pose.t += (frame->prior.way_m * towards - way_m) * a.axes.along;
  } else if (!weigh_in(frame->prior, towards, way_m, settings_.protection_sigmas, &a)) {
    frame->reasons |= POSE_WALL_MOTION_R_PRIOR;
  }
}

// The unknown way along, beyond sigma.
double Odometry::slip_of(const Frame& frame, double along_m) const {
  if (frame.is(POSE_WALL_ALONG_MEASURED)) return 0.0;
  if (frame.prior.has_way()) return settings_.protection_sigmas * frame.prior.way_sigma_m;
  if (frame.is(POSE_WALL_ALONG_AMBIGUOUS)) return frame.curve.apart_m;
  return settings_.speed_max_m_s * frame.dt_s + std::fabs(along_m);
}

namespace {

// The turns, each as far as it exceeds its own noise. A few rings of ground give pitch to 0.1 degrees, and ten times
// that a second would bend the next scan.
Six shrunk_turn(const Six& rate, const Six& noise) {
  Six out = Six::Zero();
  for (int k = POSE_WALL_MOTION_ROLL; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    const double turn2 = rate[k] * rate[k];
    out[k] = rate[k] * turn2 / (turn2 + noise[k] * noise[k] + kNoTurn2);
  }
  return out;
}

}  // namespace

// The mean motion since the last frame. The scan begins now, and its own motion is told by it.
void Odometry::learn_twist(const Frame& frame) {
  const RoadAxes& axes = frame.alignment.axes;
  Twist now = {frame.step_m / frame.dt_s, frame.step_rad / frame.dt_s};
  const bool along_known = frame.is(POSE_WALL_ALONG_MEASURED) || frame.prior.has_way();
  if (!along_known) {
    const Eigen::Vector3d axis = pose_.R.transpose() * axes.along;
    now.velocity_m_s += axis * axis.dot(twist_.velocity_m_s - now.velocity_m_s);
  }
  if (frame.dt_s < kTwistLasts_s) {
    const Six rate = in_road(axes, now);
    scan_motion_.learn(rate, frame.step_variance / (frame.dt_s * frame.dt_s));
    if (!along_known) scan_motion_.set_along(rate[POSE_WALL_MOTION_ALONG], frame.slip_m / frame.dt_s);
    now.turn_rad_s = in_base(axes, shrunk_turn(rate, frame.step.sigma / frame.dt_s)).turn_rad_s;
  } else {  // a mean over a gap is that of no scan
    forget_motion();
  }
  // Half of this frame's step: single steps are noisy, and machines are heavy.
  const double share = since_start_ < 2 ? 1.0 : 0.5;
  twist_.velocity_m_s += share * (now.velocity_m_s - twist_.velocity_m_s);
  twist_.turn_rad_s += share * (now.turn_rad_s - twist_.turn_rad_s);
}

// What the patches of rock say of this step; then what slip adds to the pose.
void Odometry::learn_alignment(Frame* frame) {
  Alignment& a = frame->alignment;
  const bool measured = frame->is(POSE_WALL_ALONG_MEASURED);
  if (!measured) {
    a.covariance.row(0).setZero();
    a.covariance.col(0).setZero();
  }
  frame->step_variance = Travel::variance_of_step(last_alignment_, a.covariance);
  last_alignment_ = a.covariance;
  if (measured) return;
  // Where the road bends or dips, the slipped machine follows it.
  const double bend_rad = kBendOfSpread * map_.unevenness() * frame->slip_m;
  a.covariance(POSE_WALL_MOTION_PITCH, POSE_WALL_MOTION_PITCH) += bend_rad * bend_rad;
  a.covariance(POSE_WALL_MOTION_YAW, POSE_WALL_MOTION_YAW) += bend_rad * bend_rad;
}

void Odometry::conclude(Frame* frame) {
  Alignment& a = frame->alignment;
  const bool measured = frame->is(POSE_WALL_ALONG_MEASURED);
  use_prior(frame);
  frame->step_s = frame->dt_s;
  frame->step_m = pose_.R.transpose() * (a.pose.t - pose_.t);
  frame->step_rad = turn_of(pose_.R.transpose() * a.pose.R);
  const double along_m = (a.pose.t - pose_.t).dot(a.axes.along);
  frame->slip_m = slip_of(*frame, along_m);
  if (is_bent_) a.covariance(0, 0) += kBentShare * kBentShare * along_m * along_m;
  learn_alignment(frame);
  travel_.go(along_m);
  const double step_slip_m = measured ? slipped_m_ : frame->slip_m;  // the first one found makes up for the others
  frame->step = Travel::of_step(last_covariance_, a.covariance, step_slip_m, settings_.protection_sigmas);
  if (lost_s_ > 0.0) {
    frame->step.widen(settings_.speed_max_m_s * lost_s_, settings_.turn_max_rad_s * lost_s_);
    frame->step_s += lost_s_;
    lost_s_ = 0.0;
  }
  learn_twist(*frame);
  // A place found again in the map undoes the slip since, unless guesses went into the map.
  if (measured && guesses_) travel_.slip(slipped_m_, 0.0);
  slipped_m_ = measured ? 0.0 : slipped_m_ + frame->slip_m;
  guesses_ = !measured && (guesses_ || frame->guessed);
  pose_ = a.pose;
  axes_ = a.axes;
  last_covariance_ = a.covariance;
  ++since_start_;
  frame->whole = travel_.bounds(a.covariance, slipped_m_, settings_.protection_sigmas);
  keep_map(*frame);
}

// A keyframe if the machine went or turned far enough; a new relief if the place of the old one is lost.
void Odometry::keep_map(const Frame& frame) {
  if (slipped_m_ > kSlipMost_m) {
    map_.forget_relief();
    take_in_scan();
    travel_.take_in(frame.alignment.covariance, map_.keyframes());
    travel_.slip(slipped_m_, map_.unevenness());
    slipped_m_ = 0.0;
    guesses_ = false;
    return;
  }
  if (begins_unbent(frame)) {  // the map begins anew with this very scan
    travel_.take_in(frame.alignment.covariance, map_.keyframes());
    return;
  }
  const double moved_m = std::sqrt((pose_.t - keyframe_.t).squaredNorm());
  const double turned_rad = std::sqrt(turn_of(keyframe_.R.transpose() * pose_.R).squaredNorm());
  const bool known = frame.is(POSE_WALL_ALONG_MEASURED) || frame.guessed;
  // A map of one scan is thin: the first few go in wherever they are.
  const bool young = since_start_ <= kYoungFrames;
  if (known && (young || moved_m > settings_.keyframe_m || turned_rad > kKeyframeTurn_rad)) {
    take_in_scan();
    travel_.take_in(frame.alignment.covariance, map_.keyframes());
  }
}

bool Odometry::begins_unbent(const Frame& frame) const {
  if (!is_bent_ || !frame.is(POSE_WALL_ALONG_MEASURED)) return false;
  const double speed_m_s = std::sqrt(twist_.velocity_m_s.squaredNorm());
  const double turn_rad_s = std::sqrt(twist_.turn_rad_s.squaredNorm());
  return frame.dt_s * (speed_m_s + kBentAt_m * turn_rad_s) > kBent_m;
}

// The motion during the first scans was unknown. The map starts anew with a scan freed of its motion. If the machine
// stands, two scans that were bent alike have shown that.
void Odometry::begin_unbent(const Frame& frame) {
  const std::uint32_t count = image_.count;
  work_.add(std::uint64_t{frame.cloud.width} * frame.cloud.height, steps::kPointProjected);
  project_again(frame.cloud, mount_, twist_, &image_);
  if (image_.count != count) {
    work_.add(image_.count, steps::kPointLookedAt);
    image_.flags.fill(0);
    segment(pose_.R, mount_, &segment_, &image_);
    mark_features(&image_);
  }
  begin_map_here();
  travel_.begin_with(frame.alignment.covariance);
}

// The expected place of the frame, by the last twist and the machine's own data.
void Odometry::expect(Frame* frame) const {
  frame->prior = ask_machine(frame->cloud.inputs, frame->dt_s);
  if (!frame->prior.sound) frame->reasons |= POSE_WALL_MOTION_R_PRIOR;
  // The duration of a twist is unknown.
  const double lasts_s = frame->dt_s < kTwistLasts_s ? frame->dt_s : kTwistLasts_s;
  Eigen::Vector3d step_m = twist_.velocity_m_s * lasts_s, step_rad = twist_.turn_rad_s * lasts_s;
  if (frame->prior.has_way()) {
    step_m += (frame->prior.way_m - settings_.forward_base.dot(step_m)) * settings_.forward_base;
  }
  if (frame->prior.has_turn()) step_rad.z() = frame->prior.turn_rad;
  frame->expected.t = pose_.t + pose_.R * step_m;
  frame->expected.R = orthonormal(pose_.R * turn_by(step_rad));
}

// True if its points, or a part of them, came before.
bool Odometry::is_repeat(const pose_wall_cloud& cloud) {
  project(cloud, mount_, twist_, &image_, print_);
  work_.add(std::uint64_t{cloud.width} * cloud.height, steps::kPointProjected);
  return freshness_.keep(*print_, cloud.stamp_ns).is_one;
}

void Odometry::look(Frame* frame) {
  frame->segments = segment(frame->expected.R, mount_, &segment_, &image_);
  frame->features = mark_features(&image_);
  const std::uint32_t count = choose_observations(image_, frame->expected, &choice_, observation_);
  work_.add(image_.count, steps::kPointLookedAt);
  frame->observations = observation_.first(count);
}

// A fit that needs more motion than the machine is capable of is none. Dust turned it upside down, frame by frame.
void Odometry::check_reach(Frame* frame) const {
  const Pose& at = frame->alignment.pose;
  const Eigen::Vector3d& along = frame->alignment.axes.along;
  const Eigen::Vector3d moved_m = at.t - pose_.t, beside_m = moved_m - along * along.dot(moved_m);
  const double turned_rad = std::sqrt(turn_of(pose_.R.transpose() * at.R).squaredNorm());
  const double reach_s = kReachMargin * frame->dt_s;
  if (std::sqrt(beside_m.squaredNorm()) <= settings_.speed_max_m_s * reach_s &&
      turned_rad <= settings_.turn_max_rad_s * reach_s) {
    return;
  }
  frame->reasons |= POSE_WALL_MOTION_R_AT_EDGE;
  frame->state = POSE_WALL_ALONG_LOST;
}

// The scan's place in the map and its consequences. Without a place the frame is lost.
void Odometry::measure(Frame* frame) {
  map_.set_corner(frame->expected.t);
  if (frame->observations.size() < kObservationsLeast) {
    frame->reasons |= POSE_WALL_MOTION_R_FEW_POINTS;
    frame->state = POSE_WALL_ALONG_LOST;
  } else if (!has_map_) {
    begin_map(frame);
    frame->reasons |= POSE_WALL_MOTION_R_FIRST;
    frame->whole = travel_.bounds(SixBySix::Zero(), slipped_m_, settings_.protection_sigmas);
  } else if (place_scan(frame)) {
    align(frame);
    check_reach(frame);
    if (!frame->is(POSE_WALL_ALONG_LOST)) conclude(frame);
    if (!frame->is(POSE_WALL_ALONG_MEASURED)) return;
    if (begins_unbent(*frame)) begin_unbent(*frame);
    is_bent_ = false;
  } else {
    frame->reasons |= POSE_WALL_MOTION_R_FEW_MATCHES;
    frame->state = POSE_WALL_ALONG_LOST;
  }
}

// Time counts from the last frame with a pose: frames of nothing have no effect.
void Odometry::keep_time(const Frame& frame) {
  if (has_map_ && frame.observations.size() < kObservationsLeast) return;
  const bool usual = frame.dt_s > 0.0 && frame.dt_s < kPeriodMost_s;
  if (usual) period_s_ = period_s_ > 0.0 ? period_s_ + 0.1 * (frame.dt_s - period_s_) : frame.dt_s;
  stamp_ns_ = frame.cloud.stamp_ns;
}

// The machine may be as far as it can have moved. The map starts anew there.
void Odometry::begin_anew(Frame* frame) {
  if (frame->observations.size() < kObservationsLeast) return;
  const double place_m = settings_.speed_max_m_s * frame->dt_s, turn_rad = settings_.turn_max_rad_s * frame->dt_s;
  travel_.lose(place_m, turn_rad);
  lost_s_ += frame->dt_s;
  twist_ = Twist{};
  frame->expected = pose_;
  begin_map(frame);
}

void Odometry::process(const pose_wall_cloud& cloud, pose_wall_motion_result* result) {
  Frame frame(cloud);
  work_ = Work{};
  frame.first = !has_map_;
  frame.dt_s = frames_ == 0 ? 0.0 : (static_cast<double>(cloud.stamp_ns) - static_cast<double>(stamp_ns_)) * 1e-9;
  const bool goes_on = frames_ == 0 || frame.dt_s > kSameStamp_s;
  if (goes_on && is_repeat(cloud)) {  // as if nothing had been seen
    frame.reasons |= POSE_WALL_MOTION_R_REPEATED;
    frame.state = POSE_WALL_ALONG_LOST;
    image_.count = 0;
  } else if (goes_on) {
    expect(&frame);
    look(&frame);
    measure(&frame);
    if (frame.is(POSE_WALL_ALONG_LOST) && has_map_) begin_anew(&frame);
    if (map_.gave_way()) frame.reasons |= POSE_WALL_MOTION_R_MAP_FULL;
    keep_time(frame);
    back_ = 0;
  } else {
    frame.reasons |= POSE_WALL_MOTION_R_STAMP;
    frame.state = has_map_ ? POSE_WALL_ALONG_UNOBSERVABLE : POSE_WALL_ALONG_LOST;
    frame.alignment.pose = pose_;
    frame.alignment.axes = axes_;
    frame.whole = travel_.bounds(last_covariance_, slipped_m_, settings_.protection_sigmas);
    image_.count = 0;
    // One frame out of order, or a clock that was set back: the second one decides. The usual period is the best
    // estimate of the time since the last pose.
    if (frame.dt_s < -kSameStamp_s && ++back_ > 1) {
      // by whole numbers that wrap: a stamp may be the least there is
      stamp_ns_ = static_cast<std::int64_t>(static_cast<std::uint64_t>(cloud.stamp_ns) -
                                            static_cast<std::uint64_t>(period_s_ * 1e9));
    }
  }
  has_pose_ = !frame.is(POSE_WALL_ALONG_LOST) && frame.has_stamp();
  report(frame, start_, result);
  result->frame_index = frames_++;
  result->along_m = frame.is(POSE_WALL_ALONG_LOST) ? not_a_number() : travel_.along_m();
  result->points_used = image_.count;
  result->tiles = map_.tiles();
  result->keyframes = map_.keyframes();
}

// Without a pose nothing is known of place and motion but the machine's limits. A run of its own keeps such a frame
// from being compared with its neighbours.
void Odometry::tell_nothing(pose_wall_odometry* out) const {
  out->run = run_ + 2 * (frames_ + 1);  // runs are odd, and no two frames of this one alike
  ScanMotion any;
  any.forget(settings_.speed_max_m_s, settings_.turn_max_rad_s);
  const Six rate_level = any.level(settings_.protection_sigmas);
  for (int k = 0; k < 3; ++k) out->velocity_m_s[k] = out->turn_rate_rad_s[k] = 0.0;
  for (int k = 0; k < POSE_WALL_ODOMETRY_DIRECTIONS; ++k) {
    out->level[k] = std::numeric_limits<double>::infinity();
    out->rate_level[k] = rate_level[k];
  }
}

bool Odometry::tell(pose_wall_odometry* out) const {
  if (frames_ == 0) return false;
  Eigen::Quaterniond q(pose_.R);
  q.normalize();
  out->run = run_;
  const Six level = Travel::level_of(last_covariance_, slipped_m_, settings_.protection_sigmas);
  const Six rate_level = scan_motion_.level(settings_.protection_sigmas);
  const Twist moves = in_base(axes_, scan_motion_.rate());
  for (int k = 0; k < 3; ++k) {
    out->position_m[k] = pose_.t[k];
    out->along[k] = axes_.along[k];
    out->across[k] = axes_.left[k];
    out->velocity_m_s[k] = moves.velocity_m_s[k];
    out->turn_rate_rad_s[k] = moves.turn_rad_s[k];
  }
  for (int k = 0; k < 4; ++k) out->quaternion[k] = q.coeffs()[k];
  for (int k = 0; k < POSE_WALL_ODOMETRY_DIRECTIONS; ++k) {
    out->level[k] = level[k];
    out->drift_variance[k] = travel_.drift_variance()[k];
    out->drift[k] = travel_.drift()[k];
    out->rate_level[k] = rate_level[k];
  }
  if (!has_pose_) tell_nothing(out);
  return true;
}

std::uint32_t Odometry::map_points(std::uint32_t first, std::uint32_t capacity, float* xyz) const {
  const std::uint32_t total = map_.points(first, capacity, xyz);
  const std::uint32_t written = first >= total ? 0U : total - first < capacity ? total - first : capacity;
  for (std::uint32_t i = 0; i < written; ++i) {
    float* const p = xyz + std::size_t{3} * i;
    const Eigen::Vector3d q =
        start_.R.transpose() *
        (Eigen::Vector3d(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])) - start_.t);
    for (int k = 0; k < 3; ++k) p[k] = static_cast<float>(q[k]);
  }
  return total;
}

}  // namespace pose_wall::motion
