// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/movement.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "io/numbers/angles.hpp"
#include "io/terminal/did_you_mean.hpp"
#include "lab/campaign/event.hpp"
#include "lab/campaign/fingerprint.hpp"
#include "lab/sim/random.hpp"
#include "lab/sim/scenes.hpp"

namespace pose_wall::tools::campaign {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Loaders drive so fast at most on roads like these (judgement, 2026-11-27).
constexpr double kSpeedMost_mps = 5.0;
// At most so far from frame to frame, however slow the sensor is: what a scan at 10 Hz sees of 5 m/s.
constexpr double kStepMost_m = 0.5;
// A machine that keeps to a straight road turns so fast at most; hold_rate_angle allows for 2.9 degrees a second.
constexpr double kTurnMost_dps = 2.0;
// In all: with the 12 degrees at which it may stand at the start, within yaw_max_deg by far.
constexpr double kTurnedMost_deg = 10.0;
// In a curve the machine turns as the road does. So fast at most.
constexpr double kCurveMost_dps = 5.0;
// hold_rate_distance is 0.2 m/s, and the machine's turn takes its part.
constexpr double kWallMost_mps = 0.15;
// From a thing that stands at one place: a sampling point passes half a narrow opening at most.
constexpr double kRoomAtThings_m = 1.0;
// Of the way to a face.
constexpr double kRoomToFace = 0.25;
// Five frames of 10 Hz, the last scan included: what a scene without an event shows.
constexpr double kShown_s = 0.5;
// Speeds and rates are drawn in hundredths, so that commands stay short.
constexpr double kStepsPerUnit = 100.0;
// Likewise for the time of a scan: tenths of a millisecond, rounded down, since it may not exceed 1 / rate_hz.
constexpr double kScanSteps_hz = 1e4;

// Random numbers of their own: the scene's draws stay as they are.
constexpr std::uint64_t kStream = 0x30fe5;

constexpr const char* kNoSpeed = "speed_mps=0";
constexpr const char* kNoSway = "sway_roll_deg=0";

enum class Gait { kStill, kSwaying, kDriving };

std::string setting(const char* key, double value) {
  return fmt::format("{}={}", key, value);
}

double in_steps(double value) {
  return std::round(value * kStepsPerUnit) / kStepsPerUnit;
}

bool names_key(const sim::SceneChoice& scene, std::string_view key) {
  return std::any_of(scene.values.begin(), scene.values.end(), [&](const auto& value) { return key == value.key; });
}

// Every second run drives. Of those that stand, every second one sways as a machine does that cuts. The class's name
// decides where it begins, so that a campaign of one draw has all of them.
Gait gait_of(const RunOfClass& run) {
  const std::uint64_t turn = fingerprint(run.scene + "/" + run.sensor) + run.draw;
  if (turn % 2 == 1) return Gait::kDriving;
  return turn % 4 == 0 ? Gait::kStill : Gait::kSwaying;
}

double seconds_shown(const sim::Setup& setup) {
  return std::max(kShown_s, frames_to_watch(setup) / setup.sequence.rate_hz);
}

double fastest_mps(const sim::Setup& setup) {
  double fastest = std::min(kSpeedMost_mps, kStepMost_m * setup.sequence.rate_hz);
  fastest = std::min(fastest, room_to_drive_m(setup) / seconds_shown(setup));
  const double splay_deg = std::max(std::abs(setup.road.splay_left_deg), std::abs(setup.road.splay_right_deg));
  if (splay_deg > 0.0) fastest = std::min(fastest, kWallMost_mps / std::tan(splay_deg * kRadPerDeg));
  const double radius_m = std::abs(setup.road.curve_radius_m);
  return radius_m > 0.0 ? std::min(fastest, kCurveMost_dps * kRadPerDeg * radius_m) : fastest;
}

std::vector<std::string> standing(Gait gait) {
  std::vector<std::string> settings = {kNoSpeed, "turn_rate_dps=0"};
  if (gait == Gait::kStill) settings.insert(settings.end(), {kNoSway, "sway_pitch_deg=0"});
  return settings;
}

// Where its room ends the machine stops: nothing but a run of many more frames than the scene asks for goes so far.
std::vector<std::string> driving(const sim::Setup& setup, const sim::SceneChoice& scene, sim::Random* random) {
  std::vector<std::string> settings;
  const double backwards = random->chance(0.5) ? -1.0 : 1.0;
  const double speed_mps = backwards * in_steps(random->uniform(0.0, fastest_mps(setup)));
  const double turn_most_dps = std::min(kTurnMost_dps, kTurnedMost_deg / seconds_shown(setup));
  const double turn_dps = in_steps(random->uniform(-turn_most_dps, turn_most_dps));
  settings.push_back(setting("speed_mps", speed_mps));
  const double room_m = room_to_drive_m(setup);
  if (std::isfinite(room_m) && speed_mps != 0.0) {
    settings.push_back(
        setting("speed_change_at_s", std::floor(room_m / std::abs(speed_mps) * kStepsPerUnit) / kStepsPerUnit));
    settings.emplace_back("speed_after_mps=0");
  }
  if (!names_key(scene, "turn_rate_dps")) settings.push_back(setting("turn_rate_dps", turn_dps));
  return settings;
}

}  // namespace

