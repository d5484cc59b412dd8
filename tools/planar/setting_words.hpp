// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Settings of a part of pose_wall_planar as `--set NAME=VALUE` gives them. Names are those of the struct's members.

#pragma once

#include <cstddef>
#include <cstdint>
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
// Throw std::invalid_argument.
double setting_number(const NamedValue& setting);
std::uint32_t setting_count(const NamedValue& setting);
[[noreturn]] void refuse_setting(const std::string& word, const pose_wall_planar_fault& fault);
[[noreturn]] void refuse_unknown_setting(const std::string& name, const std::vector<std::string>& known);

// Sets the members that `words` names and takes these words out. Throws std::invalid_argument that names the setting
// and its range. check: the part's _settings_check.
template <typename Settings, std::size_t kWords, typename Check>
void take_settings(const SettingWord<Settings> (&known)[kWords], Check check, std::vector<std::string>* words,
                   Settings* settings) {
  std::vector<std::string> left;
  for (const std::string& word : *words) {
    const NamedValue given = named_value(word);
    bool is_taken = false;
    for (const SettingWord<Settings>& setting : known) {
      if (given.name != setting.name) continue;
      if (setting.number != nullptr) settings->*setting.number = setting_number(given);
      if (setting.count != nullptr) settings->*setting.count = setting_count(given);
      is_taken = true;
    }
    if (!is_taken) {
      left.push_back(word);
      continue;
    }
    pose_wall_planar_fault fault{};
    if (check(settings, &fault) != POSE_WALL_OK) refuse_setting(word, fault);
  }
  *words = left;
}

template <typename Settings, std::size_t kWords>
std::vector<std::string> names_of(const SettingWord<Settings> (&known)[kWords]) {
  std::vector<std::string> names;
  for (const SettingWord<Settings>& setting : known) names.emplace_back(setting.name);
  return names;
}

}  // namespace pose_wall::tools
