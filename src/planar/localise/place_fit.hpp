// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// How well what was seen fits a place of the map. Points of one surface err alike, so evidence is counted in patches of
// a square metre, never in points. The patches belong to the points, not to the place: two places are compared patch by
// patch.

#pragma once

#include <cstdint>

#include "planar/localise/place_map.hpp"

namespace pose_wall::planar {

constexpr std::uint32_t kLookPointsMost = 1024;
constexpr std::uint32_t kPatchesMost = 128;
constexpr std::uint32_t kSightsMost = 64;

// What was seen, from where base stands now: a scan, or the last metres.
struct Look {
  Span<ScanPoint> points;
  Span<std::uint8_t> patch;      // of each point; kPatchesMost: of none
  Span<std::uint32_t> in_patch;  // points of each patch
  Span<ScanPoint> sights;        // ends of lines of sight from base, spread over all directions
  std::uint32_t point_count = 0, patches = 0, sight_count = 0;
  ScanPoint sight_from = {0.0F, 0.0F};
  double sigma_m = 0.0;

  void lay_out(Arena& arena);
  // One scan, and its lines of sight.
  void take(Span<const ScanPoint> scan_points, const Eigen::Vector2d& origin_m, double scan_sigma_m);
  void take_sights(Span<const ScanPoint> scan_points, const Eigen::Vector2d& origin_m);
  // Patches of the first `count` points.
  void sort_into_patches(std::uint32_t count);
};

// Patches with fewer points say nothing.
constexpr std::uint32_t kPatchPointsLeast = 3;

struct Fit {
  Pose2 pose;                                             // of base in the map
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  // of x, y, yaw, as if points were independent
  double explained = 0.0;                                 // share of the points in seen parts that lie on surfaces
  double rms_m = 0.0;                                     // of these, across the surfaces
  double seen = 0.0;                                      // share of the points that lie in seen parts
  std::uint32_t points = 0;                               // in seen parts
};

// The mean cost of each patch: squared residuals over their variance, 9 at most. 255 stands for 9.
struct PatchCosts {
  std::uint8_t cost[kPatchesMost];
};
constexpr double kCostMost = 9.0;
constexpr double kCostUnseen = 4.5;  // a new surface is no contradiction, and no agreement

struct PatchVerdict {
  double cost = 0.0;         // sum over patches
  double fits = 0.0;         // share of the seen patches that fit at the level of noise
  std::uint32_t seen = 0;    // patches in seen parts
  std::uint32_t judged = 0;  // patches with enough points
};

// Gauss and Newton with Cauchy's weights.
struct FitRule {
  double sigma_m;                                    // of a point
  double reach_m;                                    // farther surfaces do not count
  std::uint32_t stride;                              // every so manieth point
  std::uint32_t rounds;                              // at most
  Pose2 prior;                                       // what is known before, with
  Eigen::Matrix3d weight = Eigen::Matrix3d::Zero();  // its information
};

Fit fit_pose(const PlaceMap& map, const Look& look, const Pose2& start, const FitRule& rule);
PatchVerdict judge_patches(const PlaceMap& map, const Look& look, const Pose2& pose, PatchCosts* costs);
// By how many of its standard errors the mean patch fits worse at `other`.
double worse_by(const Look& look, const PatchCosts& best, const PatchCosts& other);
// Share of the lines of sight that pass through surfaces of the map.
double seen_through(const PlaceMap& map, const Look& look, const Pose2& pose);

struct Slid {
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  // unit, in the map: where the fit holds least
  double reach_m = 0.0;                                  // largest shift that patches do not exclude
};
// A patch's own wall, and what it costs to be moved along it.
struct PatchWall {
  float n, x, y, xx, xy, yy;  // sums from the corner of the square metre, for the sake of small numbers
  float along_x, along_y;     // unit, in the map
  float ahead, behind;        // sums of costs where it is moved
};
// How many patches have relief of their own: moved along their wall they fit worse, to either side. Rock is like that
// nearly everywhere, smooth walls only at their corners. `room` for one, `walls` for kPatchesMost.
std::uint32_t relief_patches(const PlaceMap& map, const Look& look, const Pose2& pose, PatchCosts* room,
                             Span<PatchWall> walls);
// A shift is excluded if the mean patch fits worse by so many standard errors. `room` for two.
Slid slide_of(const PlaceMap& map, const Look& look, const Fit& fit, double excluded, PatchCosts* room);

}  // namespace pose_wall::planar
