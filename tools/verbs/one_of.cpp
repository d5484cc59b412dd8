// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "verbs/one_of.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "language/language.hpp"
#include "terminal/did_you_mean.hpp"

namespace pose_wall::tools {

CLI::Validator one_of(const std::vector<std::string>& words) {
  const auto fault = [words](const std::string& word) -> std::string {
    if (std::find(words.begin(), words.end(), word) != words.end()) return "";
    return say("'{}' is not one of {}{}", word, fmt::format("{}", fmt::join(words, ", ")), did_you_mean(word, words));
  };
  return CLI::Validator(fault, fmt::format("{{{}}}", fmt::join(words, ",")), "");
}

CLI::Validator whole_number() {
  const auto fault = [](const std::string& word) -> std::string {
    const bool is_number = !word.empty() && word.find_first_not_of("0123456789") == std::string::npos;
    return is_number ? "" : say("'{}' is refused; a whole number from 0 is allowed", word);
  };
  return CLI::Validator(fault, "0 and more", "");
}

}  // namespace pose_wall::tools
