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

#include "io/frames/text_cursor.hpp"
#include "io/terminal/did_you_mean.hpp"
#include "lab/sim/sensors.hpp"
#include "peer_contest.hpp"
#include "peer_table.hpp"

namespace pose_wall::bench {
namespace {

constexpr int kUsage = 2;
constexpr std::uint32_t kCountMax = 10000;
constexpr float kRadiusMax_m = 100.0F;

constexpr const char* kHelp =
    "usage: pose_wall_peer_pcl [--roads N] [--frames N] [--pcl-ground-radius M] [SENSOR ...]\n\n"
    "Runs pose_wall, the same pipeline from PCL's parts (SACSegmentation by RANSAC and by MLESAC) and the least pass\n"
    "(read, turn, range test, one hash insertion a point) on the same simulated frames, turn by turn, one thread "
    "each,\n"
    "and prints a table of times, stage by stage, and one of errors against the simulator's truth.\n\n"
    "  SENSOR      {}; all of them by default\n"
    "  --roads N   so many roads of scene nominal, drawn within its ranges; 1 to 10000, 10 by default\n"
    "  --frames N  frames of each; 1 to 10000, 3 by default\n"
    "  --pcl-ground-radius M\n"
    "              of PCL's floor, 1 to 100 m; the best of 3 to 15 for each sensor and method by default\n"
    "  --help      this text\n\n"
    "Times are processor time. pose_wall's also buy gates, protection levels and smoothing, which PCL's do not.\n"
    "Exit status 0: done, 1: the engine refused, 2: bad usage.\n";

struct Request {
  ContestPlan plan;
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
      const Contest contest = hold_contest(sensor, request.plan);
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
    const std::string& word = words[i];
    if (word == "--help" || word == "-h") {
      fmt::print(kHelp, fmt::join(sensor_names(), ", "));
      return EXIT_SUCCESS;
    }
    const std::string value = i + 1 < words.size() ? words[i + 1] : "";
    if (word == "--frames" || word == "--roads") {
      const auto number = tools::parse_number<std::uint32_t>(value);
      if (!number || *number < 1 || *number > kCountMax) {
        return complain(fmt::format("{}: a whole number from 1 to {}, not '{}'", word, kCountMax, value));
      }
      (word == "--frames" ? request.plan.frames : request.plan.roads) = *number;
      ++i;
    } else if (word == "--pcl-ground-radius") {
      const auto radius_m = tools::parse_number<float>(value);
      if (!radius_m || !(*radius_m >= 1.0F && *radius_m <= kRadiusMax_m)) {
        return complain(fmt::format("{}: 1 to {} m, not '{}'", word, kRadiusMax_m, value));
      }
      request.plan.pcl_ground_radius_m = *radius_m;
      ++i;
    } else if (tools::sim::find_sensor(word) != nullptr) {
      request.sensors.push_back(word);
    } else if (!word.empty() && word[0] == '-') {
      return complain(fmt::format("no option '{}'{}", word,
                                  tools::did_you_mean(word, {"--roads", "--frames", "--pcl-ground-radius", "--help"})));
    } else {
      return complain(fmt::format("no sensor '{}'{} (sensors: {})", word, tools::did_you_mean(word, sensor_names()),
                                  fmt::join(sensor_names(), ", ")));
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
