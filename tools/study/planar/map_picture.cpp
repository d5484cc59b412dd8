// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/map_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "io/picture/palette.hpp"
#include "io/picture/parts.hpp"
#include "io/picture/svg.hpp"
#include "io/picture/viewport.hpp"
#include "io/terminal/text_table.hpp"
#include "study/planar/indexed_png.hpp"
#include "study/report/columns.hpp"

namespace pose_wall::tools {
namespace {

using picture::Anchor;
using picture::Pixel;
using picture::Svg;

constexpr double kMargin = 36.0;  // numbers of the y axis stand in it
constexpr double kHead = 84.0;
constexpr double kFoot = 56.0;
constexpr double kMapWidth = 1300.0, kMapHeight = 900.0;  // at most
constexpr double kLeastWidth = 720.0;                     // of heads and legends
constexpr int kOccupied = 65, kFree = 35;                 // per cent, as the map's file has it

// In the order of the palette.
enum Shade : std::uint8_t { kUnknownShade, kFreeShade, kThingShade };
constexpr std::array<Rgb, 4> kShades = {{{222, 219, 212}, {255, 255, 255}, {34, 40, 46}, {255, 255, 255}}};

Shade shade_of(std::int8_t cell) {
  if (cell >= kOccupied) return kThingShade;
  return cell >= 0 && cell <= kFree ? kFreeShade : kUnknownShade;
}

// Cells of the grid that are shown; the end is behind the last.
struct Window {
  std::uint32_t column = 0, row = 0, column_end = 0, row_end = 0;
};

struct ShownBox {
  double x_min_m = INFINITY, y_min_m = INFINITY, x_max_m = -INFINITY, y_max_m = -INFINITY;
  void include(double x_m, double y_m) {
    x_min_m = std::min(x_min_m, x_m);
    x_max_m = std::max(x_max_m, x_m);
    y_min_m = std::min(y_min_m, y_m);
    y_max_m = std::max(y_max_m, y_m);
  }
};

std::uint32_t cell_at(double place_m, double origin_m, double resolution_m, std::uint32_t most) {
  const double cell = std::floor((place_m - origin_m) / resolution_m);
  if (!(cell > 0.0)) return 0;
  return cell >= static_cast<double>(most) ? most : static_cast<std::uint32_t>(cell);
}

Window window_of(const MapScene& scene) {
  const pose_wall_planar_grid& grid = scene.grid;
  const Window all{0, 0, grid.width, grid.height};
  if (!(scene.margin_m > 0.0)) return all;
  ShownBox corners;
  for (const MapLine& line : scene.lines) {
    for (const MapPlace& place : line.places) corners.include(place.x_m, place.y_m);
  }
  for (const MapMachine& machine : scene.machines) corners.include(machine.base.x_m, machine.base.y_m);
  if (!(corners.x_min_m <= corners.x_max_m)) return all;
  const double size = grid.resolution_m;
  const Window window{cell_at(corners.x_min_m - scene.margin_m, grid.origin_x_m, size, grid.width),
                      cell_at(corners.y_min_m - scene.margin_m, grid.origin_y_m, size, grid.height),
                      cell_at(corners.x_max_m + scene.margin_m, grid.origin_x_m, size, grid.width),
                      cell_at(corners.y_max_m + scene.margin_m, grid.origin_y_m, size, grid.height)};
  return window.column < window.column_end && window.row < window.row_end ? window : all;
}

// Blocks of `step` cells as a pixel each: a thing wins, then free.
std::vector<std::uint8_t> shades_of(const pose_wall_planar_grid& grid, const Window& window, std::uint32_t step,
                                    std::uint32_t width, std::uint32_t height) {
  std::vector<std::uint8_t> pixels(std::size_t{width} * height, kUnknownShade);
  for (std::uint32_t row = window.row; row < window.row_end; ++row) {
    const std::size_t down = height - 1 - (row - window.row) / step;
    for (std::uint32_t column = window.column; column < window.column_end; ++column) {
      std::uint8_t& pixel = pixels[down * width + (column - window.column) / step];
      pixel = std::max<std::uint8_t>(pixel, shade_of(grid.cells[std::size_t{row} * grid.width + column]));
    }
  }
  return pixels;
}

// From metres of the map to pixels of the page.
struct Page {
  double pixels_per_m = 1.0;
  double left_m = 0.0, top_m = 0.0;  // the map's corner
  Pixel corner{kMargin, kHead};
  double width = 0.0, height = 0.0;

  Pixel operator()(const MapPlace& place) const {
    return {corner.x + (place.x_m - left_m) * pixels_per_m, corner.y + (top_m - place.y_m) * pixels_per_m};
  }
};

MapPlace placed(const pose_wall_planar_pose& base, const MapPlace& p) {
  const double c = std::cos(base.yaw_rad);
  const double s = std::sin(base.yaw_rad);
  return {base.x_m + c * p.x_m - s * p.y_m, base.y_m + s * p.x_m + c * p.y_m};
}

// On the page.
struct PixelBox {
  double left, top, right, bottom;

