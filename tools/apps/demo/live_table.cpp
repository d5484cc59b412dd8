// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/demo/live_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "io/language/engine_words.hpp"
#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/numbers/quantities.hpp"

namespace pose_wall::tools {
namespace {

constexpr int kWidth = 9;
constexpr std::array<const char*, POSE_WALL_QUANTITIES> kHeads = {
    translatable("roll °"), translatable("pitch °"), translatable("yaw °"), translatable("d_LF m"),
    translatable("d_LB m"), translatable("d_RF m"),  translatable("d_RB m")};
// By pose_wall_state.
constexpr std::array<const char*, 4> kMarks = {"!", "h", "~", " "};
constexpr std::array<const char*, 4> kColours = {"\033[31m", "\033[34m", "\033[33m", "\033[32m"};
constexpr const char* kDim = "\033[2m";
constexpr const char* kPlain = "\033[0m";

std::string figure(std::uint32_t quantity, double value) {
  if (!std::isfinite(value)) return "-";
  return is_angle(quantity) ? fmt::format("{:+.2f}", value * kDegPerRad) : fmt::format("{:.3f}", value);
}

}  // namespace

std::string LiveTable::painted(const std::string& text, std::uint32_t state) const {
  return colours_ ? kColours.at(state) + text + kPlain : text;
}

std::string LiveTable::dimmed(const std::string& text) const {
  return colours_ ? kDim + text + kPlain : text;
}

std::string LiveTable::cell(std::uint32_t quantity, const pose_wall_value& value) const {
  const std::string number = fmt::format("{:>{}}", figure(quantity, value.value), kWidth - 1);
  return painted(number + kMarks.at(value.state), value.state);
}

std::string LiveTable::head() const {
  std::string line = tr("frame   time   ");
  for (const char* name : kHeads) line += fmt::format("{:>{}} ", tr(name), kWidth - 1);
  return line + fmt::format("{:>8}\n", tr("engine"));
}

std::string LiveTable::rows(std::uint64_t frame, double time_s, const pose_wall_result& result,
                            const std::array<double, POSE_WALL_QUANTITIES>& truth, double engine_ms) const {
  std::string measured = fmt::format("{:5} {:5.1f} s  ", frame, time_s);
  std::string true_line = fmt::format("{:>13}  ", tr("truth"));
  for (std::uint32_t quantity = 0; quantity < POSE_WALL_QUANTITIES; ++quantity) {
    measured += cell(quantity, result.quantity[quantity]);
    true_line += fmt::format("{:>{}} ", figure(quantity, truth.at(quantity)), kWidth - 1);
  }
  return measured + fmt::format(" {:4.1f} ms\n", engine_ms) + dimmed(true_line) + "\n";
}

std::string LiveTable::key() const {
  std::string line = tr("states:");
  for (std::uint32_t state = POSE_WALL_VALID + 1; state-- > 0;) {
    const std::string name = state_words(state);
    line += "  " + painted(state == POSE_WALL_VALID ? name : fmt::format("{} {}", kMarks.at(state), name), state);
  }
  return line + "\n";
}

}  // namespace pose_wall::tools
