// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The sizes of the engine's structs in each version of the header; struct_sizes.hpp explains them.

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

}  // namespace pose_wall
