// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A map in a dirty block of its own, and scans of places that are drawn as lines.

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "base/math/crc32.hpp"
#include "base/math/elementary.hpp"
#include "base/math/random.hpp"
#include "part/held.hpp"
#include "planar/map/grid_map.hpp"
#include "planar/map/tile_record.hpp"
#include "pose_wall_planar_map.h"

namespace pose_wall::planar::test {

inline pose_wall_planar_map_settings map_settings() {
  pose_wall_planar_map_settings settings;
  EXPECT_EQ(pose_wall_planar_map_settings_init(&settings), POSE_WALL_OK);
  settings.tiles = 64;
  return settings;
}

class OpenedMap {
 public:
  explicit OpenedMap(const pose_wall_planar_map_settings& settings = map_settings()) {
    std::uint64_t bytes = 0;
    EXPECT_EQ(pose_wall_planar_map_memory_needed(&settings, &bytes), POSE_WALL_OK);
    block_.reset(static_cast<unsigned char*>(std::aligned_alloc(POSE_WALL_BLOCK_ALIGNMENT, bytes)));
    std::memset(block_.get(), 0xA5, bytes);
    EXPECT_EQ(pose_wall_planar_map_open(&settings, block_.get(), bytes, &map_), POSE_WALL_OK);
  }

  pose_wall_planar_map* get() const { return map_; }
  GridMap& inner() const { return reinterpret_cast<Held<GridMap, 0x70616D6C616E616CULL>*>(map_)->body(); }

  pose_wall_planar_map_report insert(const pose_wall_planar_scan& scan, const pose_wall_planar_pose& base) const {
    pose_wall_planar_map_report report{};
    report.struct_size = sizeof(report);
    EXPECT_EQ(pose_wall_planar_map_insert(map_, &scan, &base, &report), POSE_WALL_OK);
    return report;
  }
  pose_wall_planar_cell cell(double x_m, double y_m) const {
    pose_wall_planar_cell cell{};
    cell.struct_size = sizeof(cell);
    EXPECT_EQ(pose_wall_planar_map_cell(map_, x_m, y_m, &cell), POSE_WALL_OK);
    return cell;
  }
  std::uint32_t state(double x_m, double y_m) const { return cell(x_m, y_m).state; }
  pose_wall_planar_box box() const {
    pose_wall_planar_box box{};
    box.struct_size = sizeof(box);
    EXPECT_EQ(pose_wall_planar_map_box(map_, &box), POSE_WALL_OK);
    return box;
  }
  std::vector<unsigned char> saved() const {
    std::uint64_t bytes = 0, written = 0;
    EXPECT_EQ(pose_wall_planar_map_save_bytes(map_, &bytes), POSE_WALL_OK);
    std::vector<unsigned char> all(bytes, 0xA5);
    EXPECT_EQ(pose_wall_planar_map_save_all(map_, all.data(), bytes, &written), POSE_WALL_OK);
    EXPECT_EQ(written, bytes);
    return all;
  }
  std::int32_t load(const std::vector<unsigned char>& bytes) const {
    return pose_wall_planar_map_load_all(map_, bytes.data(), bytes.size());
  }

 private:
  struct Free {
    void operator()(unsigned char* block) const { std::free(block); }
  };
  std::unique_ptr<unsigned char, Free> block_;
  pose_wall_planar_map* map_ = nullptr;
};

// A scan and its own ranges.
struct DrawnScan {
  std::vector<float> ranges;
  pose_wall_planar_scan scan{};

