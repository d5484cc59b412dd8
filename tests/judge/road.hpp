// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A road drawn at random from a seed: rock, what stands in it, water, dust, and its true planes.
// World frame: the machine stands near the origin, x runs along the road (ahead), y to its left, z roughly up.

#pragma once

#include <cstdint>
#include <vector>

#include "judge/surfaces.hpp"

namespace pose_wall::judge {

enum Feature : std::uint32_t {
  kRoughRock,  // uneven by more than a centimetre
  kArch,       // the roof bends down to the walls
  kSteelSets,
  kPipes,    // and cables
  kBelt,     // a conveyor along one wall
  kBox,      // beside the machine
  kVehicle,  // ahead or behind
  kPeople,
  kCrosscut,  // a gallery to one side
  kHeaps,     // of muck
  kBench,     // the floor is higher along one wall
  kRamp,      // floor and roof take another slope ahead of the machine
  kBend,      // the road turns ahead
  kPuddles,
  kDust,
  kBody,  // the machine is in its own view
  kFeatures
};
const char* feature_name(std::uint32_t feature);

// normal . p + offset = 0, with a unit normal into the road.
struct Plane {
  double distance_m(const Vector3d& p_m) const { return normal.dot(p_m) + offset_m; }

  Vector3d normal;
  double offset_m;
};

struct Puddle {
  Vector3d centre_m;
  double half_x_m, half_y_m;
  bool mirrors;  // else it returns nothing
};

struct Dust {
  double lost = 0.0, near = 0.0;  // shares of rays without a return, and with one from the air
  double depth_m = 1.0;           // mean range of the latter
};

struct Road {
  bool has(Feature feature) const { return (features >> feature & 1U) != 0; }

  std::uint64_t seed = 0;
  std::uint32_t features = 0;
  double width_m = 5.0, height_m = 3.0;
  double free_left_m = 2.5, free_right_m = 2.5;  // beside the machine, from the middle of the road
  double room_ahead_m = 30.0;                    // as far as that its floor and its walls are these planes
  Plane floor, left, right;
  std::vector<Panel> panels;  // panels[0] is the floor
  std::vector<Solid> solids;
  std::vector<Puddle> puddles;
  Dust dust;
};

// Every size and feature drawn. Quiet: no features, no unevenness of the rock, nothing that would make the directions
// of the two walls differ; floor and walls still tilt and lean. Rich: features twice as often and more, rock as rough
// as in a gallery that was blasted, and dust as thick as behind a cutting head.
enum class Furnishing { kDrawn, kQuiet, kRich };
Road draw_road(std::uint64_t seed, Furnishing furnishing = Furnishing::kDrawn);

// The range that a ray has, 0 for none. `body` moves with the machine and is in the frame of the ray, too.
double range_m(const Road& road, const std::vector<Solid>& body, const Ray& ray, Draw* draw);

}  // namespace pose_wall::judge
