// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "verbs/one_of.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "terminal/did_you_mean.hpp"

namespace pose_wall::tools {

CLI::Validator one_of(const std::vector<std::string>& words) {
  const auto fault = [words](const std::string& word) -> std::string {
    if (std::find(words.begin(), words.end(), word) != words.end()) return "";
    return fmt::format("'{}' is not one of {}{}", word, fmt::join(words, ", "), did_you_mean(word, words));
  };
  return CLI::Validator(fault, fmt::format("{{{}}}", fmt::join(words, ",")), "");
}

}  // namespace pose_wall::tools
