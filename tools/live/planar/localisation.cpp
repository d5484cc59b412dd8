// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The localisation in a saved map as a finder of places.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "language/language.hpp"
#include "live/log.hpp"
#include "live/planar/place_finder.hpp"
#include "planar/map_files.hpp"
#include "planar/part_block.hpp"
#include "planar/plane_pose.hpp"
#include "planar/saved_trail.hpp"
#include "pose_wall_planar_localise.h"

namespace pose_wall::tools::live {
namespace {

// Travel between two places of the track that is shown.
constexpr double kTrackStep_m = 0.3;
// A kilometre of road takes some 300.
constexpr std::uint32_t kTilesMost = 2048;

pose_wall_planar_localise_settings settings_of_localisation(bool map_is_whole) {
  pose_wall_planar_localise_settings settings{};
  require_ok(pose_wall_planar_localise_settings_init(&settings), translatable("the settings of the map"));
  settings.tiles_most = kTilesMost;
  settings.map_is_whole = map_is_whole ? 1 : 0;
  return settings;
}

std::uint64_t bytes_for(const pose_wall_planar_localise_settings& settings) {
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_localise_memory_needed(&settings, &bytes), translatable("the settings of the map"));
  return bytes;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad() || bytes.empty()) {
    throw std::runtime_error(fmt::format("planar_map: {} cannot be read", file.string()));
  }
  return bytes;
}

void require_map(std::int32_t status, const std::filesystem::path& file) {
  if (status == POSE_WALL_OK) return;
  throw std::runtime_error(fmt::format("planar_map: {}: {}", file.string(), pose_wall_planar_status_text(status)));
}

void add_trail(pose_wall_planar_localise* localise, const std::filesystem::path& file) {
  const SavedTrail trail = [&file] {
    const std::string saved = bytes_of(file);
    try {
      return SavedTrail(file, saved);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("planar_map: {}", error.what()));
    }
  }();
  for (std::uint32_t k = 0; k < trail.keyframes(); ++k) {
    const pose_wall_planar_keyframe keyframe = trail.keyframe(k);
    std::vector<float> xy_m = trail.points(k);
    xy_m.resize(xy_m.size() + 2);  // a keyframe without points has an address, too
    require_map(pose_wall_planar_localise_add(localise, &keyframe.pose, xy_m.data(), keyframe.points), file);
  }
}

std::shared_ptr<const RoadwayMap> map_of(const std::filesystem::path& yaml) {
  MapFile file = read_map_files(yaml);
  if (!file.note.empty()) log_line(Grade::kWarning, "planar", file.note);
  auto map = std::make_shared<RoadwayMap>();
  map->version = 1;
  map->width = file.width, map->height = file.height;
  map->resolution_m = file.resolution_m, map->origin_x_m = file.origin_x_m, map->origin_y_m = file.origin_y_m;
  map->cells = std::move(file.cells);
  return map;
}

class Localisation final : public PlaceFinder {
 public:
  explicit Localisation(const PlanarSettings& settings)
      : settings_(settings_of_localisation(settings.map_whole == "yes")), block_(bytes_for(settings_)) {
    require_ok(pose_wall_planar_localise_open(&settings_, block_.data(), block_.bytes(), &localise_),
               translatable("the settings of the map"));
    load(settings.map);
    last_.struct_size = sizeof last_;
  }

  void place(const pose_wall_planar_scan& scan, const pose_wall_planar_pose* odometry, RoadwayNews* news) override {
    require_ok(pose_wall_planar_localise_process(localise_, &scan, odometry, &last_), translatable("the scan"));
    news->state = pose_wall_planar_localise_state_name(last_.state);
    if (last_.state == POSE_WALL_PLANAR_LOCALISE_UNIQUE) {
      news->pose = last_.pose;
      std::copy(std::begin(last_.covariance), std::end(last_.covariance), std::begin(news->covariance));
      if (track_.empty() || distance_m(track_.back(), last_.pose) >= kTrackStep_m) track_.push_back(last_.pose);
      if (track_.size() > kTrackMost) track_.erase(track_.begin());
    }
    pose_wall_planar_candidate candidate{};
    candidate.struct_size = sizeof candidate;
    for (std::uint32_t k = 0; k < last_.candidates; ++k) {
      if (pose_wall_planar_localise_candidate(localise_, k, &candidate) != POSE_WALL_OK) break;
      news->candidates.push_back(candidate.pose);
    }
  }

  std::shared_ptr<const RoadwayMap> changed_map(std::int64_t) override { return std::exchange(map_, nullptr); }
  std::vector<pose_wall_planar_pose> track() const override { return track_; }

  std::vector<std::pair<std::string, std::string>> facts() const override {
    return {{"searches", std::to_string(last_.searches)},
            {"progress", fmt::format("{:.2f}", last_.progress)},
            {"candidates", std::to_string(last_.candidates_all)},
            {"place lost", std::to_string(last_.lost)}};
  }

 private:
  // A trail holds more of the rock's relief than cells do; the cells beside it are for people and for planners.
  void load(const std::filesystem::path& file) {
    const bool is_trail = file.extension() == ".pwt";
    const std::filesystem::path yaml = is_trail ? file.parent_path() / "map.yaml" : file;
    if (is_trail) add_trail(localise_, file);
    if (!is_trail || std::filesystem::exists(yaml)) map_ = map_of(yaml);
    if (!map_) log_line(Grade::kWarning, "planar", fmt::format("there is no {}: no map is shown", yaml.string()));
    if (!is_trail) {
      const pose_wall_planar_grid grid = map_->grid();
      require_map(pose_wall_planar_localise_add_grid(localise_, &grid), file);
    }
    require_map(pose_wall_planar_localise_finish(localise_), file);
  }

  pose_wall_planar_localise_settings settings_;
  PartBlock block_;
  pose_wall_planar_localise* localise_ = nullptr;
  pose_wall_planar_localise_result last_{};
  std::shared_ptr<const RoadwayMap> map_;
  std::vector<pose_wall_planar_pose> track_;
};

}  // namespace

std::unique_ptr<PlaceFinder> make_localisation(const PlanarSettings& settings) {
  return std::make_unique<Localisation>(settings);
}

}  // namespace pose_wall::tools::live
