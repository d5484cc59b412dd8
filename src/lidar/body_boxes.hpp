// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What belongs to the machine, for every part that reads a cloud: the config's boxes and those of the frame, which tell
// where the boom is now.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/simd/four_floats.hpp"
#include "lidar/box.hpp"
#include "pose_wall.h"

namespace pose_wall {

class BodyBoxes {
 public:
  static constexpr std::uint32_t kOfConfig = 4;                              // body_box_1 to body_box_4
  static constexpr std::uint32_t kMost = kOfConfig + POSE_WALL_INPUT_BOXES;  // and those of the frame

  // origin_base_m: what the points of hold() count from.
  BodyBoxes(const Box (&of_config)[kOfConfig], const pose_wall_cloud& cloud,
            const Eigen::Vector3d& origin_base_m = Eigen::Vector3d::Zero()) {
    for (const Box& box : of_config) add(box, origin_base_m);
    if (cloud.inputs == nullptr) return;
    for (const auto& edges_m : cloud.inputs->body_box) {
      const Box box = box_of(edges_m);
      if (box.is_sound()) add(box, origin_base_m);
    }
  }

  // None holds anything.
  bool empty() const { return count_ == 0; }

  // Which of four points of base lie in one.
  FourTruths hold(const FourPlaces& p) const {
    FourTruths inside = all_four_ints(0);
    for (std::uint32_t k = 0; k < count_; ++k) {
      const float(&edge)[6] = edge_m_[k];
      inside |= (p.x >= edge[0]) & (p.x <= edge[1]) & (p.y >= edge[2]) & (p.y <= edge[3]) & (p.z >= edge[4]) &
                (p.z <= edge[5]);
    }
    return inside;
  }

 private:
  void add(const Box& box, const Eigen::Vector3d& origin_base_m) {
    if (!box.holds_something()) return;
    const double edges_m[6] = {box.x_min, box.x_max, box.y_min, box.y_max, box.z_min, box.z_max};
    for (int k = 0; k < 6; ++k) edge_m_[count_][k] = static_cast<float>(edges_m[k] - origin_base_m(k / 2));
    ++count_;
  }

  float edge_m_[kMost][6] = {};
  std::uint32_t count_ = 0;
};

}  // namespace pose_wall
