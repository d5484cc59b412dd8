// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What rays meet: the rock of a road. Either a section's surfaces (world.hpp), or a real road that somebody measured.
#pragma once

#include <memory>
#include <vector>

#include "lab/sim/label.hpp"
#include "lab/sim/pose.hpp"
#include "lab/sim/surface.hpp"

namespace pose_wall::tools::sim {

struct Hit {
  double t_m = kNever;
  double cosine = 1.0;  // of the incidence on the mean surface
  Label label = Label::kNone;
  int side = 0;  // of the wall that was hit
};

class RockSurface {
 public:
  RockSurface() = default;
  RockSurface(const RockSurface&) = delete;
  RockSurface& operator=(const RockSurface&) = delete;
  RockSurface(RockSurface&&) = default;
  RockSurface& operator=(RockSurface&&) = default;
  virtual ~RockSurface() = default;

  // The first rock within t_max_m. Floor and roof by how they lie, z up; all else is kFace, of no side. From several
  // threads at once.
  virtual Hit trace(const Ray& ray, double t_max_m) const = 0;
};

// A real road: its rock, and where base stands in it at each frame.
struct Survey {
  std::shared_ptr<const RockSurface> rock;
  std::vector<Placement> path;

  // At a moment between frames, in frames since the first; before the first and behind the last, there.
  Placement at(double frame) const;
};

}  // namespace pose_wall::tools::sim
