// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "bench_frames.hpp"

#include <map>
#include <stdexcept>
#include <utility>

#include "sim/run_files.hpp"
#include "sim/scenes.hpp"

namespace pose_wall::bench {
namespace {

constexpr std::uint64_t kSeed = 1;

tools::sim::Setup setup(const std::string& sensor) {
  return tools::sim::make_setup("nominal", sensor, false, kSeed);
}

struct Recording {
  std::vector<tools::sim::Frame> frames;
  std::vector<tools::TruthRow> truths;
};

const Recording& recording(const std::string& sensor, std::uint32_t count) {
  static std::map<std::pair<std::string, std::uint32_t>, Recording> kept;
  Recording& made = kept[{sensor, count}];
  if (!made.frames.empty()) return made;
  const tools::sim::Simulator simulator(setup(sensor), kSeed);
  for (std::uint32_t i = 0; i < count; ++i) {
    made.frames.push_back(simulator.render(i));
    made.truths.push_back(simulator.truth(i));
  }
  return made;
}

}  // namespace

const std::vector<tools::sim::Frame>& frames(const std::string& sensor, std::uint32_t count) {
  return recording(sensor, count).frames;
}

const std::vector<tools::TruthRow>& truths(const std::string& sensor, std::uint32_t count) {
  return recording(sensor, count).truths;
}

api::Config config(const std::string& sensor) {
  api::Config config;
  for (const tools::sim::EngineSetting& s : tools::sim::engine_setting_list(setup(sensor))) {
    if (config.set(s.key.c_str(), s.value.c_str()) != POSE_WALL_OK) {
      throw std::runtime_error("the config refused " + s.key + "=" + s.value);
    }
  }
  return config;
}

pose_wall_cloud cloud_of(const tools::sim::Frame& frame, std::int64_t stamp_ns) {
  pose_wall_cloud cloud{};
  constexpr std::uint32_t kPointStep = 4 * sizeof(float);
  if (pose_wall_cloud_xyz32(&cloud, frame.xyz_intensity.data(), static_cast<std::uint32_t>(frame.count()), kPointStep,
                            stamp_ns) != POSE_WALL_OK) {
    throw std::runtime_error("the simulator's frame was refused");
  }
  return cloud;
}

}  // namespace pose_wall::bench
