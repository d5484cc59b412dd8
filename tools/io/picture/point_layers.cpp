// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/picture/point_layers.hpp"

#include <array>
#include <vector>

#include "io/picture/palette.hpp"
#include "io/picture/parts.hpp"

namespace pose_wall::tools::picture {
namespace {

constexpr uint32_t kDotsMax = 20000;
// Unused points first, so that they do not hide the used ones.
constexpr std::array<uint8_t, 4> kOrder = {POSE_WALL_LABEL_OTHER, POSE_WALL_LABEL_FLOOR, POSE_WALL_LABEL_LEFT,
                                           POSE_WALL_LABEL_RIGHT};

template <typename Keep, typename Place>
void draw_layers(Svg& svg, const FrameScene& scene, const DrawnFrame& frame, double diameter, Keep keep, Place place) {
  const pose_wall_points& points = *scene.points;
  const uint32_t stride = points.count / kDotsMax + 1;
  std::array<std::vector<Pixel>, kOrder.size()> layers;
  for (uint32_t i = 0; i < points.count; i += stride) {
    const Drawn p = frame.from_base(static_cast<double>(points.x_base_m[i]), static_cast<double>(points.y_base_m[i]),
                                    static_cast<double>(points.z_base_m[i]));
    const std::size_t label = points.label[i] < kOrder.size() ? points.label[i] : std::size_t{POSE_WALL_LABEL_OTHER};
    if (keep(p, label)) layers[label].push_back(place(p));
  }
  for (const uint8_t label : kOrder) {
    svg.dots(layers[label], diameter, label_colour(label), label == POSE_WALL_LABEL_OTHER ? 0.6 : 0.5);
  }
}

}  // namespace

void draw_points_from_above(Svg& svg, const Viewport& view, const FrameScene& scene, const DrawnFrame& frame) {
  // The roof would lie over everything.
  const double roof_m = frame.floor_up_m() + config_number(scene, "wall_z_max");
  const Range along = view.right_m();
  const Range left = view.up_m();
  const auto keep = [&](const Drawn& p, std::size_t label) {
    const bool inside = p.along > along.low && p.along < along.high && p.left > left.low && p.left < left.high;
    return inside && (label != POSE_WALL_LABEL_OTHER || p.up < roof_m);
  };
  draw_layers(svg, scene, frame, 2.2, keep, [&](const Drawn& p) { return view(p.along, p.left); });
}

void draw_points_across(Svg& svg, const Viewport& view, const FrameScene& scene, const DrawnFrame& frame,
                        Range slab_along_m) {
  const auto keep = [&](const Drawn& p, std::size_t) {
    return p.along > slab_along_m.low && p.along < slab_along_m.high;
  };
  draw_layers(svg, scene, frame, 2.0, keep, [&](const Drawn& p) { return view(-p.left, p.up); });
}

}  // namespace pose_wall::tools::picture
