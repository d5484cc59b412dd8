// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// One frame as a picture: top view, cross-section and the seven values with their protection levels.
#pragma once

#include <string>

#include "pose_wall.h"

namespace pose_wall::tools::picture {

// The input of a picture. Pointers must hold for the call only.
struct FrameScene {
  const pose_wall_config* config;
  const pose_wall_result* result;
  const pose_wall_points* points;
  std::string title;
  std::string subtitle;
  const double* truth = nullptr;  // the seven quantities' true values, if known (NaN: not known)
};

// The SVG document. The same scene gives the same text.
std::string frame_picture(const FrameScene& scene);

}  // namespace pose_wall::tools::picture
