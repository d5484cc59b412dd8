// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/segmentation.hpp"

#include <cmath>
#include <initializer_list>

namespace pose_wall::motion {
namespace {

// Neighbouring rings on level ground lie within 10 degrees of level (the document's and LeGO-LOAM's threshold).
constexpr float kGroundSlope = 0.17633F;
// Ground lies below the sensor, by more than a step.
constexpr float kBelowSensor_m = 0.3F;
// Smaller clusters are noise (the document: "points < 30").
constexpr std::uint32_t kClusterLeast = 30;

// Neighbours are of one surface when their ranges are this alike: a wall that is met at 10 degrees steps by 6 times the
// spacing of directions, which is 0.012 rad.
float step_most_m(float range_m) {
  return 0.15F + 0.07F * range_m;
}

// Of two neighbours one above the other: both ground where what lies between them is level.
std::uint32_t mark_ground(const Eigen::Matrix3d& R_map_base, const Reading& reading, RangeImage* image) {
  const Eigen::Vector3f up = R_map_base.row(2).transpose().cast<float>();
  const float sensor = up.dot(reading.lidar_base_m.cast<float>()) - kBelowSensor_m;
  const std::uint32_t columns = image->columns;
  for (std::uint32_t a = 0; a < image->count; ++a) {
    const Eigen::Vector3f pa = image->point(a);
    if (!(up.dot(pa) < sensor)) continue;
    const std::uint32_t above = image->place[a] + columns;
    if (above >= image->rows * columns) continue;
    std::uint16_t b = image->cell[above];
    if (b == kNoPoint && above + columns < image->rows * columns) b = image->cell[above + columns];
    if (b == kNoPoint) continue;
    const Eigen::Vector3f pb = image->point(b), d = pb - pa;
    const float rise = up.dot(d);
    if (!(up.dot(pb) < sensor)) continue;
    if (!(rise * rise < kGroundSlope * kGroundSlope * (d.squaredNorm() - rise * rise))) continue;
    image->flags[a] |= kGround | kKept;
    image->flags[b] |= kGround | kKept;
  }
  std::uint32_t marked = 0;
  for (std::uint32_t i = 0; i < image->count; ++i) marked += image->flags[i] & 1U;
  return marked;
}

// Breadth first from one point; what was reached lies in the queue's first entries. Where the next is none
// of the surface, as between the lines of a pattern or in dust, the next but one is asked.
std::uint32_t grow(std::uint16_t seed, const RangeImage& image, SegmentScratch* scratch) {
  const std::uint32_t columns = image.columns, cells = image.rows * columns;
  std::uint32_t head = 0, tail = 0;
  scratch->queue[tail++] = seed;
  scratch->visited[seed] = 1;
  while (head < tail) {
    const std::uint16_t at = scratch->queue[head++];
    const std::uint32_t place = image.place[at];
    const std::int32_t column = static_cast<std::int32_t>(place % columns);
    const std::uint32_t row = place - static_cast<std::uint32_t>(column);
    const float range = image.range[at], most = step_most_m(range);
    const std::uint32_t next_of[4] = {row + image.wrapped(column + 1), row + image.wrapped(column - 1), place + columns,
                                      place - columns};  // beyond the first row: wraps, and is no cell
    const std::uint32_t but_one[4] = {row + image.wrapped(column + 2), row + image.wrapped(column - 2),
                                      place + 2 * columns, place - 2 * columns};
    for (int k = 0; k < 4; ++k) {
      for (const std::uint32_t place_of : {next_of[k], but_one[k]}) {
        const std::uint16_t next = place_of < cells ? image.cell[place_of] : kNoPoint;
        if (next == kNoPoint || !(std::fabs(image.range[next] - range) < most)) continue;
        if (scratch->visited[next] == 0) scratch->queue[tail++] = next;
        scratch->visited[next] = 1;
        break;
      }
    }
  }
  return tail;
}

}  // namespace

void SegmentScratch::lay_out(Arena& arena) {
  queue = arena.take<std::uint16_t>(kImageCells);
  visited = arena.take<std::uint8_t>(kImageCells);
}

Segments segment(const Eigen::Matrix3d& R_map_base, const Reading& reading, SegmentScratch* scratch,
                 RangeImage* image) {
  Segments out;
  out.ground = mark_ground(R_map_base, reading, image);
  for (std::uint32_t i = 0; i < image->count; ++i) scratch->visited[i] = image->flags[i] & kGround;
  for (std::uint32_t i = 0; i < image->count; ++i) {
    if (scratch->visited[i] != 0) continue;
    const std::uint32_t size = grow(static_cast<std::uint16_t>(i), *image, scratch);
    if (size < kClusterLeast) continue;
    ++out.clusters;
    for (std::uint32_t k = 0; k < size; ++k) image->flags[scratch->queue[k]] |= kKept;
  }
  return out;
}

}  // namespace pose_wall::motion
