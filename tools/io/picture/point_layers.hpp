// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Clouds of dots by label, thinned so that the file stays small.
#pragma once

#include "io/picture/drawn_frame.hpp"
#include "io/picture/frame_picture.hpp"
#include "io/picture/svg.hpp"
#include "io/picture/viewport.hpp"

namespace pose_wall::tools::picture {

void draw_points_from_above(Svg& svg, const Viewport& view, const FrameScene& scene, const DrawnFrame& frame);

// Only points within the slab along the road that the section shows.
void draw_points_across(Svg& svg, const Viewport& view, const FrameScene& scene, const DrawnFrame& frame,
                        Range slab_along_m);

}  // namespace pose_wall::tools::picture
