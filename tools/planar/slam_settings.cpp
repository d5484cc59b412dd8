// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/slam_settings.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "frames/text_cursor.hpp"
#include "language/language.hpp"
#include "planar/scan_trail.hpp"

namespace pose_wall::tools {
namespace {

struct SlamSetting {
  const char* name;
  double pose_wall_planar_slam_settings::* member;
};

constexpr SlamSetting kSettings[] = {
    {"keyframe_m", &pose_wall_planar_slam_settings::keyframe_m},
    {"keyframe_rad", &pose_wall_planar_slam_settings::keyframe_rad},
    {"odometry_m", &pose_wall_planar_slam_settings::odometry_m},
    {"odometry_rad", &pose_wall_planar_slam_settings::odometry_rad},
};

}  // namespace

std::vector<std::string> slam_setting_names() {
  std::vector<std::string> names;
  for (const SlamSetting& setting : kSettings) names.emplace_back(setting.name);
  return names;
}

pose_wall_planar_slam_settings take_slam_settings(std::vector<std::string>* words) {
  pose_wall_planar_slam_settings settings{};
  require_ok(pose_wall_planar_slam_settings_init(&settings), translatable("the settings of the map"));
  std::vector<std::string> left;
  for (const std::string& word : *words) {
    const std::size_t equals = std::min(word.find('='), word.size());
    const std::string name = word.substr(0, equals);
    const auto* found = std::find_if(std::begin(kSettings), std::end(kSettings),
                                     [&name](const SlamSetting& setting) { return name == setting.name; });
    if (found == std::end(kSettings)) {
      left.push_back(word);
      continue;
    }
    const std::string value = equals < word.size() ? word.substr(equals + 1) : "";
    const std::optional<double> number = parse_number<double>(value);
    if (!number) throw std::invalid_argument(say("--set {}: '{}' is no number", name, value));
    settings.*found->member = *number;
    pose_wall_planar_fault fault{};
    if (pose_wall_planar_slam_settings_check(&settings, &fault) != POSE_WALL_OK) {
      throw std::invalid_argument(
          fmt::format("--set {}: {}", word, fault.rule != nullptr ? fault.rule : tr("the value is refused")));
    }
  }
  *words = left;
  return settings;
}

}  // namespace pose_wall::tools
