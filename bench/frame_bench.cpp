// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A whole frame through the C ABI, as a controller calls it: simulated sensors, points that fill every table, and,
// where POSE_WALL_DATA names their folder, recorded frames.

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frame_input.hpp"
#include "frame_run.hpp"
#if POSE_WALL_BENCH_RECORDED
#include "recorded_frames.hpp"
#endif

namespace pose_wall::bench {
namespace {

// Made when its turn comes, so that a filter saves the work, and kept for the framework's further rounds.
void add(const std::string& name, std::function<FrameInput()> make) {
  const auto kept = std::make_shared<std::optional<FrameInput>>();
  const auto run = [kept, make = std::move(make)](benchmark::State& state) {
    try {
      if (!kept->has_value()) kept->emplace(make());
    } catch (const std::exception& e) {
      return state.SkipWithError(e.what());
    }
    run_frames(state, **kept);
  };
  benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond);
}

void add_simulated() {
  for (const char* sensor : {"vlp16", "mid360", "os1-64", "os0-128"}) {
    add(std::string("frame/") + sensor, [sensor] { return simulated_input(sensor); });
  }
  for (const std::uint32_t points : {28'800U, 65'000U, 131'000U}) {
    add("spread/" + std::to_string(points), [points] { return spread_input(points); });
  }
}

void add_recorded() {
#if POSE_WALL_BENCH_RECORDED
  const char* const folder = std::getenv("POSE_WALL_DATA");
  if (folder == nullptr) {
    std::cerr << "no recorded frames: POSE_WALL_DATA is not set\n";
    return;
  }
  const std::filesystem::path data(folder);
  if (!std::filesystem::is_directory(data)) {
    std::cerr << "no recorded frames: POSE_WALL_DATA: " << data << " is no folder\n";
    return;
  }
  for (const Recording& recording : recordings()) {
    if (!std::filesystem::exists(data / recording.path)) {
      std::cerr << "left out: there is no " << (data / recording.path) << '\n';
      continue;
    }
    add("recorded/" + recording.name, [data, recording] { return recorded_input(data, recording); });
  }
#else
  std::cerr << "no recorded frames: built without the frame readers (POSE_WALL_BUILD_TOOLS)\n";
#endif
}

int run(int argc, char** argv) {
  // So many counters can only be read as a table. What the caller says comes later and wins.
  std::string tabular = "--benchmark_counters_tabular=true";
  std::vector<char*> words = {argv[0], tabular.data()};
  words.insert(words.end(), argv + 1, argv + argc);
  int count = static_cast<int>(words.size());
  words.push_back(nullptr);
  benchmark::Initialize(&count, words.data());
  if (benchmark::ReportUnrecognizedArguments(count, words.data())) return EXIT_FAILURE;
  add_simulated();
  add_recorded();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace pose_wall::bench

int main(int argc, char** argv) {
  return pose_wall::bench::run(argc, argv);
}
