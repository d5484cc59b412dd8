// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A part of the page with its own scale: metres to the right and up, pixels to the right and down.
#pragma once

#include <algorithm>

#include "io/picture/svg.hpp"

namespace pose_wall::tools::picture {

struct Range {
  double low;
  double high;
  double length() const { return high - low; }
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

class Viewport {
 public:
  // The largest scale at which both ranges fit into the rectangle; both are then centred in it.
  Viewport(Pixel corner, double width, double height, Range right_m, Range up_m)
      : corner_(corner),
        width_(width),
        height_(height),
        pixels_per_m_(std::min(width / right_m.length(), height / up_m.length())),
        right_centre_m_(0.5 * (right_m.low + right_m.high)),
        up_centre_m_(0.5 * (up_m.low + up_m.high)) {}

  Pixel operator()(double right_m, double up_m) const {
    return {corner_.x + 0.5 * width_ + (right_m - right_centre_m_) * pixels_per_m_,
            corner_.y + 0.5 * height_ - (up_m - up_centre_m_) * pixels_per_m_};
  }
  // The extent of the rectangle, in metres.
  Range right_m() const { return around(right_centre_m_, width_); }
  Range up_m() const { return around(up_centre_m_, height_); }
  double pixels_per_m() const { return pixels_per_m_; }
  Pixel corner() const { return corner_; }
  double width() const { return width_; }
  double height() const { return height_; }

 private:
  Range around(double centre_m, double pixels) const {
    return {centre_m - 0.5 * pixels / pixels_per_m_, centre_m + 0.5 * pixels / pixels_per_m_};
  }

  Pixel corner_;
  double width_;
  double height_;
  double pixels_per_m_;
  double right_centre_m_;
  double up_centre_m_;
};

// A bar of 1 or 2 m with its length, its right end at `end`.
inline void scale_bar(Svg& svg, const Viewport& view, Pixel end, std::string_view colour) {
  const double length_m = view.pixels_per_m() > 60.0 ? 1.0 : 2.0;
  const Pixel start{end.x - length_m * view.pixels_per_m(), end.y};
  svg.line(start, end, {colour, 2.0});
  svg.line({start.x, start.y - 4.0}, {start.x, start.y + 4.0}, {colour, 2.0});
  svg.line({end.x, end.y - 4.0}, {end.x, end.y + 4.0}, {colour, 2.0});
  svg.text({0.5 * (start.x + end.x), end.y - 8.0}, length_m > 1.5 ? "2 m" : "1 m", {colour, 12.0, Anchor::kMiddle});
}

}  // namespace pose_wall::tools::picture
