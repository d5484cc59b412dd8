// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "containers/direction_grid.hpp"

#include <cmath>

namespace pose_wall {
namespace {

constexpr std::uint32_t kCountMax = 0xFFFF;

// Way around the square |x| + |y| = 1 from +X over +Y, 0..4.
double way_of(double x, double y) {
  const double around = std::fabs(x) + std::fabs(y);
  if (!(around > 0.0)) return 0.0;
  const double share = y / around;
  if (x < 0.0) return 2.0 - share;
  return share >= 0.0 ? share : 4.0 + share;
}

}  // namespace

void DirectionGrid::add(const Eigen::Vector3d& ray, std::uint32_t returns) {
  const double up = ray.z() / std::sqrt(ray.squaredNorm());
  const auto column = static_cast<std::uint32_t>(way_of(ray.x(), ray.y()) * (kColumns / 4.0));
  // Rounding may leave the sine of a tiny ray a little outside.
  const auto row = static_cast<std::uint32_t>(up > -1.0 ? (up + 1.0) * (kRows / 2.0) : 0.0);
  std::uint16_t& count = counts_[(row < kRows ? row : kRows - 1) * kColumns + (column < kColumns ? column : 0)];
  const std::uint32_t sum = count + returns;
  count = static_cast<std::uint16_t>(sum < kCountMax ? sum : kCountMax);
}

DirectionGrid::Column DirectionGrid::column(std::uint32_t column) {
  const double way = (column + 0.5) * (4.0 / kColumns);
  const double x = way < 2.0 ? 1.0 - way : way - 3.0;
  const double y = way < 1.0 ? way : (way < 3.0 ? 2.0 - way : way - 4.0);
  const double length2 = x * x + y * y, scale = 1.0 / std::sqrt(length2);
  return {x * scale, y * scale, 1.0 / length2};
}

}  // namespace pose_wall
