// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A key of pose_wall.yaml that the engine does not read: what its table says of it, and which values it takes.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pose_wall::tools {

// One row of a table of such keys.
struct OutsideKey {
  enum class Type { kText, kChoice, kNumber, kInteger, kSwitch, kHostPort, kIpv4, kIpv4OrNone };

  const char* name;
  const char* group;
  Type type;
  const char* unit;
  double minimum, maximum;  // of numbers
  const char* choices;      // of kChoice: "udp, ros1, ros2"
  const char* help;
};

// What the table of a part's settings says of a member: include/NAME_settings.def, with
//     #define POSE_WALL_SETTING(...) POSE_WALL_SETTING_RANGE(pose_wall_motion_settings, __VA_ARGS__)
template <typename Settings>
struct SettingRange {
  double Settings::*member;
  const char* unit;
  double least, most;
};
#define POSE_WALL_SETTING_RANGE(Settings, type, name, standard, least, most, unit, help) \
  {&Settings::name, unit, least, most},

// A key that is such a member, in the table's unit and range.
template <typename Settings, std::size_t kRows>
OutsideKey key_of(const SettingRange<Settings> (&rows)[kRows], double Settings::*member, const char* name,
                  const char* group, const char* help) {
  std::size_t row = 0;
  while (rows[row].member != member) ++row;  // every member has its row
  return {name, group, OutsideKey::Type::kNumber, rows[row].unit, rows[row].least, rows[row].most, "", help};
}

// Of kChoice, each for itself.
std::vector<std::string> choices_of(const OutsideKey& key);

// "one of udp, ros1, ros2", "a number from 0 to 65535", ...
std::string allowed_text(const OutsideKey& key);

// Of kNumber and kInteger; nothing where the text is none that the key takes.
std::optional<double> number_of(const OutsideKey& key, const std::string& text);

}  // namespace pose_wall::tools
