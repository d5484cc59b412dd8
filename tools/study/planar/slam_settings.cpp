// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/slam_settings.hpp"

#include "io/language/language.hpp"
#include "study/planar/part_block.hpp"

namespace pose_wall::tools {
const SettingRows& slam_setting_rows() {
  static const SettingRows rows = without({"keyframes_most"}, {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_slam_settings, __VA_ARGS__)
#include "pose_wall_planar_slam_settings.def"
                                                              });
  return rows;
}

pose_wall_planar_slam_settings take_slam_settings(std::vector<std::string>* words) {
  pose_wall_planar_slam_settings settings{};
  require_ok(pose_wall_planar_slam_settings_init(&settings), translatable("the settings of the map"));
  take_settings(slam_setting_rows(), pose_wall_planar_slam_settings_check, words, &settings);
  return settings;
}

}  // namespace pose_wall::tools
