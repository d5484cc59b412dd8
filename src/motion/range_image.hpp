// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The scan as an image of rings and directions, its points in base and freed of the machine's motion (the document's
// projection; Shan and Englot 2018, section III A).

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "lidar/cloud_print.hpp"
#include "lidar/mount.hpp"
#include "motion/pose.hpp"
#include "pose_wall.h"

namespace pose_wall::motion {

// Rows by ring, else by elevation; columns by azimuth. There are as many as the sensor has directions or cells allow:
// 64 rings in 512 directions, 16 in 2048. More points of one scan give the way along no better, and each costs time:
constexpr std::uint32_t kImageCells = 32768;
constexpr std::uint32_t kImageRowsMost = 64;
constexpr std::uint32_t kImageColumnsLeast = kImageCells / kImageRowsMost, kImageColumnsMost = 2048;
constexpr std::uint16_t kNoPoint = 0xFFFF;  // beyond all numbers of points: there are kImageCells at most

enum PointFlag : std::uint8_t {
  kGround = 1,  // marked as ground
  kKept = 2,    // ground, or of a cluster that is large enough
  kEdge = 4,    // a curvature feature: corner
  kPlane = 8    // a curvature feature: flat
};

struct RangeImage {
  void lay_out(Arena& arena);

  // The point of a cell, or kNoPoint; columns go round, beyond the first and last row there is none.
  std::uint16_t at(std::int32_t row, std::int32_t column) const {
    if (row < 0 || row >= static_cast<std::int32_t>(rows)) return kNoPoint;
    return cell[static_cast<std::uint32_t>(row) * columns + wrapped(column)];
  }
  // Columns go round; of numbers at most a turn away.
  std::uint32_t wrapped(std::int32_t column) const {
    const std::int32_t all = static_cast<std::int32_t>(columns);
    return static_cast<std::uint32_t>(column < 0 ? column + all : column >= all ? column - all : column);
  }
  std::int32_t row_of(std::uint32_t point) const { return static_cast<std::int32_t>(place[point] / columns); }
  std::int32_t column_of(std::uint32_t point) const { return static_cast<std::int32_t>(place[point] % columns); }
  Eigen::Vector3f point(std::uint32_t i) const { return {x[i], y[i], z[i]}; }

  std::uint32_t rows = 0, columns = 0;
  std::uint32_t count = 0;     // points
  Span<float> x, y, z, range;  // base, m; range from the sensor
  Span<std::uint16_t> place;   // row * columns + column
  Span<std::uint8_t> flags;
  Span<std::uint16_t> cell;
};

// De-skewed by the twist where the cloud has times: each point where it would have been seen from at the stamp. The
// print is of all points in range, those of the machine's body and those that the image has no room for, too.
void project(const pose_wall_cloud& cloud, const Mount& mount, const Twist& twist, RangeImage* image,
             CloudPrint* print);
// The same cloud by another twist. Cells and the order of points do not depend on it, so flags stay. The exception is
// another point inside the machine's own body, which shows in the count.
void project_again(const pose_wall_cloud& cloud, const Mount& mount, const Twist& twist, RangeImage* image);

}  // namespace pose_wall::motion
