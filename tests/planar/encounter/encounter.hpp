// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// One encounter: a road, a machine with its stop, and what comes into its way.

#pragma once

#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "planar/bytes_needed.hpp"
#include "planar/encounter/machine.hpp"
#include "planar/encounter/sensor.hpp"
#include "planar/encounter/world.hpp"
#include "pose_wall_planar_stop.h"
#include "support/aligned_block.hpp"

namespace pose_wall::test {

enum class Drive { straight, curve, spot, reverse };
enum class Loss { none, silent, frozen, delayed, covered, dirty, part_frozen, losses };
enum class Kind { clear, person_crosses, person_comes, person_starts, prop, box, muck, boom, dust, puddle, kinds };

inline const char* name_of(Kind kind) {
  static constexpr const char* kNames[] = {"clear", "person_crosses", "person_comes", "person_starts", "prop",
                                           "box",   "muck",           "boom",         "dust",          "puddle"};
  return kNames[static_cast<int>(kind)];
}

struct Plan {
  World world;
  Machine machine;
  Sensor sensor;
  Drive drive = Drive::straight;
  Kind kind = Kind::clear;
  Loss loss = Loss::none;
  double loss_from_s = 1e9, dirt_to_rad = 0.0;
  double frozen_rad = 0.5;  // width of what stays, where a part freezes
  double wish_m_s = 1.0;    // rim speed that the driver wants
  double lasts_s = 8.0;
  double odometry = 1.0;  // measured over true
  bool goes_on = false;   // however often the machine stops, until it stands for good
  double ends_m = 1e9;    // of its way
};

struct Outcome {
  bool contact = false;
  double contact_m_s = 0.0, contact_s = 0.0, moved_m = 0.0, drove_s = 0.0, lasted_s = 0.0;
  double top_m_s = 0.0, top_near_m_s = 0.0;                         // and while a thing was near
  double top_stop_m_s = 0.0;                                        // at the stop that came at most speed
  std::uint32_t stops = 0, frames = 0;                              // from motion
  std::uint32_t stops_by[POSE_WALL_PLANAR_STOP_REASON_COUNT] = {};  // of these; one may have several reasons
  double first_metre_s = 1e9, allowed_m = 0.0;                      // while it drove: allowed speed by time
  // Frames in which it stood, the first seconds apart: by reason, and where the nearest blind place lay.
  std::uint32_t held = 0, held_by[POSE_WALL_PLANAR_STOP_REASON_COUNT] = {};
  std::uint32_t blind_ahead = 0, blind_beside = 0, blind_behind = 0;
  Kind touched = Kind::clear;
};

// An opened stop with room for it.
class StopUnderTest {
 public:
  StopUnderTest() : block_(stop_bytes_needed(), Dirt::kRandom) {}

  void open(const Sensor& sensor, const pose_wall_planar_stop_settings& settings) {
    pose_wall_config config;
    (void)pose_wall_config_init(&config);
    (void)pose_wall_config_set_number(&config, "extrinsic_x", sensor.x_m);
    (void)pose_wall_config_set_number(&config, "extrinsic_z", sensor.z_m);
    (void)pose_wall_config_set_number(&config, "extrinsic_roll", sensor.roll_rad);
    (void)pose_wall_config_set_number(&config, "extrinsic_pitch", sensor.pitch_rad);
    (void)pose_wall_config_set_number(&config, "range_min", 0.3);
    (void)pose_wall_config_set_number(&config, "range_max", 100.0);
    if (sensor.has_body()) (void)pose_wall_config_set(&config, "body_box_1", box_around(sensor.body_m).c_str());
    if (pose_wall_planar_stop_open(&config, &settings, block_.data(), block_.size(), &stop_) != POSE_WALL_OK) {
      stop_ = nullptr;
    }
    result_.struct_size = sizeof(result_);
  }
  pose_wall_planar_stop* get() { return stop_; }
  pose_wall_planar_stop_result& result() { return result_; }

  // Keeps all that the stop knows, and brings it back.
  void keep() {
    kept_.resize(block_.size());
    std::memcpy(kept_.data(), block_.data(), kept_.size());
    kept_result_ = result_;
  }
  void bring_back() {
    std::memcpy(block_.data(), kept_.data(), kept_.size());
    result_ = kept_result_;
  }

