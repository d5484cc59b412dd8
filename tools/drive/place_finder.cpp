// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "drive/place_finder.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "language/language.hpp"
#include "pose_wall_planar_slam.h"

namespace pose_wall::tools {
namespace {

pose_wall_planar_localise_settings localise_settings() {
  constexpr std::uint32_t kPlaceTilesMost = 2048;
  pose_wall_planar_localise_settings settings{};
  require_ok(pose_wall_planar_localise_settings_init(&settings), translatable("the settings of the localisation"));
  settings.tiles_most = kPlaceTilesMost;
  return settings;
}

std::uint64_t localise_bytes() {
  const pose_wall_planar_localise_settings settings = localise_settings();
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_localise_memory_needed(&settings, &bytes),
             translatable("the settings of the localisation"));
  return bytes;
}

// A saved trail, opened to be read.
class SavedTrail {
 public:
  explicit SavedTrail(const std::string& saved) : settings_(settings()), block_(bytes_for(settings_)) {
    require_ok(pose_wall_planar_slam_open(&settings_, block_.data(), block_.bytes(), &slam_),
               translatable("the trail"));
    require_ok(pose_wall_planar_slam_load(slam_, saved.data(), saved.size(), nullptr), translatable("the trail"));
  }

  // visit(keyframe, points) for each.
  template <typename Visit>
  void each_keyframe(const Visit& visit) const {
    pose_wall_planar_keyframe keyframe{};
    keyframe.struct_size = sizeof keyframe;
    std::vector<float> xy_m;
    for (std::uint32_t k = 0; pose_wall_planar_slam_keyframe(slam_, k, &keyframe) == POSE_WALL_OK; ++k) {
      if (keyframe.points == 0) continue;
      xy_m.resize(2 * std::size_t{keyframe.points});
      require_ok(pose_wall_planar_slam_points(slam_, k, xy_m.data(), keyframe.points), translatable("the trail"));
      visit(keyframe, xy_m.data());
    }
  }

 private:
  static pose_wall_planar_slam_settings settings() {
    constexpr std::uint32_t kSavedKeyframesMost = 65536;
    pose_wall_planar_slam_settings settings{};
    require_ok(pose_wall_planar_slam_settings_init(&settings), translatable("the settings of the map"));
    settings.keyframes_most = kSavedKeyframesMost;
    return settings;
  }
  static std::uint64_t bytes_for(const pose_wall_planar_slam_settings& settings) {
    std::uint64_t bytes = 0;
    require_ok(pose_wall_planar_slam_memory_needed(&settings, &bytes), translatable("the settings of the map"));
    return bytes;
  }

  pose_wall_planar_slam_settings settings_;
  PartBlock block_;
  pose_wall_planar_slam* slam_ = nullptr;
};

}  // namespace

PlaceFinder::PlaceFinder(const std::string& trail) : block_(localise_bytes()) {
  const pose_wall_planar_localise_settings settings = localise_settings();
  require_ok(pose_wall_planar_localise_open(&settings, block_.data(), block_.bytes(), &localise_),
             translatable("the settings of the localisation"));
  SavedTrail(trail).each_keyframe([this](const pose_wall_planar_keyframe& keyframe, const float* xy_m) {
    require_ok(pose_wall_planar_localise_add(localise_, &keyframe.pose, xy_m, keyframe.points),
               translatable("the map of the localisation"));
  });
  require_ok(pose_wall_planar_localise_finish(localise_), translatable("the map of the localisation"));
  result_.struct_size = sizeof result_;
}

const pose_wall_planar_localise_result& PlaceFinder::find(const pose_wall_planar_scan& scan,
                                                          const pose_wall_planar_pose& odometry) {
  require_ok(pose_wall_planar_localise_process(localise_, &scan, &odometry, &result_),
             translatable("the localisation"));
  return result_;
}

double position_sigma_m(const pose_wall_planar_localise_result& where) {
  const double xx = where.covariance[0], xy = where.covariance[1], yy = where.covariance[4];
  const double variance = 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
  return variance >= 0.0 ? std::sqrt(variance) : std::numeric_limits<double>::infinity();
}

}  // namespace pose_wall::tools
