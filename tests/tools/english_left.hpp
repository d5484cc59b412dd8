// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Finds English that is left in a Chinese text. Names, keys, options and paths have no language.

#pragma once

#include <regex>
#include <string>

#include "io/language/language.hpp"

namespace pose_wall::tools::test {

// The first run of three English words; empty where there is none.
inline std::string english_in(const std::string& text) {
  static const std::regex kName(R"([A-Za-z0-9]*[-_./#=][-A-Za-z0-9_./#=*]*)");
  static const std::regex kEnglish(R"([A-Za-z]{2,}([ ,;:.]+[A-Za-z]{2,}){2,})");
  const std::string words = std::regex_replace(text, kName, "|");
  std::smatch found;
  return std::regex_search(words, found, kEnglish) ? found.str() : "";
}

// The words of a picture, one text a line.
inline std::string words_of_svg(const std::string& svg) {
  static const std::regex kText(R"(<text[^>]*>([^<]*)</text>)");
  std::string words;
  for (std::sregex_iterator it(svg.begin(), svg.end(), kText), end; it != end; ++it) words += (*it)[1].str() + "\n";
  return words;
}

// Tests speak English unless they choose otherwise.
struct EnglishAfterwards {
  EnglishAfterwards() = default;
  EnglishAfterwards(const EnglishAfterwards&) = delete;
  EnglishAfterwards& operator=(const EnglishAfterwards&) = delete;
  ~EnglishAfterwards() { choose_language(Language::kEnglish); }
};

}  // namespace pose_wall::tools::test
