// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A scan against surfaces: a search over a whole window of poses, then Gauss and Newton.
//
// The search is correlative (Olson, ICRA 2009): the score of a pose is the mean likelihood of the scan's points. Scores
// of coarse cells bound those of the cells inside (Hess et al., ICRA 2016), so most of the window is never looked at.
// Each level keeps a bounded number of cells. The search reports whether that could have cost the best one.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "planar/match/surface_map.hpp"

namespace pose_wall::planar {

constexpr std::uint32_t kSearchNodesMost = 512;
constexpr int kRefineRounds = 12;  // of Gauss and Newton

// Points of one surface err alike: of so many one counts. An estimate on the safe side, from recorded logs; in the
// simulator each would count (README.md).
constexpr double kAlike = 10.0;

struct SearchWindow {
  Pose2 middle;
  double reach_m = 0.0, reach_rad = 0.0;  // to each side
  std::uint32_t nodes = 512;              // cells that each level keeps, at most kSearchNodesMost
};

struct Found {
  Pose2 pose;
  double score = 0.0;         // mean likelihood of the points, 0 to 1
  double second_score = 0.0;  // of the best pose that is no neighbour of the best
  Pose2 second;
  bool is_whole = false;  // no part of the window that was left out can be better
};

struct Refined {
  Pose2 pose;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  // of x, y, yaw in the map, without the prior's
  double explained = 0.0;                                 // share of the points in the window that lie on surfaces
  double rms_m = 0.0;                                     // of these, across the surfaces
  double misfit = 0.0;  // sum over the points of squared residual over variance, at most 9 each
  std::uint32_t points = 0;
  bool is_valid = false;
};

// How far the match could slide along the direction that holds least.
struct Slide {
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  // unit, in the map
  double reach_m = 0.0;  // the largest shift that the patches do not exclude, to either side
};

// What is known before the scan: a pose and the information about it, in the map's axes.
struct Prior {
  Pose2 pose;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
};

class Matcher {
 public:
  void lay_out(Arena& arena);

  Found search(Span<const ScanPoint> points, const SurfaceMap& map, const SearchWindow& window) const;
  // sigma_m: range noise of the scan.
  Refined refine(Span<const ScanPoint> points, const SurfaceMap& map, const Pose2& start, const Prior& prior,
                 double sigma_m, int rounds = kRefineRounds) const;
  // What the match tells about x, y and yaw in the map: without what the slide leaves open, and since points of one
  // surface err alike, much less than so many independent points would tell.
  Eigen::Matrix3d information(const Refined& match, const Slide& slide) const;
  // Evidence is what patches of a square metre agree on: normals of noise make any wall look as if it held its scan.
  Slide slide(Span<const ScanPoint> points, const SurfaceMap& map, const Refined& match, double sigma_m) const;

 private:
  struct Node {
    std::uint32_t score;
    std::int16_t yaw;
    std::int16_t x, y;  // in fine cells from the window's corner
  };
  struct Offset {
    std::int32_t column, row;
  };
  struct Grid;
  struct Patch {
    std::int32_t column, row;
    double gain;
  };

  void rotate(const Grid& grid, std::int32_t yaw) const;
  std::uint32_t score(const Grid& grid, std::uint32_t level, const Node& node) const;
  void offer(const Grid& grid, const Node& node, std::uint32_t* kept, std::uint32_t* dropped) const;
  void keep_best(const Grid& grid, Found* found, std::uint32_t kept, std::uint32_t dropped) const;
  std::uint32_t look_coarse(const Grid& grid, std::uint32_t* dropped) const;
  std::uint32_t look_closer(const Grid& grid, std::uint32_t level, std::uint32_t parents, std::uint32_t* dropped) const;

  static constexpr std::uint32_t kSearchPointsMost = 240;

  std::uint32_t make_patches(Span<const ScanPoint> points, const Turn2& turn, const Eigen::Vector2d& place) const;
  double agreed_gain(Span<const ScanPoint> points, const SurfaceMap& map, std::uint32_t patches, const Pose2& match,
                     const Pose2& other, double noise_m2) const;
  static constexpr std::uint32_t kPatchesMost = 128;

  Span<Patch> patches_;
  Span<std::uint32_t> patch_of_;
  Span<Node> nodes_, parents_;
  Span<Offset> offsets_;
  Span<ScanPoint> chosen_;
};

}  // namespace pose_wall::planar
