// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Sensors by their data sheets: which way each ray goes, when, and what range comes back.

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "judge/beams.hpp"
#include "judge/drive.hpp"
#include "judge/machine.hpp"
#include "pose_wall.h"

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
  double noise_m;             // one sigma
  double quantum_m;           // least step of a range
  double dropouts;            // share of rays without a return
  Hung hung;                  // Mid-360 class: which way it looks best
  BeamTable beams = nullptr;  // of a real sensor; else rings are even and `rays` tells their columns
};
// Seeds draw from the first kSensors rows at one instant, from all that real sensors have when scans take their time.
constexpr int kSensors = 8, kAllSensors = 15;
constexpr int kRandomDown = 6;  // Mid-360's field and number of rays, upside down, every direction drawn at random
extern const std::array<Sensor, kAllSensors> kSensorTable;
inline const Sensor& sensor_at(int row) {
  return kSensorTable.at(static_cast<std::size_t>(row));
}
// Of that name, or -1.
int sensor_row(const std::string& name);
// A row whose scans take their time, each such row as often as another.
int draw_real_sensor(Draw* draw);
// Whether its clouds tell when each point was measured: not those of directions at random, which are at one instant.
bool tells_times(const Sensor& sensor);

struct Point {
  float x_m, y_m, z_m;
  std::uint32_t after_ns;  // since the stamp
  std::uint32_t ring;
};

struct Cloud {
  // By reference: it describes the points as long as they stay where they are.
  pose_wall_cloud described(std::int64_t stamp_ns) const;

  std::vector<Point> points;
  bool timed = false;  // else neither times nor rings are told
};

class Scanner {
 public:
  // Draws the constant error of this specimen's ranges.
  Scanner(const Sensor& sensor, bool no_bias, Draw* draw);

  // All rays at one instant, in the sensor's frame. Lost rays are left out, zero or not a number, by the specimen.
  Cloud scan(const Road& road, const Machine& machine, const Pose& pose, int frame, Draw* draw) const;
  // Each ray at its own time, while the machine moves.
  Cloud sweep(const Road& road, const Machine& machine, const Passage& passage, int frame, Draw* draw) const;
  // Light leaves the sensor's origin.
  void leave_out_offsets() { beams_ = without_offsets(beams_); }

 private:
  // A ray in the sensor's frame, and the share of the scan's time after which it is fired.
  struct Shot {
    Vector3d from_m, way;
    double share;
    int ring;
  };

  int shots() const;
  Shot shot(int k, int frame, Draw* draw) const;
  Shot shot_by_table(int k) const;
  Vector3d direction(int ray, int frame, Draw* draw) const;
  // The range that is told; negative where the ray is lost.
  double told_m(double exact_m, double before_m, Draw* draw) const;
  void add(Cloud* cloud, const Shot& shot, double told_m) const;

  Sensor sensor_;
  Beams beams_;
  double bias_m_, phase_rad_;
  int lost_as_;
};

}  // namespace pose_wall::judge
