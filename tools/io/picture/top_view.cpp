// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/language/engine_words.hpp"
#include "io/numbers/angles.hpp"
#include "io/picture/palette.hpp"
#include "io/picture/parts.hpp"
#include "io/picture/point_layers.hpp"
#include "io/picture/viewport.hpp"

namespace pose_wall::tools::picture {
namespace {

// One of the four distances: from a sampling point square to its wall.
struct Distance {
  uint32_t quantity;
  const char* name;
  const char* s_key;
  bool left;
};
constexpr Distance kDistances[] = {{POSE_WALL_D_LF, "d_LF", "s_front", true},
                                   {POSE_WALL_D_LB, "d_LB", "s_back", true},
                                   {POSE_WALL_D_RF, "d_RF", "s_front", false},
                                   {POSE_WALL_D_RB, "d_RB", "s_back", false}};

constexpr double kView_m = 11.0;       // shown ahead and behind, unless walls end sooner
constexpr double kBeyondWall_m = 1.1;  // shown behind the walls

Viewport view_of(const Box& box, const FrameScene& scene, const DrawnFrame& frame) {
  Range along{-kView_m, kView_m};
  Range left{-1.6, 1.6};
  for (const pose_wall_plane* plane : {&scene.result->left, &scene.result->right}) {
    const DrawnPlane wall = frame.wall(*plane);
    if (!wall.found) continue;
    left.include(wall.left_at(-3.0, 0.0));
    left.include(wall.left_at(3.0, 0.0));
  }
  for (const Distance& distance : kDistances) {
    const double value = scene.result->quantity[distance.quantity].value;
    if (std::isfinite(value)) left.include(distance.left ? value : -value);
  }
  return Viewport({box.corner.x, box.corner.y + 20.0}, box.width, box.height - 34.0, along,
                  {left.low - kBeyondWall_m, left.high + kBeyondWall_m});
}

void draw_grid(Svg& svg, const Box& box, const Viewport& view) {
  const Range along = view.right_m();
  constexpr int kStep_m = 5;
  const int last = static_cast<int>(along.high) / kStep_m;
  for (int metre = -last * kStep_m; metre <= last * kStep_m; metre += kStep_m) {
    const double x = view(metre, 0.0).x;
    svg.line({x, box.corner.y + 30.0}, {x, box.bottom() - 22.0}, {kGrid, 1.0});
    const std::string words = metre == 0 ? "0 m" : fmt::format("{:+} m", metre);
    svg.text({x, box.bottom() - 8.0}, words, {kFaintInk, 11.0, Anchor::kMiddle});
  }
}

void draw_wall(Svg& svg, const Viewport& view, const DrawnFrame& frame, const pose_wall_plane& plane,
               std::string_view colour, std::string_view side) {
  const DrawnPlane wall = frame.wall(plane);
  if (!wall.found) return;
  const Range along = view.right_m();
  const auto at = [&](double along_m) { return view(along_m, wall.left_at(along_m, 0.0)); };
  svg.line(at(along.low), at(along.high), {colour, 1.2, "3 6"});
  const double from_m = std::max(along.low, wall.extent_min_m);
  const double to_m = std::min(along.high, wall.extent_max_m);
  if (from_m < to_m) svg.line(at(from_m), at(to_m), {colour, 2.6});

  const double outwards = wall.left_at(0.0, 0.0) > 0.0 ? -1.0 : 1.0;
  const Pixel foot = at(along.low + 0.35);
  const std::string words = say("{}: {} inliers, rms {:.0f} mm, {:+.1f} to {:+.1f} m", side, plane.inliers,
                                1000.0 * plane.rms_m, plane.extent_min_m, plane.extent_max_m);
  const double y = std::clamp(foot.y + outwards * 26.0 + 4.0, view.corner().y + 26.0, view.corner().y + view.height());
  svg.text({foot.x, y}, words, {colour, 12.5, Anchor::kStart, true, kPanel});
}

void draw_machine(Svg& svg, const Viewport& view, const DrawnFrame& frame) {
  const auto at = [&](double forward_m, double left_m) {
    const Drawn p = frame.from_machine(forward_m, left_m, 0.0);
    return view(p.along, p.left);
  };
  const double nose = 0.5 * kMachineLength_m;
  const double flank = 0.5 * kMachineWidth_m;
  svg.polygon({at(-nose, flank), at(nose, flank), at(nose, -flank), at(-nose, -flank)}, kMachine, {kMachineRim, 1.6});
  // Tracks, 1.4 m long and 1 m apart; the outline is drawn around them.
  for (const double side : {0.5, -0.5}) svg.line(at(-0.7, side), at(0.7, side), {kMachineRim, 5.0});
  svg.line(at(-nose + 0.3, 0.0), at(nose + 0.55, 0.0), {kMachineRim, 2.0});
  svg.polygon({at(nose + 0.85, 0.0), at(nose + 0.5, 0.17), at(nose + 0.5, -0.17)}, kMachineRim, {kMachineRim, 1.0});
  svg.circle(at(0.0, 0.0), 5.0, kPanel, {kInk, 2.0});
}

// The drawing shows this frame's own value where there is one: a smoothed value would not fit the line beside it. The
// word sets it apart from the value in the table.
std::string kind_of(const pose_wall_value& value) {
  return std::isfinite(value.raw) ? tr("raw") : state_words(value.state);
}

// The machine's axis against the road's direction, with the angle between them.
void draw_yaw(Svg& svg, const Viewport& view, const DrawnFrame& frame, const pose_wall_value& yaw) {
  if (!frame.has_yaw()) return;
  constexpr double kArm_m = 5.2;
  std::vector<Pixel> arc;
  for (int step = 0; step <= 24; ++step) {
    const double angle = -frame.yaw_rad() * step / 24.0;
    arc.push_back(view(kArm_m * std::cos(angle), kArm_m * std::sin(angle)));
  }
  svg.line(view(0.0, 0.0), view(kArm_m + 0.5, 0.0), {kFaintInk, 1.2, "7 5"});
  const double reach = kArm_m + 0.3;
  svg.line(view(0.0, 0.0), view(reach * std::cos(-frame.yaw_rad()), reach * std::sin(-frame.yaw_rad())),
           {kMachineRim, 1.2, "2 4"});
  const std::string_view colour = state_colour(yaw.state);
  svg.polyline(arc, {colour, 3.0});
  const Pixel tip = view(kArm_m + 0.65, 0.0);
  svg.text({tip.x, tip.y + 4.5}, say("{} yaw {:+.2f}°", kind_of(yaw), frame.yaw_rad() * kDegPerRad),
           {colour, 13.5, Anchor::kStart, true, kPanel});
}

void draw_distance(Svg& svg, const Viewport& view, const FrameScene& scene, const DrawnFrame& frame,
                   const Distance& distance) {
  const pose_wall_value& value = scene.result->quantity[distance.quantity];
  const char* const offset_key = distance.left ? "lateral_offset_left" : "lateral_offset_right";
  const double s_m = config_number(scene, distance.s_key);
  const Drawn start = frame.from_machine(s_m, config_number(scene, offset_key), 0.0);
  const Pixel from = view(start.along, start.left);
  const std::string_view colour = state_colour(value.state);
  const double side = distance.left ? 1.0 : -1.0;
  const Anchor anchor = s_m >= 0.0 ? Anchor::kStart : Anchor::kEnd;
  if (!std::isfinite(value.value)) {
    const Pixel beside = view(start.along, start.left + side * 1.2);
    svg.text(beside, say("{} not measured", distance.name), {colour, 13.0, anchor, true, kPanel});
    return;
  }

  const bool is_raw = std::isfinite(value.raw);
  const double shown_m = is_raw ? value.raw : value.value;
  Pixel foot = view(start.along, start.left + side * shown_m);
  const DrawnPlane wall = frame.wall(distance.left ? scene.result->left : scene.result->right);
  if (wall.found) {
    const Drawn& n = wall.normal;
    const double gap = n.along * start.along + n.left * start.left + n.up * start.up + wall.d_m;
    foot = view(start.along - gap * n.along, start.left - gap * n.left);
  }
  svg.line(from, foot, {colour, 2.4, value.state >= POSE_WALL_DEGRADED ? "" : "6 5"});
  svg.circle(foot, 3.6, colour);

  const double shift = anchor == Anchor::kStart ? 9.0 : -9.0;
  const Pixel words{0.45 * from.x + 0.55 * foot.x + shift, 0.45 * from.y + 0.55 * foot.y};
  svg.text(words, fmt::format("{} {} {:.3f} m", kind_of(value), distance.name, shown_m),
           {colour, 15.0, anchor, true, kPanel});
  svg.text({words.x, words.y + 16.0},
           fmt::format("± {:.3f}", is_raw ? value.raw_protection_level : value.protection_level),
           {colour, 12.0, anchor, false, kPanel});
}

void draw_sampling_point(Svg& svg, const Viewport& view, const DrawnFrame& frame, double s_m, double lateral_m) {
  const Drawn p = frame.from_machine(s_m, lateral_m, 0.0);
  svg.circle(view(p.along, p.left), 5.5, kPanel, {kInk, 2.4});
}

}  // namespace

void draw_top_view(Svg& svg, const Box& box, const FrameScene& scene, const DrawnFrame& frame) {
  draw_panel(svg, box,
             frame.has_yaw() ? tr("From above, road to the right; drawn by raw, as this frame alone measured it")
                             : tr("From above, machine's axis to the right"));
  const Viewport view = view_of(box, scene, frame);
  draw_grid(svg, box, view);
  svg.begin_clip({box.corner.x, box.corner.y + 28.0}, box.width, box.height - 50.0);
  draw_points_from_above(svg, view, scene, frame);
  draw_wall(svg, view, frame, scene.result->left, kLeft, tr("left wall"));
  draw_wall(svg, view, frame, scene.result->right, kRight, tr("right wall"));
  draw_machine(svg, view, frame);
  draw_yaw(svg, view, frame, scene.result->quantity[POSE_WALL_YAW]);
  for (const Distance& distance : kDistances) draw_distance(svg, view, scene, frame, distance);
  for (const char* key : {"s_front", "s_back"}) {
    for (const char* offset : {"lateral_offset_left", "lateral_offset_right"}) {
      draw_sampling_point(svg, view, frame, config_number(scene, key), config_number(scene, offset));
    }
  }
  svg.end_clip();
  scale_bar(svg, view, {box.right() - 20.0, box.corner.y + 30.0}, kInk);
}

}  // namespace pose_wall::tools::picture