 private:
  // Returns of the body have noise.
  static std::string box_around(const std::array<double, 6>& body_m) {
    constexpr double kNoise_m = 0.05;  // above three deviations of the noisiest sensor that is drawn
    std::string text;
    for (std::size_t k = 0; k < 6; ++k) text += std::to_string(body_m[k] + (k % 2 == 0 ? -kNoise_m : kNoise_m)) + " ";
    return text;
  }
  AlignedBlock block_;
  std::vector<unsigned char> kept_;
  pose_wall_planar_stop_result kept_result_{};
  pose_wall_planar_stop* stop_ = nullptr;
  pose_wall_planar_stop_result result_{};
};

class Encounter {
 public:
  Encounter(const Plan& plan, const pose_wall_planar_stop_settings& settings, StopUnderTest* stop, Draw* draw)
      : plan_(plan), settings_(settings), stop_(stop), draw_(draw) {}

  // Prints every stop from motion.
  void tell_stops() { tells_stops_ = true; }
  // Prints every frame.
  void tell_frames() { tells_frames_ = true; }

  Outcome run() {
    if (!begin()) return out_;
    while (step() && !is_over()) continue;
    return out_;
  }

  // Drives for so long, whatever happens.
  void run_up(double seconds) {
    if (!begin()) return;
    while (now_s_ < seconds && step()) continue;
  }
  // What happens from now on, in another draw; `stop` holds what it held when the run-up had ended. Times of the event
  // are from now on.
  Outcome run_on(const Plan& event, Draw* draw) {
    draw_ = draw;
    plan_.world.things = event.world.things, plan_.world.dust = event.world.dust;
    plan_.world.puddles = event.world.puddles;
    for (Thing& t : plan_.world.things) t.walks_from_s += now_s_, t.walks_until_s += now_s_;
    plan_.loss = event.loss, plan_.loss_from_s = now_s_ + event.loss_from_s, plan_.dirt_to_rad = event.dirt_to_rad;
    plan_.frozen_rad = event.frozen_rad;
    plan_.kind = event.kind;
    plan_.lasts_s = now_s_ + event.lasts_s;
    out_ = Outcome();
    const double began_s = now_s_;
    while (step() && !is_over()) continue;
    out_.lasted_s -= began_s;
    return out_;
  }
  const Machine& machine() const { return plan_.machine; }

 private:
  static std::int64_t ns(double s) { return 1000000000LL + static_cast<std::int64_t>(s * 1e9 + 0.5); }

  static constexpr double kStep_s = 0.02;

  bool begin() {
    stop_->open(plan_.sensor, settings_);
    phase_s_ = draw_->within(0.0, 0.1);
    return pose_wall_planar_stop_confirm(stop_->get()) == POSE_WALL_OK;
  }

  // False after a contact and at the plan's end.
  bool step() {
    if (now_s_ + phase_s_ >= next_frame_s_) {
      frame(now_s_);
      next_frame_s_ += 0.1;
      if (tells_frames_) print(now_s_);
    }
    deliver(now_s_);
    obey(now_s_);
    plan_.machine.step(now_s_, kStep_s);
    for (Thing& thing : plan_.world.things) thing.step(now_s_, kStep_s);
    watch(now_s_, kStep_s);
    stood_s_ = plan_.machine.rim_m_s <= 0.0 ? stood_s_ + kStep_s : 0.0;
    now_s_ += kStep_s;
    return !out_.contact && now_s_ < plan_.lasts_s;
  }

  // It stands again and nothing comes, or it never starts, or nothing is left that it could drive into.
  bool is_over() const {
    constexpr double kForGood_s = 10.0;  // where nothing moves
    if (out_.moved_m >= plan_.ends_m) return true;
    if (plan_.goes_on) return stood_s_ > kForGood_s;
    if (is_walking(now_s_)) return false;
    if (out_.moved_m > 0.0) return stood_s_ > 0.4 || has_passed_all();
    return now_s_ > settings_.settle_s + settings_.restart_s + 1.0 && stood_s_ > 1.6;
  }

