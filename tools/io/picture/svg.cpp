// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/picture/svg.hpp"

#include <fmt/format.h>

#include <iterator>

namespace pose_wall::tools::picture {
namespace {

std::string attributes(const Stroke& stroke) {
  if (stroke.width <= 0.0) return R"(stroke="none")";
  const std::string dashes = stroke.dashes.empty() ? "" : fmt::format(R"( stroke-dasharray="{}")", stroke.dashes);
  return fmt::format(R"(stroke="{}" stroke-width="{:.1f}"{})", stroke.colour, stroke.width, dashes);
}

std::string coordinates(const std::vector<Pixel>& points) {
  std::string list;
  for (const Pixel& point : points) fmt::format_to(std::back_inserter(list), "{:.1f},{:.1f} ", point.x, point.y);
  return list;
}

std::string_view name(Anchor anchor) {
  if (anchor == Anchor::kStart) return "start";
  return anchor == Anchor::kMiddle ? "middle" : "end";
}

}  // namespace

std::string escaped(std::string_view words) {
  std::string safe;
  for (const char letter : words) {
    if (letter == '&') {
      safe += "&amp;";
    } else if (letter == '<') {
      safe += "&lt;";
    } else if (letter == '"') {
      safe += "&quot;";
    } else {
      safe += letter;
    }
  }
  return safe;
}

Svg::Svg(double width, double height, std::string_view background) {
  body_ = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0:.0f}" height="{1:.0f}" viewBox="0 0 {0:.0f} {1:.0f}" )"
      R"(font-family="DejaVu Sans, Verdana, Helvetica, Arial, )"
      R"(Noto Sans CJK SC, Microsoft YaHei, PingFang SC, sans-serif">)"
      "\n",
      width, height);
  rectangle({0.0, 0.0}, width, height, background);
}

void Svg::line(Pixel from, Pixel to, const Stroke& stroke) {
  body_ += fmt::format(R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke-linecap="round" {}/>)"
                       "\n",
                       from.x, from.y, to.x, to.y, attributes(stroke));
}

void Svg::rectangle(Pixel corner, double width, double height, std::string_view fill, double radius) {
  body_ += fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" rx="{:.1f}" fill="{}"/>)"
                       "\n",
                       corner.x, corner.y, width, height, radius, fill);
}

void Svg::circle(Pixel centre, double radius, std::string_view fill, const Stroke& rim) {
  body_ += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{:.1f}" fill="{}" {}/>)"
                       "\n",
                       centre.x, centre.y, radius, fill, attributes(rim));
}

void Svg::polygon(const std::vector<Pixel>& corners, std::string_view fill, const Stroke& rim) {
  body_ += fmt::format(R"(<polygon points="{}" fill="{}" stroke-linejoin="round" {}/>)"
                       "\n",
                       coordinates(corners), fill, attributes(rim));
}

void Svg::polyline(const std::vector<Pixel>& points, const Stroke& stroke) {
  body_ += fmt::format(R"(<polyline points="{}" fill="none" stroke-linecap="round" {}/>)"
                       "\n",
                       coordinates(points), attributes(stroke));
}

void Svg::dots(const std::vector<Pixel>& centres, double diameter, std::string_view colour, double opacity) {
  if (centres.empty()) return;
  std::string path;
  for (const Pixel& centre : centres) {
    fmt::format_to(std::back_inserter(path), "M{:.1f} {:.1f}h0", centre.x, centre.y);
  }
  body_ += fmt::format(R"(<path d="{}" stroke="{}" stroke-width="{:.1f}" stroke-opacity="{:.2f}" )"
                       R"(stroke-linecap="round" fill="none"/>)"
                       "\n",
                       path, colour, diameter, opacity);
}

void Svg::image(Pixel corner, double width, double height, std::string_view href) {
  body_ += fmt::format(R"(<image x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" preserveAspectRatio="none" )"
                       R"(image-rendering="pixelated" href="{}"/>)"
                       "\n",
                       corner.x, corner.y, width, height, href);
}

void Svg::text(Pixel at, std::string_view words, const TextStyle& style) {
  const std::string halo =
      style.halo.empty()
          ? ""
          : fmt::format(R"( stroke="{}" stroke-width="4" stroke-linejoin="round" paint-order="stroke")", style.halo);
  body_ += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" font-size="{:.1f}" fill="{}" text-anchor="{}"{}{}>{}</text>)"
                       "\n",
                       at.x, at.y, style.size, style.colour, name(style.anchor),
                       style.bold ? R"( font-weight="bold")" : "", halo, escaped(words));
}

void Svg::begin_clip(Pixel corner, double width, double height) {
  ++clips_;
  body_ += fmt::format(
      R"svg(<clipPath id="clip{0}"><rect x="{1:.1f}" y="{2:.1f}" width="{3:.1f}" height="{4:.1f}"/></clipPath>)svg"
      R"svg(<g clip-path="url(#clip{0})">)svg"
      "\n",
      clips_, corner.x, corner.y, width, height);
}

void Svg::end_clip() {
  body_ += "</g>\n";
}

std::string Svg::document() const {
  return body_ + "</svg>\n";
}

}  // namespace pose_wall::tools::picture
