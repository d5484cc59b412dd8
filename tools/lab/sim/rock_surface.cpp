// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/rock_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace pose_wall::tools::sim {

Placement Survey::at(double frame) const {
  const double last = static_cast<double>(path.size() - 1);
  const double within = std::clamp(frame, 0.0, last);
  const auto before = static_cast<std::size_t>(std::floor(within));
  const Placement& a = path[before];
  const Placement& b = path[std::min(before + 1, path.size() - 1)];
  const double share = within - static_cast<double>(before);
  if (!(share > 0.0)) return a;
  const Eigen::Quaterniond turned = Eigen::Quaterniond(a.R_road_base).slerp(share, Eigen::Quaterniond(b.R_road_base));
  return {turned.toRotationMatrix(), a.origin_road + share * (b.origin_road - a.origin_road)};
}

}  // namespace pose_wall::tools::sim
