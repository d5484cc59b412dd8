// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A table in a Markdown page.

#pragma once

#include <string>
#include <vector>

namespace pose_wall::tools::campaign {

class MarkdownTable {
 public:
  // The first `left_columns` columns stand left, the others right.
  explicit MarkdownTable(const std::vector<std::string>& head, std::size_t left_columns = 1) {
    add_row(head);
    std::vector<std::string> rule(head.size(), "---:");
    for (std::size_t i = 0; i < left_columns && i < rule.size(); ++i) rule[i] = "---";
    add_row(rule);
  }

  void add_row(const std::vector<std::string>& cells) {
    text_ += "|";
    for (const std::string& cell : cells) text_ += " " + cell + " |";
    text_ += "\n";
  }

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace pose_wall::tools::campaign
