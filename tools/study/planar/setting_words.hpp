// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Settings of a part of pose_wall_planar as `--set NAME=VALUE` gives them, by the table of the part's public header.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "pose_wall_planar_types.h"

namespace pose_wall::tools {

// One member: where it lies, whether it is a whole number, and what the table says of it.
struct SettingRow {
  const char* name;
  std::size_t offset;
  bool is_count;
  const char *standard, *least, *most, *unit, *help;
};
using SettingRows = std::vector<SettingRow>;

// Rows of a settings struct:
//     #define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_slam_settings, __VA_ARGS__)
//     #include "pose_wall_planar_slam_settings.def"
#define POSE_WALL_SETTING_ROW(Settings, type, name, standard, least, most, unit, help) \
  {#name, offsetof(Settings, name), sizeof(type) == sizeof(std::uint32_t), #standard, #least, #most, unit, help},

// The others, where a verb knows some values itself.
SettingRows without(const std::vector<std::string>& names, SettingRows rows);
std::vector<std::string> names_of(const SettingRows& rows);
// For the end of a verb's --help: a paragraph of each setting with its default and range.
std::string settings_help(const SettingRows& rows);

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
template <typename Settings>
void take_settings(const SettingRows& rows, std::int32_t (*check)(const Settings*, pose_wall_planar_fault*),
                   std::vector<std::string>* words, Settings* settings) {
  std::vector<SettingPlace> places;
  for (const SettingRow& row : rows) {
    unsigned char* const at = reinterpret_cast<unsigned char*>(settings) + row.offset;
    places.push_back({row.name, row.is_count ? nullptr : reinterpret_cast<double*>(at),
                      row.is_count ? reinterpret_cast<std::uint32_t*>(at) : nullptr});
  }
  refuse_settings(set_places(
      places, [&](pose_wall_planar_fault* fault) { return check(settings, fault); }, words));
}

}  // namespace pose_wall::tools
