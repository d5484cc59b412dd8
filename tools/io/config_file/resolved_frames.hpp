// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The machine's axes and sampling points as the config resolves them: what a person must see before trusting "left".

#pragma once

#include <array>
#include <string>

#include "pose_wall.hpp"

namespace pose_wall::tools {

using Vector3 = std::array<double, 3>;

struct ResolvedFrames {
  std::string forward_axis;
  Vector3 forward_base{};
  Vector3 left_base{};
  Vector3 up_base{};
  // In the order of the four distances: left front, left back, right front, right back.
  std::array<Vector3, 4> sampling_points_base_m{};
  Vector3 extrinsic_position_m{};
  Vector3 extrinsic_roll_pitch_yaw_deg{};
};

ResolvedFrames resolve_frames(const api::Config& config);

// Several lines for a log or a page, each starting with `indent`.
std::string resolved_frames_text(const ResolvedFrames& frames, const std::string& indent);

// What positive angles mean under this forward_axis, and where that is another than ROS or a reader expects. Lines as
// above.
std::string signs_text(const ResolvedFrames& frames, const std::string& indent);

}  // namespace pose_wall::tools
