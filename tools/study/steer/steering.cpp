// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/steer/steering.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "io/language/both_languages.hpp"
#include "io/numbers/angles.hpp"
#include "io/numbers/quantities.hpp"

namespace pose_wall::tools {
namespace {

// A level beyond so many alert limits promises nothing: "± 20.862 m" would look like a tolerance.
constexpr double kLimitsShown = 10.0;
constexpr double kUsualMost = 1.0 + 1e-9;  // a limit went through a text and back

// Short of what each says alone, and the column's name in English. Chinese names are those of the page.
constexpr const char* kNames[POSE_WALL_QUANTITIES] = {translatable("roll"), translatable("pitch"), translatable("yaw"),
                                                      translatable("d_lf"), translatable("d_lb"),  translatable("d_rf"),
                                                      translatable("d_rb")};

using Words = std::vector<std::string>;

std::string joined(Language language, const Words& words, const char* divider) {
  return fmt::format("{}", fmt::join(words, tr(language, divider)));
}

// Once, where all are the same.
std::string each(Language language, const Words& words) {
  const bool is_one =
      std::all_of(words.begin(), words.end(), [&](const std::string& word) { return word == words[0]; });
  return is_one ? words[0] : joined(language, words, translatable(", "));
}

std::string name_of(Language language, std::uint32_t quantity) {
  return tr(language, kNames[quantity]);
}

bool is_told_together(const SteerValue& a, const SteerValue& b) {
  return a.cause == b.cause && a.is_measured == b.is_measured &&
         (!a.is_measured || is_angle(a.quantity) == is_angle(b.quantity));
}

// "level 0.140 m, 0.203 m, limit 0.100 m", or that they were not measured.
std::string levels_of(Language language, const std::vector<SteerValue>& alike) {
  const SteerValue& first = alike.front();
  if (!first.is_measured) return tr(language, translatable("not measured"));
  if (std::isnan(first.level)) return tr(language, translatable("no bound"));
  Words levels;
  for (const SteerValue& value : alike) levels.push_back(level_text(value.quantity, value.level, value.limit));
  const std::string level = each(language, levels);
  if (!(first.limit > 0.0)) return say_in(language, translatable("level {}"), level);
  return say_in(language, translatable("level {}, limit {}"), level,
                level_text(first.quantity, first.limit, first.limit));
}

// What may steer by a limit that somebody widened says so: "roll (limit 20.000°)".
std::string may_name(Language language, const SteerValue& value) {
  static const AlertLimits kUsual = alert_limits_of(api::Config());
  const std::string name = name_of(language, value.quantity);
  if (!(value.limit > kUsualMost * limit_of(value.quantity, kUsual))) return name;
  return say_in(language, translatable("{} (limit {})"), name, level_text(value.quantity, value.limit, value.limit));
}

// "d_lf, d_lb (level 0.140 m, 0.203 m, limit 0.100 m: ...)": those that have one cause.
std::string told(Language language, const std::vector<SteerValue>& alike) {
  Words names, shares;
  for (const SteerValue& value : alike) {
    names.push_back(name_of(language, value.quantity));
    shares.push_back(fmt::format("{:.0f} %", 100.0 * value.valid_share));
  }
  std::string levels = levels_of(language, alike);
  if (std::isfinite(alike.front().valid_share)) {
    levels =
        say_in(language, translatable("valid in {} of the frames, else mostly {}"), each(language, shares), levels);
  }
  return say_in(language, translatable("{} ({}: {})"), joined(language, names, translatable(", ")), levels,
                steer_cause_words(language, alike.front().cause));
}

Words remedies_of(Language language, const Steering& steering) {
  Words remedies;
  for (const SteerValue& value : steering) {
    const std::string remedy = value.may_steer() ? "" : steer_remedy(language, value.cause);
    const bool is_new = std::find(remedies.begin(), remedies.end(), remedy) == remedies.end();
    if (!remedy.empty() && is_new) remedies.push_back(remedy);
  }
  return remedies;
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json in_both_languages(const std::string& english, const std::string& chinese) {
  return {{"en", english}, {"zh", chinese}};
}

}  // namespace

std::string level_text(std::size_t quantity, double level, double limit) {
  const double most = kLimitsShown * limit;
  if (most > 0.0 && level > most) {
    return is_angle(quantity) ? fmt::format("> {:g}°", most * kDegPerRad) : fmt::format("> {:g} m", most);
  }
  if (!std::isfinite(level)) return "-";
  return is_angle(quantity) ? fmt::format("{:.3f}°", level * kDegPerRad) : fmt::format("{:.3f} m", level);
}

Steering steering_of(const pose_wall_result& result, const AlertLimits& limits) {
  Steering steering;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value& value = result.quantity[q];
    const bool has_level = value.state != POSE_WALL_INVALID;
    steering[q].quantity = q;
    steering[q].cause = steer_cause(value);
    steering[q].is_measured = is_measured(value);
    steering[q].level = has_level ? value.protection_level : std::numeric_limits<double>::quiet_NaN();
    steering[q].limit = limit_of(q, limits);
  }
  return steering;
}

std::string steer_line(Language language, const Steering& steering) {
  Words may, may_not;
  std::array<bool, POSE_WALL_QUANTITIES> is_told{};
  for (const SteerValue& value : steering) {
    if (value.may_steer()) may.push_back(may_name(language, value));
    if (value.may_steer() || is_told[value.quantity]) continue;
    std::vector<SteerValue> alike;
    for (const SteerValue& other : steering) {
      if (!is_told_together(value, other)) continue;
      alike.push_back(other);
      is_told[other.quantity] = true;
    }
    may_not.push_back(told(language, alike));
  }
  const std::string names =
      may.empty() ? tr(language, translatable("none")) : joined(language, may, translatable(", "));
  if (may_not.empty()) return say_in(language, translatable("may steer: {}."), names);
  const std::string others = joined(language, may_not, translatable("; "));
  const Words remedies = remedies_of(language, steering);
  if (remedies.empty()) return say_in(language, translatable("may steer: {}; may not: {}."), names, others);
  return say_in(language, translatable("may steer: {}; may not: {}. To look at: {}."), names, others,
                joined(language, remedies, translatable("; ")));
}

Json steer_json(const Steering& steering) {
  Json list = Json::array();
  for (const SteerValue& value : steering) {
    const std::string unit = is_angle(value.quantity) ? "_rad" : "_m";
    Json entry = {{"value", pose_wall_quantity_name(value.quantity)},
                  {"may_steer", value.may_steer()},
                  {"measured", value.is_measured},
                  {"level" + unit, number(value.level)},
                  {"limit" + unit, number(value.limit)},
                  {"cause", nullptr},
                  {"remedy", nullptr}};
    if (!value.may_steer()) {
      entry["cause"] = steer_cause_name(value.cause);
      const std::string english = steer_remedy(Language::kEnglish, value.cause);
      if (!english.empty()) {
        entry["remedy"] = in_both_languages(english, steer_remedy(Language::kChinese, value.cause));
      }
    }
    list.push_back(entry);
  }
  return list;
}

Json steer_line_json(const Steering& steering) {
  return in_both_languages(steer_line(Language::kEnglish, steering), steer_line(Language::kChinese, steering));
}

}  // namespace pose_wall::tools
