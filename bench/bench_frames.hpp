// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The data of all benchmarks: a rough heading, simulated, the machine creeping in it. The same frames on every machine
// with the same maths library.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lab/sim/simulator.hpp"
#include "pose_wall.hpp"

namespace pose_wall::bench {

// The scene with its own sizes, the machine level: what all but the contest with PCL is of. From 1 on: roads drawn
// within the scene's ranges, their sizes, rock and floor, and the machine's place, lean and motion.
constexpr std::uint32_t kAsItStands = 0;

struct Recording {
  std::vector<tools::sim::Frame> frames;
  std::vector<tools::TruthRow> truths;  // of the same frames
};
Recording record(const std::string& sensor, std::uint32_t count, std::uint32_t road);

// Of the scene as it stands: made once per sensor and count, and kept.
const std::vector<tools::sim::Frame>& frames(const std::string& sensor, std::uint32_t count);
// The same frame with about so many points: every n-th of it, or it several times over, each time shifted a little.
tools::sim::Frame resampled(const tools::sim::Frame& frame, std::uint32_t points);
// What fills every table: points spread evenly over a box of 40 x 40 x 5 m around the sensor, hardly two in a voxel.
tools::sim::Frame spread(std::uint32_t points);
// The engine's settings for these frames: defaults, a box around the machine's body, the sensor's own settings.
api::Config config(const std::string& sensor, std::uint32_t road = kAsItStands);

pose_wall_cloud cloud_of(const tools::sim::Frame& frame, std::int64_t stamp_ns);

}  // namespace pose_wall::bench