  bool meets(const PixelBox& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
  bool lies_in(const PixelBox& outer) const {
    return left >= outer.left && right <= outer.right && top >= outer.top && bottom <= outer.bottom;
  }
};

PixelBox box_round(const std::vector<Pixel>& corners) {
  PixelBox box{corners.front().x, corners.front().y, corners.front().x, corners.front().y};
  for (const Pixel& p : corners) {
    box = {std::min(box.left, p.x), std::min(box.top, p.y), std::max(box.right, p.x), std::max(box.bottom, p.y)};
  }
  return box;
}

// Words beside things of the map, drawn where they cover no others and are not cut off.
class Labels {
 public:
  explicit Labels(const Page& page)
      : frame_{page.corner.x, page.corner.y, page.corner.x + page.width, page.corner.y + page.height} {}

  void draw(Svg& svg, const PixelBox& thing, const std::string& words, std::string_view colour) {
    if (words.empty()) return;
    constexpr double kSize = 13.0, kGap = 6.0, kLine = 1.2 * kSize;
    constexpr double kAscent = 0.8 * kSize, kDescent = 0.25 * kSize, kColumn = 0.65 * kSize;  // of bold letters
    constexpr int kLines = 4;
    const double width = kColumn * static_cast<double>(shown_width(words));
    const double x = std::max(std::min(thing.left, frame_.right - width), frame_.left);
    const double above = thing.top - kGap, below = thing.bottom + kGap + kAscent;
    const auto box_at = [&](double y) { return PixelBox{x, y - kAscent, x + width, y + kDescent}; };
    const auto is_free = [&](double y) {
      const PixelBox box = box_at(y);
      return box.lies_in(frame_) &&
             std::none_of(taken_.begin(), taken_.end(), [&box](const PixelBox& other) { return box.meets(other); });
    };
    double y = above;
    for (int line = 0; line < kLines && !is_free(y); ++line) {
      y = above - line * kLine;
      if (!is_free(y)) y = below + line * kLine;
    }
    taken_.push_back(box_at(y));
    svg.text({x, y}, words, {colour, kSize, Anchor::kStart, true, picture::kPanel});
  }

