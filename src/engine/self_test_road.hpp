// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The road of the self test: what a sensor of 32 lines sees between four planes. Its points are the same bits on every
// machine, for they come from whole numbers and + - * / of doubles alone, which IEEE 754 rounds in one way.

#pragma once

#include <cstdint>

namespace pose_wall {

constexpr std::uint32_t kSelfTestLines = 32;                                   // of the sensor, over 45 degrees
constexpr std::uint32_t kSelfTestTurns = 600;                                  // rays of a line
constexpr std::uint32_t kSelfTestPointsMax = kSelfTestLines * kSelfTestTurns;  // every ray returns at most once

// The parts of the road that are present. The roof always is. Steel sets stand before the walls, 15 cm of every metre.
struct SelfTestScene {
  bool floor, left, right, steel;
};

// Writes x y z in base, in metres, for each ray that meets something. Returns how many.
std::uint32_t scan_self_test_road(const SelfTestScene& scene, std::uint32_t frame, float (*points_base_m)[3]);

// How the machine stands in it, by the signs of pose_wall.h and in the order of pose_wall_quantity: rad and m.
extern const double kSelfTestTruth[7];  // NOLINT(bugprone-dynamic-static-initializers): it is constant

}  // namespace pose_wall
