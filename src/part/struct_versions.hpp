// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The sizes of the engine's structs in each version of the header; struct_sizes.hpp explains them. And a cloud of any
// version as a whole.

#pragma once

#include <cstddef>

#include "part/struct_sizes.hpp"

namespace pose_wall {

constexpr StructSizes kCloudSizes = {offsetof(pose_wall_cloud, inputs), offsetof(pose_wall_cloud, ring),
                                     sizeof(pose_wall_cloud)};
constexpr StructSizes kResultSizes = {864, sizeof(pose_wall_result), sizeof(pose_wall_result)};
constexpr StructSizes kInputsSizes = {0, offsetof(pose_wall_inputs, odometry), sizeof(pose_wall_inputs)};
constexpr StructSizes kMomentSizes = {0, sizeof(pose_wall_moment), sizeof(pose_wall_moment)};
constexpr StructSizes kSourceSizes = {0, sizeof(pose_wall_image_source), sizeof(pose_wall_image_source)};

// A caller's checked cloud with its inputs, both as this header has them.
struct WholeCloud {
  explicit WholeCloud(const pose_wall_cloud& given) : cloud(read_struct<pose_wall_cloud>(&given, given.struct_size)) {
    if (cloud.inputs == nullptr) return;
    inputs = read_struct<pose_wall_inputs>(cloud.inputs, cloud.inputs->struct_size);
    cloud.inputs = &inputs;
  }
  WholeCloud(const WholeCloud&) = delete;
  WholeCloud& operator=(const WholeCloud&) = delete;

  pose_wall_cloud cloud;
  pose_wall_inputs inputs{};
};

}  // namespace pose_wall
