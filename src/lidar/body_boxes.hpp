// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What belongs to the machine, for every part that reads a cloud: the config's boxes and those of the frame, which tell
// where the boom is now.

#pragma once

#include <cstdint>

#include "lidar/box.hpp"
#include "pose_wall.h"

namespace pose_wall {

class BodyBoxes {
 public:
  static constexpr std::uint32_t kOfConfig = 4;                              // body_box_1 to body_box_4
  static constexpr std::uint32_t kMost = kOfConfig + POSE_WALL_INPUT_BOXES;  // and those of the frame

  BodyBoxes(const Box (&of_config)[kOfConfig], const pose_wall_cloud& cloud) {
    for (const Box& box : of_config) add(box);
    if (cloud.inputs == nullptr) return;
    for (const auto& edges_m : cloud.inputs->body_box) {
      const Box box = box_of(edges_m);
      if (box.is_sound()) add(box);
    }
  }

  // Those that hold something, in base.
  const Box* begin() const { return box_; }
  const Box* end() const { return box_ + count_; }

 private:
  void add(const Box& box) {
    if (box.holds_something()) box_[count_++] = box;
  }

  Box box_[kMost] = {};
  std::uint32_t count_ = 0;
};

}  // namespace pose_wall
