// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Settings of a part of pose_wall_planar as `--set NAME=VALUE` gives them. Names are those of the struct's members.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "pose_wall_planar_types.h"

namespace pose_wall::tools {

// One member: a number, or a count.
template <typename Settings>
struct SettingWord {
  const char* name;
  double Settings::*number = nullptr;
  std::uint32_t Settings::*count = nullptr;
};

struct NamedValue {
  std::string name, value;
};
// "NAME=VALUE"; the value is empty where there is no "=".
NamedValue named_value(const std::string& word);

// A member of one settings struct, where it lies.
struct SettingPlace {
  const char* name;
  double* number;
  std::uint32_t* count;
};
// The part's _settings_check of that struct.
using SettingsCheck = std::function<std::int32_t(pose_wall_planar_fault*)>;

// Sets the members that `words` name and takes these words out. Returns a line for each that is refused, with what is
// allowed; such a member keeps its default. All words are set before their limits are looked at, for some depend on
// each other.
std::vector<std::string> set_places(const std::vector<SettingPlace>& places, const SettingsCheck& check,
                                    std::vector<std::string>* words);
// The line for a word that names no setting.
std::string unknown_setting_text(const std::string& name, const std::vector<std::string>& known);
// Throws std::invalid_argument of all these lines, if there is any.
void refuse_settings(const std::vector<std::string>& faults);

// Sets the members that `words` name and takes these words out. Throws std::invalid_argument that names every refused
// setting and its range.
template <typename Settings, std::size_t kWords, typename Check>
void take_settings(const SettingWord<Settings> (&known)[kWords], Check check, std::vector<std::string>* words,
                   Settings* settings) {
  std::vector<SettingPlace> places;
  for (const SettingWord<Settings>& setting : known) {
    places.push_back({setting.name, setting.number != nullptr ? &(settings->*setting.number) : nullptr,
                      setting.count != nullptr ? &(settings->*setting.count) : nullptr});
  }
  refuse_settings(set_places(
      places, [&](pose_wall_planar_fault* fault) { return check(settings, fault); }, words));
}

template <typename Settings, std::size_t kWords>
std::vector<std::string> names_of(const SettingWord<Settings> (&known)[kWords]) {
  std::vector<std::string> names;
  for (const SettingWord<Settings>& setting : known) names.emplace_back(setting.name);
  return names;
}

}  // namespace pose_wall::tools
