// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Text that a terminal of 120 columns shows without breaking it: the last column of a table is wrapped.

#pragma once

#include <string>
#include <vector>

namespace pose_wall::tools {

constexpr std::size_t kLineWidth = 120;

// "name   text", the text wrapped; its further lines begin under its first. `indent`: columns before the text.
std::string hanging(const std::string& name, const std::string& text, std::size_t indent, std::size_t width);

// Wrapped text with the same sign before each line.
std::string wrapped_behind(const std::string& sign, const std::string& text, std::size_t width);

// Rows with their last cell wrapped so that no line is wider; all columns stand left, a rule under the head.
std::string wrapped_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                          std::size_t width = kLineWidth);

}  // namespace pose_wall::tools
