// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/setting_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "io/frames/text_cursor.hpp"
#include "io/language/language.hpp"
#include "io/terminal/did_you_mean.hpp"
#include "io/terminal/text_table.hpp"

namespace pose_wall::tools {
namespace {

// Doubles hold every count.
double value_at(const SettingPlace& place) {
  return place.number != nullptr ? *place.number : static_cast<double>(*place.count);
}

void put(const SettingPlace& place, double value) {
  if (place.number != nullptr) *place.number = value;
  if (place.count != nullptr) *place.count = static_cast<std::uint32_t>(value);
}

// A setting that was given, and what it was before.
struct GivenSetting {
  std::string word;
  const SettingPlace* place;
  double value, before;
};

// What is wrong with the value by itself; empty: it is set.
std::string value_fault(const SettingPlace& place, const std::string& word, const NamedValue& given) {
  if (word.find('=') == std::string::npos) return say("--set {}: KEY=VALUE is expected", word);
  if (place.number != nullptr) {
    const std::optional<double> number = parse_number<double>(given.value);
    if (!number) return say("--set {}: '{}' is no number", given.name, given.value);
    *place.number = *number;
    return "";
  }
  const std::optional<std::uint32_t> count = parse_number<std::uint32_t>(given.value);
  if (!count) return say("--set {}: '{}' is no whole number from 0", given.name, given.value);
  *place.count = *count;
  return "";
}

// The given setting to which a rule's fault is due: the member that the rule names, else the one without which the rule
// would hold, else the last one.
std::vector<GivenSetting>::iterator culprit_of(const pose_wall_planar_fault& fault, const SettingsCheck& check,
                                               std::vector<GivenSetting>* given) {
  const std::string at_fault = fault.member != nullptr ? fault.member : "";
  const auto is_named = [&](const GivenSetting& one) { return one.place->name == at_fault; };
  const auto named = std::find_if(given->begin(), given->end(), is_named);
  if (named != given->end()) return named;
  const auto cures = [&](const GivenSetting& one) {
    put(*one.place, one.before);
    pose_wall_planar_fault other{};
    const bool is_cured = check(&other) == POSE_WALL_OK || other.rule != fault.rule;
    put(*one.place, one.value);
    return is_cured;
  };
  const auto cure = std::find_if(given->begin(), given->end(), cures);
  return cure != given->end() ? cure : std::prev(given->end());
}

bool has_word(const std::string& text, const std::string& word) {
  constexpr const char* kLetters = "abcdefghijklmnopqrstuvwxyz_0123456789";
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const bool begins = at == 0 || std::string(kLetters).find(text[at - 1]) == std::string::npos;
    const std::size_t end = at + word.size();
    if (begins && (end == text.size() || std::string(kLetters).find(text[end]) == std::string::npos)) return true;
  }
  return false;
}

// The rule, and the values of the other members that it names.
std::string rule_text(const pose_wall_planar_fault& fault, const std::vector<SettingPlace>& places,
                      const SettingPlace& culprit) {
  if (fault.rule == nullptr) return tr("the value is refused");
  std::string text = fault.rule;
  for (const SettingPlace& place : places) {
    if (&place == &culprit || !has_word(fault.rule, place.name)) continue;
    text += say("; {} is {:g}", place.name, value_at(place));
  }
  return text;
}

// "0.3 m, 0.05 to 2"
std::string range_text(const SettingRow& row) {
  const bool is_switch = row.is_count && row.least == std::string("0") && row.most == std::string("1");
  const std::string unit = row.unit == std::string("1") ? "" : std::string(" ") + row.unit;
  return is_switch ? say("{}; 0 or 1", row.standard) : say("{}{}; {} to {}", row.standard, unit, row.least, row.most);
}

}  // namespace

SettingRows without(const std::vector<std::string>& names, SettingRows rows) {
  const auto is_named = [&names](const SettingRow& row) {
    return std::find(names.begin(), names.end(), row.name) != names.end();
  };
  rows.erase(std::remove_if(rows.begin(), rows.end(), is_named), rows.end());
  return rows;
}

std::vector<std::string> names_of(const SettingRows& rows) {
  std::vector<std::string> names;
  for (const SettingRow& row : rows) names.emplace_back(row.name);
  return names;
}

std::string settings_help(const SettingRows& rows) {
  constexpr std::size_t kWidth = 108;  // with the indent as wide as the other lines of the help
  std::string text = std::string("\n") + tr("Settings of --set, each with its default and range:");
  for (const SettingRow& row : rows) {
    const std::string setting = wrapped(say("{} ({}): {}", row.name, range_text(row), tr(row.help)), 4, kWidth);
    text += "\n" + setting.substr(2, setting.size() - 3);
  }
  return text;
}

NamedValue named_value(const std::string& word) {
  const std::size_t equals = std::min(word.find('='), word.size());
  return {word.substr(0, equals), equals < word.size() ? word.substr(equals + 1) : ""};
}

std::vector<std::string> set_places(const std::vector<SettingPlace>& places, const SettingsCheck& check,
                                    std::vector<std::string>* words) {
  std::vector<std::string> left, faults;
  std::vector<GivenSetting> given;
  for (const std::string& word : *words) {
    const NamedValue named = named_value(word);
    const auto place = std::find_if(places.begin(), places.end(),
                                    [&named](const SettingPlace& one) { return named.name == one.name; });
    if (place == places.end()) {
      left.push_back(word);
      continue;
    }
    const auto again =
        std::find_if(given.begin(), given.end(), [&place](const GivenSetting& one) { return one.place == &*place; });
    const double before = again != given.end() ? again->before : value_at(*place);
    const std::string fault = value_fault(*place, word, named);
    if (!fault.empty()) {
      faults.push_back(fault);
      continue;
    }
    if (again != given.end()) given.erase(again);  // the last one counts
    given.push_back({word, &*place, value_at(*place), before});
  }
  const char* told = nullptr;
  for (pose_wall_planar_fault fault{}; !given.empty() && check(&fault) != POSE_WALL_OK; fault = {}) {
    if (told != nullptr && fault.rule == told) break;  // with the default, which nobody gave
    told = fault.rule;
    const auto culprit = culprit_of(fault, check, &given);
    faults.push_back(fmt::format("--set {}: {}", culprit->word, rule_text(fault, places, *culprit->place)));
    put(*culprit->place, culprit->before);
    given.erase(culprit);
  }
  *words = left;
  return faults;
}

std::string unknown_setting_text(const std::string& name, const std::vector<std::string>& known) {
  return say("--set {}: there is no such setting{}; settings: {}", name, did_you_mean(name, known),
             fmt::format("{}", fmt::join(known, ", ")));
}

void refuse_settings(const std::vector<std::string>& faults) {
  if (!faults.empty()) throw std::invalid_argument(fmt::format("{}", fmt::join(faults, "\n")));
}

}  // namespace pose_wall::tools
