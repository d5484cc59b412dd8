// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <memory>
#include <utility>

#include "lab/sim/objects.hpp"
#include "lab/sim/rock_surface.hpp"
#include "lab/sim/section.hpp"

namespace pose_wall::tools::sim {

// The road, and what stands or walks in it. Its surface is the rock alone, with steel sets; heaps and bodies, a narrow
// place among them, are not.
class World final : public RockSurface {
 public:
  World(const Setup& setup, std::uint64_t seed);
  // The rock of a real road, and nothing that stands in it.
  explicit World(std::shared_ptr<const RockSurface> rock) : surveyed_(std::move(rock)) {}

  // The bare rock without relief, objects, crosscuts, heaps and faces: what truth is measured to.
  static World mean(const Setup& setup);

  // As they stand at the start.
  const std::vector<Primitive>& objects() const { return objects_; }
  std::vector<Primitive> objects_at(double time_s) const;
  Hit trace(const Ray& ray, double t_max_m, const std::vector<Primitive>& things, const SectorIndex& index) const;
  Hit trace(const Ray& ray, double t_max_m) const override;
  // With heaps.
  Hit trace_ground(const Ray& ray, double t_max_m) const;
  bool is_surveyed() const { return surveyed_ != nullptr; }
  const Plane& floor() const { return floor_; }
  // Smooth field over the floor, normally distributed, that decides where water stands.
  double wetness(const Vector& p) const;
  // How much light a point of the rock gives back: 1 in the mean, and nowhere in the road the same pattern.
  double brightness(const Vector& p) const;

 private:
  World() = default;
  void hit_wall_or_recess(const RoadSurface& wall, const Ray& ray, double t_start, Hit* best) const;
  double hit_steel(const RoadSurface& behind, const Ray& ray, double t_behind) const;

  std::shared_ptr<const RockSurface> surveyed_;  // in place of surfaces_ and recesses_
  CentreLine line_{0.0};
  Rock rock_;
  Plane floor_{};
  std::unique_ptr<NoiseTile> tile_;
  NoiseLayer puddles_, texture_;
  std::vector<RoadSurface> surfaces_;
  std::vector<Recess> recesses_;
  std::vector<Primitive> objects_, ground_;  // the latter are some of them
};

}  // namespace pose_wall::tools::sim
