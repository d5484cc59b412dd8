// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A scan against surfaces, over a whole window of poses.
//
// The search is correlative (Olson, ICRA 2009): the score of a pose is the mean likelihood of the scan's points. Scores
// of coarse cells bound those of the cells inside (Hess et al., ICRA 2016), so most of the window is never looked at.
// Each level keeps a bounded number of cells. The search reports whether that could have cost the best one.

#pragma once

#include <cstdint>

#include "place/patches.hpp"
#include "planar/match/surface_map.hpp"

namespace pose_wall::planar {

constexpr std::uint32_t kSearchNodesMost = 512;  // a bound on the time of a level; is_whole says whether it cost a pose

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

class Matcher {
 public:
  void lay_out(Arena& arena);

  Found search(Span<const ScanPoint> points, const SurfaceMap& map, const SearchWindow& window) const;
  // At most kMatchPointsMost points by their patches, until the next call.
  const PatchedPoints& sort(Span<const ScanPoint> points, double sigma_m);

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

  void rotate(const Grid& grid, std::int32_t yaw) const;
  std::uint32_t score(const Grid& grid, std::uint32_t level, const Node& node) const;
  void offer(const Grid& grid, const Node& node, std::uint32_t* kept, std::uint32_t* dropped) const;
  void keep_best(const Grid& grid, Found* found, std::uint32_t kept, std::uint32_t dropped) const;
  std::uint32_t look_coarse(const Grid& grid, std::uint32_t* dropped) const;
  std::uint32_t look_closer(const Grid& grid, std::uint32_t level, std::uint32_t parents, std::uint32_t* dropped) const;

  static constexpr std::uint32_t kSearchPointsMost = 240;  // a bound on the time of a pose: every third of a whole scan

  Span<Node> nodes_, parents_;
  Span<Offset> offsets_;
  Span<ScanPoint> chosen_;
  PatchedPoints patched_;
};

}  // namespace pose_wall::planar
