// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// One frame's beams: what each meets, and what the sensor makes of it.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/sim/pose.hpp"
#include "lab/sim/random.hpp"
#include "lab/sim/sensors.hpp"
#include "lab/sim/world.hpp"

namespace pose_wall::tools::sim {

struct Return {
  double range_m = kNever;
  double cosine = 1.0;
  double brightness = 1.0;  // of the rock there, relative
  Label label = Label::kNone;
  int side = 0;
};

// How much of the light that a return needs comes back, 0 to 255, as a sensor tells it.
float intensity(const Return& r);

class BeamCaster {
 public:
  BeamCaster(const Setup& setup, const World& world, const Moment& moment, std::uint64_t frame_seed);

  // The machine stands elsewhere, and it is another time.
  void move_to(const Moment& moment);

  // One return, or two with dual_returns; label kNone for none.
  struct Returns {
    Return first;
    Return second;
  };
  Returns cast(const Beam& beam);

 private:
  Return meet(const Ray& ray);
  Return meet_floor(const Ray& ray, const Return& floor);
  Return mirrored(const Ray& ray, double range_m) const;
  void mix_edge(const Ray& ray, Returns* returns);
  bool lost(const Return& r);
  Return through_air(Return* r);
  double noise_m(const Return& r, bool shimmer) const;
  void measure(double azimuth_deg, Return* r);

  const Setup& setup_;
  const World& world_;
  Random random_;
  Matrix R_machine_lidar_;  // x forward, y left
  double water_below_;
  double grazing_cosine_;
  double lens_reach_m_ = 0.0;   // how far from the sensor's origin beams begin
  double range_ahead_m_ = 0.0;  // what the sensor's ranges hold besides the way of the light
  // Of the moment:
  Matrix R_road_lidar_;
  Vector origin_, left_road_;
  std::vector<Primitive> things_;
  SectorIndex index_;
  double dust_ = 0.0;
  bool wall_lost_ = false;
  bool partial_ = false;
  bool needs_azimuth_ = false;
};

}  // namespace pose_wall::tools::sim
