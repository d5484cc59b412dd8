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
constexpr long kCountMax = 10000;
constexpr double kRadiusMax_m = 100.0;

constexpr const char* kHelp =
    "usage: pose_wall_peer_pcl [--roads N] [--frames N] [--pcl-ground-radius M] [SENSOR ...]\n\n"
    "Runs pose_wall, the same pipeline from PCL's parts (SACSegmentation by RANSAC and by MLESAC) and the floor pass\n"
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

bool read_count(const std::string& word, std::uint32_t* count) {
  char* end = nullptr;
  const long number = std::strtol(word.c_str(), &end, 10);
  if (end == word.c_str() || *end != '\0' || number < 1 || number > kCountMax) return false;
  *count = static_cast<std::uint32_t>(number);
  return true;
}

bool read_radius(const std::string& word, float* radius_m) {
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  *radius_m = static_cast<float>(number);
  return end != word.c_str() && *end == '\0' && number >= 1.0 && number <= kRadiusMax_m;
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
      if (!read_count(value, word == "--frames" ? &request.plan.frames : &request.plan.roads)) {
        return complain(fmt::format("{}: a whole number from 1 to {}, not '{}'", word, kCountMax, value));
      }
      ++i;
    } else if (word == "--pcl-ground-radius") {
      if (!read_radius(value, &request.plan.pcl_ground_radius_m)) {
        return complain(fmt::format("{}: 1 to {} m, not '{}'", word, kRadiusMax_m, value));
      }
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
