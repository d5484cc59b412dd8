// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The SLAM as a finder of places.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "apps/live/log.hpp"
#include "apps/live/planar/live_map.hpp"
#include "apps/live/planar/place_finder.hpp"
#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"
#include "io/language/system_errors.hpp"
#include "io/planar_files/map_files.hpp"
#include "pose_wall_planar_slam.h"
#include "study/planar/part_block.hpp"

namespace pose_wall::tools::live {
namespace {

pose_wall_planar_slam_settings default_slam_settings() {
  pose_wall_planar_slam_settings settings{};
  require_ok(pose_wall_planar_slam_settings_init(&settings), translatable("the settings of the map"));
  return settings;
}

std::uint64_t bytes_for(const pose_wall_planar_slam_settings& settings) {
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_slam_memory_needed(&settings, &bytes), translatable("the settings of the map"));
  return bytes;
}

class Mapping final : public PlaceFinder {
 public:
  explicit Mapping(const PlanarSettings& settings)
      : settings_(default_slam_settings()), block_(bytes_for(settings_)), map_(settings.cell_m), file_(settings.map) {
    require_ok(pose_wall_planar_slam_open(&settings_, block_.data(), block_.bytes(), &slam_),
               translatable("the settings of the map"));
    last_.struct_size = sizeof last_;
    require_folder();
    if (file_.empty() || !std::filesystem::exists(file_)) return;
    log_line(Grade::kWarning, "planar", fmt::format("{} is there already: this map is not saved", file_.string()));
    file_.clear();
  }

  void find(const pose_wall_planar_scan& scan, const pose_wall_planar_pose* odometry, RoadwayNews* news) override {
    require_ok(pose_wall_planar_slam_process(slam_, &scan, odometry, &last_), translatable("the scan"));
    map_.add(scan, last_, slam_);
    news->state = pose_wall_planar_slam_state_name(last_.state);
    const bool is_known = last_.state == POSE_WALL_PLANAR_SLAM_FIRST || last_.state == POSE_WALL_PLANAR_SLAM_TRACKED;
    if (is_known) news->pose = last_.pose;
  }

  std::shared_ptr<const RoadwayMap> changed_map(std::int64_t header_stamp_ns) override {
    return map_.changed(header_stamp_ns);
  }

  std::vector<pose_wall_planar_pose> track() const override {
    std::vector<pose_wall_planar_pose> poses;
    const std::uint32_t step = 1 + last_.keyframes / static_cast<std::uint32_t>(kTrackMost);
    pose_wall_planar_keyframe keyframe{};
    keyframe.struct_size = sizeof keyframe;
    for (std::uint32_t k = 0; k < last_.keyframes; k += step) {
      require_ok(pose_wall_planar_slam_keyframe(slam_, k, &keyframe), translatable("a keyframe"));
      poses.push_back(keyframe.pose);
    }
    return poses;
  }

  void save(const RoadwayMap* map) override {
    if (file_.empty() || last_.keyframes == 0) return;
    std::uint64_t bytes = 0;
    require_ok(pose_wall_planar_slam_save_bytes(slam_, &bytes), translatable("the trail"));
    std::string saved(static_cast<std::size_t>(bytes), '\0');
    require_ok(pose_wall_planar_slam_save(slam_, saved.data(), saved.size(), &bytes), translatable("the trail"));
    write_lasting_file(file_, saved);
    if (map != nullptr) write_map_files(file_.parent_path() / "map.yaml", map->grid());
    log_line(Grade::kGood, "planar", fmt::format("saved {} keyframes in {}", last_.keyframes, file_.string()));
  }

  std::vector<std::pair<std::string, std::string>> facts() const override {
    return {{"keyframes", std::to_string(last_.keyframes)},
            {"closures", std::to_string(last_.closures)},
            {"trail is full", std::to_string(last_.is_full)},
            {"maps built anew", std::to_string(map_.rebuilt())},
            {"beams without room in the map", std::to_string(map_.beams_not_stored())}};
  }

 private:
  // Now, and not after an hour of driving, when the map is to be saved.
  void require_folder() const {
    if (file_.empty()) return;
    const std::filesystem::path folder = file_.has_parent_path() ? file_.parent_path() : ".";
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored)) {
      throw std::runtime_error(
          fmt::format("planar_map: {}: there is no folder {}; allowed: a file in a folder that is there",
                      file_.string(), folder.string()));
    }
    if (access(folder.c_str(), W_OK | X_OK) != 0) {
      throw std::runtime_error(
          fmt::format("planar_map: {}: {}: {}", file_.string(), folder.string(), system_error_text(errno)));
    }
  }

  pose_wall_planar_slam_settings settings_;
  PartBlock block_;
  pose_wall_planar_slam* slam_ = nullptr;
  pose_wall_planar_slam_result last_{};
  LiveMap map_;
  std::filesystem::path file_;  // empty: not saved
};

}  // namespace

std::unique_ptr<PlaceFinder> make_mapping(const PlanarSettings& settings) {
  return std::make_unique<Mapping>(settings);
}

}  // namespace pose_wall::tools::live
