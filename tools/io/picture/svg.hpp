// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Writes SVG elements without knowing their meaning. Coordinates in pixels, one decimal.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pose_wall::tools::picture {

// Words as they stand in SVG or HTML.
std::string escaped(std::string_view words);

struct Pixel {
  double x;
  double y;
};

struct Stroke {
  std::string_view colour;
  double width = 1.0;
  std::string_view dashes = "";  // as in stroke-dasharray
};

enum class Anchor { kStart, kMiddle, kEnd };

struct TextStyle {
  std::string_view colour;
  double size = 13.0;
  Anchor anchor = Anchor::kStart;
  bool bold = false;
  std::string_view halo = "";  // colour of a rim that keeps the text readable over lines
};

class Svg {
 public:
  Svg(double width, double height, std::string_view background);

  void line(Pixel from, Pixel to, const Stroke& stroke);
  void rectangle(Pixel corner, double width, double height, std::string_view fill, double radius = 0.0);
  void circle(Pixel centre, double radius, std::string_view fill, const Stroke& rim = {"none", 0.0});
  void polygon(const std::vector<Pixel>& corners, std::string_view fill, const Stroke& rim);
  void polyline(const std::vector<Pixel>& points, const Stroke& stroke);
  // All dots of one colour as one path: a tenth of the bytes of as many circles.
  void dots(const std::vector<Pixel>& centres, double diameter, std::string_view colour, double opacity);
  // href: a link, or the image itself as data:image/png;base64,... Its pixels stay sharp squares.
  void image(Pixel corner, double width, double height, std::string_view href);
  void text(Pixel at, std::string_view words, const TextStyle& style);
  // Elements up to end_clip() show only inside the rectangle.
  void begin_clip(Pixel corner, double width, double height);
  void end_clip();

  // The whole document.
  std::string document() const;

 private:
  std::string body_;
  int clips_ = 0;
};

}  // namespace pose_wall::tools::picture
