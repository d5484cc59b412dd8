// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "frames/kitti_reader.hpp"

#include <fmt/format.h>

#include <utility>

namespace pose_wall::tools {

Frame read_kitti(Bytes bytes) {
  constexpr std::uint32_t kPointStep = 16;
  if (bytes.size() % kPointStep != 0) {
    throw FrameError(fmt::format("KITTI .bin: {} bytes are not a multiple of {} (x y z intensity, float32 each)",
                                 bytes.size(), kPointStep));
  }
  PointLayout layout;
  layout.point_step = kPointStep;
  layout.count = count_points(bytes.size() / kPointStep, bytes.size(), kPointStep);
  layout.fields = {{"x", {0, POSE_WALL_FIELD_FLOAT32}},
                   {"y", {4, POSE_WALL_FIELD_FLOAT32}},
                   {"z", {8, POSE_WALL_FIELD_FLOAT32}},
                   {"intensity", {12, POSE_WALL_FIELD_FLOAT32}}};
  return describe_frame(std::move(bytes), layout);
}

}  // namespace pose_wall::tools
