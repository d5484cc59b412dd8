// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Drives an OS1-64 along a scene and gives its frames to the planar library: scan, match (SLAM), map, stop, each with
// its defaults. Before and after each part it calls getppid(), for count_plugin to write what it has counted. Prints a
// line per frame: points, beams with a range, state of SLAM, and the processor time of the engine and the four parts in
// microseconds. A table of the times follows on stderr: there they mean something where nothing emulates.
//
//   pose_wall_marked_planar [SCENE [FRAMES]]

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "cpu_time.hpp"
#include "lab/sim/run_files.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/simulator.hpp"
#include "pose_wall.h"
#include "pose_wall_planar.h"

namespace pose_wall::bench {
namespace {

constexpr double kSpeed_m_s = 0.7;  // of a roadheader that moves to another place
constexpr std::uint64_t kSeed = 1;  // as in bench/README.md
constexpr const char* kNames[] = {"engine", "scan", "match", "map", "stop"};
constexpr std::size_t kParts = std::size(kNames);

void must(std::int32_t status, const char* what) {
  if (status != POSE_WALL_OK) throw std::runtime_error(std::string(what) + ": " + pose_wall_planar_status_text(status));
}

class Blocks {
 public:
  void* take(std::uint64_t bytes) {
    blocks_.emplace_back(std::aligned_alloc(
        POSE_WALL_BLOCK_ALIGNMENT,
        (bytes + POSE_WALL_BLOCK_ALIGNMENT - 1) / POSE_WALL_BLOCK_ALIGNMENT * POSE_WALL_BLOCK_ALIGNMENT));
    if (blocks_.back() == nullptr) throw std::bad_alloc();
    return blocks_.back().get();
  }

 private:
  struct Free {
    void operator()(void* block) const { std::free(block); }
  };
  std::vector<std::unique_ptr<void, Free>> blocks_;
};

struct Chain {
  explicit Chain(const pose_wall_config& config) {
    std::uint64_t bytes = 0;
    must(pose_wall_memory_needed(&config, &bytes), "engine");
    must(pose_wall_open(&config, blocks.take(bytes), bytes, &engine), "engine");
    pose_wall_planar_scanner_settings scanning;
    must(pose_wall_planar_scanner_settings_init(&scanning), "scan");
    must(pose_wall_planar_scanner_memory_needed(&scanning, &bytes), "scan");
    must(pose_wall_planar_scanner_open(&config, &scanning, blocks.take(bytes), bytes, &scanner), "scan");
    must(pose_wall_planar_slam_memory_needed(nullptr, &bytes), "match");
    must(pose_wall_planar_slam_open(nullptr, blocks.take(bytes), bytes, &slam), "match");
    must(pose_wall_planar_map_memory_needed(nullptr, &bytes), "map");
    must(pose_wall_planar_map_open(nullptr, blocks.take(bytes), bytes, &map), "map");
    must(pose_wall_planar_stop_memory_needed(&bytes), "stop");
    must(pose_wall_planar_stop_open(&config, nullptr, blocks.take(bytes), bytes, &stop), "stop");
    motion.struct_size = sizeof motion;
    motion.given = POSE_WALL_PLANAR_STOP_MEASURED;
    motion.speed_m_s = kSpeed_m_s;
  }

