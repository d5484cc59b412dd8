// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/picture/spectra_diagram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "io/picture/palette.hpp"
#include "io/picture/svg.hpp"

namespace pose_wall::tools::picture {
namespace {

constexpr double kPanelWidth = 320.0, kPanelHeight = 250.0, kGap = 70.0, kMargin = 60.0, kHead = 66.0;
constexpr std::size_t kColumns = 3;
constexpr double kShortest_m = 0.1, kLongest_m = 10.0, kLow_m = 1e-4, kHigh_m = 0.3;
constexpr std::array<std::string_view, 6> kRoads = {"#22282e", "#c63f28", "#2274a5", "#d9a01f", "#1e8e4f", "#7a4ea3"};

double along(double value, double low, double high) {
  return std::log(std::clamp(value, low, high) / low) / std::log(high / low);
}

class Panel {
 public:
  explicit Panel(std::size_t index)
      : corner_{kMargin + static_cast<double>(index % kColumns) * (kPanelWidth + kGap),
                kHead + static_cast<double>(index / kColumns) * (kPanelHeight + kGap)} {}

  Pixel at(double length_m, double rms_m) const {
    return {corner_.x + kPanelWidth * along(length_m, kShortest_m, kLongest_m),
            corner_.y + kPanelHeight * (1.0 - along(rms_m, kLow_m, kHigh_m))};
  }

  void draw_ground(Svg& svg, const std::string& title) const {
    svg.rectangle(corner_, kPanelWidth, kPanelHeight, kPanel);
    const Stroke grid{kGrid, 1.0};
    for (const double length_m : {0.1, 0.3, 1.0, 3.0, 10.0}) {
      svg.line(at(length_m, kLow_m), at(length_m, kHigh_m), grid);
      const Pixel below = at(length_m, kLow_m);
      svg.text({below.x, below.y + 17.0}, fmt::format("{:g} m", length_m), {kInk, 12.0, Anchor::kMiddle});
    }
    for (const double rms_m : {1e-4, 1e-3, 1e-2, 1e-1}) {
      svg.line(at(kShortest_m, rms_m), at(kLongest_m, rms_m), grid);
      const Pixel beside = at(kShortest_m, rms_m);
      svg.text({beside.x - 8.0, beside.y + 4.0}, fmt::format("{:g} mm", 1e3 * rms_m), {kInk, 12.0, Anchor::kEnd});
    }
    svg.text({corner_.x, corner_.y - 8.0}, title, {kInk, 14.0, Anchor::kStart, true});
  }

  void draw_line(Svg& svg, const SpectrumLine& line, std::string_view colour) const {
    std::vector<Pixel> median, rough;
    for (std::size_t i = 0; i < line.length_m.size(); ++i) {
      median.push_back(at(line.length_m[i], line.median_m[i]));
      rough.push_back(at(line.length_m[i], line.rough_m[i]));
    }
    svg.polyline(rough, {colour, 1.0, "4 3"});
    svg.polyline(median, {colour, 2.2});
  }

 private:
  Pixel corner_;
};

}  // namespace

std::string spectra_diagram(const std::vector<SpectraPanel>& panels) {
  const std::size_t rows = (panels.size() + kColumns - 1) / kColumns;
  Svg svg(2.0 * kMargin + static_cast<double>(kColumns) * (kPanelWidth + kGap) - kGap,
          kHead + static_cast<double>(rows) * (kPanelHeight + kGap), kPaper);
  double x = kMargin;
  for (std::size_t i = 0; !panels.empty() && i < panels.front().lines.size(); ++i) {
    const std::string& road = panels.front().lines[i].road;
    svg.line({x, 26.0}, {x + 26.0, 26.0}, {kRoads[i % kRoads.size()], 2.2});
    svg.text({x + 32.0, 30.0}, road, {kInk, 13.0});
    x += 56.0 + 7.5 * static_cast<double>(road.size());
  }
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Panel panel(i);
    panel.draw_ground(svg, panels[i].title);
    for (std::size_t k = 0; k < panels[i].lines.size(); ++k) {
      panel.draw_line(svg, panels[i].lines[k], kRoads[k % kRoads.size()]);
    }
  }
  return svg.document();
}

}  // namespace pose_wall::tools::picture
