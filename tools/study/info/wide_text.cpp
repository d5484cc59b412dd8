// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/info/wide_text.hpp"

#include <algorithm>
#include <sstream>

#include "io/terminal/text_table.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kLastWidthMin = 30;  // narrower lines are harder to read than wide ones

std::vector<std::string> lines_of(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  std::istringstream stream(wrapped(text, 0, width));
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  if (lines.empty()) lines.emplace_back();
  return lines;
}

}  // namespace

std::string hanging(const std::string& name, const std::string& text, std::size_t indent, std::size_t width) {
  std::string all;
  for (const std::string& line : lines_of(text, width - std::min(width, indent))) {
    const std::string before = all.empty() ? name : "";
    std::string padded = before + std::string(indent - std::min(indent, shown_width(before)), ' ') + line;
    padded.erase(padded.find_last_not_of(' ') + 1);
    all += padded + '\n';
  }
  return all;
}

std::string wrapped_behind(const std::string& sign, const std::string& text, std::size_t width) {
  std::string all;
  for (const std::string& line : lines_of(text, width - std::min(width, sign.size()))) all += sign + line + '\n';
  return all;
}

std::string wrapped_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                          std::size_t width) {
  std::size_t before = 0;  // the columns before the last, with the gaps behind them
  for (std::size_t column = 0; column + 1 < head.size(); ++column) {
    std::size_t widest = shown_width(head[column]);
    for (const std::vector<std::string>& row : rows) widest = std::max(widest, shown_width(row[column]));
    before += widest + 2;
  }
  TextTable table(head);
  for (const std::vector<std::string>& row : rows) {
    std::vector<std::string> cells = row;
    for (const std::string& line : lines_of(row.back(), std::max(width - std::min(width, before), kLastWidthMin))) {
      cells.back() = line;
      table.add_row(cells);
      std::fill(cells.begin(), cells.end(), "");
    }
  }
  return table.text(head.size());
}

}  // namespace pose_wall::tools
