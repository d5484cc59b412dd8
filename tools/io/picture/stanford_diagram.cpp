// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/picture/stanford_diagram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/language/language.hpp"
#include "io/picture/palette.hpp"
#include "io/picture/svg.hpp"

namespace pose_wall::tools::picture {
namespace {

constexpr double kWidth = 860.0;
constexpr double kHeight = 800.0;
constexpr Pixel kCorner{96.0, 76.0};  // upper left of the plot
constexpr double kSide = 640.0;

// Light to dark: few counts to many.
constexpr std::array<std::string_view, 6> kShades = {"#c6dbe8", "#93bfd8", "#5b9cc2", "#2f78a6", "#175480", "#0b3357"};
constexpr std::array<std::string_view, 6> kAlarms = {"#f3b39b", "#ea8a6a", "#de6243", "#c63f28", "#9e2418", "#6e110d"};
constexpr std::string_view kWithinGround = "#f1f7ee";
constexpr std::string_view kBeyondGround = "#fbf0dc";
constexpr std::string_view kMisleadingGround = "#f9dfd8";
constexpr std::string_view kTooWideGround = "#eeeff1";

// At least that of 2: one count has the lightest shade.
double log_of_largest(const StanfordCounts& counts) {
  return std::log(std::max(2.0, static_cast<double>(counts.largest_cell())));
}

class Plot {
 public:
  explicit Plot(const StanfordScale& scale) : scale_(scale) {}

  double along(double number) const {
    return kSide * std::log(number / scale_.low) / std::log(scale_.high / scale_.low);
  }
  Pixel at(double error, double level) const { return {kCorner.x + along(error), kCorner.y + kSide - along(level)}; }

