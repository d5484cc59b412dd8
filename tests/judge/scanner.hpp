// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Sensors by their data sheets: which way each ray goes, and what range comes back.

#pragma once

#include <array>
#include <string>
#include <vector>

#include "judge/machine.hpp"

namespace pose_wall::judge {

enum class Pattern {
  kRings,    // even steps around, one ring per elevation
  kRosette,  // a petal curve that never repeats
  kRandom    // azimuth and elevation drawn anew for each ray
};

struct Sensor {
  const char* name;
  const char* config;  // file in the folder of config files
  Pattern pattern;
  int rings;
  int rays;  // of a frame
  double down_deg, up_deg;
  double noise_m;    // one sigma
  double quantum_m;  // least step of a range
  double dropouts;   // share of rays without a return
  Hung hung;         // Mid-360 class: which way it looks best
};
constexpr int kSensors = 8;
constexpr int kRandomDown = 6;  // Mid-360's field and number of rays, upside down, every direction drawn at random
extern const std::array<Sensor, kSensors> kSensorTable;

class Scanner {
 public:
  // Draws the constant error of this specimen's ranges.
  Scanner(const Sensor& sensor, bool no_bias, Draw* draw);

  // x, y, z of each return in the sensor's frame. Lost rays are left out, zero or not a number, by the specimen.
  std::vector<float> scan(const Road& road, const Machine& machine, const Pose& pose, int frame, Draw* draw) const;

 private:
  Vector3d direction(int ray, int frame, Draw* draw) const;

  Sensor sensor_;
  double bias_m_, phase_rad_;
  int lost_as_;
};

}  // namespace pose_wall::judge
