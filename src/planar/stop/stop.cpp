// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/stop.hpp"

#include <cmath>
#include <limits>

#include "base/math/elementary.hpp"
#include "base/math/finite.hpp"
#include "place/pose2.hpp"
#include "planar/stop/stop_image.hpp"

namespace pose_wall::planar {
namespace {

// In a frame: a sensor that is covered or off has fewer, and fewer do not tell a frame from those before.
constexpr std::uint32_t kReturnsLeast = SeenClouds::kReturnsLeast;
constexpr std::uint32_t kMomentFirst_ms = 1000000;  // the first frame's time: that of a place that was never seen is 0
constexpr std::uint32_t kMomentMost_ms = 0xF0000000U;  // after 46 days all is forgotten once
constexpr double kFuture_s = 0.005;                    // a stamp may lie so far ahead of the caller's clock
constexpr std::uint32_t kClockStandsMost = 100;        // calls with one time: a clock in steps of 16 ms takes some
constexpr double kStill_m_s = 1e-9;                    // it stands: no drive is as slow

// Without a frame that can be used nothing is known:
constexpr std::uint32_t kFatal =
    POSE_WALL_PLANAR_STOP_R_STALE | POSE_WALL_PLANAR_STOP_R_INVALID | POSE_WALL_PLANAR_STOP_R_FROZEN;

// Of two moments of which the second is not before the first; stamps may be any numbers.
double nanoseconds_between(std::int64_t first_ns, std::int64_t second_ns) {
  return static_cast<double>(static_cast<std::uint64_t>(second_ns) - static_cast<std::uint64_t>(first_ns));
}

}  // namespace

void Stop::lay_out(Arena& arena) {
  sight_.lay_out(arena);
  places_.lay_out(arena);
  moves_.lay_out(arena);
  hazards_ = arena.take<Hazard>(kHazards);
  looks_ = arena.take_one<FloorLooks>();
  print_ = arena.take_one<CloudPrint>();
}

void Stop::open(const StopSettings& settings, const Mount& mount, double sigmas, std::uint32_t settings_crc32) {
  settings_ = settings;
  mount_ = mount;
  sight_.open(settings, mount);
  sweep_.open(settings);
  moves_.open(settings, mount, sweep_.radius_m(), sigmas);
  heartbeat_ = 0;
  settings_crc32_ = settings_crc32;
  reset();
}

void Stop::reset() {
  has_now_ = false;
  now_ns_ = 0;
  clock_stood_calls_ = 0;
  repeat_guard_ = RepeatGuard{};  // a clock that is set back leaves it: what was seen is old all the same
  forget();
}

void Stop::forget() {
  places_.open(settings_);
  moves_.forget();
  first_ns_ = last_ns_ = clear_since_ns_ = 0;
  frames_ = 0;
  now_ms_ = kMomentFirst_ms;
  is_stopped_ = true;
  is_clear_ = false;
  went_back_ = false;
  back_ns_ = 0;
  last_ = begun(0);
  last_.reasons = POSE_WALL_PLANAR_STOP_R_STALE;
}

// What is known has ages by this clock. Where it goes back they are lost, and with them all that is known. While it
// stands still, nothing tells how old a frame is, and the heart does not beat.
std::uint32_t Stop::heed_clock(std::int64_t now_ns) {
  const bool is_first = !has_now_, is_set_back = !is_first && seconds_between(now_ns, now_ns_) > kFuture_s;
  if (is_first || is_set_back || now_ns > now_ns_) {
    has_now_ = true;
    now_ns_ = now_ns;
    clock_stood_calls_ = 0;
    ++heartbeat_;
  } else if (clock_stood_calls_ < kClockStandsMost) {
    ++clock_stood_calls_;
  }
  if (is_set_back) {
    forget();
    return POSE_WALL_PLANAR_STOP_R_INVALID;
  }
  return clock_stood_calls_ < kClockStandsMost ? 0 : POSE_WALL_PLANAR_STOP_R_STALE;
}

// One stamp that goes back is a frame that was overtaken. The second in a row is a clock that was set back: it is taken
// for the first frame.
void Stop::heed_stamp(std::int64_t stamp_ns) {
  const bool goes_back = frames_ > 0 && stamp_ns < last_ns_;
  const bool is_second = goes_back && went_back_ && stamp_ns > back_ns_;
  if (is_second) forget();
  went_back_ = goes_back && !is_second;
  back_ns_ = stamp_ns;
}

void Stop::confirm() {
  places_.confirm(moves_.way(), sweep_, now_ms_);
}

pose_wall_planar_stop_result Stop::begun(std::int64_t now_ns) const {
  pose_wall_planar_stop_result r{};
  r.struct_size = sizeof(r);
  r.state = POSE_WALL_PLANAR_STOP_STOP;
  r.stamp_ns = last_ns_;
  r.now_ns = now_ns;
  r.frames = frames_;
  r.rim_speed_m_s = r.nearest_m[0] = r.nearest_m[1] = r.nearest_distance_m = not_a_number();
  r.nearest_size_m = r.nearest_age_s = not_a_number();
  r.floor_height_m = r.floor_slope[0] = r.floor_slope[1] = not_a_number();
  r.speed_m_s = r.speed_error_m_s = r.turn_rad_s = r.turn_error_rad_s = not_a_number();
  r.time_to_contact_s = std::numeric_limits<double>::infinity();
  r.settings_crc32 = settings_crc32_;
  r.mark = kStopMark;
  return r;
}

std::uint32_t Stop::frame_reasons(const pose_wall_cloud& cloud, std::int64_t now_ns) {
  std::uint32_t reasons = 0;
  const double age_s = seconds_between(cloud.stamp_ns, now_ns);
  if (!(age_s <= settings_.stale_s)) reasons |= POSE_WALL_PLANAR_STOP_R_STALE;
  if (!(age_s >= -kFuture_s)) reasons |= POSE_WALL_PLANAR_STOP_R_INVALID;
  if (frames_ > 0 && !(cloud.stamp_ns > last_ns_)) reasons |= POSE_WALL_PLANAR_STOP_R_INVALID;
  if (repeat_guard_.keep(*print_, cloud.stamp_ns).is_one) reasons |= POSE_WALL_PLANAR_STOP_R_FROZEN;
  return reasons;
}

void Stop::see(const Ground& ground, pose_wall_planar_stop_result* result) {
  const Eigen::Vector2d sensor_m = mount_.sensor_base_m.head<2>();
  places_.put_returns(sight_, moves_.way(), sensor_m, now_ms_);
  places_.put_seen(sight_, moves_.way(), sensor_m, sweep_, now_ms_);
  result->floor_height_m = ground.height_m;
  result->floor_slope[0] = ground.slope_x, result->floor_slope[1] = ground.slope_y;
  if (!ground.seen) result->reasons |= POSE_WALL_PLANAR_STOP_R_NO_FLOOR;
}

void Stop::judge(const SweepMotion& motion, pose_wall_planar_stop_result* result) {
  // Its own speeds by the careful sweep, the stop by the other.
  sweep_.set_motion(motion, reaction_s(settings_) + settings_.slack_s);
  Places::Count count;
  const Eigen::Vector2d sensor_m = mount_.sensor_base_m.head<2>();
  const std::uint32_t found = places_.find_hazards(sight_, moves_.way(), sensor_m, sweep_, now_ms_, hazards_, &count);
  const Span<const Hazard> hazards = hazards_.first(found);
  std::int32_t limiting = -1;
  const std::uint32_t careful = sweep_.highest_level(hazards, &limiting);
  result->allowed_speed_m_s = sweep_.speed_of(careful);
  result->stop_speed_m_s = result->allowed_speed_m_s;
  if (limiting >= 0) {
    const Hazard& hazard = hazards[static_cast<std::uint32_t>(limiting)];
    tell_nearest(hazard, result);
    if (result->rim_speed_m_s > kStill_m_s) result->time_to_contact_s = sweep_.path_to(hazard) / result->rim_speed_m_s;
    sweep_.set_motion(motion, reaction_s(settings_));
    std::int32_t same = -1;
    result->stop_speed_m_s = sweep_.speed_of(sweep_.highest_level(hazards, &same));
    if (result->stop_speed_m_s < result->allowed_speed_m_s) result->allowed_speed_m_s = result->stop_speed_m_s;
  }
  result->allowed_turn_rad_s = result->allowed_speed_m_s * motion.turn_rad_m;
  result->thing_cells = count.things;
  result->blind_cells = count.blind;
  result->doubtful_cells = count.doubtful;
  if (count.doubtful > 0) result->reasons |= POSE_WALL_PLANAR_STOP_R_DUST;
}

void Stop::tell_nearest(const Hazard& hazard, pose_wall_planar_stop_result* result) const {
  result->nearest_m[0] = static_cast<double>(hazard.x_m);
  result->nearest_m[1] = static_cast<double>(hazard.y_m);
  result->nearest_distance_m = static_cast<double>(sweep_.distance_now(hazard.x_m, hazard.y_m));
  result->nearest_height = hazard.kind;
  if (hazard.kind == POSE_WALL_PLANAR_STOP_UNSEEN) {
    result->reasons |= POSE_WALL_PLANAR_STOP_R_BLIND;
    return;
  }
  const Place& place = places_.at(hazard.place);
  result->nearest_size_m = places_.size_around(hazard.place, moves_.way(), now_ms_);
  const bool is_high = (hazard.kind & POSE_WALL_PLANAR_STOP_HIGH) != 0;
  result->nearest_age_s = 0.001 * (now_ms_ - (is_high ? place.first_ms : place.low_first_ms));
  result->reasons |= POSE_WALL_PLANAR_STOP_R_THING;
  if (!is_high) result->reasons |= POSE_WALL_PLANAR_STOP_R_LOW;
  if (hazard.approach_m_s > 0.0F) result->reasons |= POSE_WALL_PLANAR_STOP_R_NEARING;
}

// Stops at once; goes on only after restart_s without a reason to stop.
void Stop::decide(std::uint32_t fatal, std::int64_t now_ns, pose_wall_planar_stop_result* r) {
  // The sweep has the errors of a speed; the same ones may be in what was measured.
  const double may_read_m_s = r->stop_speed_m_s + moves_.rim_error_m_s(r->stop_speed_m_s);
  const bool is_fast = !(r->rim_speed_m_s <= may_read_m_s);
  if (is_fast) r->reasons |= POSE_WALL_PLANAR_STOP_R_SPEED;
  const bool may_move = fatal == 0 && r->stop_speed_m_s > 0.0 && !is_fast;
  const bool is_clear = may_move && r->allowed_speed_m_s >= settings_.restart_speed_m_s;
  if (!is_clear) is_clear_ = false;
  if (is_clear && !is_clear_) is_clear_ = true, clear_since_ns_ = now_ns;
  if (!may_move) is_stopped_ = true;
  if (is_stopped_ && is_clear_) {
    const double clear_s = static_cast<double>(now_ns - clear_since_ns_) * kNanosecond_s;
    is_stopped_ = !(clear_s >= settings_.restart_s);
    if (is_stopped_) r->reasons |= POSE_WALL_PLANAR_STOP_R_RESTART;
  }
  if (is_stopped_) {
    r->state = POSE_WALL_PLANAR_STOP_STOP;
    r->allowed_speed_m_s = r->allowed_turn_rad_s = 0.0;
    return;
  }
  const bool is_whole = r->allowed_speed_m_s >= settings_.speed_max_m_s;
  r->state = is_whole ? POSE_WALL_PLANAR_STOP_GO : POSE_WALL_PLANAR_STOP_SLOW;
}

void Stop::process(const pose_wall_cloud& cloud, const pose_wall_planar_stop_motion& given, std::int64_t now_ns,
                   pose_wall_planar_stop_result* result) {
  const Rays rays(cloud, mount_);
  // Each cloud is looked at: one that is refused may come again. Of what it shows only its print is kept.
  const Ground ground = find_ground(rays, mount_, settings_, looks_);
  const std::uint32_t points_used = sight_.look(rays, ground, print_);
  const std::uint32_t of_clock = heed_clock(now_ns);
  heed_stamp(cloud.stamp_ns);
  moves_.take(given, cloud.stamp_ns);
  const std::uint32_t refused = of_clock | frame_reasons(cloud, now_ns);
  pose_wall_planar_stop_result r = begun(now_ns);
  r.reasons = refused;
  r.points_in = static_cast<std::uint32_t>(rays.points());
  r.rim_speed_m_s = moves_.rim_m_s();
  moves_.tell(&r);
  if (!moves_.is_known()) r.reasons |= POSE_WALL_PLANAR_STOP_R_MISSING;
  // A stamp of the future is no last one: all that follow would seem to go back.
  const bool is_of_future = !(seconds_between(cloud.stamp_ns, now_ns) >= -kFuture_s);
  const bool goes_on = !is_of_future && (frames_ == 0 || cloud.stamp_ns > last_ns_);
  if (goes_on) {
    if (frames_ == 0) first_ns_ = cloud.stamp_ns;
    const double since_s = frames_ == 0 ? 0.0 : kNanosecond_s * nanoseconds_between(last_ns_, cloud.stamp_ns);
    const double ms = 1e-6 * nanoseconds_between(first_ns_, cloud.stamp_ns);
    if (!(ms < kMomentMost_ms - kMomentFirst_ms)) places_.forget(), first_ns_ = cloud.stamp_ns;
    now_ms_ = kMomentFirst_ms + static_cast<std::uint32_t>(1e-6 * nanoseconds_between(first_ns_, cloud.stamp_ns));
    last_ns_ = cloud.stamp_ns;
    moves_.go(cloud.stamp_ns, now_ms_, since_s);
    ++frames_;
  }
  r.stamp_ns = last_ns_;
  r.frames = frames_;
  if (goes_on && (refused & kFatal) == 0) {
    r.points_used = points_used;
    see(ground, &r);
    if (r.points_used < kReturnsLeast) r.reasons |= POSE_WALL_PLANAR_STOP_R_INVALID;
    judge(moves_.sweep(), &r);
  }
  decide(r.reasons & kFatal, now_ns, &r);
  r.heartbeat = heartbeat_;
  last_ = r;
  *result = r;
}

void Stop::tick(std::int64_t now_ns, pose_wall_planar_stop_result* result) {
  std::uint32_t reasons = heed_clock(now_ns);
  last_.now_ns = now_ns;
  const double age_s = seconds_between(last_ns_, now_ns);
  if (frames_ == 0 || !(age_s <= settings_.stale_s)) {
    reasons |= POSE_WALL_PLANAR_STOP_R_STALE;
  } else if (!(age_s >= -kFuture_s)) {
    reasons |= POSE_WALL_PLANAR_STOP_R_INVALID;
  }
  if (reasons != 0) {
    last_.reasons |= reasons;
    is_stopped_ = true;
    is_clear_ = false;
    last_.state = POSE_WALL_PLANAR_STOP_STOP;
    last_.allowed_speed_m_s = last_.allowed_turn_rad_s = last_.stop_speed_m_s = 0.0;
  }
  last_.heartbeat = heartbeat_;
  *result = last_;
}

}  // namespace pose_wall::planar
