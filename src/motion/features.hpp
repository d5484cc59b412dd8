// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Curvature features (the document's section 2): edges, planes, and which points an occlusion makes worthless. And the
// observations: plane points spread evenly over the surfaces, each with the axis that its surface faces.

#pragma once

#include "motion/range_image.hpp"
#include "motion/relief_map.hpp"

namespace pose_wall::motion {

// Twice as many as a curve or the fine steps take (kRowsMost, kEquationsMost), so that each takes an even half.
constexpr std::uint32_t kObservationsMost = 4096;
// Cosine to an axis that a surface faces, within 53 degrees. A normal has 0.577 at least to its nearest one, so nearly
// all surfaces face one.
constexpr float kFaces = 0.6F;

struct Observation {
  float x, y, z;        // base, m
  float normal[3];      // of the surface about it, base, towards the sensor
  std::uint8_t facing;  // Facing, in the map
  std::uint8_t ground;
};

struct FeatureCounts {
  std::uint32_t edges = 0, planes = 0;
};

// Sets kEdge and kPlane on kept points.
FeatureCounts mark_features(RangeImage* image);

// The normal of the surface about a point, base, towards the sensor; by neighbours some decimetres away, so that
// neither noise nor the rock's roughness turns it over. False where there are none.
bool normal_about(const RangeImage& image, std::uint32_t point, Eigen::Vector3f* normal);

// The axis of the map that a normal faces; false where it faces none (kFaces).
bool facing_of(const Eigen::Vector3f& normal_map, std::uint8_t* facing);

// Facings of successive points of the image: within half of a normal's reach the last one's holds for its neighbours.
class FacingWalk {
 public:
  FacingWalk(const RangeImage& image, const Eigen::Matrix3f& R_map_base) : image_(image), R_(R_map_base) {}
  // False where the surface faces no axis, or there is none.
  bool go_to(std::uint32_t point);
  std::uint8_t facing() const { return facing_; }
  const Eigen::Vector3f& normal() const { return normal_; }  // base

 private:
  const RangeImage& image_;
  Eigen::Matrix3f R_;
  Eigen::Vector3f at_ = Eigen::Vector3f::Zero(), normal_ = Eigen::Vector3f::Zero();
  std::uint8_t facing_ = kFacesX;
  bool faces_ = false, has_begun_ = false;
};

struct ObservationScratch {
  void lay_out(Arena& arena);
  Span<std::uint8_t> taken;  // of each cubic metre
};

// At most a few a cubic metre, so that near rock does not outweigh far rock; and half on ground and roof, unless walls
// have no more to give. Gives how many.
std::uint32_t choose_observations(const RangeImage& image, const Pose& expected, ObservationScratch* scratch,
                                  Span<Observation> out);

// Recomputes the facings for another attitude; points that face no axis keep theirs.
void face(const Eigen::Matrix3d& R_map_base, Span<Observation> observations);

}  // namespace pose_wall::motion
