// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/config_file/motion_settings.hpp"

#include <fmt/format.h>

#include <optional>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"

namespace pose_wall::tools {
namespace {

struct MotionKeyRow {
  OutsideKey info;
  double pose_wall_motion_settings::*member;
  double per_unit;  // of the member, in one unit of the key
};

constexpr const char* kMotion = translatable("Motion along the road");

constexpr SettingRange<pose_wall_motion_settings> kMotionRanges[] = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_RANGE(pose_wall_motion_settings, __VA_ARGS__)
#include "pose_wall_motion_settings.def"
};

MotionKeyRow motion_key(const char* name, double pose_wall_motion_settings::*member, const char* help) {
  return {key_of(kMotionRanges, member, name, kMotion, help), member, 1.0};
}

// The range in degrees lies within the table's.
const std::vector<MotionKeyRow>& motion_key_rows() {
  static const std::vector<MotionKeyRow> table = {
      motion_key(
          "motion_speed_max", &pose_wall_motion_settings::speed_max_m_s,
          translatable("top speed of the machine; decides how far each frame is searched, and how fast the level along "
                       "the road grows while travel is unobservable")),
      {{"motion_turn_max_deg", kMotion, OutsideKey::Type::kNumber, "deg/s", 1, 570, "",
        translatable("fastest turn of the machine")},
       &pose_wall_motion_settings::turn_max_rad_s,
       kRadPerDeg},
      motion_key("motion_range_max", &pose_wall_motion_settings::range_max_m,
                 translatable("farther returns are not used for motion; range_max does not apply here")),
      motion_key(
          "motion_keyframe", &pose_wall_motion_settings::keyframe_m,
          translatable(
              "travel between two scans of the map; smaller follows rough rock better and fills the map sooner")),
  };
  return table;
}

const MotionKeyRow* find_motion_row(const std::string& name) {
  for (const MotionKeyRow& row : motion_key_rows()) {
    if (name == row.info.name) return &row;
  }
  return nullptr;
}

}  // namespace

pose_wall_motion_settings default_motion_settings() {
  pose_wall_motion_settings settings{};
  pose_wall_motion_settings_init(&settings);
  return settings;
}

const std::vector<OutsideKey>& motion_keys() {
  static const std::vector<OutsideKey> keys = [] {
    std::vector<OutsideKey> keys_alone;
    for (const MotionKeyRow& row : motion_key_rows()) keys_alone.push_back(row.info);
    return keys_alone;
  }();
  return keys;
}

const OutsideKey* find_motion_key(const std::string& name) {
  const MotionKeyRow* row = find_motion_row(name);
  return row != nullptr ? &row->info : nullptr;
}

std::string motion_value_text(const pose_wall_motion_settings& settings, const OutsideKey& key) {
  const MotionKeyRow* row = find_motion_row(key.name);
  return fmt::format("{:.9g}", settings.*row->member / row->per_unit);
}

bool set_motion_value(pose_wall_motion_settings* settings, const OutsideKey& key, const std::string& value) {
  const std::optional<double> read = number_of(key, value);
  if (!read) return false;
  const MotionKeyRow* row = find_motion_row(key.name);
  settings->*row->member = *read * row->per_unit;
  return true;
}

}  // namespace pose_wall::tools
