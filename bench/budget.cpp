// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall_budget: does a frame fit into 10 or 20 Hz on this controller? One static program, to be copied there and
// run. It links nothing but the engine and the simulator, so it writes with printf.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "bench_frames.hpp"
#include "io/frames/text_cursor.hpp"
#include "io/terminal/did_you_mean.hpp"
#include "lab/sim/sensors.hpp"
#include "quantiles.hpp"

namespace pose_wall::bench {
namespace {

constexpr int kUsage = 2;
constexpr std::uint32_t kFramesMax = 100000;
constexpr std::uint32_t kDifferentFrames = 10;
constexpr std::int64_t kPeriod_ns = 100'000'000;
// Other work comes in bursts: a frame that takes more than this of its period will be late some day.
constexpr double kSafeShare = 0.7;

struct Request {
  std::uint32_t frames = 100;
  std::vector<std::string> sensors;
};

struct Times {
  std::uint32_t points = 0, voxels = 0;
  double median_ms = 0.0, p99_ms = 0.0, worst_ms = 0.0;
};

constexpr const char* kHelp =
    "usage: pose_wall_budget [--frames N] [SENSOR ...]\n\n"
    "Does a frame fit into 10 or 20 Hz on this controller? Simulates a rough heading for each sensor, runs the engine\n"
    "on it, and prints the times of a frame and a verdict. They are wall time of one thread, with whatever else the\n"
    "controller does meanwhile: run it beside the controller's usual load.\n\n"
    "  SENSOR      %s; all of them by default\n"
    "  --frames N  frames of each, 1 to %u, 100 by default\n"
    "  --help      this text\n\n"
    "Exit status 0: the worst frame of each is done within 10 Hz (fits or tight), 1: some are not, or the engine "
    "refused\n"
    "its config or a frame, 2: bad usage.\n";

std::vector<std::string> sensor_names() {
  std::vector<std::string> names;
  for (const tools::sim::SensorModel& model : tools::sim::sensor_models()) names.push_back(model.sensor.name);
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

int complain(const std::string& what) {
  std::fprintf(stderr, "pose_wall_budget: %s\n--help explains\n", what.c_str());
  return kUsage;
}

bool measure(const std::string& sensor, std::uint32_t frame_count, Times* out) {
  using Clock = std::chrono::steady_clock;
  api::Engine engine;
  if (engine.open(config(sensor)) != POSE_WALL_OK) return false;
  const std::vector<tools::sim::Frame>& input = frames(sensor, kDifferentFrames);
  pose_wall_result result = api::make_result();
  std::vector<double> times_ms;
  for (std::uint32_t k = 0; k < frame_count + kDifferentFrames; ++k) {
    const pose_wall_cloud cloud = cloud_of(input[k % kDifferentFrames], (k + 1) * kPeriod_ns);
    const Clock::time_point before = Clock::now();
    if (engine.process(cloud, result) != POSE_WALL_OK) return false;
    const std::chrono::duration<double, std::milli> took = Clock::now() - before;
    if (k >= kDifferentFrames) times_ms.push_back(took.count());  // the first ones fill the caches
  }
  *out = {result.points_in, result.voxels, median(times_ms), at_share(times_ms, 0.99), at_share(times_ms, 1.0)};
  return true;
}

std::string verdict(double worst_ms, double hz) {
  const double share = worst_ms * hz / 1000.0;
  char text[64];
  std::snprintf(text, sizeof text, "%s, %.0f %% of it",
                share <= kSafeShare ? "fits"
                : share <= 1.0      ? "tight"
                                    : "too slow",
                100.0 * share);
  return text;
}

int run(const Request& request) {
  std::printf("%-9s %7s %7s %10s %10s %10s   %-20s %-20s\n", "sensor", "points", "voxels", "median", "99 %", "worst",
              "10 Hz", "20 Hz");
  bool all_fit = true;
  for (const std::string& sensor : request.sensors) {
    Times t;
    if (!measure(sensor, request.frames, &t)) {
      std::fprintf(stderr, "pose_wall_budget: the engine refused its config or a frame of %s\n", sensor.c_str());
      return EXIT_FAILURE;
    }
    std::printf("%-9s %7u %7u %7.1f ms %7.1f ms %7.1f ms   %-20s %-20s\n", sensor.c_str(), t.points, t.voxels,
                t.median_ms, t.p99_ms, t.worst_ms, verdict(t.worst_ms, 10.0).c_str(),
                verdict(t.worst_ms, 20.0).c_str());
    std::fflush(stdout);
    all_fit = all_fit && t.worst_ms <= 100.0;
  }
  std::printf("worst of %u frames each; fits: within %.0f %% of the period\n", request.frames, 100.0 * kSafeShare);
  return all_fit ? EXIT_SUCCESS : EXIT_FAILURE;
}

int main_of(const std::vector<std::string>& words) {
  Request request;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--help" || words[i] == "-h") {
      std::printf(kHelp, listed(sensor_names()).c_str(), kFramesMax);
      return EXIT_SUCCESS;
    }
    if (words[i] == "--frames") {
      const std::string value = ++i < words.size() ? words[i] : "";
      const auto number = tools::parse_number<std::uint32_t>(value);
      if (!number || *number < 1 || *number > kFramesMax) {
        return complain("--frames: a whole number from 1 to " + std::to_string(kFramesMax) + ", not '" + value + "'");
      }
      request.frames = *number;
    } else if (tools::sim::find_sensor(words[i]) != nullptr) {
      request.sensors.push_back(words[i]);
    } else if (words[i][0] == '-') {
      return complain("no option '" + words[i] + "'" + tools::did_you_mean(words[i], {"--frames", "--help"}));
    } else {
      return complain("no sensor '" + words[i] + "'" + tools::did_you_mean(words[i], sensor_names()) +
                      " (sensors: " + listed(sensor_names()) + ")");
    }
  }
  if (request.sensors.empty()) request.sensors = sensor_names();
  try {
    return run(request);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "pose_wall_budget: %s\n", e.what());
    return EXIT_FAILURE;
  }
}

}  // namespace
}  // namespace pose_wall::bench

int main(int argc, char** argv) {
  return pose_wall::bench::main_of({argv + 1, argv + argc});
}
