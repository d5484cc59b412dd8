// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/odometry.hpp"

#include <cmath>
#include <limits>

#include "base/math/finite.hpp"
#include "base/math/golden_ratio.hpp"
#include "motion/motion_report.hpp"
#include "motion/wide_start.hpp"

namespace pose_wall::motion {
namespace {

// A scan that its motion bends by less, so far off, is straight: two ranges differ by as much (1.4 kRangeSigma_m). From
// 5 to 100 mm the sweep measured the same frames.
constexpr double kBent_m = 0.02, kBentAt_m = 5.0;
// With 1 the sweep's median level along is 49 mm and not 40. With 10 the map takes in what it is then measured by: 33
// poses left their level and not 9.
constexpr std::uint32_t kYoungFrames = 3;

}  // namespace

void Odometry::lay_out(Arena& arena) {
  imager_.lay_out(arena);
  scratch_.lay_out(arena);
  keyframes_.lay_out(arena);
}

void Odometry::open(const Mount& mount, const MotionSettings& settings) {
  mount_ = mount;
  settings_ = settings;
  reset();
}

void Odometry::reset() {
  imager_.reset();
  clock_ = FrameClock{};
  model_.reset(settings_);
  keyframes_.clear();
  course_ = Course{};
  start_ = Pose{};
  has_map_ = has_pose_ = false;
}

void Odometry::process(const pose_wall_cloud& cloud, pose_wall_motion_result* result) {
  work_ = Work{};
  const double dt_s = clock_.since_last_s(cloud.stamp_ns);
  const Frame frame = {cloud, dt_s, clock_.is_late(dt_s)};
  report_nothing(result);
  report_axis(RoadAxes{}, start_, result);
  AlongVerdict verdict;
  if (!clock_.goes_on(dt_s)) {
    verdict = stay(frame, result);
  } else if (imager_.repeats(cloud, mount_, model_.twist(), &work_)) {  // as if nothing had been seen
    verdict.reasons = POSE_WALL_MOTION_R_REPEATED;
  } else {
    verdict = measure(frame, result);
    if (keyframes_.map().gave_way()) verdict.reasons |= POSE_WALL_MOTION_R_MAP_FULL;
    clock_.go_on();
    result->points_used = imager_.image().count;
  }
  has_pose_ = verdict.state != POSE_WALL_ALONG_LOST && (verdict.reasons & POSE_WALL_MOTION_R_STAMP) == 0;
  result->along_state = verdict.state;
  result->reasons = verdict.reasons;
  result->stamp_ns = cloud.stamp_ns;
  result->points_in = static_cast<std::uint32_t>(static_cast<std::uint64_t>(cloud.width) * cloud.height);
  result->frame_index = clock_.frames();
  result->tiles = keyframes_.map().tiles();
  result->keyframes = keyframes_.count();
  clock_.count();
}

// Of a frame out of order nothing is taken: the last pose, and how well it is known.
Odometry::AlongVerdict Odometry::stay(const Frame& frame, pose_wall_motion_result* result) {
  clock_.go_back(frame.cloud.stamp_ns, frame.dt_s);
  report_axis(course_.axes, start_, result);
  if (!has_map_) return {POSE_WALL_ALONG_LOST, POSE_WALL_MOTION_R_STAMP};
  report(course_, course_.bounds(settings_.protection_sigmas), start_, false, result);
  return {POSE_WALL_ALONG_UNOBSERVABLE, POSE_WALL_MOTION_R_STAMP};
}

Odometry::AlongVerdict Odometry::measure(const Frame& frame, pose_wall_motion_result* result) {
  const Expected expected = model_.expect(course_, settings_, frame);
  const Seen seen = imager_.look(expected.pose, mount_, &work_);
  report(seen, result);
  keyframes_.set_corner(expected.pose.t);
  // Time counts from the last frame with a pose: frames of nothing have no effect.
  if (!has_map_ || seen.suffices()) clock_.take(frame.cloud.stamp_ns, frame.dt_s);
  if (!seen.suffices()) return {POSE_WALL_ALONG_LOST, expected.reasons | POSE_WALL_MOTION_R_FEW_POINTS};
  AlongVerdict verdict = has_map_ ? go_on(frame, expected, seen, result) : begin(frame, expected, seen, result);
  verdict.reasons |= expected.reasons;
  return verdict;
}

Odometry::AlongVerdict Odometry::go_on(const Frame& frame, const Expected& expected, const Seen& seen,
                                       pose_wall_motion_result* result) {
  const Road road = {keyframes_.map(), course_, settings_, mount_.sensor_base_m};
  const Placed placed = place_scan(road, frame, expected.pose, seen, &scratch_, &work_);
  report(placed, result);
  if (placed.is(POSE_WALL_ALONG_LOST)) {
    begin_anew(frame, seen);
    report_axis(course_.axes, start_, result);
    return {POSE_WALL_ALONG_LOST, placed.reasons};
  }
  const Concluded concluded = conclude(road, frame, expected.prior, placed);
  report(concluded.step, result);
  report(concluded.course, concluded.whole, start_, false, result);
  take(frame, placed, concluded);
  return {placed.state, placed.reasons | concluded.reasons};
}

// The first scan stands upright and square to the map's axes, so that surfaces face them.
Odometry::AlongVerdict Odometry::begin(const Frame& frame, const Expected& expected, const Seen& seen,
                                       pose_wall_motion_result* result) {
  const Eigen::Matrix3d& R = expected.pose.R;
  const Eigen::Matrix3d level = upright(seen.observations, R, mount_.sensor_base_m) * R;
  const double yaw_rad = squaring_yaw_rad(seen.observations, level);
  start_ = {turn_by(Eigen::Vector3d(0.0, 0.0, yaw_rad)) * level, expected.pose.t};
  begin_map(frame, seen, start_);
  report(course_, course_.bounds(settings_.protection_sigmas), start_, true, result);
  return {POSE_WALL_ALONG_MEASURED, POSE_WALL_MOTION_R_FIRST};
}

// The machine may be as far as it can have moved. The map starts anew there.
void Odometry::begin_anew(const Frame& frame, const Seen& seen) {
  course_.lose_slip(0.0);
  course_.since_known = Pieces{};
  course_.travel.lose(settings_.speed_max_m_s * frame.dt_s, settings_.turn_max_rad_s * frame.dt_s);
  course_.lost_s += frame.dt_s;
  model_.forget_twist();
  begin_map(frame, seen, course_.pose);
}

void Odometry::begin_map(const Frame& frame, const Seen& seen, const Pose& at) {
  face(at.R, seen.observations);
  course_.pose = at;
  course_.axes.along = at.R * settings_.forward_base;
  course_.axes.left = Eigen::Vector3d::UnitZ().cross(course_.axes.along).normalized();
  course_.axes.up = course_.axes.along.cross(course_.axes.left);
  course_.axes.hold = 0.0;
  course_.travel.go(Eigen::Vector3d::Zero(), course_.axes.in_road());
  course_.covariance.setZero();
  course_.of_rock.setZero();
  course_.frames = 0;
  course_.is_bent = frame.cloud.time.type != POSE_WALL_FIELD_NONE;
  begin_map_here();
  // A number that no other map has, one of another motion that began at another time neither.
  run_ = (run_ + static_cast<std::uint64_t>(frame.cloud.stamp_ns) + 1) * kGoldenTurn64 | 1U;
  model_.forget_rates(settings_);
  has_map_ = true;
}

void Odometry::begin_map_here() {
  course_.rock_variance_m2 = 0.0;
  keyframes_.begin(imager_.image(), course_.pose, mount_.sensor_base_m, &work_);
}

// What was concluded becomes the memory of the next frames.
void Odometry::take(const Frame& frame, const Placed& placed, const Concluded& concluded) {
  model_.learn(course_, concluded.course.axes, settings_, concluded.step, frame.dt_s);
  course_ = concluded.course;
  if (!passes<gate::SLIP>(course_.slipped.m())) {  // the place of the relief is lost
    keyframes_.forget_relief();
    take_in_scan();
    course_.lose_slip(keyframes_.map().unevenness());
  } else if (begins_unbent(frame, placed)) {
    begin_unbent(frame);
  } else if (is_keyframe(placed)) {
    take_in_scan();
  }
  if (placed.is(POSE_WALL_ALONG_MEASURED)) course_.is_bent = false;
}

// If the machine went or turned far enough. A map of one scan is thin: the first few go in wherever they are.
bool Odometry::is_keyframe(const Placed& placed) const {
  const bool known = placed.is(POSE_WALL_ALONG_MEASURED) || placed.is_guessed;
  return known && (course_.frames <= kYoungFrames || keyframes_.are_due(course_.pose, settings_.keyframe_m));
}

void Odometry::take_in_scan() {
  keyframes_.take_in(imager_.image(), course_.pose, mount_.sensor_base_m, &work_);
  course_.travel.take_in(course_.covariance, keyframes_.count());
}

bool Odometry::begins_unbent(const Frame& frame, const Placed& placed) const {
  if (!course_.is_bent || !placed.is(POSE_WALL_ALONG_MEASURED)) return false;
  const double speed_m_s = std::sqrt(model_.twist().velocity_m_s.squaredNorm());
  const double turn_rad_s = std::sqrt(model_.twist().turn_rad_s.squaredNorm());
  return frame.dt_s * (speed_m_s + kBentAt_m * turn_rad_s) > kBent_m;
}

// The motion during the first scans was unknown. The map starts anew with this very scan, freed of its motion. If the
// machine stands, two scans that were bent alike have shown that.
void Odometry::begin_unbent(const Frame& frame) {
  course_.travel.take_in(course_.covariance, keyframes_.count());
  imager_.look_again(frame.cloud, mount_, model_.twist(), course_.pose, &work_);
  begin_map_here();
  course_.travel.begin_with(course_.covariance);
}

// Without a pose nothing is known of place and motion but the machine's limits. A run of its own keeps such a frame
// from being compared with its neighbours.
void Odometry::tell_nothing(pose_wall_odometry* out) const {
  out->run = run_ + 2 * (clock_.frames() + 1);  // runs are odd, and no two frames of this one alike
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
  if (clock_.frames() == 0) return false;
  Eigen::Quaterniond q(course_.pose.R);
  q.normalize();
  out->run = run_;
  const Six level = course_.travel.level_of(course_.covariance, course_.slipped, settings_.protection_sigmas);
  const Six rate_level = model_.rate_level(settings_.protection_sigmas);
  const Twist moves = model_.rates(course_);
  for (int k = 0; k < 3; ++k) {
    out->position_m[k] = course_.pose.t[k];
    out->along[k] = course_.axes.along[k];
    out->across[k] = course_.axes.left[k];
    out->velocity_m_s[k] = moves.velocity_m_s[k];
    out->turn_rate_rad_s[k] = moves.turn_rad_s[k];
  }
  for (int k = 0; k < 4; ++k) out->quaternion[k] = q.coeffs()[k];
  for (int k = 0; k < POSE_WALL_ODOMETRY_DIRECTIONS; ++k) {
    out->level[k] = level[k];
    out->drift_variance[k] = course_.travel.drift_variance()[k];
    out->drift[k] = course_.travel.drift()[k];
    out->rate_level[k] = rate_level[k];
  }
  if (!has_pose_) tell_nothing(out);
  return true;
}

std::uint32_t Odometry::map_points(std::uint32_t first, std::uint32_t capacity, float* xyz) const {
  const std::uint32_t total = keyframes_.map().points(first, capacity, xyz);
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
