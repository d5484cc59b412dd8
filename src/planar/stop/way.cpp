// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/way.hpp"

#include <cmath>
#include <limits>

#include "base/math/elementary.hpp"
#include "base/math/finite.hpp"

namespace pose_wall::planar {
namespace {

constexpr double kOdometryMost_s = 1.0;                               // without one for longer, reckoning goes on alone
constexpr float kUnknown_m = std::numeric_limits<float>::infinity();  // of what no bound is known for

double root_above(double first, double second) {
  return second > first ? std::sqrt(second - first) : 0.0;
}

bool are_errors(const double* values) {
  for (int k = 0; k < POSE_WALL_ODOMETRY_DIRECTIONS; ++k) {
    if (!(values[k] >= 0.0)) return false;
  }
  return true;
}

}  // namespace

void Way::lay_out(Arena& arena) {
  frames_ = arena.take<Frame>(kFrames);
  buckets_ = arena.take<Bucket>(kBuckets);
}

void Way::open(const Machine& machine) {
  machine_ = machine;
  reckoned_m_ = 0.0;
  base_ = Pose2();
  forget();
}

void Way::forget() {
  count_ = measured_ = 0;
  waiting_ = Place();
  now_ = Certainty();
  for (std::uint32_t k = 0; k < kBuckets; ++k) buckets_[k].number = 0;
}

// Along and across together: sums, for their differences bound each of the two and both at once. What is as good as
// infinite tells nothing of its place.
bool Way::read(const pose_wall_odometry& o, Place* place) {
  const auto sum = [](const double* values) { return values[0] + values[1]; };
  place->run = o.run;
  place->position_m = {o.position_m[0], o.position_m[1], o.position_m[2]};
  place->turn = Eigen::Quaterniond(o.quaternion[3], o.quaternion[0], o.quaternion[1], o.quaternion[2]);
  place->level_m = std::sqrt(o.level[0] * o.level[0] + o.level[1] * o.level[1]);
  place->level_rad = o.level[POSE_WALL_ODOMETRY_DIRECTIONS - 1];
  place->variance_m2 = sum(o.drift_variance);
  place->variance_rad2 = o.drift_variance[POSE_WALL_ODOMETRY_DIRECTIONS - 1];
  place->drift_m = sum(o.drift), place->drift_rad = o.drift[POSE_WALL_ODOMETRY_DIRECTIONS - 1];
  constexpr double kFar_m = 1e7, kUnit = 1e-5;  // by the interface
  const bool is_near = place->position_m.allFinite() && place->position_m.squaredNorm() < kFar_m * kFar_m;
  const bool is_turn = std::fabs(place->turn.squaredNorm() - 1.0) < kUnit;
  return o.run != 0 && is_near && is_turn && are_errors(o.level) && are_errors(o.drift_variance) && are_errors(o.drift);
}

Way::Certainty Way::certainty_of(const Place& place) const {
  return {place.variance_m2, place.variance_rad2, place.drift_m + machine_.lever_m * place.drift_rad,
          place.level_m + machine_.lever_m * place.level_rad};
}

double Way::error_of(const Certainty& first, const Certainty& second) const {
  const double deviation_m = root_above(first.variance_m2, second.variance_m2) +
                             machine_.lever_m * root_above(first.variance_rad2, second.variance_rad2);
  return first.own_m + second.own_m + machine_.sigmas * deviation_m + larger(second.drift_m - first.drift_m, 0.0);
}

float Way::error_m(std::uint32_t first_ms, std::uint32_t second_ms) const {
  if (second_ms == now_ms_) return error_m(first_ms);
  if (first_ms == second_ms) return 0.0F;
  const Bucket &first = buckets_[first_ms / kBucket_ms % kBuckets],
               &second = buckets_[second_ms / kBucket_ms % kBuckets];
  const bool is_known = first.number == first_ms / kBucket_ms && second.number == second_ms / kBucket_ms;
  return is_known ? static_cast<float>(error_of(first.first, second.first)) : kUnknown_m;
}

float Way::error_m(std::uint32_t first_ms) const {
  if (first_ms == now_ms_) return 0.0F;
  const Bucket& first = buckets_[first_ms / kBucket_ms % kBuckets];
  if (first.number != first_ms / kBucket_ms) return kUnknown_m;
  if (first.known_ms != now_ms_) {
    first.error_m = static_cast<float>(error_of(first.first, now_));
    first.known_ms = now_ms_;
  }
  return first.error_m;
}

void Way::remember() {
  Bucket& bucket = buckets_[now_ms_ / kBucket_ms % kBuckets];
  bucket.known_ms = 0;
  if (bucket.number != now_ms_ / kBucket_ms) {
    bucket.number = now_ms_ / kBucket_ms;
    bucket.first = now_;
  } else {
    bucket.first.own_m = larger(bucket.first.own_m, now_.own_m);
  }
}

// What is placed from here on is reckoned: its errors add up again, from what the last place's were.
void Way::leave_odometry() {
  if (measured_ == 0) return;
  now_.drift_m += 2.0 * now_.own_m;
  now_.own_m = 0.0;
  measured_ = 0;
  for (std::uint32_t k = 0; k < kFrames; ++k) frames_[k].place.run = 0;
}

void Way::go(std::int64_t stamp_ns, std::uint32_t now_ms, const Pose2& step, double error_m) {
  base_ = count_ == 0 ? Pose2() : compose(base_, step);
  now_ms_ = now_ms;
  reckoned_m_ += error_m;
  if (measured_ != 0) {
    now_.own_m += error_m;
  } else {
    now_.drift_m += error_m;
  }
  frames_[count_++ % kFrames] = {stamp_ns, base_, reckoned_m_, Place()};
  if (waiting_.run != 0 && waiting_ns_ == stamp_ns) measure(count_ - 1, waiting_);
  waiting_.run = 0;
  const bool is_alone =
      measured_ != 0 && (count_ - measured_ >= kFrames ||
                         seconds_between(frames_[(measured_ - 1) % kFrames].stamp_ns, stamp_ns) > kOdometryMost_s);
  if (is_alone) leave_odometry();
  remember();
}

bool Way::note(const pose_wall_odometry& odometry, std::int64_t stamp_ns) {
  Place place;
  if (!read(odometry, &place)) return false;
  for (std::uint32_t back = 0; back < kFrames && back < count_; ++back) {
    const std::uint32_t frame = count_ - 1 - back;
    if (frames_[frame % kFrames].stamp_ns != stamp_ns) continue;
    if (frame >= measured_) measure(frame, place);
    return true;
  }
  waiting_ = place;
  waiting_ns_ = stamp_ns;
  return true;
}

// The frame stands where the odometry saw it from the frame that was measured before, and all later ones go with it.
void Way::measure(std::uint32_t number, const Place& place) {
  Frame& frame = frames_[number % kFrames];
  constexpr double kMost = 1e6;  // of any error: sums keep millimetres beside it
  const bool is_told = place.level_m < kMost && place.level_rad < kMost && place.variance_m2 < kMost &&
                       place.variance_rad2 < kMost && place.drift_m < kMost && place.drift_rad < kMost;
  if (!is_told) return;
  const bool goes_on = measured_ != 0 && frames_[(measured_ - 1) % kFrames].place.run == place.run;
  const Certainty seen = certainty_of(place);
  if (goes_on) {
    const Frame& before = frames_[(measured_ - 1) % kFrames];
    const Eigen::Quaterniond back = before.place.turn.conjugate();
    const Eigen::Vector3d moved_m = back * (place.position_m - before.place.position_m);
    const Eigen::Matrix3d turned = (back * place.turn).toRotationMatrix();
    const Pose2 at = compose(before.base, {moved_m.x(), moved_m.y(), arc_tangent2(turned(1, 0), turned(0, 0))});
    const Pose2 was = frame.base;
    for (std::uint32_t k = number; k < count_; ++k) {
      Pose2& base = frames_[k % kFrames].base;
      base = compose(at, between(was, base));
    }
    base_ = frames_[(count_ - 1) % kFrames].base;
    now_.variance_m2 += larger(place.variance_m2 - before.place.variance_m2, 0.0);
    now_.variance_rad2 += larger(place.variance_rad2 - before.place.variance_rad2, 0.0);
    const Certainty then = certainty_of(before.place);
    now_.drift_m += larger(seen.drift_m - then.drift_m, 0.0);
  } else {
    leave_odometry();
    now_.drift_m += seen.own_m;  // of the place from which the others are told
  }
  frame.place = place;
  measured_ = number + 1;
  now_.own_m = seen.own_m + (reckoned_m_ - frame.reckoned_m);
  if (count_ - 1 > number) remember();
}

// The speed between two places of one run is the mean of that time. Since its middle the drive may have changed it.
MeasuredMotion Way::motion_since(const Frame& before, const Frame& last, double age_s) const {
  const double seconds = seconds_between(before.stamp_ns, last.stamp_ns);
  const Place &first = before.place, &second = last.place;
  const Pose2 moved = between(before.base, last.base);
  const Eigen::Vector2d halfway = Turn2(0.5 * moved.yaw_rad).back(moved.place());
  const double changed_m_s = machine_.acceleration_m_s2 * (0.5 * seconds + age_s);
  const double place_m = first.level_m + second.level_m +
                         machine_.sigmas * root_above(first.variance_m2, second.variance_m2) +
                         larger(second.drift_m - first.drift_m, 0.0);
  const double turn_rad = first.level_rad + second.level_rad +
                          machine_.sigmas * root_above(first.variance_rad2, second.variance_rad2) +
                          larger(second.drift_rad - first.drift_rad, 0.0);
  MeasuredMotion motion;
  motion.speed_m_s = halfway.dot(machine_.forward) / seconds;
  motion.turn_rad_s = moved.yaw_rad / seconds;
  motion.speed_error_m_s = place_m / seconds + changed_m_s;
  motion.turn_error_rad_s = turn_rad / seconds + changed_m_s / machine_.radius_m;
  motion.is_known = true;
  return motion;
}

MeasuredMotion Way::motion(std::int64_t now_ns) const {
  MeasuredMotion best;
  if (measured_ == 0) return best;
  const Frame& last = frames_[(measured_ - 1) % kFrames];
  const double age_s = seconds_between(last.stamp_ns, now_ns);
  for (std::uint32_t back = 2; back <= kFrames && back <= measured_ && measured_ - back + kFrames >= count_; ++back) {
    const Frame& before = frames_[(measured_ - back) % kFrames];
    if (before.place.run != last.place.run) continue;
    if (seconds_between(before.stamp_ns, last.stamp_ns) > kOdometryMost_s) break;
    const MeasuredMotion since = motion_since(before, last, age_s);
    if (!best.is_known) best = since;
    // Each bound holds by itself.
    if (since.speed_error_m_s < best.speed_error_m_s) {
      best.speed_m_s = since.speed_m_s, best.speed_error_m_s = since.speed_error_m_s;
    }
    if (since.turn_error_rad_s < best.turn_error_rad_s) {
      best.turn_rad_s = since.turn_rad_s, best.turn_error_rad_s = since.turn_error_rad_s;
    }
  }
  return best;
}

}  // namespace pose_wall::planar
