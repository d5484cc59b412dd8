// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/scan_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "io/language/language.hpp"
#include "io/picture/palette.hpp"
#include "io/picture/svg.hpp"
#include "io/picture/viewport.hpp"
#include "study/planar/map_picture.hpp"
#include "study/planar/plane_pose.hpp"

namespace pose_wall::tools {
namespace {

using picture::Anchor;
using picture::Pixel;
using picture::Svg;
using picture::Viewport;

constexpr double kPageWidth = 1280.0, kPageHeight = 900.0, kPageMargin = 24.0, kHeadHeight = 84.0, kFootHeight = 46.0;
constexpr double kLeastShown_m = 3.0;

// Along beam `beam` of the scan, in base.
MapPlace along_beam(const SourcedScan& scan, std::size_t beam, double range_m) {
  const pose_wall_planar_pose& sensor = scan.scan.sensor;
  const double angle_rad =
      sensor.yaw_rad + scan.scan.angle_min_rad + static_cast<double>(beam) * scan.scan.angle_step_rad;
  return {sensor.x_m + range_m * std::cos(angle_rad), sensor.y_m + range_m * std::sin(angle_rad)};
}

// Of a cloud by what its rays passed; of a log up to the range.
double seen_free_m(const SourcedScan& scan, const pose_wall_planar_scan_view* view, std::size_t beam) {
  const auto range_m = static_cast<double>(scan.range_m[beam]);
  const double free_m = view != nullptr ? static_cast<double>(view->free_m[beam]) : range_m;
  return std::isfinite(free_m) ? std::min(free_m, scan.scan.range_max_m) : 0.0;
}

std::vector<MapPlace> ends_of(const SourcedScan& scan, const float* ranges_m) {
  std::vector<MapPlace> ends;
  for (std::size_t beam = 0; beam < scan.range_m.size(); ++beam) {
    if (std::isfinite(ranges_m[beam])) ends.push_back(along_beam(scan, beam, static_cast<double>(ranges_m[beam])));
  }
  return ends;
}

void draw_dots(Svg& svg, const Viewport& view, const std::vector<MapPlace>& places, std::string_view colour) {
  std::vector<Pixel> dots;
  for (const MapPlace& place : places) dots.push_back(view(place.x_m, place.y_m));
  svg.dots(dots, 3.0, colour, 1.0);
}

}  // namespace

std::string scan_picture(const SourcedScan& scan, const pose_wall_planar_scan_view* view) {
  const std::vector<MapPlace> surfaces = ends_of(scan, scan.range_m.data());
  picture::Range x_m{-kLeastShown_m, kLeastShown_m};
  picture::Range y_m{-kLeastShown_m, kLeastShown_m};
  for (const MapPlace& place : surfaces) {
    x_m.include(place.x_m);
    y_m.include(place.y_m);
  }
  const Pixel corner{kPageMargin, kHeadHeight};
  const double width = kPageWidth - 2.0 * kPageMargin;
  const double height = kPageHeight - kHeadHeight - kFootHeight;
  const Viewport page(corner, width, height, {x_m.low - 1.0, x_m.high + 1.0}, {y_m.low - 1.0, y_m.high + 1.0});

  Svg svg(kPageWidth, kPageHeight, picture::kPaper);
  svg.text({kPageMargin, 38.0}, std::filesystem::path(scan.name).filename().string(),
           {picture::kInk, 21.0, Anchor::kStart, true});
  svg.text({kPageMargin, 62.0},
           say("{} beams, {} with a range, at {} s. Grey: unknown. White: seen free", scan.range_m.size(),
               surfaces.size(), scan.time),
           {picture::kFaintInk, 13.5});
  svg.rectangle(corner, width, height, "#dedbd4");
  svg.begin_clip(corner, width, height);
  const pose_wall_planar_pose& sensor = scan.scan.sensor;
  std::vector<Pixel> free = {page(sensor.x_m, sensor.y_m)};
  for (std::size_t beam = 0; beam < scan.range_m.size(); ++beam) {
    const MapPlace end = along_beam(scan, beam, seen_free_m(scan, view, beam));
    free.push_back(page(end.x_m, end.y_m));
  }
  svg.polygon(free, picture::kPanel, {"none", 0.0});
  if (view != nullptr) {
    draw_dots(svg, page, ends_of(scan, view->overhead_m), kReverseColour);
    draw_dots(svg, page, ends_of(scan, view->low_m), kClosureColour);
  }
  draw_dots(svg, page, surfaces, picture::kInk);
  const Pixel base = page(0.0, 0.0);
  const Pixel ahead = page(1.0, 0.0);
  svg.line(base, ahead, {kTrailColour, 2.5});
  svg.circle(base, 5.0, kTrailColour);
  svg.text({ahead.x + 6.0, ahead.y + 4.0}, "x", {kTrailColour, 13.0, Anchor::kStart, true, picture::kPanel});
  svg.end_clip();
  picture::scale_bar(svg, page, {kPageWidth - kPageMargin, kPageHeight - 16.0}, picture::kInk);
  double x = kPageMargin + 6.0;
  const auto entry = [&](std::string_view colour, const std::string& words) {
    svg.circle({x, kPageHeight - 22.0}, 4.0, colour);
    svg.text({x + 10.0, kPageHeight - 18.0}, words, {picture::kFaintInk, 12.0});
    x += 40.0 + 7.5 * static_cast<double>(words.size());
  };
  entry(picture::kInk, tr("surfaces"));
  if (view != nullptr) {
    entry(kClosureColour, tr("low things"));
    entry(kReverseColour, tr("things overhead"));
  }
  return svg.document();
}

}  // namespace pose_wall::tools
