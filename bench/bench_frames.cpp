// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "bench_frames.hpp"

#include <map>
#include <random>
#include <stdexcept>
#include <utility>

#include "lab/sim/run_files.hpp"
#include "lab/sim/scenes.hpp"

namespace pose_wall::bench {
namespace {

constexpr std::uint64_t kSeedAsItStands = 1;

std::uint64_t seed_of(std::uint32_t road) {
  return road == kAsItStands ? kSeedAsItStands : road;
}

tools::sim::Setup setup(const std::string& sensor, std::uint32_t road) {
  return tools::sim::make_setup("nominal", sensor, road != kAsItStands, seed_of(road));
}

const Recording& kept_recording(const std::string& sensor, std::uint32_t count) {
  static std::map<std::pair<std::string, std::uint32_t>, Recording> kept;
  Recording& made = kept[{sensor, count}];
  if (made.frames.empty()) made = record(sensor, count, kAsItStands);
  return made;
}

}  // namespace

Recording record(const std::string& sensor, std::uint32_t count, std::uint32_t road) {
  Recording made;
  const tools::sim::Simulator simulator(setup(sensor, road), seed_of(road));
  for (std::uint32_t i = 0; i < count; ++i) {
    made.frames.push_back(simulator.render(i));
    made.truths.push_back(simulator.truth(i));
  }
  return made;
}

const std::vector<tools::sim::Frame>& frames(const std::string& sensor, std::uint32_t count) {
  return kept_recording(sensor, count).frames;
}

tools::sim::Frame resampled(const tools::sim::Frame& frame, std::uint32_t points) {
  constexpr float kShift_m = 0.017F;  // a third of a voxel
  tools::sim::Frame out;
  out.stamp_ns = frame.stamp_ns;
  const double step = static_cast<double>(frame.count()) / points;
  for (std::uint32_t i = 0; i < points; ++i) {
    const auto place = static_cast<std::size_t>(i * (step < 1.0 ? 1.0 : step));
    const std::size_t from = place % frame.count(), copy = place / frame.count();
    const float* const p = &frame.xyz_intensity[4 * from];
    const float shift_m = kShift_m * static_cast<float>(copy);
    out.xyz_intensity.insert(out.xyz_intensity.end(), {p[0] + shift_m, p[1] + shift_m, p[2] + shift_m, p[3]});
    out.labels.push_back(frame.labels[from]);
  }
  return out;
}

tools::sim::Frame spread(std::uint32_t points) {
  constexpr float kSides_m[3] = {40.0F, 40.0F, 5.0F};
  tools::sim::Frame out;
  std::mt19937 random(1);  // the same numbers everywhere
  for (std::uint32_t i = 0; i < points; ++i) {
    for (const float side_m : kSides_m) {
      out.xyz_intensity.push_back(side_m * (static_cast<float>(random() >> 8U) / static_cast<float>(1U << 24U) - 0.5F));
    }
    out.xyz_intensity.push_back(1.0F);
    out.labels.emplace_back();
  }
  return out;
}

api::Config config(const std::string& sensor, std::uint32_t road) {
  api::Config config;
  for (const tools::EngineSetting& s : tools::sim::engine_setting_list(setup(sensor, road))) {
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