std::vector<std::string> scans_names() {
  return {"turning", "instant"};
}

const char* scans_name(Scans scans) {
  return scans == Scans::kTurning ? "turning" : "instant";
}

Scans scans_named(const std::string& name) {
  for (const Scans scans : {Scans::kTurning, Scans::kInstant}) {
    if (name == scans_name(scans)) return scans;
  }
  throw std::invalid_argument(fmt::format("unknown scans '{}'{}; {} are there", name, did_you_mean(name, scans_names()),
                                          fmt::join(scans_names(), ", ")));
}

double room_to_drive_m(const sim::Setup& setup) {
  const sim::Objects& o = setup.objects;
  const double nowhere = sim::kSideNone;
  const bool has_things = setup.openings.crosscut_side != nowhere || setup.openings.widening_side != nowhere ||
                          setup.road.ramp_deg != 0.0 || setup.openings.narrow_side != nowhere ||
                          o.vehicle_side != nowhere || o.people_side != nowhere || o.curtain_side != nowhere ||
                          o.clutter_count > 0.0 || setup.road.splay_left_deg != 0.0 ||
                          setup.road.splay_right_deg != 0.0;
  double room_m = has_things ? kRoomAtThings_m : kInf;
  for (const double end_m : {setup.road.face_distance_m, setup.road.rear_distance_m}) {
    if (end_m > 0.0) room_m = std::min(room_m, kRoomToFace * end_m);
  }
  return room_m;
}

std::vector<std::string> movement_of(const RunOfClass& run, Scans scans) {
  if (scans == Scans::kInstant) return {};
  const sim::Setup drawn = sim::make_setup(run.scene, run.sensor, true, run.seed);  // refuses names that do not exist
  const sim::SceneChoice& scene = *sim::find_scene(run.scene);
  const double rate_hz = drawn.sequence.rate_hz;
  std::vector<std::string> settings = {setting("scan_s", std::floor(kScanSteps_hz / rate_hz) / kScanSteps_hz),
                                       "rock_repeats=no"};
  // A jump in the midst of a scan is no motion of a machine: it comes between two frames.
  if (drawn.machine.turn_step_deg != 0.0) {
    settings.push_back(setting("turn_step_at_s", std::ceil(drawn.machine.turn_step_at_s * rate_hz) / rate_hz));
  }
  if (names_key(scene, "speed_mps")) return settings;
  sim::Random random(run.seed, kStream);
  const Gait gait = gait_of(run);
  const auto moves = gait == Gait::kDriving ? driving(drawn, scene, &random) : standing(gait);
  settings.insert(settings.end(), moves.begin(), moves.end());
  return settings;
}

bool stands(const std::vector<std::string>& settings) {
  return std::find(settings.begin(), settings.end(), kNoSpeed) != settings.end();
}

bool has_straight_scans(const std::vector<std::string>& settings) {
  return settings.empty() || std::find(settings.begin(), settings.end(), kNoSway) != settings.end();
}

}  // namespace pose_wall::tools::campaign
