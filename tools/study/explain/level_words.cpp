// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/level_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/language/engine_words.hpp"
#include "io/numbers/angles.hpp"
#include "io/numbers/quantities.hpp"

namespace pose_wall::tools::explain {
namespace {

// Figures as whole numbers of the last digit that is shown.
struct Digits {
  double per_unit;  // rad or m
  int decimals;
  const char* unit;
};

// As amounts.hpp shows the level: lengths below a decimetre to the millimetre.
Digits digits_of(std::uint32_t quantity, double level) {
  if (is_angle(quantity)) return {100.0 * kDegPerRad, 2, "°"};
  if (level < 0.1) return {1000.0, 3, " m"};
  return {100.0, 2, " m"};
}

std::string figure(const Digits& digits, long long whole) {
  return fmt::format("{:.{}f}{}", static_cast<double>(whole) * std::pow(10.0, -digits.decimals), digits.decimals,
                     digits.unit);
}

// Each part is rounded down. The digits that are then missing in the sum go to the parts that lost most.
std::array<long long, POSE_WALL_PARTS> shared_out(const pose_wall_value& value, const Digits& digits) {
  std::array<long long, POSE_WALL_PARTS> whole{};
  std::array<double, POSE_WALL_PARTS> lost{};
  long long lacking = std::llround(value.protection_level * digits.per_unit);
  for (std::size_t part = 0; part < whole.size(); ++part) {
    const double exact = value.part[part] * digits.per_unit;
    whole[part] = static_cast<long long>(std::floor(exact));
    lost[part] = exact - std::floor(exact);
    lacking -= whole[part];
  }
  for (; lacking > 0; --lacking) {
    const auto most = std::max_element(lost.begin(), lost.end());
    if (!(*most > 0.0)) break;
    ++whole[static_cast<std::size_t>(most - lost.begin())];
    *most = 0.0;
  }
  return whole;
}

bool has_sum(const pose_wall_value& value) {
  constexpr double kMost = 1e6;  // rad or m: nobody reads the parts of what knows no bound
  return value.protection_level < kMost && value.cause < POSE_WALL_PARTS;
}

}  // namespace

bool shows_lag(const pose_wall_value& value, std::uint32_t quantity) {
  return has_sum(value) && shared_out(value, digits_of(quantity, value.protection_level))[POSE_WALL_PART_LAG] != 0;
}

std::vector<std::uint32_t> parts_by_size(const pose_wall_value& value) {
  std::vector<std::uint32_t> parts;
  for (std::uint32_t part = 0; part < POSE_WALL_PARTS; ++part) {
    if (value.part[part] > 0.0) parts.push_back(part);
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [&value](std::uint32_t a, std::uint32_t b) { return value.part[a] > value.part[b]; });
  return parts;
}

std::string level_sum(const pose_wall_value& value, std::uint32_t quantity) {
  if (!has_sum(value)) return "";
  const Digits digits = digits_of(quantity, value.protection_level);
  const std::array<long long, POSE_WALL_PARTS> whole = shared_out(value, digits);
  std::string text;
  for (const std::uint32_t part : parts_by_size(value)) {
    if (whole[part] == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? " = " : " + ", figure(digits, whole[part]), spoken_part(part));
  }
  const bool no_lag = std::isfinite(value.raw) && whole[POSE_WALL_PART_LAG] == 0;
  return figure(digits, std::llround(value.protection_level * digits.per_unit)) + text + (no_lag ? tr("; lag 0") : "");
}

}  // namespace pose_wall::tools::explain
