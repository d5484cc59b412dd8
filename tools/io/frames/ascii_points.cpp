// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/ascii_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "io/frames/field_aliases.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

struct Slot {
  std::size_t word = 0;  // position in the line
  std::uint32_t offset = 0;
  bool is_double = false;
};

struct Plan {
  PointLayout layout;
  std::vector<Slot> slots;  // by position in the line
  std::size_t words = 0;    // per line
};

Plan make_plan(const std::vector<AsciiColumn>& columns) {
  std::vector<std::string_view> names;
  for (const AsciiColumn& column : columns) names.emplace_back(column.name);
  require_coordinates(names);  // here, for what nobody knows is passed over
  Plan plan;
  plan.layout.big_endian = host_is_big_endian();
  for (const AsciiColumn& column : columns) {
    if (column.count == 1 && field_role(column.name) != FieldRole::kNone) {
      const std::uint32_t type = column.is_double ? POSE_WALL_FIELD_FLOAT64 : POSE_WALL_FIELD_FLOAT32;
      plan.slots.push_back({plan.words, plan.layout.point_step, column.is_double});
      plan.layout.fields.push_back({column.name, {plan.layout.point_step, type}});
      plan.layout.point_step += column.is_double ? 8 : 4;
    }
    plan.words += column.count;
  }
  return plan;
}

template <typename Number>
void append_number(Bytes& bytes, std::string_view word, std::size_t line) {
  const std::optional<Number> number = parse_number<Number>(word);
  if (!number) throw FrameError(say("line {}: '{}' is not a number", line, word));
  std::array<std::byte, sizeof(Number)> raw;
  std::memcpy(raw.data(), &*number, sizeof(Number));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

void append_point(Bytes& bytes, const Plan& plan, std::string_view text, std::size_t line, AsciiStyle style) {
  const std::string_view separators = style == AsciiStyle::kText ? kTextSeparators : kBlankSigns;
  std::size_t words = 0;
  auto slot = plan.slots.begin();
  for (std::string_view word = take_word(text, separators); !word.empty();
       word = take_word(text, separators), ++words) {
    if (slot == plan.slots.end() || slot->word != words) continue;
    slot->is_double ? append_number<double>(bytes, word, line) : append_number<float>(bytes, word, line);
    ++slot;
  }
  if (words != plan.words) throw FrameError(say("line {}: {} values, {} expected", line, words, plan.words));
}

// Whether the line holds no point.
bool is_passed_over(std::string_view line, AsciiStyle style) {
  const std::size_t start = line.find_first_not_of(style == AsciiStyle::kText ? kTextSeparators : kBlankSigns);
  if (start == std::string_view::npos) return true;
  if (style != AsciiStyle::kText) return false;
  return line[start] == '#' || line[start] == '%' || line.substr(start, 2) == "//";
}

}  // namespace

Frame parse_ascii_points(TextCursor& cursor, const std::vector<AsciiColumn>& columns,
                         std::optional<std::uint64_t> points, AsciiStyle style) {
  Plan plan = make_plan(columns);
  Bytes bytes;
  std::uint64_t count = 0;
  while (!points || count < *points) {
    const std::optional<std::string_view> line = cursor.next_line();
    if (!line && !points) break;
    if (!line) {
      throw FrameError(say("the header declares {} points, but {} lines of points follow", *points, count));
    }
    if (is_passed_over(*line, style)) continue;
    append_point(bytes, plan, *line, cursor.line(), style);
    ++count;
  }
  plan.layout.count = static_cast<std::uint32_t>(count);
  return describe_frame(std::move(bytes), plan.layout);
}

}  // namespace pose_wall::tools
