// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The words of --sweep and --ablate, of engine and motion alike.

#pragma once

#include <charconv>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "io/frames/text_cursor.hpp"

namespace pose_wall::tools::campaign {

// One at least, which may be empty.
inline std::vector<std::string> words_between_commas(const std::string& words) {
  std::vector<std::string> parts;
  std::istringstream list(words + ",");
  for (std::string part; std::getline(list, part, ',');) parts.push_back(part);
  return parts;
}

// NaN for what is no number, or too large to be one. Blanks around it do not matter.
inline double number_in(std::string_view word) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const std::string_view digits = take_word(word);
  double number = kNaN;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool is_whole = error == std::errc{} && end == digits.data() + digits.size();
  return is_whole && take_word(word).empty() ? number : kNaN;
}

}  // namespace pose_wall::tools::campaign
