// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/options/pose_word.hpp"

#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <vector>

#include "io/frames/text_cursor.hpp"
#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kFarthest_m = 1e6;

std::optional<std::vector<double>> numbers_of(const std::string& word) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at <= word.size();) {
    const std::size_t comma = std::min(word.find(',', at), word.size());
    const std::optional<double> number = parse_number<double>(word.substr(at, comma - at));
    if (!number || !(std::abs(*number) <= kFarthest_m)) return std::nullopt;
    numbers.push_back(*number);
    at = comma + 1;
  }
  return numbers;
}

}  // namespace

pose_wall_planar_pose pose_of_word(const std::string& word, const char* option) {
  const std::optional<std::vector<double>> numbers = numbers_of(word);
  if (!numbers || numbers->size() != 3) {
    throw std::invalid_argument(
        say("{}: '{}' is refused; allowed: x,y,yaw in m, m and degrees, as 12.5,-3,90", option, word));
  }
  return {(*numbers)[0], (*numbers)[1], (*numbers)[2] * kRadPerDeg};
}

CLI::Validator svg_file() {
  const auto fault = [](const std::string& path) -> std::string {
    return std::filesystem::path(path).extension() == ".svg" ? "" : say("'{}': a file ending in .svg is allowed", path);
  };
  return CLI::Validator(fault, "", "");
}

}  // namespace pose_wall::tools
