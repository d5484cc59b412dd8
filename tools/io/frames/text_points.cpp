// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/text_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/frames/ascii_points.hpp"
#include "io/frames/column_kinds.hpp"
#include "io/frames/field_aliases.hpp"
#include "io/frames/field_value.hpp"
#include "io/frames/text_cursor.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::size_t kUnnamedColumnsMax = 5;  // without names

std::string_view without_comment_sign(std::string_view line) {
  const std::size_t start = line.find_first_not_of("#/% \t");
  return start == std::string_view::npos ? std::string_view{} : line.substr(start);
}

bool is_comment(std::string_view line) {
  const std::size_t start = line.find_first_not_of(kTextSeparators);
  return start == std::string_view::npos || line[start] == '#' || line[start] == '%' || line.substr(start, 2) == "//";
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::string_view word = take_word(line, kTextSeparators); !word.empty();
       word = take_word(line, kTextSeparators)) {
    words.push_back(word);
  }
  return words;
}

// "X", "\"x\"", "x_m", "x[m]", ParaView's "Points:0": x.
std::string column_name(std::string_view word) {
  std::string name;
  for (const char c : word) {
    if (c != '"' && c != '\'') name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (name.rfind("points", 0) == 0 && name.size() > 2 && name[name.size() - 2] == ':') {
    const char axis = name.back();
    return axis == '0' ? "x" : axis == '1' ? "y" : axis == '2' ? "z" : name;
  }
  for (const char* unit : {"[m]", "(m)", "_m"}) {
    const std::size_t at = name.size() - std::min(name.size(), std::string_view(unit).size());
    if (at > 0 && name.compare(at, std::string::npos, unit) == 0) name.resize(at);
  }
  return name;
}

bool names_coordinates(const std::vector<std::string_view>& words) {
  const auto has = [&words](const char* wanted) {
    return std::any_of(words.begin(), words.end(), [wanted](auto word) { return column_name(word) == wanted; });
  };
  return has("x") && has("y") && has("z");
}

bool are_numbers(const std::vector<std::string_view>& words) {
  return !words.empty() &&
         std::all_of(words.begin(), words.end(), [](auto word) { return parse_number<double>(word).has_value(); });
}

struct TextHead {
  std::vector<AsciiColumn> columns;
  std::optional<std::uint64_t> announced;  // points
  std::size_t data_offset = 0;
  std::size_t lines = 0;       // before the data
  bool is_fifth_open = false;  // nobody says what the fifth column is
};

std::vector<AsciiColumn> named_columns(const std::vector<std::string_view>& words) {
  std::vector<AsciiColumn> columns;
  for (const std::string_view word : words) columns.push_back({column_name(word), 1, true});
  return columns;
}

std::vector<AsciiColumn> columns_of(const BareLayout& layout) {
  std::vector<AsciiColumn> columns;
  for (const char letter : layout.columns) columns.push_back({std::string(bare_column_name(letter)), 1, true});
  return columns;
}

std::vector<AsciiColumn> unnamed_columns(std::size_t count, std::size_t line) {
  if (count < 3 || count > kUnnamedColumnsMax) {
    throw FrameError(say(
        "line {}: {} values; x y z [intensity] [time or ring] are allowed, or a first line that names the columns, or "
        "--layout",
        line, count));
  }
  std::vector<AsciiColumn> columns;
  for (const char* name : {"x", "y", "z", "intensity", "time"}) {
    if (columns.size() < count) columns.push_back({name, 1, true});
  }
  return columns;
}

// "1,5;2,0;3,1" would be read as six values.
void refuse_decimal_commas(std::string_view line, std::size_t number) {
  if (line.find(';') != std::string_view::npos && line.find(',') != std::string_view::npos) {
    throw FrameError(say("line {}: commas and semicolons; numbers with a decimal point are allowed", number));
  }
}

// What the lines before the first point say.
TextHead read_head(std::string_view text, const BareLayout* given) {
  TextHead head;
  TextCursor cursor(text, text.substr(0, kByteOrderMark.size()) == kByteOrderMark ? kByteOrderMark.size() : 0);
  while (true) {
    head.data_offset = cursor.offset();
    head.lines = cursor.line();
    const std::optional<std::string_view> line = cursor.next_line();
    if (!line) throw FrameError(tr("there is no line of points"));
    const std::vector<std::string_view> words = words_of(is_comment(*line) ? without_comment_sign(*line) : *line);
    if (given == nullptr && names_coordinates(words)) {
      head.columns = named_columns(words);
      continue;
    }
    if (is_comment(*line)) continue;
    if (words.size() == 1 && !head.announced && parse_number<std::uint64_t>(words.front())) {
      head.announced = parse_number<std::uint64_t>(words.front());
      continue;
    }
    if (given != nullptr && head.columns.empty() && !are_numbers(words) && names_coordinates(words)) continue;
    refuse_decimal_commas(*line, cursor.line());
    if (head.columns.empty()) {
      head.is_fifth_open = given == nullptr && words.size() == kUnnamedColumnsMax;
      head.columns = given != nullptr ? columns_of(*given) : unnamed_columns(words.size(), cursor.line());
    }
    return head;
  }
}

std::string columns_text(const std::vector<AsciiColumn>& columns) {
  std::string text;
  for (const AsciiColumn& column : columns) {
    text += (text.empty() ? "" : " ") + (column.name.empty() ? "_" : column.name);
  }
  return text;
}

// What the fifth column is, by its values; nothing where they do not show it.
std::optional<char> letter_of_fifth(const Frame& frame) {
  ColumnLook look;
  const pose_wall_cloud& cloud = frame.cloud;
  for (std::uint32_t i = 0; i < cloud.width; ++i) {
    const auto value = [&cloud, i](const pose_wall_field& field) { return field_value(cloud, 0, i, field); };
    look.add(value(cloud.time), value(cloud.x), value(cloud.y), value(cloud.z));
  }
  switch (look.kind()) {
    case ColumnKind::kConstant:
      return '_';
    case ColumnKind::kRing:
      return 'r';
    case ColumnKind::kTime:
      return 't';
    case ColumnKind::kOther:
      break;
  }
  return std::nullopt;
}

// Read as a time so far.
void name_fifth(Frame* frame, char letter) {
  if (letter == 't') return;
  if (letter == 'r') frame->cloud.ring = frame->cloud.time;
  frame->cloud.time = {0, POSE_WALL_FIELD_NONE};
  if (letter == 'r') {
    frame->fields.back().name = bare_column_name(letter);
  } else {
    frame->fields.pop_back();
  }
}

void settle_fifth(Frame* frame, const BareLayout* of_others) {
  const std::optional<char> shown = letter_of_fifth(*frame);
  const std::optional<char> others =
      of_others != nullptr ? std::optional<char>(of_others->columns.back()) : std::nullopt;
  if (!shown && !others) {
    throw FrameError(
        tr("no line names the columns, and the values of the fifth show neither times nor rings; --layout xyzit, "
           "--layout xyzir or --layout xyzi_ says what it is"));
  }
  if (shown && others && *shown != *others && *shown != '_') {
    throw FrameError(say("the values look like {}, those of the files before like {}; --layout says which",
                         columns_text(columns_of(*parse_bare_layout(std::string("xyzi") + *shown))),
                         columns_text(columns_of(*of_others))));
  }
  name_fifth(frame, others ? *others : *shown);
}

}  // namespace

