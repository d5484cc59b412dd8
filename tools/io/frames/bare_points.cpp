// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/bare_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kColumnsMax = 32;

bool has_once(const std::string& columns, char letter) {
  return std::count(columns.begin(), columns.end(), letter) == 1;
}

}  // namespace

std::optional<BareLayout> parse_bare_layout(std::string_view word) {
  BareLayout layout;
  if (word.size() > 2 && word.substr(word.size() - 2) == "64") {
    layout.value_bytes = 8;
    word.remove_suffix(2);
  }
  layout.columns = std::string(word);
  const bool is_known = layout.columns.find_first_not_of("xyzitr_") == std::string::npos;
  const bool is_once = std::all_of(layout.columns.begin(), layout.columns.end(),
                                   [&layout](char c) { return c == '_' || has_once(layout.columns, c); });
  const bool has_place =
      has_once(layout.columns, 'x') && has_once(layout.columns, 'y') && has_once(layout.columns, 'z');
  if (!is_known || !is_once || !has_place || layout.columns.size() > kColumnsMax) return std::nullopt;
  return layout;
}

std::string bare_layout_rule() {
  return tr(
      "one letter for each value of a point, as xyz or xyzi: x y z, i intensity, t time, r ring, _ passed over; 64 "
      "behind "
      "them for float64");
}

std::string bare_layout_word(const BareLayout& layout) {
  return layout.columns + (layout.value_bytes == 8 ? "64" : "");
}

std::string_view bare_column_name(char letter) {
  switch (letter) {
    case 'x':
      return "x";
    case 'y':
      return "y";
    case 'z':
      return "z";
    case 'i':
      return "intensity";
    case 't':
      return "time";
    case 'r':
      return "ring";
    default:
      return "";
  }
}

std::string bare_layout_words(const BareLayout& layout) {
  std::string names;
  for (const char letter : layout.columns) {
    const std::string_view name = bare_column_name(letter);
    names += (names.empty() ? "" : " ") + std::string(name.empty() ? "_" : name);
  }
  return say("{} {}, {} bytes a point", layout.value_bytes == 8 ? "float64" : "float32", names, layout.point_step());
}

Frame read_bare_points(Bytes bytes, const BareLayout& layout) {
  PointLayout points;
  points.point_step = layout.point_step();
  if (bytes.size() % points.point_step != 0) {
    throw FrameError(
        say("{} bytes are not a multiple of {} ({})", bytes.size(), points.point_step, bare_layout_words(layout)));
  }
  points.count = count_points(bytes.size() / points.point_step, bytes.size(), points.point_step);
  const std::uint32_t type = layout.value_bytes == 8 ? POSE_WALL_FIELD_FLOAT64 : POSE_WALL_FIELD_FLOAT32;
  for (std::uint32_t i = 0; i < layout.columns.size(); ++i) {
    const std::string_view name = bare_column_name(layout.columns[i]);
    if (!name.empty()) points.fields.push_back({name, {i * layout.value_bytes, type}});
  }
  return describe_frame(std::move(bytes), points);
}

}  // namespace pose_wall::tools
