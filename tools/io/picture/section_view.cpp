// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <algorithm>
#include <cmath>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/picture/palette.hpp"
#include "io/picture/parts.hpp"
#include "io/picture/point_layers.hpp"
#include "io/picture/viewport.hpp"

namespace pose_wall::tools::picture {
namespace {

constexpr Range kSlab_m{-2.0, 2.0};

Viewport view_of(const Box& box, const FrameScene& scene, const DrawnFrame& frame) {
  Range right{-1.6, 1.6};
  for (const pose_wall_plane* plane : {&scene.result->left, &scene.result->right}) {
    const DrawnPlane wall = frame.wall(*plane);
    if (wall.found) right.include(-wall.left_at(0.0, 0.0));
  }
  const double floor_m = frame.floor_up_m();
  return Viewport({box.corner.x, box.corner.y + 34.0}, box.width, box.height - 44.0,
                  {right.low - 0.9, right.high + 0.9}, {floor_m - 0.55, floor_m + 3.4});
}

void draw_floor(Svg& svg, const Viewport& view, const FrameScene& scene, const DrawnFrame& frame) {
  if (!frame.has_floor()) return;
  const double floor_m = frame.floor_up_m();
  const Range right = view.right_m();
  svg.line(view(right.low, floor_m), view(right.high, floor_m), {kFloor, 3.6});
  const pose_wall_plane& floor = scene.result->floor;
  const Pixel below = view(0.5 * (right.low + right.high), floor_m);
  svg.text({below.x, below.y + 22.0}, say("floor: {} inliers, rms {:.0f} mm", floor.inliers, 1000.0 * floor.rms_m),
           {kFloor, 12.5, Anchor::kMiddle, true, kPanel});
}

void draw_wall(Svg& svg, const Viewport& view, const DrawnFrame& frame, const pose_wall_plane& plane, Range band_up_m,
               std::string_view colour, double label_above_px) {
  const DrawnPlane wall = frame.wall(plane);
  if (!wall.found) return;
  const auto at = [&](double up_m) { return view(-wall.left_at(0.0, up_m), up_m); };
  const Range up = view.up_m();
  svg.line(at(frame.floor_up_m()), at(up.high), {colour, 1.2, "3 6"});
  svg.line(at(band_up_m.low), at(band_up_m.high), {colour, 3.6});
  const Pixel top = at(band_up_m.high);
  const bool left = wall.left_at(0.0, 0.0) > 0.0;
  const double lean_deg = std::round(plane.lean_rad * kDegPerRad * 10.0) / 10.0 + 0.0;  // + 0.0: never "-0.0"
  svg.text({top.x + (left ? 12.0 : -12.0), top.y - label_above_px}, say("lean {:+.1f}°", lean_deg),
           {colour, 12.5, left ? Anchor::kStart : Anchor::kEnd, true, kPanel});
}

// The machine's box stands on the floor below the base origin and is tilted as base is.
void draw_machine(Svg& svg, const Viewport& view, const FrameScene& scene, const DrawnFrame& frame) {
  const double flank = 0.5 * kMachineWidth_m;
  const double height_m = std::max(0.4, -frame.floor_up_m() - 0.15);
  const auto at = [&](double left_m, double up_m) {
    const Drawn p = frame.from_machine(0.0, left_m, up_m);
    return view(-p.left, p.up);
  };
  svg.polygon({at(flank, -height_m), at(flank, -0.25), at(-flank, -0.25), at(-flank, -height_m)}, kMachine,
              {kMachineRim, 1.6});
  for (const double side : {0.5, -0.5}) svg.line(at(side, -height_m + 0.12), at(side, -height_m), {kMachineRim, 12.0});

  const Pixel origin = at(0.0, 0.0);
  svg.line(at(0.0, -0.25), origin, {kMachineRim, 3.0});
  svg.line(at(0.75, 0.0), at(-0.75, 0.0), {kInk, 1.2, "4 4"});
  svg.line(origin, at(0.0, 0.7), {kInk, 1.2, "4 4"});
  const Drawn sensor = frame.from_base(config_number(scene, "extrinsic_x"), config_number(scene, "extrinsic_y"),
                                       config_number(scene, "extrinsic_z"));
  const Pixel lidar = view(-sensor.left, sensor.up);
  svg.circle(lidar, 5.0, kPanel, {kInk, 2.0});
  svg.text({lidar.x + 14.0, lidar.y - 12.0}, tr("LiDAR"), {kInk, 12.0, Anchor::kStart, false, kPanel});
}

}  // namespace

void draw_section(Svg& svg, const Box& box, const FrameScene& scene, const DrawnFrame& frame) {
  draw_panel(svg, box, tr("Across the road at the machine, looking ahead, levelled by the floor"));
  const Viewport view = view_of(box, scene, frame);
  const double floor_m = frame.floor_up_m();
  const Range band{floor_m + config_number(scene, "wall_z_min"), floor_m + config_number(scene, "wall_z_max")};
  svg.begin_clip({box.corner.x, box.corner.y + 30.0}, box.width, box.height - 34.0);
  draw_points_across(svg, view, scene, frame, kSlab_m);
  draw_floor(svg, view, scene, frame);
  // One above the other: between the walls of a narrow road there is no room for both beside each other.
  draw_wall(svg, view, frame, scene.result->left, band, kLeft, 26.0);
  draw_wall(svg, view, frame, scene.result->right, band, kRight, 8.0);
  draw_machine(svg, view, scene, frame);
  svg.end_clip();
  scale_bar(svg, view, {box.right() - 20.0, box.bottom() - 16.0}, kInk);
}

}  // namespace pose_wall::tools::picture