Frame read_text_points(const Bytes& bytes, const BareLayout* columns, const BareLayout* of_others) {
  const std::string_view text = as_text(bytes);
  const TextHead head = read_head(text, columns);
  TextCursor cursor(text, head.data_offset, head.lines);
  Frame frame;
  try {
    frame = parse_ascii_points(cursor, head.columns, head.announced, AsciiStyle::kText);
  } catch (const FrameError& fault) {
    throw FrameError(say("{}; a line holds {}, separated by spaces, tabs, commas or semicolons", fault.what(),
                         columns_text(head.columns)));
  }
  if (head.is_fifth_open) settle_fifth(&frame, of_others);
  return frame;
}

std::optional<BareLayout> text_layout_shown(const Bytes& bytes) {
  const std::string_view text = as_text(bytes);
  const TextHead head = read_head(text, nullptr);
  if (!head.is_fifth_open) return std::nullopt;
  TextCursor cursor(text, head.data_offset, head.lines);
  const std::optional<char> letter =
      letter_of_fifth(parse_ascii_points(cursor, head.columns, head.announced, AsciiStyle::kText));
  if (!letter || *letter == '_') return std::nullopt;
  return parse_bare_layout(std::string("xyzi") + *letter);
}

bool begins_like_points(std::string_view beginning) {
  if (beginning.substr(0, kByteOrderMark.size()) == kByteOrderMark) beginning.remove_prefix(kByteOrderMark.size());
  TextCursor cursor(beginning);
  while (const std::optional<std::string_view> line = cursor.next_line()) {
    const std::vector<std::string_view> words = words_of(is_comment(*line) ? without_comment_sign(*line) : *line);
    if (names_coordinates(words)) return true;
    if (is_comment(*line)) continue;
    return are_numbers(words) && (words.size() >= 3 || words.size() == 1);
  }
  return false;
}

}  // namespace pose_wall::tools
