// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The points of a measured frame with what became of them, as a file for viewers of point clouds.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pose_wall.h"

namespace pose_wall::tools {

struct AnnotatedPoint {
  float x_base_m, y_base_m, z_base_m;
  std::uint32_t label;  // pose_wall_label
  float residual_m;     // signed distance to the plane of its label, + on the machine's side; NaN for other
  std::uint32_t rgb;    // 0x00RRGGBB, the colours of the pictures
};

std::vector<AnnotatedPoint> annotated_points(const pose_wall_points& points, const pose_wall_result& result);

enum class CloudFormat { kPcd, kPly };

// A whole file: binary PCD 0.7 or binary little-endian PLY, `comment` in its head.
std::string annotated_cloud(const std::vector<AnnotatedPoint>& points, CloudFormat format, const std::string& comment);

// Whether a file that begins so was made by annotated_cloud.
bool is_annotated_cloud(const std::string& beginning);

}  // namespace pose_wall::tools