 private:
  PixelBox frame_;
  std::vector<PixelBox> taken_;
};

// The box of what was drawn.
PixelBox draw_machine(Svg& svg, const Page& page, const MapMachine& machine) {
  const double arrow_m = 14.0 / page.pixels_per_m;
  std::vector<MapPlace> outline = machine.outline_m;
  if (outline.empty()) outline = {{arrow_m, 0.0}, {-0.6 * arrow_m, 0.5 * arrow_m}, {-0.6 * arrow_m, -0.5 * arrow_m}};
  std::vector<Pixel> corners;
  for (const MapPlace& p : outline) corners.push_back(page(placed(machine.base, p)));
  svg.polygon(corners, machine.outline_m.empty() ? machine.colour : std::string_view("none"), {machine.colour, 2.0});
  if (!machine.outline_m.empty()) {
    const MapPlace nose{std::max_element(outline.begin(), outline.end(),
                                         [](const MapPlace& a, const MapPlace& b) { return a.x_m < b.x_m; })
                            ->x_m,
                        0.0};
    svg.line(page(placed(machine.base, {0.0, 0.0})), page(placed(machine.base, nose)), {machine.colour, 2.0});
  }
  return box_round(corners);
}

// A round length of some 100 pixels.
double round_length_m(const Page& page) {
  constexpr double kAimed_px = 160.0;
  double length_m = 1.0;
  for (const double candidate_m : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0}) {
    if (candidate_m * page.pixels_per_m <= kAimed_px) length_m = candidate_m;
  }
  return length_m;
}

// Marks on the left and lower edge, by which places can be read off: `plan` takes them.
void draw_axes(Svg& svg, const Page& page) {
  constexpr double kMark = 5.0, kSize = 10.0;
  const double step_m = round_length_m(page);
  const Pixel end{page.corner.x + page.width, page.corner.y + page.height};
  const double right_m = page.left_m + page.width / page.pixels_per_m;
  const double bottom_m = page.top_m - page.height / page.pixels_per_m;
  const auto number = [](double value_m) { return fmt::format("{:g}", value_m + 0.0); };
  for (double x_m = step_m * std::ceil(page.left_m / step_m); x_m <= right_m; x_m += step_m) {
    const double x = page({x_m, 0.0}).x;
    svg.line({x, end.y}, {x, end.y + kMark}, {picture::kFaintInk, 1.0});
    svg.text({x, end.y + kMark + kSize}, number(x_m), {picture::kFaintInk, kSize, Anchor::kMiddle});
  }
  for (double y_m = step_m * std::ceil(bottom_m / step_m); y_m <= page.top_m; y_m += step_m) {
    const double y = page({0.0, y_m}).y;
    svg.line({page.corner.x - kMark, y}, {page.corner.x, y}, {picture::kFaintInk, 1.0});
    svg.text({page.corner.x - kMark - 2.0, y + 0.35 * kSize}, number(y_m), {picture::kFaintInk, kSize, Anchor::kEnd});
  }
  svg.text({end.x + 13.0, end.y + kMark + kSize}, "x, m", {picture::kFaintInk, kSize});
  svg.text({page.corner.x, page.corner.y - kMark}, "y, m", {picture::kFaintInk, kSize, Anchor::kEnd});
}

// Right of the legend also below a narrow map.
void draw_scale(Svg& svg, const Page& page) {
  const double length_m = round_length_m(page);
  const Pixel end{page.corner.x + std::max(page.width, kLeastWidth), page.corner.y + page.height + 34.0};
  const Pixel start{end.x - length_m * page.pixels_per_m, end.y};
  svg.line(start, end, {picture::kInk, 2.0});
  for (const Pixel& tip : {start, end}) svg.line({tip.x, tip.y - 4.0}, {tip.x, tip.y + 4.0}, {picture::kInk, 2.0});
  svg.text({start.x - 8.0, end.y + 4.0}, fmt::format("{:g} m", length_m), {picture::kInk, 12.0, Anchor::kEnd});
}

void draw_legend(Svg& svg, const Page& page, const std::vector<LegendEntry>& legend) {
  double x = page.corner.x + 6.0;
  const double y = page.corner.y + page.height + 38.0;
  for (const LegendEntry& entry : legend) {
    svg.line({x - 6.0, y - 4.0}, {x + 10.0, y - 4.0}, {entry.colour, 3.0});
    svg.text({x + 16.0, y}, entry.words, {picture::kFaintInk, 12.0});
    x += 44.0 + 7.5 * static_cast<double>(entry.words.size());
  }
}

}  // namespace

std::string map_picture(const MapScene& scene) {
  const pose_wall_planar_grid& grid = scene.grid;
  const Window window = window_of(scene);
  const double columns = window.column_end - window.column;
  const double rows = window.row_end - window.row;
  const double scale = std::min(kMapWidth / columns, kMapHeight / rows);  // pixels a cell
  const auto step = static_cast<std::uint32_t>(std::max(1.0, std::ceil(0.5 / scale)));
  const auto width = static_cast<std::uint32_t>(std::ceil(columns / step));
  const auto height = static_cast<std::uint32_t>(std::ceil(rows / step));
  const double size_m = grid.resolution_m;
  Page page;
  page.pixels_per_m = scale / size_m;
  page.width = scale * step * width;
  page.height = scale * step * height;
  page.left_m = grid.origin_x_m + size_m * window.column;
  page.top_m = grid.origin_y_m + size_m * (window.row + step * height);

  Svg svg(std::max(page.width, kLeastWidth) + 2.0 * kMargin, page.height + kHead + kFoot, picture::kPaper);
  svg.text({kMargin, 38.0}, scene.title, {picture::kInk, 21.0, Anchor::kStart, true});
  svg.text({kMargin, 62.0}, scene.subtitle, {picture::kFaintInk, 13.5});
  if (!scene.warning.empty()) svg.text({kMargin, 79.0}, scene.warning, {kBadColour, 12.5});
  const std::string png = indexed_png(width, height, shades_of(grid, window, step, width, height), kShades);
  svg.image(page.corner, page.width, page.height, "data:image/png;base64," + report::base64(png));
  svg.begin_clip(page.corner, page.width, page.height);
  for (const MapLine& line : scene.lines) {
    std::vector<Pixel> points;
    for (const MapPlace& place : line.places) points.push_back(page(place));
    svg.polyline(points, {line.colour, line.width_px, line.dashes});
  }
  struct Labelled {
    PixelBox thing;
    const std::string* words;
    std::string_view colour;
  };
  std::vector<Labelled> labelled;
  for (const MapDot& dot : scene.dots) {
    const Pixel at = page(dot.at);
    svg.circle(at, 4.0, dot.colour);
    labelled.push_back({{at.x - 4.0, at.y - 4.0, at.x + 4.0, at.y + 4.0}, &dot.words, dot.colour});
  }
  for (const MapMachine& machine : scene.machines) {
    labelled.push_back({draw_machine(svg, page, machine), &machine.words, machine.colour});
  }
  Labels labels(page);
  for (const Labelled& one : labelled) labels.draw(svg, one.thing, *one.words, one.colour);
  svg.end_clip();
  draw_axes(svg, page);
  draw_scale(svg, page);
  draw_legend(svg, page, scene.legend);
  return svg.document();
}

std::vector<MapPlace> roadheader_outline() {
  constexpr double kNose_m = 0.5 * picture::kMachineLength_m;
  constexpr double kFlank_m = 0.5 * picture::kMachineWidth_m;
  return {{kNose_m, kFlank_m}, {kNose_m, -kFlank_m}, {-kNose_m, -kFlank_m}, {-kNose_m, kFlank_m}};
}

}  // namespace pose_wall::tools
