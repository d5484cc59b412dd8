// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Tables of text: columns as wide as their widest cell.

#pragma once

#include <string>
#include <vector>

namespace pose_wall::tools {

class TextTable {
 public:
  explicit TextTable(std::vector<std::string> head) : head_(std::move(head)) {}

  // A row may have fewer cells than the head.
  void add_row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

  // The first `left_columns` columns stand left, the others right; a rule under the head.
  std::string text(std::size_t left_columns = 1) const;

 private:
  std::vector<std::string> head_;
  std::vector<std::vector<std::string>> rows_;
};

// Characters a terminal shows for UTF-8 text (combining and wide characters aside).
std::size_t shown_width(const std::string& text);

// Breaks text at spaces into lines of at most `width` characters, each behind `indent` spaces.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t width);

}  // namespace pose_wall::tools
