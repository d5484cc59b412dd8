// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/estimation/tangent_points.hpp"

#include "base/simd/four_turns.hpp"

namespace pose_wall {

void TangentPoints::add(const PointSet& cloud, Span<const std::uint32_t> list) {
  const std::uint32_t room = capacity() - count;
  const Span<const std::uint32_t> added = list.first(list.size() < room ? list.size() : room);
  Eigen::Matrix3d rows;
  rows << frame.u.transpose(), frame.v.transpose(), plane.n.transpose();
  const FourTurns to_frame(rows, -(rows * frame.origin));
  for (std::uint32_t k = 0; k < added.size(); k += kFour) {
    const FourIndices four(added, k);
    const FourPlaces at = to_frame(four.of(cloud.x), four.of(cloud.y), four.of(cloud.z));
    const FourFloats stands_for = four.of(cloud.weight);
    store_four(at.x, &u[count + k]);
    store_four(at.y, &v[count + k]);
    store_four(at.z, &r[count + k]);
    store_four(stands_for, &weight[count + k]);
  }
  count += added.size();
}

}  // namespace pose_wall