  bool has_passed_all() const {
    if (plan_.drive != Drive::straight) return false;
    const Machine& m = plan_.machine;
    for (const Thing& t : plan_.world.things) {
      const double ahead_m = std::cos(m.yaw_rad) * (t.x_m - m.x_m) + std::sin(m.yaw_rad) * (t.y_m - m.y_m);
      if (ahead_m + t.reach_m() > 0.0) return false;
    }
    return !plan_.world.things.empty();
  }

  bool is_walking(double now_s) const {
    for (const Thing& t : plan_.world.things) {
      if (now_s < t.walks_until_s) return true;
    }
    return false;
  }

  // A scan is taken; it arrives 40 ms later.
  void frame(double now_s) {
    const bool lost = now_s >= plan_.loss_from_s;
    if (lost && plan_.loss == Loss::silent) return;
    const Machine& m = plan_.machine;
    if (!(lost && plan_.loss == Loss::frozen)) {
      const auto rest = plan_.world.rest_at(m.x_m, m.y_m);
      const double c = std::cos(m.yaw_rad), s = std::sin(m.yaw_rad);
      const double pitch = -(c * rest.along + s * rest.across) + 0.004 * draw_->normal();
      const double roll = (-s * rest.along + c * rest.across) + 0.004 * draw_->normal();
      if (lost && plan_.loss == Loss::dirty) {
        plan_.sensor.dirt_from_rad = plan_.dirt_to_rad - 0.3, plan_.sensor.dirt_to_rad = plan_.dirt_to_rad;
      }
      if (lost && plan_.loss == Loss::part_frozen) before_ = scan_.points();
      scan_.take(plan_.sensor, plan_.world, m.x_m, m.y_m, m.yaw_rad, pitch, roll, draw_);
      if (lost && plan_.loss == Loss::part_frozen) {
        scan_.keep_some(before_, plan_.dirt_to_rad - plan_.frozen_rad, plan_.dirt_to_rad);
      }
      if (lost && plan_.loss == Loss::covered) scan_.blind();
    }
    const double delay_s = lost && plan_.loss == Loss::delayed ? 0.04 + 0.5 * (now_s - plan_.loss_from_s) : 0.04;
    stamp_s_ = now_s;
    if (delay_s > 0.5) return;
    arrives_s_ = now_s + delay_s;
    waits_ = true;
    ++out_.frames;
  }

  void deliver(double now_s) {
    auto& result = stop_->result();
    if (waits_ && now_s + 1e-9 >= arrives_s_) {
      waits_ = false;
      const pose_wall_cloud cloud = scan_.cloud(ns(stamp_s_));
      pose_wall_planar_stop_motion motion{};
      motion.struct_size = sizeof(motion);
      motion.given = POSE_WALL_PLANAR_STOP_MEASURED | POSE_WALL_PLANAR_STOP_COMMANDED;
      const Machine& m = plan_.machine;
      motion.speed_m_s = m.speed_m_s() * plan_.odometry;
      motion.turn_rad_s = m.turn_rad_s() * plan_.odometry;
      const double next = m.wanted() > 0.02 ? m.wanted() : 0.02;
      motion.command_speed_m_s = next * m.velocity;
      motion.command_turn_rad_s = next * m.turn_rad_m;
      if (pose_wall_planar_stop_process(stop_->get(), &cloud, &motion, ns(now_s), &result) != POSE_WALL_OK) {
        result.state = POSE_WALL_PLANAR_STOP_STOP;
      }
      tally(now_s);
      return;
    }
    if (pose_wall_planar_stop_tick(stop_->get(), ns(now_s), &result) != POSE_WALL_OK) {
      result.state = POSE_WALL_PLANAR_STOP_STOP;
    }
  }

