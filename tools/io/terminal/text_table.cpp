// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/terminal/text_table.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string_view>

namespace pose_wall::tools {
namespace {

void append_cell(std::string& line, const std::string& cell, std::size_t width, bool left) {
  const std::string padding(width - std::min(width, shown_width(cell)), ' ');
  line += left ? cell + padding : padding + cell;
}

// Columns of a terminal that a character takes: Chinese signs and their punctuation are as wide as two letters
// (Unicode Standard Annex 11, East Asian Width W and F).
std::size_t columns_of(char32_t c) {
  constexpr char32_t kWide[][2] = {{0x1100, 0x115F}, {0x2E80, 0xA4CF}, {0xAC00, 0xD7A3}, {0xF900, 0xFAFF},
                                   {0xFE30, 0xFE6F}, {0xFF00, 0xFF60}, {0xFFE0, 0xFFE6}, {0x20000, 0x3FFFD}};
  const auto holds = [c](const char32_t(&range)[2]) { return c >= range[0] && c <= range[1]; };
  return std::any_of(std::begin(kWide), std::end(kWide), holds) ? 2 : 1;
}

bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

// UTF-8, one character from i on; i moves behind it.
char32_t next_character(const std::string& text, std::size_t* i) {
  const auto first = static_cast<unsigned char>(text[(*i)++]);
  char32_t c = first < 0x80U ? first : first & (first >= 0xF0U ? 0x07U : first >= 0xE0U ? 0x0FU : 0x1FU);
  for (; *i < text.size() && continues_character(text[*i]); ++*i) {
    c = (c << 6U) | (static_cast<unsigned char>(text[*i]) & 0x3FU);
  }
  return c;
}

// Punctuation that closes is kept on the line of what it closes.
bool may_begin_line(const std::string& sign) {
  constexpr std::string_view kClosing[] = {"，", "。", "；", "：", "、", "）", "”", "！", "？", "》"};
  return std::find(std::begin(kClosing), std::end(kClosing), sign) == std::end(kClosing);
}

// A word between spaces, and each wide sign, for Chinese has no spaces: parts at which a line may end.
std::vector<std::string> parts_of(const std::string& word) {
  std::vector<std::string> parts;
  bool was_wide = false;
  for (std::size_t i = 0; i < word.size();) {
    const std::size_t begin = i;
    const bool wide = columns_of(next_character(word, &i)) == 2;
    const std::string sign = word.substr(begin, i - begin);
    const bool breaks = (wide || was_wide) && may_begin_line(sign);
    if (parts.empty() || breaks) parts.emplace_back();
    parts.back() += sign;
    was_wide = wide;
  }
  return parts;
}

void trim_end(std::string& line) {
  line.erase(line.find_last_not_of(' ') + 1);
}

}  // namespace

std::size_t shown_width(const std::string& text) {
  std::size_t columns = 0;
  for (std::size_t i = 0; i < text.size();) columns += columns_of(next_character(text, &i));
  return columns;
}

std::string TextTable::text(std::size_t left_columns) const {
  std::vector<std::size_t> widths(head_.size(), 0);
  const auto widen = [&widths](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < std::min(cells.size(), widths.size()); ++i) {
      widths[i] = std::max(widths[i], shown_width(cells[i]));
    }
  };
  widen(head_);
  for (const auto& row : rows_) widen(row);

  std::string all;
  const auto append_row = [&](const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t i = 0; i < std::min(cells.size(), widths.size()); ++i) {
      if (i > 0) line += "  ";
      append_cell(line, cells[i], widths[i], i < left_columns);
    }
    trim_end(line);
    all += line + '\n';
  };
  append_row(head_);
  std::vector<std::string> rule;
  rule.reserve(widths.size());
  for (const std::size_t width : widths) rule.emplace_back(width, '-');
  append_row(rule);
  for (const auto& row : rows_) append_row(row);
  return all;
}

std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
  std::istringstream words(text);
  std::string all;
  std::string line;
  const auto end_line = [&] {
    if (!line.empty()) all += std::string(indent, ' ') + line + '\n';
    line.clear();
  };
  for (std::string word; words >> word;) {
    std::string space = line.empty() ? "" : " ";
    for (const std::string& part : parts_of(word)) {
      if (!line.empty() && shown_width(line + space + part) > width) {
        end_line();
        space.clear();
      }
      line += space + part;
      space.clear();
    }
  }
  end_line();
  return all;
}

}  // namespace pose_wall::tools
