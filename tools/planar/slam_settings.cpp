// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/slam_settings.hpp"

#include "language/language.hpp"
#include "planar/part_block.hpp"
#include "planar/setting_words.hpp"

namespace pose_wall::tools {
namespace {

using SlamSettings = pose_wall_planar_slam_settings;

constexpr SettingWord<SlamSettings> kSlamWords[] = {
    {"keyframe_m", &SlamSettings::keyframe_m},
    {"keyframe_rad", &SlamSettings::keyframe_rad},
    {"odometry_m", &SlamSettings::odometry_m},
    {"odometry_rad", &SlamSettings::odometry_rad},
};

}  // namespace

std::vector<std::string> slam_setting_names() {
  return names_of(kSlamWords);
}

pose_wall_planar_slam_settings take_slam_settings(std::vector<std::string>* words) {
  pose_wall_planar_slam_settings settings{};
  require_ok(pose_wall_planar_slam_settings_init(&settings), translatable("the settings of the map"));
  take_settings(kSlamWords, pose_wall_planar_slam_settings_check, words, &settings);
  return settings;
}

}  // namespace pose_wall::tools
