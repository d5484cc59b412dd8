// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The map: the rock's surfaces as height images. A tile is a square metre of a surface that faces one of the map's
// axes: a plane, and the heights of the rock about it in cells of 5 cm along the tile and 10 cm across. Tiles lie in
// the order of their use; the one that was seen longest ago gives way.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "base/simd/four_floats.hpp"
#include "motion/pose.hpp"

namespace pose_wall::motion {

// The axis of the map that a surface faces. Heights are along it; u and v are the two others, in the order x, y, z.
enum Facing : std::uint8_t { kFacesX = 0, kFacesY = 1, kFacesZ = 2 };
constexpr int kU[] = {1, 0, 0}, kV[] = {2, 2, 1};  // the two other axes, by facing

// Of 850 bytes: 3.5 MiB of the 6 that POSE_WALL_MOTION_BLOCK_MOST allows. A road of 5 by 4 m has 18 to the metre, so
// they hold 230 m of it.
constexpr std::uint32_t kTilesMost = 4096;
// 5 cm along resolve rock that comes again after 0.1 m. Across, the rings of a sensor are as far apart as a cell: 10 cm
// are 1.2 degrees at 5 m.
constexpr std::int32_t kAlongCells = 20, kAcrossCells = 10;
constexpr float kLayer_m = 0.35F;  // a point further from a tile's plane is of another surface

struct Cell {
  std::int16_t height_um100 = 0;  // 0.1 mm above the plane
  std::int8_t along = 0;          // the mean place of its points along u, in 1/256 of a cell from its middle
  std::uint8_t count = 0;         // of points, at most 255
};

struct Tile {
  std::int32_t u, v;                 // which square metre
  float height_m, slope_u, slope_v;  // plane: height = height_m + slope_u u + slope_v v, about the tile's middle
  float cosine;                      // of its normal to the axis
  std::uint32_t seen;                // by which keyframe, last
  std::int16_t next;                 // another surface over the same square, or another square of the same bucket
  std::uint8_t facing;
  std::uint8_t fresh;        // began in this keyframe: its slope is not known yet
  std::uint8_t stands_free;  // the road goes on behind it, as the sensor sees it
  std::uint8_t keyframes;    // that saw it, at most 255
  float seen_from[3];        // the sensor's place, mean over these keyframes
  Cell cell[kAlongCells * kAcrossCells];

  Eigen::Vector3f normal() const {
    Eigen::Vector3f n;
    n[facing] = cosine;
    n[kU[facing]] = -slope_u * cosine;
    n[kV[facing]] = -slope_v * cosine;
    return n;
  }
};

// A pose as the map counts: metres from a corner of its grid near the machine, so that floats are fine enough.
struct LocalPose {
  LocalPose(const Pose& pose, const Eigen::Vector3d& corner)
      : R(pose.R.cast<float>()), t((pose.t - corner).cast<float>()) {}
  Eigen::Vector3f operator()(const Eigen::Vector3f& p_base) const { return R * p_base + t; }

  Eigen::Matrix3f R;
  Eigen::Vector3f t;
};

// The map at a point.
struct Surface {
  const Tile* tile;
  float u, v;     // within the tile, from its middle, m
  float above_m;  // the point above the tile's plane, along the axis
};

// The rock above the tile's plane at a point.
struct Relief {
  float height_m;
  float spread;  // variance of a point's height against this, in variances of a single one
};

// Four points over one tile, and the rock there.
struct FourSurfaces {
  const Tile* tile;
  FourFloats u, v, above_m;
};
struct FourReliefs {
  FourFloats height_m, spread;
};

class ReliefMap {
 public:
  void lay_out(Arena& arena);
  void clear();

  // Points given to the map count from here, whole metres.
  void set_corner(const Eigen::Vector3d& near_map);
  Eigen::Vector3d corner() const {
    return {static_cast<double>(corner_[0]), static_cast<double>(corner_[1]), static_cast<double>(corner_[2])};
  }

  // The surface nearest to the point, if one is within kLayer_m.
  bool find(const Eigen::Vector3f& p, std::uint8_t facing, Surface* out) const;

  // The same, where a point that was moved a little lies on the tile that it lay on before.
  bool find_again(const Eigen::Vector3f& p, const Tile* before, Surface* out) const;

  // By the two nearest cells along u; false where one of them is empty.
  static bool relief(const Surface& at, Relief* out);
  static FourTruths relief(const FourSurfaces& at, FourReliefs* out);

  // The place from which a tile was seen, as points are given.
  Eigen::Vector3f seen_from(const Tile& tile) const {
    return Eigen::Vector3f(tile.seen_from[0], tile.seen_from[1], tile.seen_from[2]) - corner().cast<float>();
  }

  // A scan goes in between begin and end, which gives how many tiles began.
  void begin_keyframe(const Eigen::Vector3d& sensor_map) {
    ++keyframe_;
    last_ = nullptr;
    sensor_ = sensor_map.cast<float>();
  }
  void add(const Eigen::Vector3f& p, std::uint8_t facing);
  std::uint32_t end_keyframe();
  // Forgets the rock about the planes; the planes stay.
  void forget_relief();
  // Root mean square of the tiles' slopes along u, about their mean, of walls or of ground and roof: how bent they are.
  double unevenness() const;

  std::uint32_t tiles() const { return used_; }
  std::uint32_t keyframes() const { return keyframe_; }
  bool gave_way() const { return gave_way_; }
  const Tile& tile(std::uint32_t index) const { return tile_[index]; }
  std::uint32_t index_of(const Tile* tile) const { return static_cast<std::uint32_t>(tile - tile_.data()); }

  // Points of the map's cells in the map's own frame, for pictures; writes those from the first-th on, gives their
  // number.
  std::uint32_t points(std::uint32_t first, std::uint32_t capacity, float* xyz_m) const;

 private:
  std::uint32_t bucket_of(std::int32_t u, std::int32_t v, std::uint8_t facing) const;
  Tile* tile_for(const Eigen::Vector3f& p, std::uint8_t facing, Surface* at);
  std::int32_t take_tile();
  Surface over(const Tile& tile, const Eigen::Vector3f& p) const;
  bool is_still_over(const Tile& tile, const Eigen::Vector3f& p, std::uint8_t facing, Surface* at) const;
  void settle(Tile* tile);
  bool goes_on_behind(const Tile& tile) const;
  bool has_ground(std::int32_t x, std::int32_t y, float below_m) const;

  Span<Tile> tile_;
  Span<std::int16_t> bucket_;
  Span<std::int16_t> fresh_;
  Tile* last_ = nullptr;  // that a point of this keyframe went to
  std::uint32_t used_ = 0, fresh_count_ = 0, keyframe_ = 0;
  bool gave_way_ = false;
  Eigen::Vector3f sensor_ = Eigen::Vector3f::Zero();  // of this keyframe
  std::int32_t corner_[3] = {0, 0, 0};
};

}  // namespace pose_wall::motion