  explicit DrawnScan(std::vector<float> of, double range_max_m = 30.0) : ranges(std::move(of)) {
    scan.struct_size = sizeof(scan);
    scan.beams = static_cast<std::uint32_t>(ranges.size());
    scan.angle_min_rad = -kPi;
    scan.angle_step_rad = 2.0 * kPi / static_cast<double>(ranges.size());
    scan.range_max_m = range_max_m;
    scan.sigma_m = 0.02;
    scan.range_m = ranges.data();
  }
  DrawnScan(const DrawnScan&) = delete;
  DrawnScan& operator=(const DrawnScan&) = delete;
};

// One beam along x.
inline std::unique_ptr<DrawnScan> one_beam(float range_m, double angle_rad = 0.0) {
  auto drawn = std::make_unique<DrawnScan>(std::vector<float>{range_m});
  drawn->scan.angle_min_rad = angle_rad;
  drawn->scan.angle_step_rad = 0.01;
  return drawn;
}

struct Line {
  double x0, y0, x1, y1;
};

// The nearest crossing of a ray with the lines; infinity: none.
inline double range_to(const std::vector<Line>& lines, double x, double y, double angle) {
  const double dx = cosine(angle), dy = sine(angle);  // our own: the same ranges on every machine
  double nearest = std::numeric_limits<double>::infinity();
  for (const Line& line : lines) {
    const double ex = line.x1 - line.x0, ey = line.y1 - line.y0, det = ex * dy - ey * dx;
    if (std::abs(det) < 1e-12) continue;
    const double range = (ex * (line.y0 - y) - ey * (line.x0 - x)) / det;
    const double along = (dx * (line.y0 - y) - dy * (line.x0 - x)) / det;
    if (range > 0.0 && along >= 0.0 && along <= 1.0) nearest = std::min(nearest, range);
  }
  return nearest;
}

// Roughly normal: the sum of twelve even numbers.
inline double noise(Random* random) {
  double sum = -6.0;
  for (int k = 0; k < 12; ++k) sum += static_cast<double>(random->below(1U << 30)) / (1U << 30);
  return sum;
}

inline std::unique_ptr<DrawnScan> drawn_scan(const std::vector<Line>& lines, const pose_wall_planar_pose& pose,
                                             std::uint32_t beams, double sigma_m, Random* random,
                                             double range_max_m = 30.0) {
  std::vector<float> ranges(beams);
  const double step = 2.0 * kPi / beams;
  for (std::uint32_t k = 0; k < beams; ++k) {
    const double range = range_to(lines, pose.x_m, pose.y_m, pose.yaw_rad - kPi + k * step);
    ranges[k] = range <= range_max_m ? static_cast<float>(range + sigma_m * noise(random))
                                     : std::numeric_limits<float>::infinity();
  }
  return std::make_unique<DrawnScan>(std::move(ranges), range_max_m);
}

// Walls to both sides of a road along x, `width_m` apart, whose rock stands out by up to `rough_m`.
inline std::vector<Line> rough_road(double length_m, double width_m, double rough_m, std::uint64_t seed) {
  Random random(seed);
  std::vector<Line> lines;
  const double step_m = 0.4;
  for (const double side : {-1.0, 1.0}) {
    double before = 0.0;
    for (double x = 0.0; x < length_m; x += step_m) {
      const double now = rough_m * static_cast<double>(random.below(1000)) / 1000.0;
      const double middle = side * 0.5 * width_m;
      lines.push_back({x, middle - side * before, x + step_m, middle - side * now});
      before = now;
    }
  }
  return lines;
}

// All bits of things are those of the cells, and every square of distance is that of a search through all things.
inline void expect_true_distances(const GridMap& map, std::int32_t every = 1) {
  std::vector<std::pair<std::int32_t, std::int32_t>> things;
  const TileTable& tiles = map.tiles();
  const std::int32_t cap = map.distances().cap();
  for (std::uint32_t tile = 0; tile < tiles.count(); ++tile) {
    const CellBox whole = tiles.head(tile).box();
    std::uint32_t count = 0;
    for (std::int32_t y = whole.y0; y <= whole.y1; ++y) {
      for (std::int32_t x = whole.x0; x <= whole.x1; ++x) {
        ASSERT_LE(map.value_at(x, y), kValueMost) << "a mark was left";
        const bool is_thing = map.value_at(x, y) >= map.model().thing_from;
        ASSERT_EQ(is_thing, (tiles.things(tile)[y - whole.y0] >> (x - whole.x0) & 1U) != 0) << x << ' ' << y;
        if (is_thing) things.emplace_back(x, y);
        count += is_thing ? 1U : 0U;
      }
    }
    ASSERT_EQ(count, tiles.head(tile).things);
  }
  for (std::uint32_t tile = 0; tile < tiles.count(); ++tile) {
    const CellBox whole = tiles.head(tile).box();
    std::vector<std::pair<std::int32_t, std::int32_t>> near;
    const CellBox reach = whole.widened(cap);
    for (const auto& thing : things) {
      if (reach.holds(thing.first, thing.second)) near.push_back(thing);
    }
    for (std::int32_t y = whole.y0; y <= whole.y1; ++y) {
      for (std::int32_t x = whole.x0 + (y % every + every) % every; x <= whole.x1; x += every) {
        std::int32_t least = cap * cap;
        for (const auto& thing : near) {
          const std::int32_t dx = thing.first - x, dy = thing.second - y;
          least = std::min(least, dx * dx + dy * dy);
        }
        ASSERT_EQ(map.distances().square_at(x, y), least) << x << ' ' << y;
      }
    }
  }
}

}  // namespace pose_wall::planar::test