 private:
  const StanfordScale& scale_;
};

void draw_grounds(Svg& svg, const Plot& plot, const StanfordScale& s) {
  const Stroke none{"none", 0.0};
  const double limit = s.alert_limit;
  svg.rectangle(kCorner, kSide, kSide, kBeyondGround);
  svg.polygon({plot.at(s.low, s.low), plot.at(limit, limit), plot.at(s.low, limit)}, kWithinGround, none);
  svg.polygon({plot.at(s.low, limit), plot.at(limit, limit), plot.at(s.high, s.high), plot.at(s.low, s.high)},
              kTooWideGround, none);
  svg.polygon({plot.at(limit, s.low), plot.at(s.high, s.low), plot.at(s.high, limit), plot.at(limit, limit)},
              kMisleadingGround, none);
}

void draw_cells(Svg& svg, const StanfordCounts& counts) {
  const double largest = log_of_largest(counts);
  constexpr double kCell = kSide / static_cast<double>(StanfordCounts::kCells);
  for (std::size_t level = 0; level < StanfordCounts::kCells; ++level) {
    for (std::size_t error = 0; error < StanfordCounts::kCells; ++error) {
      const std::size_t count = counts.cell(error, level);
      if (count == 0) continue;
      const double share = std::log(static_cast<double>(count)) / largest;
      const auto shade = std::min<std::size_t>(kShades.size() - 1, static_cast<std::size_t>(share * kShades.size()));
      const Pixel corner{kCorner.x + static_cast<double>(error) * kCell,
                         kCorner.y + kSide - static_cast<double>(level + 1) * kCell};
      svg.rectangle(corner, kCell + 0.1, kCell + 0.1, error > level ? kAlarms[shade] : kShades[shade]);
    }
  }
}

void draw_axes(Svg& svg, const Plot& plot, const StanfordScale& s) {
  const Stroke grid{"#d9d9d4", 0.6};
  for (double decade = s.low; decade < 1.001 * s.high; decade *= 10.0) {
    svg.line(plot.at(decade, s.low), plot.at(decade, s.high), grid);
    svg.line(plot.at(s.low, decade), plot.at(s.high, decade), grid);
    const Pixel below = plot.at(decade, s.low);
    const Pixel beside = plot.at(s.low, decade);
    svg.text({below.x, below.y + 20.0}, s.label(decade), {kInk, 13.0, Anchor::kMiddle});
    svg.text({beside.x - 10.0, beside.y + 4.5}, s.label(decade), {kInk, 13.0, Anchor::kEnd});
  }
  svg.text({kCorner.x + 0.5 * kSide, kCorner.y + kSide + 46.0}, tr("error of the value"),
           {kInk, 15.0, Anchor::kMiddle, true});
  svg.text({kCorner.x, kCorner.y - 14.0}, tr("protection level"), {kInk, 15.0, Anchor::kStart, true});
}

void draw_limits(Svg& svg, const Plot& plot, const StanfordScale& s) {
  const Stroke limit{kFaintInk, 1.4, "6 4"};
  svg.line(plot.at(s.alert_limit, s.low), plot.at(s.alert_limit, s.high), limit);
  svg.line(plot.at(s.low, s.alert_limit), plot.at(s.high, s.alert_limit), limit);
  svg.line(plot.at(s.low, s.low), plot.at(s.high, s.high), {kInk, 1.6});
  const Pixel end = plot.at(s.alert_limit, s.high);
  svg.text({end.x, end.y - 8.0}, say("alert limit {}", s.label(s.alert_limit)), {kFaintInk, 12.0, Anchor::kMiddle});
}

struct Name {
  Pixel at;
  Anchor anchor;
  std::string_view words;
  std::size_t count;
  std::string_view colour;
};

void draw_names(Svg& svg, const Plot& plot, const StanfordCounts& counts) {
  const StanfordScale& s = counts.scale();
  const StanfordCounts::Regions& r = counts.regions();
  const std::size_t sum = r.within + r.too_wide + r.beyond_protection + r.misleading_if_valid;
  const double total = static_cast<double>(std::max<std::size_t>(1, sum));
  const Pixel limit = plot.at(s.alert_limit, s.alert_limit);
  const Pixel low = plot.at(s.low, s.low);
  const Pixel high = plot.at(s.high, s.high);
  const Name names[] = {
      {{low.x + 14.0, limit.y + 0.5 * (low.y - limit.y)}, Anchor::kStart, tr("within protection"), r.within, "#2f6b3c"},
      {{low.x + 14.0, high.y + 26.0},
       Anchor::kStart,
       tr("within protection, too wide to be valid"),
       r.too_wide,
       "#565d64"},
      {{limit.x - 14.0, low.y - 34.0}, Anchor::kEnd, tr("value > protection"), r.beyond_protection, "#9a6200"},
      {{high.x - 14.0, low.y - 34.0}, Anchor::kEnd, tr("misleading if valid"), r.misleading_if_valid, "#a3230f"},
  };
  for (const Name& name : names) {
    svg.text(name.at, name.words, {name.colour, 16.0, name.anchor, true, kPanel});
    svg.text({name.at.x, name.at.y + 20.0},
             fmt::format("{} ({:.4g} %)", name.count, 100.0 * static_cast<double>(name.count) / total),
             {name.colour, 13.0, name.anchor, false, kPanel});
  }
}

void draw_shades(Svg& svg, const StanfordCounts& counts) {
  const double x = kCorner.x + kSide + 22.0;
  double y = kCorner.y + 20.0;
  double shown = 0.0;
  svg.text({x, kCorner.y + 8.0}, tr("values per cell"), {kInk, 12.0});
  for (std::size_t i = 0; i < kShades.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kShades.size());
    const double from = std::ceil(std::exp(log_of_largest(counts) * share) - 1e-9);
    if (from <= shown) continue;
    svg.rectangle({x, y}, 18.0, 18.0, kShades[i]);
    svg.rectangle({x + 20.0, y}, 18.0, 18.0, kAlarms[i]);
    svg.text({x + 46.0, y + 13.5}, fmt::format("≥ {:.0f}", from), {kInk, 12.0});
    y += 24.0;
    shown = from;
  }
}

}  // namespace

std::string stanford_diagram(const StanfordCounts& counts, std::string_view title) {
  Svg svg(kWidth, kHeight, kPaper);
  const Plot plot(counts.scale());
  svg.text({kCorner.x, 34.0}, title, {kInk, 19.0, Anchor::kStart, true});
  draw_grounds(svg, plot, counts.scale());
  svg.begin_clip(kCorner, kSide, kSide);
  draw_cells(svg, counts);
  svg.end_clip();
  draw_axes(svg, plot, counts.scale());
  draw_limits(svg, plot, counts.scale());
  draw_names(svg, plot, counts);
  draw_shades(svg, counts);
  return svg.document();
}

}  // namespace pose_wall::tools::picture
