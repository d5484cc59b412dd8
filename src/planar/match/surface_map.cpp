// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/match/surface_map.hpp"

namespace pose_wall::planar {
namespace {

constexpr std::int32_t kLikely = 2;  // cells about a surface that are likely: two standard deviations of kBell

}  // namespace

void SurfaceMap::lay_out(Arena& arena) {
  std::uint32_t count = at(0, kSide);
  nearest_ = arena.take<std::uint16_t>(count);
  for (Span<std::uint8_t>& field : field_) {
    field = arena.take<std::uint8_t>(count);
    count /= static_cast<std::uint32_t>(kShrink * kShrink);
  }
  seen_ = arena.take<std::uint8_t>(seen_at(0, kSide));
  cells_.lay_out(arena, kCellsMost);
}

void SurfaceMap::open() {
  nearest_.fill(Cells::kNone);
  for (const Span<std::uint8_t>& field : field_) field.fill(0);
  seen_.fill(0);
  cells_.clear();
}

// Only what was written is cleared: a window is mostly empty.
void SurfaceMap::begin(const Eigen::Vector2d& middle_m) {
  for (std::uint32_t k = 0; k < cells_.used(); ++k) {
    const SurfaceCell& cell = cells_.cell(k);
    for (std::int32_t row = cell.row - kReach; row <= cell.row + kReach; ++row) {
      for (std::int32_t column = cell.column - kReach; column <= cell.column + kReach; ++column) {
        nearest_[at(column, row)] = Cells::kNone;
        field_[0][at(column, row)] = 0;
      }
    }
  }
  if (!is_empty()) {
    field_[1].fill(0);
    field_[2].fill(0);
    seen_.fill(0);
  }
  cells_.clear();
  middle_m_ = middle_m;
}

void SurfaceMap::add(Span<const ScanPoint> points, const Pose2& pose, bool with_sight) {
  const Turn2 turn(pose.yaw_rad);
  const Eigen::Vector2d place = pose.place() - middle_m_;
  for (const ScanPoint& point : points) {
    const Eigen::Vector2d p = turn * as_double(point) + place;
    if (!Cells::holds(p.x(), p.y())) continue;
    const std::int32_t column = Cells::cell_of(p.x()), row = Cells::cell_of(p.y());
    (void)cells_.put(p, column, row, &nearest_[at(column, row)]);
    if (!with_sight) continue;
    walk_sight(place, p, [&](const Eigen::Vector2d& q) {
      if (Cells::holds(q.x(), q.y())) seen_[seen_at(Cells::cell_of(q.x()), Cells::cell_of(q.y()))] = 1;
    });
  }
}

void SurfaceMap::spread_likelihood(const SurfaceCell& cell) {
  // exp(-d^2 / (2 s^2)) with s of a cell, by the distance between cells.
  static constexpr std::uint8_t kBell[kLikely + 1][kLikely + 1] = {{255, 155, 35}, {155, 94, 21}, {35, 21, 5}};
  for (std::int32_t dy = -kLikely; dy <= kLikely; ++dy) {
    for (std::int32_t dx = -kLikely; dx <= kLikely; ++dx) {
      const std::int32_t column = cell.column + dx, row = cell.row + dy;
      const std::uint8_t bell = kBell[dy < 0 ? -dy : dy][dx < 0 ? -dx : dx];
      std::uint8_t& value = field_[0][at(column, row)];
      if (bell <= value) continue;
      value = bell;
      raise(1, column / kShrink, row / kShrink, bell);
    }
  }
}

// A value goes to the block that holds it, and to the blocks to the left and below, whose neighbour that is.
void SurfaceMap::raise(std::uint32_t level, std::int32_t x, std::int32_t y, std::uint8_t value) {
  const std::int32_t side = kSide >> (2U * level);
  for (std::int32_t v = y > 0 ? y - 1 : 0; v <= y; ++v) {
    for (std::int32_t u = x > 0 ? x - 1 : 0; u <= x; ++u) {
      std::uint8_t& most = field_[level][static_cast<std::uint32_t>(v * side + u)];
      if (value <= most) continue;
      most = value;
      if (level + 1 < kLevels) raise(level + 1, u / kShrink, v / kShrink, value);
    }
  }
}

void SurfaceMap::finish() {
  const auto slot_at = [this](std::int32_t column, std::int32_t row) { return &nearest_[at(column, row)]; };
  cells_.make_surfaces(slot_at);
  for (std::uint32_t k = 0; k < cells_.used(); ++k) {
    cells_.spread(k, kReach, slot_at);
    spread_likelihood(cells_.cell(k));
  }
}

std::uint32_t SurfaceMap::likelihood(std::uint32_t level, std::int32_t cell_x, std::int32_t cell_y) const {
  const std::int32_t side = kSide >> (2U * level);
  if (cell_x < 0 || cell_x >= side || cell_y < 0 || cell_y >= side) return 0;
  return field_[level][static_cast<std::uint32_t>(cell_y * side + cell_x)];
}

}  // namespace pose_wall::planar
