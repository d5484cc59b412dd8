// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/setting_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "frames/text_cursor.hpp"
#include "language/language.hpp"
#include "terminal/did_you_mean.hpp"

namespace pose_wall::tools {

NamedValue named_value(const std::string& word) {
  const std::size_t equals = std::min(word.find('='), word.size());
  return {word.substr(0, equals), equals < word.size() ? word.substr(equals + 1) : ""};
}

double setting_number(const NamedValue& setting) {
  const std::optional<double> number = parse_number<double>(setting.value);
  if (!number) throw std::invalid_argument(say("--set {}: '{}' is no number", setting.name, setting.value));
  return *number;
}

std::uint32_t setting_count(const NamedValue& setting) {
  const std::optional<std::uint32_t> count = parse_number<std::uint32_t>(setting.value);
  if (!count) throw std::invalid_argument(say("--set {}: '{}' is no whole number from 0", setting.name, setting.value));
  return *count;
}

void refuse_setting(const std::string& word, const pose_wall_planar_fault& fault) {
  throw std::invalid_argument(
      fmt::format("--set {}: {}", word, fault.rule != nullptr ? fault.rule : tr("the value is refused")));
}

void refuse_unknown_setting(const std::string& name, const std::vector<std::string>& known) {
  throw std::invalid_argument(say("--set {}: there is no such setting{}; settings: {}", name, did_you_mean(name, known),
                                  fmt::format("{}", fmt::join(known, ", "))));
}

}  // namespace pose_wall::tools
