// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/options/one_of.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

#include "io/frames/text_cursor.hpp"
#include "io/language/language.hpp"
#include "io/terminal/did_you_mean.hpp"

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
  return CLI::Validator(fault, tr("0 and more"), "");
}

CLI::Validator whole_number_within(std::uint64_t minimum, std::uint64_t maximum) {
  const auto fault = [minimum, maximum](const std::string& word) -> std::string {
    const std::optional<std::uint64_t> number = parse_number<std::uint64_t>(word);
    if (number && *number >= minimum && *number <= maximum) return "";
    return say("'{}' is refused; a whole number from {} to {} is allowed", word, minimum, maximum);
  };
  return CLI::Validator(fault, say("{} to {}", minimum, maximum), "");
}

CLI::Validator number_within(double minimum, double maximum) {
  const auto fault = [minimum, maximum](const std::string& word) -> std::string {
    const std::optional<double> number = parse_number<double>(word);
    if (number && *number >= minimum && *number <= maximum) return "";
    return say("'{}' is refused; a number from {:g} to {:g} is allowed", word, minimum, maximum);
  };
  return CLI::Validator(fault, say("{:g} to {:g}", minimum, maximum), "");
}

CLI::Validator existing_file() {
  const auto fault = [](const std::string& path) -> std::string {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) return say("'{}' is a folder; a file is allowed", path);
    return std::filesystem::exists(path, ignored) ? "" : say("there is no file '{}'", path);
  };
  return CLI::Validator(fault, "", "");
}

}  // namespace pose_wall::tools