  Blocks blocks;
  pose_wall_engine* engine = nullptr;
  pose_wall_planar_scanner* scanner = nullptr;
  pose_wall_planar_slam* slam = nullptr;
  pose_wall_planar_map* map = nullptr;
  pose_wall_planar_stop* stop = nullptr;
  pose_wall_planar_stop_motion motion{};
};

// Marks the place for the plugin, and takes the time.
std::int64_t mark() {
  static_cast<void>(getppid());
  return cpu_time_ns();
}

using Times = std::vector<double>;  // microseconds, of each part

// One frame, part by part.
void process(const Chain& chain, const pose_wall_cloud& cloud, const pose_wall_planar_pose& odometry, Times* times) {
  pose_wall_result engine{};
  engine.struct_size = sizeof engine;
  std::int64_t at_ns = mark();
  const auto end_part = [&] {
    const std::int64_t now_ns = mark();
    times->push_back(static_cast<double>(now_ns - at_ns) * 1e-3);
    at_ns = now_ns;
  };
  must(pose_wall_process(chain.engine, &cloud, &engine), "engine");
  pose_wall_planar_floor floor{};
  floor.struct_size = sizeof floor;
  must(pose_wall_planar_floor_of(&engine, &floor), "floor");
  end_part();
  pose_wall_planar_scan scan{};
  scan.struct_size = sizeof scan;
  must(pose_wall_planar_scanner_process(chain.scanner, &cloud, &floor, &scan, nullptr), "scan");
  end_part();
  pose_wall_planar_slam_result where{};
  where.struct_size = sizeof where;
  must(pose_wall_planar_slam_process(chain.slam, &scan, &odometry, &where), "match");
  end_part();
  pose_wall_planar_map_report report{};
  report.struct_size = sizeof report;
  must(pose_wall_planar_map_insert(chain.map, &scan, &where.pose, &report), "map");
  end_part();
  pose_wall_planar_stop_result verdict{};
  verdict.struct_size = sizeof verdict;
  must(pose_wall_planar_stop_process(chain.stop, &cloud, &chain.motion, cloud.stamp_ns, &verdict), "stop");
  end_part();
  const auto with_range =
      std::count_if(scan.range_m, scan.range_m + scan.beams, [](float r) { return std::isfinite(r); });
  std::printf("%u %u %u", cloud.width, static_cast<unsigned>(with_range), where.state);
  for (std::size_t k = times->size() - kParts; k < times->size(); ++k) std::printf(" %.0f", (*times)[k]);
  std::printf("\n");
}

void show(const Times& times) {
  std::fprintf(stderr, "part      mean ms  worst ms\n");
  for (std::size_t part = 0; part < kParts; ++part) {
    double sum = 0.0, worst = 0.0;
    for (std::size_t k = part; k < times.size(); k += kParts) {
      sum += times[k];
      worst = std::max(worst, times[k]);
    }
    std::fprintf(stderr, "%-8s %8.2f %9.2f\n", kNames[part], 1e-3 * sum * kParts / static_cast<double>(times.size()),
                 1e-3 * worst);
  }
}

int run(const std::string& scene, std::uint32_t count) {
  tools::sim::Setup setup = tools::sim::make_setup(scene, "os1-64", false, kSeed);
  setup.machine.speed_mps = kSpeed_m_s;
  const tools::sim::Simulator simulator(setup, kSeed);
  pose_wall_config config;
  must(pose_wall_config_init(&config), "config");
  for (const tools::EngineSetting& s : tools::sim::engine_setting_list(setup)) {
    must(pose_wall_config_set(&config, s.key.c_str(), s.value.c_str()), s.key.c_str());
  }
  const Chain chain(config);
  Times times;
  for (std::uint32_t i = 0; i < count; ++i) {
    const tools::sim::Frame frame = simulator.render(i);
    pose_wall_cloud cloud;
    must(pose_wall_cloud_xyz32(&cloud, frame.xyz_intensity.data(), static_cast<std::uint32_t>(frame.count()),
                               4 * sizeof(float), frame.stamp_ns),
         "cloud");
    const pose_wall_planar_pose odometry{kSpeed_m_s * 1e-9 * static_cast<double>(frame.stamp_ns), 0.0, 0.0};
    process(chain, cloud, odometry, &times);
  }
  show(times);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace pose_wall::bench

int main(int argc, char** argv) {
  try {
    const unsigned long frames = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 20;
    return pose_wall::bench::run(argc > 1 ? argv[1] : "rough", static_cast<std::uint32_t>(frames));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "pose_wall_marked_planar: %s\n", e.what());
    return EXIT_FAILURE;
  }
}
