// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall beside the same pipeline from PCL's parts: time stage by stage, and errors.

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "peer_contest.hpp"
#include "peer_table.hpp"
#include "sim/sensors.hpp"
#include "terminal/did_you_mean.hpp"

namespace pose_wall::bench {
namespace {

constexpr int kUsage = 2;
constexpr long kFramesMax = 10000;

constexpr const char* kHelp =
    "usage: pose_wall_peer_pcl [--frames N] [SENSOR ...]\n\n"
    "Runs pose_wall, the same pipeline from PCL's parts (SACSegmentation by RANSAC and by MLESAC) and the floor pass\n"
    "(read, turn, range test, one hash insertion a point) on the same simulated frames, turn by turn, one thread "
    "each,\n"
    "and prints a table of times, stage by stage, and one of errors against the simulator's truth.\n\n"
    "  SENSOR      {}; all of them by default\n"
    "  --frames N  frames of each, 30 by default\n"
    "  --help      this text\n\n"
    "Times are processor time. pose_wall's also buy gates, protection levels and smoothing, which PCL's do not.\n"
    "Exit status 0: done, 1: the engine refused, 2: bad usage.\n";

struct Request {
  std::uint32_t frames = 30;
  std::vector<std::string> sensors;
};

// As README's tables name them: from few points to many.
std::vector<std::string> sensor_names() {
  return {"vlp16", "mid360", "os1-64", "os0-128"};
}

int complain(const std::string& what) {
  fmt::print(stderr, "pose_wall_peer_pcl: {}\n--help explains\n", what);
  return kUsage;
}

int run(const Request& request) {
  for (const std::string& sensor : request.sensors) {
    try {
      const Contest contest = hold_contest(sensor, request.frames);
      print_stages(contest);
      print_accuracy(contest);
      std::fflush(stdout);
    } catch (const std::exception& e) {
      fmt::print(stderr, "pose_wall_peer_pcl: {}: {}\n", sensor, e.what());
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}

int main_of(const std::vector<std::string>& words) {
  Request request;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--help" || words[i] == "-h") {
      fmt::print(kHelp, fmt::join(sensor_names(), ", "));
      return EXIT_SUCCESS;
    }
    if (words[i] == "--frames") {
      const long frames = i + 1 < words.size() ? std::strtol(words[++i].c_str(), nullptr, 10) : 0;
      if (frames < 1 || frames > kFramesMax) return complain(fmt::format("--frames: 1 to {}", kFramesMax));
      request.frames = static_cast<std::uint32_t>(frames);
    } else if (tools::sim::find_sensor(words[i]) != nullptr) {
      request.sensors.push_back(words[i]);
    } else {
      return complain(fmt::format("no sensor '{}'{}; sensors: {}", words[i],
                                  tools::did_you_mean(words[i], sensor_names()), fmt::join(sensor_names(), ", ")));
    }
  }
  if (request.sensors.empty()) request.sensors = sensor_names();
  return run(request);
}

}  // namespace
}  // namespace pose_wall::bench

int main(int argc, char** argv) {
  return pose_wall::bench::main_of({argv + 1, argv + argc});
}
