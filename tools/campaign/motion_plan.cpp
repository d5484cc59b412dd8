// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "campaign/motion_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "terminal/did_you_mean.hpp"

namespace pose_wall::tools::campaign {
namespace {

struct MotionSize {
  std::uint32_t draws;
  std::uint32_t long_draws;  // of classes that go on for minutes
  double way_m;
  double seconds;
  std::uint32_t frames;
};

// By the names of the plan's sizes.
const MotionSize& motion_size_named(const std::string& name) {
  static const std::map<std::string, MotionSize> sizes = {
      {"small", {1, 1, 6.0, 6.0, 70}},
      {"medium", {4, 2, 30.0, 60.0, 120}},
      {"large", {20, 4, 50.0, 600.0, 240}},
  };
  return sizes.at(name);
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
std::uint32_t frames_of_run(const MotionClass& one, const MotionSize& size, const sim::Setup& setup) {
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

Run motion_run(const PlanRequest& request, const MotionSize& size, const MotionClass& one, const std::string& sensor,
               std::uint32_t draw) {
  const std::uint64_t seed = run_seed(request.seed, std::string("motion ") + one.name, sensor, draw);
  const sim::Setup setup = make_motion_setup(one, sensor, seed);
  return {one.name, sensor, draw, seed, request.frames.value_or(frames_of_run(one, size, setup))};
}

}  // namespace

std::vector<Run> make_motion_plan(const PlanRequest& request) {
  const std::vector<std::string>& sensors = sensors_of(request);  // refuses sizes that do not exist
  const MotionSize& size = motion_size_named(request.size);
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

}  // namespace pose_wall::tools::campaign
