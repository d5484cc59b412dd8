// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Boxes and capsules: machines, pipes, props, people. Flat skinned.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lab/sim/label.hpp"
#include "lab/sim/surface.hpp"

namespace pose_wall::tools::sim {

struct Primitive {
  enum class Kind { kBox, kCapsule } kind;
  Label label;
  Vector centre;
  Matrix axes;                           // columns: box axes in the road frame; capsule: the first is its axis
  Vector half;                           // half lengths; capsule: half length, radius, radius
  Vector velocity_mps = Vector::Zero();  // in the road frame

  static Primitive box(Label label, const Vector& centre, const Matrix& axes, const Vector& half);
  static Primitive capsule(Label label, const Vector& from, const Vector& to, double radius_m);
  double bound_m() const { return kind == Kind::kBox ? half.norm() : half.x() + half.y(); }

  // First t > 0 from outside, kNever for a miss or a start inside. On a hit, *cosine is that of the incidence.
  double hit(const Ray& ray, double* cosine) const;
};

// Which primitives a ray can meet that begins within `reach_m` of one point, by the sector of its direction.
class SectorIndex {
 public:
  SectorIndex() = default;
  SectorIndex(const std::vector<Primitive>& primitives, const Vector& origin, double reach_m = 0.0);
  bool empty() const { return empty_; }
  const std::vector<std::uint16_t>& candidates(const Vector& direction) const {
    return sectors_[sector(direction.x(), direction.y())];
  }

 private:
  static constexpr std::size_t kSectors = 256;
  static std::size_t sector(double x, double y);
  std::array<std::vector<std::uint16_t>, kSectors> sectors_;
  bool empty_ = true;
};

}  // namespace pose_wall::tools::sim
