// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Runs frames through the engine and calls getppid() at every boundary of a stage, for count_plugin to write what it
// has counted. Before each frame the floor: one pass that no engine can do without. Prints a line per frame; the last
// number is the engine's own count of its steps.
//
//   pose_wall_marked_frames [SENSOR [FRAMES [POINTS]]]   POINTS: frames are resampled to so many
//   pose_wall_marked_frames spread FRAMES POINTS         points that fill every table
//   pose_wall_marked_frames dear:KIND FRAMES POINTS      a cloud that costs much, see tests/support/dear_clouds.hpp

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "bench_frames.hpp"
#include "least_pass.hpp"
#include "support/dear_clouds.hpp"

namespace pose_wall::bench {
namespace {

constexpr std::int64_t kPeriod_ns = 100'000'000;

std::int64_t mark(void* /*user*/) {
  static std::int64_t marks = 0;
  static_cast<void>(getppid());
  return ++marks;
}

constexpr const char* kDense = "os0-128";  // whose settings what is no sensor's has

std::vector<tools::sim::Frame> input(const std::string& name, std::uint32_t count, std::uint32_t points) {
  if (name == "spread") return std::vector<tools::sim::Frame>(count, spread(points));
  std::vector<tools::sim::Frame> out = frames(name, count);
  for (tools::sim::Frame& frame : out) {
    if (points > 0) frame = resampled(frame, points);
  }
  return out;
}

void print(const pose_wall_result& result, std::uint32_t least_cells) {
  int measured = 0;
  for (const pose_wall_value& value : result.quantity) measured += value.state >= POSE_WALL_DEGRADED ? 1 : 0;
  std::printf("%u %u %u %d %llu\n", result.points_in, least_cells, result.voxels, measured,
              static_cast<unsigned long long>(result.work));
}

// With the settings that nobody has changed, and without a least pass.
int run_dear(const std::string& kind, std::uint32_t count, std::uint32_t points) {
  static test::DearCloud cloud;
  api::Engine engine;
  if (engine.open(api::Config()) != POSE_WALL_OK || !test::fill_dear(kind, points, &cloud)) {
    std::fprintf(stderr, "no cloud is called %s\n", kind.c_str());
    return EXIT_FAILURE;
  }
  engine.set_clock(mark);
  pose_wall_result result = api::make_result();
  for (std::uint32_t frame = 0; frame < count; ++frame) {
    if (frame > 0) cloud.nudge();
    mark(nullptr);
    if (engine.process(cloud.at(1 + kPeriod_ns * frame), result) != POSE_WALL_OK) return EXIT_FAILURE;
    print(result, 0);
  }
  return EXIT_SUCCESS;
}

int run(const std::string& sensor, std::uint32_t count, std::uint32_t points) {
  api::Engine engine;
  if (engine.open(config(sensor == "spread" ? kDense : sensor)) != POSE_WALL_OK) {
    std::fprintf(stderr, "the engine refused the config for %s\n", sensor.c_str());
    return EXIT_FAILURE;
  }
  engine.set_clock(mark);
  LeastPass least;
  pose_wall_result result = api::make_result();
  std::int64_t stamp_ns = 0;
  for (const tools::sim::Frame& frame : input(sensor, count, points)) {
    const pose_wall_cloud cloud = cloud_of(frame, stamp_ns += kPeriod_ns);
    mark(nullptr);
    const std::uint32_t cells = least.run(frame);
    if (engine.process(cloud, result) != POSE_WALL_OK) {
      std::fprintf(stderr, "the engine refused a frame of %s\n", sensor.c_str());
      return EXIT_FAILURE;
    }
    print(result, cells);
  }
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace pose_wall::bench

int main(int argc, char** argv) {
  const std::string sensor = argc > 1 ? argv[1] : "os1-64";
  const auto number = [&](int i, std::uint32_t otherwise) {
    return argc > i ? static_cast<std::uint32_t>(std::strtoul(argv[i], nullptr, 10)) : otherwise;
  };
  if (sensor.rfind("dear:", 0) == 0)
    return pose_wall::bench::run_dear(sensor.substr(5), number(2, 3), number(3, 65536));
  return pose_wall::bench::run(sensor, number(2, 3), number(3, 0));
}
