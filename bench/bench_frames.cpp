// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "bench_frames.hpp"

#include <map>
#include <stdexcept>
#include <utility>

#include "demo/demo_setup.hpp"

namespace pose_wall::bench {
namespace {

constexpr std::uint64_t kSeed = 1;

tools::DemoOptions options(const std::string& sensor) {
  tools::DemoOptions demo;
  demo.sensor = sensor;
  demo.seed = kSeed;
  // Sparse clouds need looser gates.
  if (sensor == "vlp16" || sensor == "mid360") {
    demo.settings = {"ground_inlier_min=120", "wall_inlier_min=120", "outlier_radius=0.4"};
  }
  // This one looks up; hung upside down it sees the floor.
  if (sensor == "mid360") demo.simulation = {"mount_roll_deg=180"};
  return demo;
}

struct Recording {
  std::vector<tools::sim::Frame> frames;
  std::vector<tools::TruthRow> truths;
};

const Recording& recording(const std::string& sensor, std::uint32_t count) {
  static std::map<std::pair<std::string, std::uint32_t>, Recording> kept;
  Recording& made = kept[{sensor, count}];
  if (!made.frames.empty()) return made;
  const tools::sim::Simulator simulator(tools::demo_setup(options(sensor)), kSeed);
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
  const tools::DemoOptions demo = options(sensor);
  return tools::demo_config(demo, tools::demo_setup(demo));
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
