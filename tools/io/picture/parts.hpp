// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The parts of the picture; each draws itself into its rectangle of the page.
#pragma once

#include "io/picture/drawn_frame.hpp"
#include "io/picture/frame_picture.hpp"
#include "io/picture/svg.hpp"

namespace pose_wall::tools::picture {

struct Box {
  Pixel corner;
  double width;
  double height;
  double right() const { return corner.x + width; }
  double bottom() const { return corner.y + height; }
};

// From above: points, walls over their supported span, the machine, sampling points and the four distances.
void draw_top_view(Svg& svg, const Box& box, const FrameScene& scene, const DrawnFrame& frame);

// Across the road at the machine, looking ahead: floor, walls with their lean, machine and sensor.
void draw_section(Svg& svg, const Box& box, const FrameScene& scene, const DrawnFrame& frame);

// The seven values, their protection levels, states and reasons, the truth where it is known.
void draw_value_table(Svg& svg, const Box& box, const FrameScene& scene);

// The meaning of the colours.
void draw_legend(Svg& svg, const Box& box);

// White ground and heading of a part.
void draw_panel(Svg& svg, const Box& box, std::string_view heading);

double config_number(const FrameScene& scene, const char* key);

// The roadheader's outline, in metres; see the README of the project.
inline constexpr double kMachineLength_m = 4.5;
inline constexpr double kMachineWidth_m = 1.2;

}  // namespace pose_wall::tools::picture
