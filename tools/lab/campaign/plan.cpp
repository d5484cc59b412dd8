// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "io/terminal/did_you_mean.hpp"
#include "lab/campaign/event.hpp"
#include "lab/campaign/fingerprint.hpp"
#include "lab/campaign/motion_classes.hpp"
#include "lab/campaign/surfaces.hpp"
#include "lab/sim/parameters.hpp"
#include "lab/sim/pose.hpp"
#include "lab/sim/scenes.hpp"

namespace pose_wall::tools::campaign {
namespace {

constexpr std::uint32_t kWhole = std::numeric_limits<std::uint32_t>::max();

struct Size {
  const char* name;
  std::vector<std::string> sensors;
  std::uint32_t nominal_draws;        // of nominal and mine's scenes that stay as they are
  std::uint32_t draws;                // of the other ones that do
  std::uint32_t frames;               // of each of both
  std::uint32_t sequence_draws;       // of scenes in which something happens
  std::uint32_t sequence_frames_max;  // cuts long ones
  struct Motion {                     // of the motion library's classes
    std::uint32_t draws;
    std::uint32_t long_draws;  // of classes that go on for minutes
    double way_m;
    double seconds;
    std::uint32_t frames;
  } motion;
};

const std::vector<Size>& sizes() {
  static const std::vector<std::string> all = {"os1-64", "os0-128", "vlp16", "mid360"};
  static const std::vector<Size> table = {
      {"small", {"os1-64"}, 1, 1, 3, 1, 60, {1, 1, 6.0, 6.0, 70}},
      {"medium", all, 6, 6, 4, 2, 120, {4, 2, 30.0, 60.0, 120}},
      {"large", all, 60, 24, 5, 6, kWhole, {20, 4, 50.0, 600.0, 240}},
  };
  return table;
}

const Size& size_named(const std::string& name) {
  for (const Size& size : sizes()) {
    if (size.name == name) return size;
  }
  throw std::invalid_argument(fmt::format("unknown size '{}'{}; {} are there", name, did_you_mean(name, size_names()),
                                          fmt::join(size_names(), ", ")));
}

std::vector<std::string> scenes_of(const PlanRequest& request) {
  const auto is_wanted = [&request](const std::string& name) {
    const sim::SceneChoice* const scene = sim::find_scene(name);
    return request.kind == "all" || scene == nullptr || sim::scene_kind_name(scene->kind) == request.kind;
  };
  std::vector<std::string> wanted;
  if (request.scenes.empty()) {
    for (const sim::SceneChoice& scene : sim::scenes()) wanted.emplace_back(scene.name);
  } else {
    wanted = request.scenes;
  }
  wanted.erase(std::remove_if(wanted.begin(), wanted.end(), [&](const auto& scene) { return !is_wanted(scene); }),
               wanted.end());
  if (wanted.empty()) throw std::invalid_argument(fmt::format("none of the scenes is {}", request.kind));
  return wanted;
}

Run make_run(const PlanRequest& request, const Size& size, const std::string& scene, const std::string& sensor,
             std::uint32_t draw) {
  Run run{scene,
          sensor,
          draw,
          run_seed(request.seed, scene, sensor, draw),
          request.frames.value_or(size.frames),
          request.drive_in_m,
          0,
          {},
          movement_of({scene, sensor, draw, run_seed(request.seed, scene, sensor, draw)}, request.scans)};
  const sim::Setup setup = setup_of(run);
  run.drive_in_frames = sim::drive_in_frames(setup);
  const std::uint32_t watched = frames_to_watch(setup);
  if (watched > 0 && !request.frames) run.frames = std::min(watched, size.sequence_frames_max);
  return run;
}

// Its places are far apart: each frame stands alone, 10 s from the next.
Run surveyed_run(const PlanRequest& request, const std::string& file, const std::string& sensor, std::uint32_t draw) {
  const auto places = static_cast<std::uint32_t>(survey_of(file).path.size());
  return {sim::surveyed_scene().name,
          sensor,
          draw,
          run_seed(request.seed, file, sensor, draw),
          std::min(places, request.frames.value_or(places)),
          0.0,
          0,
          file,
          {"rate_hz=0.1"}};
}

bool is_sequence(const std::string& scene, const std::string& sensor) {
  return frames_to_watch(sim::make_setup(scene, sensor, false, 0)) > 0;
}

// Nominal scenes promise most. One unlucky run would break the promise of a few.
std::uint32_t draws_of(const PlanRequest& request, const Size& size, const std::string& scene,
                       const std::string& sensor) {
  if (request.draws) return *request.draws;
  if (is_sequence(scene, sensor)) return size.sequence_draws;
  const sim::SceneKind kind = sim::find_scene(scene)->kind;
  const bool is_ordinary = kind == sim::SceneKind::kNominal || kind == sim::SceneKind::kMine;
  return is_ordinary ? size.nominal_draws : size.draws;
}

std::vector<Run> plan_of_scenes(const PlanRequest& request) {
  const Size& size = size_named(request.size);
  std::vector<Run> runs;
  for (const std::string& scene : scenes_of(request)) {
    for (const std::string& sensor : sensors_of(request)) {
      const std::uint32_t draws = draws_of(request, size, scene, sensor);
      for (std::uint32_t i = 0; i < draws; ++i) {
        runs.push_back(make_run(request, size, scene, sensor, request.first_draw + i));
      }
    }
  }
  for (const std::string& sensor : sensors_of(request)) {
    std::uint32_t draw = 0;
    for (const std::string& file : request.surfaces) runs.push_back(surveyed_run(request, file, sensor, draw++));
  }
  return runs;
}

const MotionClass& class_named(const std::string& name) {
  if (const MotionClass* const one = find_motion_class(name)) return *one;
  std::vector<std::string> names;
  for (const MotionClass& one : motion_classes()) names.emplace_back(one.name);
  throw std::invalid_argument(
      fmt::format("unknown class of motion '{}'{}; `pose_wall campaign --motion --list` shows "
                  "them all",
                  name, did_you_mean(name, names)));
}

bool is_long(const MotionClass& one) {
  constexpr double kFiveMinutes_s = 300.0;
  return one.length == MotionLength::kTime && one.seconds_max > kFiveMinutes_s;
}

// The first frame stands at the start, the last at the end.
std::uint32_t frames_of_run(const MotionClass& one, const Size::Motion& size, const sim::Setup& setup) {
  if (one.length == MotionLength::kFrames) return size.frames;
  const double seconds = one.length == MotionLength::kWay ? size.way_m / std::abs(setup.machine.speed_mps)
                                                          : std::min(size.seconds, one.seconds_max);
  return 1 + static_cast<std::uint32_t>(std::ceil(seconds * setup.sequence.rate_hz));
}

std::vector<const MotionClass*> classes_of_request(const PlanRequest& request) {
  std::vector<const MotionClass*> classes;
  for (const std::string& name : request.scenes) classes.push_back(&class_named(name));
  if (!classes.empty()) return classes;
  for (const MotionClass& one : motion_classes()) classes.push_back(&one);
  return classes;
}

Run motion_run(const PlanRequest& request, const Size::Motion& size, const MotionClass& one, const std::string& sensor,
               std::uint32_t draw) {
  const std::uint64_t seed = run_seed(request.seed, std::string("motion ") + one.name, sensor, draw);
  const sim::Setup setup = make_motion_setup(one, sensor, seed);
  return {one.name, sensor, draw, seed, request.frames.value_or(frames_of_run(one, size, setup))};
}

// What was interrupted has runs of every class.
std::vector<Run> plan_of_classes(const PlanRequest& request) {
  const std::vector<std::string>& sensors = sensors_of(request);
  const Size::Motion& size = size_named(request.size).motion;
  const std::vector<const MotionClass*> classes = classes_of_request(request);
  std::vector<Run> runs;
  for (std::uint32_t i = 0; i < request.draws.value_or(size.draws); ++i) {
    for (const MotionClass* const one : classes) {
      if (!request.draws && is_long(*one) && i >= size.long_draws) continue;
      for (const std::string& sensor : sensors) {
        runs.push_back(motion_run(request, size, *one, sensor, request.first_draw + i));
      }
    }
  }
  return runs;
}

}  // namespace

const sim::SceneChoice* scene_of(const std::string& name) {
  return name == sim::surveyed_scene().name ? &sim::surveyed_scene() : sim::find_scene(name);
}

// Rock that repeats could look the same at two places of the way.
sim::Setup setup_of(const Run& run) {
  const bool is_surveyed = run.scene == sim::surveyed_scene().name;  // records do not hold the surface's file
  sim::Setup setup = is_surveyed ? sim::make_setup(sim::surveyed_scene(), run.sensor, false, run.seed)
                                 : sim::make_setup(run.scene, run.sensor, true, run.seed);
  for (const std::string& setting : run.settings) sim::set_parameter(setup, setting);
  if (run.drive_in_m > 0.0) {
    setup.machine.drive_in_m = run.drive_in_m;
    setup.rock.rock_repeats = 0.0;
  }
  return setup;
}

std::vector<std::string> size_names() {
  std::vector<std::string> names;
  for (const Size& size : sizes()) names.emplace_back(size.name);
  return names;
}

const std::vector<std::string>& sensors_of(const PlanRequest& request) {
  const Size& size = size_named(request.size);
  return request.sensors.empty() ? size.sensors : request.sensors;
}

std::uint64_t run_seed(std::uint64_t campaign_seed, const std::string& scene, const std::string& sensor,
                       std::uint32_t draw) {
  return fingerprint(fmt::format("{}/{}/{}/{}", campaign_seed, scene, sensor, draw)) % 1000000000U;
}

std::vector<Run> make_plan(const PlanRequest& request) {
  return request.motion ? plan_of_classes(request) : plan_of_scenes(request);
}

std::uint32_t frames_of(const Run& run) {
  return run.drive_in_frames + run.frames;
}

std::size_t frames_of(const std::vector<Run>& runs) {
  std::size_t frames = 0;
  for (const Run& run : runs) frames += frames_of(run);
  return frames;
}

}  // namespace pose_wall::tools::campaign
