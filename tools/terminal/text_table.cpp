// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "terminal/text_table.hpp"

#include <algorithm>
#include <sstream>

namespace pose_wall::tools {
namespace {

void append_cell(std::string& line, const std::string& cell, std::size_t width, bool left) {
  const std::string padding(width - std::min(width, shown_width(cell)), ' ');
  line += left ? cell + padding : padding + cell;
}

void trim_end(std::string& line) {
  line.erase(line.find_last_not_of(' ') + 1);
}

}  // namespace

std::size_t shown_width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
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
  for (std::string word; words >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > width) {
      all += std::string(indent, ' ') + line + '\n';
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  if (!line.empty()) all += std::string(indent, ' ') + line + '\n';
  return all;
}

}  // namespace pose_wall::tools
