// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/amounts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/numbers/quantities.hpp"

namespace pose_wall::tools::explain {
namespace {

bool is_quantity(std::uint32_t subject) {
  return subject >= POSE_WALL_TRACE_QUANTITY;
}

std::string amount(const Note& note, double value) {
  const std::string unit = note.info.unit;
  if (!std::isfinite(value)) return tr("not a number");
  if (unit == "m") return metres(value);
  if (unit == "m2") return fmt::format("{:.2f} m²", value);
  if (unit == "rad") return degrees(value);
  if (unit == "share") return per_cent(value);
  if (unit == "s") return fmt::format("{:.3g} s", value);
  if (unit == "steps") return say("{:.3g} million", 1e-6 * value);
  if (unit == "points" || unit == "frames") return fmt::format("{:.0f}", value);
  if (is_quantity(note.gate.subject)) return quantity_amount(note.gate.subject - POSE_WALL_TRACE_QUANTITY, value);
  return fmt::format("{:.4g}", value);
}

}  // namespace

std::string metres(double value_m) {
  return std::fabs(value_m) < 0.1 && value_m != 0.0 ? fmt::format("{:.3f} m", value_m)
                                                    : fmt::format("{:.2f} m", value_m);
}

std::string degrees(double value_rad) {
  return fmt::format("{:.2f}°", value_rad * kDegPerRad);
}

std::string per_cent(double share) {
  return fmt::format("{:.3g} %", 100.0 * share);
}

std::string quantity_amount(std::uint32_t quantity, double value) {
  return is_angle(quantity) ? degrees(value) : metres(value);
}

std::string value_text(const Note& note) {
  if (note.info.sense == POSE_WALL_TRACE_IS_SO) return note.passed() ? tr("yes") : tr("no");
  return amount(note, note.gate.value);
}

std::string limit_text(const Note& note) {
  return note.info.sense == POSE_WALL_TRACE_IS_SO ? tr("yes") : amount(note, note.gate.limit);
}

std::string key_of(const Note& note) {
  const std::string keys = note.info.key;
  const std::size_t bar = keys.find('|');
  if (bar == std::string::npos) return keys;
  const bool is_angle = note.gate.subject <= POSE_WALL_TRACE_QUANTITY + POSE_WALL_YAW;
  return is_angle ? keys.substr(0, bar) : keys.substr(bar + 1);
}

std::string subject_name(std::uint32_t subject) {
  if (is_quantity(subject)) return pose_wall_quantity_name(subject - POSE_WALL_TRACE_QUANTITY);
  switch (subject) {
    case POSE_WALL_TRACE_FRAME:
      return "frame";
    case POSE_WALL_TRACE_FLOOR:
      return "floor";
    case POSE_WALL_TRACE_LEFT:
      return "left wall";
    case POSE_WALL_TRACE_RIGHT:
      return "right wall";
    case POSE_WALL_TRACE_WALLS:
      return "both walls";
    case POSE_WALL_TRACE_AHEAD:
      return "ahead";
    default:
      return "behind";
  }
}

std::string subject_words(std::uint32_t subject) {
  // Marked here for subject_name.
  constexpr const char* kNames[] = {translatable("frame"),      translatable("floor"),      translatable("left wall"),
                                    translatable("right wall"), translatable("both walls"), translatable("ahead"),
                                    translatable("behind")};
  return subject < std::size(kNames) ? tr(kNames[subject]) : subject_name(subject);
}

}  // namespace pose_wall::tools::explain