  // What holds the machine, once it could have started.
  void tally(double now_s) {
    const auto& r = stop_->result();
    if (r.state != POSE_WALL_PLANAR_STOP_STOP || now_s < settings_.settle_s + settings_.restart_s) return;
    ++out_.held;
    for (std::uint32_t bit = 0; bit < POSE_WALL_PLANAR_STOP_REASON_COUNT; ++bit) {
      out_.held_by[bit] += (r.reasons >> bit) & 1U;
    }
    if (r.nearest_height != POSE_WALL_PLANAR_STOP_UNSEEN) return;
    const Machine& m = plan_.machine;
    ++(r.nearest_m[0] > m.front_m  ? out_.blind_ahead
       : r.nearest_m[0] < m.back_m ? out_.blind_behind
                                   : out_.blind_beside);
  }

  void obey(double now_s) {
    const auto& result = stop_->result();
    const bool stops = result.state == POSE_WALL_PLANAR_STOP_STOP;
    if (stops && !was_stopped_ && plan_.machine.rim_m_s > 0.01) {
      ++out_.stops;
      out_.top_stop_m_s = std::fmax(out_.top_stop_m_s, plan_.machine.rim_m_s);
      for (std::uint32_t bit = 0; bit < POSE_WALL_PLANAR_STOP_REASON_COUNT; ++bit) {
        out_.stops_by[bit] += (result.reasons >> bit) & 1U;
      }
      if (tells_stops_) print(now_s);
    }
    was_stopped_ = stops;
    const double allowed = stops ? 0.0 : result.allowed_speed_m_s;
    plan_.machine.command(now_s, std::fmin(plan_.wish_m_s, allowed), stops);
  }

  void watch(double now_s, double step_s) {
    const Machine& m = plan_.machine;
    out_.moved_m += m.rim_m_s * step_s;
    if (m.rim_m_s > 0.01) out_.drove_s += step_s, out_.allowed_m += step_s * stop_->result().allowed_speed_m_s;
    if (out_.moved_m >= 1.0) out_.first_metre_s = std::fmin(out_.first_metre_s, now_s);
    out_.top_m_s = std::fmax(out_.top_m_s, m.rim_m_s);
    out_.lasted_s = now_s;
    for (const Thing& thing : plan_.world.things) {
      constexpr double kNear_m = 6.0;
      const double far_m = m.distance(thing.x_m, thing.y_m);
      if (far_m < kNear_m) out_.top_near_m_s = std::fmax(out_.top_near_m_s, m.rim_m_s);
      if (far_m > thing.reach_m() || !m.touches(thing)) continue;
      out_.contact = true;
      out_.contact_m_s = m.rim_m_s;
      out_.contact_s = now_s;
      out_.touched = plan_.kind;
    }
  }

  void print(double now_s) const {
    const auto& r = stop_->result();
    const Machine& m = plan_.machine;
    std::printf(
        "%5.2f x %.2f y %.2f yaw %.2f rim %.2f | %s allowed %.2f stop %.2f reasons %03x things %u blind %u "
        "doubt %u near (%.2f %.2f) d %.2f kind %u age %.1f floor %.3f %.3f %.3f\n",
        now_s, m.x_m, m.y_m, m.yaw_rad, m.rim_m_s, pose_wall_planar_stop_state_name(r.state), r.allowed_speed_m_s,
        r.stop_speed_m_s, r.reasons, r.thing_cells, r.blind_cells, r.doubtful_cells, r.nearest_m[0], r.nearest_m[1],
        r.nearest_distance_m, r.nearest_height, r.nearest_age_s, r.floor_height_m, r.floor_slope[0], r.floor_slope[1]);
    for (const Thing& t : plan_.world.things) {
      std::printf("        thing at (%.2f %.2f) half %.2f %.2f z %.2f..%.2f\n", t.x_m, t.y_m, t.half_x_m, t.half_y_m,
                  t.bottom_m, t.top_m);
    }
  }

  Plan plan_;
  const pose_wall_planar_stop_settings& settings_;
  StopUnderTest* stop_;
  Draw* draw_;
  Scan scan_;
  std::vector<float> before_;
  Outcome out_;
  double now_s_ = 0.0, phase_s_ = 0.0, stood_s_ = 0.0;
  double next_frame_s_ = 0.0, stamp_s_ = 0.0, arrives_s_ = 0.0;
  bool waits_ = false, was_stopped_ = true, tells_stops_ = false, tells_frames_ = false;
};

}  // namespace pose_wall::test
