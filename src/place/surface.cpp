// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "place/surface.hpp"

namespace pose_wall::planar {

void SurfaceSums::add(const SurfaceCell& cell, double dx, double dy) {
  const double count = cell.count, sx = static_cast<double>(cell.x_m), sy = static_cast<double>(cell.y_m);
  n += count;
  x += sx + count * dx;
  y += sy + count * dy;
  xx += static_cast<double>(cell.xx_m2) + 2.0 * dx * sx + count * dx * dx;
  xy += static_cast<double>(cell.xy_m2) + dx * sy + dy * sx + count * dx * dy;
  yy += static_cast<double>(cell.yy_m2) + 2.0 * dy * sy + count * dy * dy;
}

Surface SurfaceSums::surface(double middle_x, double middle_y) const {
  const double mx = x / n, my = y / n;
  const PrincipalAxes axes(xx / n - mx * mx, xy / n - mx * my, yy / n - my * my);
  const Eigen::Vector2d normal = axes.least();
  Surface out;
  out.x_m = static_cast<float>(middle_x + mx);
  out.y_m = static_cast<float>(middle_y + my);
  out.normal_x = static_cast<float>(normal.x());
  out.normal_y = static_cast<float>(normal.y());
  out.across_m2 = static_cast<float>(axes.least_value > 0.0 ? axes.least_value : 0.0);
  out.along_m2 = static_cast<float>(axes.most_value);
  return out;
}

}  // namespace pose_wall::planar
