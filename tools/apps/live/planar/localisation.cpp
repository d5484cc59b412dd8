// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The localisation in a saved map as a finder of places.

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "apps/live/log.hpp"
#include "apps/live/planar/place_finder.hpp"
#include "study/planar/known_map.hpp"
#include "study/planar/map_localiser.hpp"
#include "study/planar/plane_pose.hpp"

namespace pose_wall::tools::live {
namespace {

// Travel between two places of the track that is shown.
constexpr double kTrackStep_m = 0.3;

pose_wall_planar_localise_settings localise_settings_of(const PlanarSettings& settings) {
  pose_wall_planar_localise_settings ours = default_localise_settings();
  ours.map_is_whole = settings.map_whole == "yes" ? 1 : 0;
  return ours;
}

std::shared_ptr<const RoadwayMap> shown_map(MapFile cells) {
  auto map = std::make_shared<RoadwayMap>();
  map->version = 1;
  map->width = cells.width, map->height = cells.height;
  map->resolution_m = cells.resolution_m, map->origin_x_m = cells.origin_x_m, map->origin_y_m = cells.origin_y_m;
  map->cells = std::move(cells.cells);
  return map;
}

class Localisation final : public PlaceFinder {
 public:
  // What the localiser has taken of the map is not kept twice.
  Localisation(KnownMap map, const PlanarSettings& settings) : localiser_(map, localise_settings_of(settings)) {
    if (!map.cells.note.empty()) log_line(Grade::kWarning, "planar", map.cells.note);
    map_ = shown_map(std::move(map.cells));
  }

  void find(const pose_wall_planar_scan& scan, const pose_wall_planar_pose* odometry, RoadwayNews* news) override {
    const pose_wall_planar_localise_result& where = localiser_.process(scan, odometry);
    news->state = pose_wall_planar_localise_state_name(where.state);
    if (where.state == POSE_WALL_PLANAR_LOCALISE_UNIQUE) {
      news->pose = where.pose;
      std::copy(std::begin(where.covariance), std::end(where.covariance), std::begin(news->covariance));
      if (track_.empty() || distance_m(track_.back(), where.pose) >= kTrackStep_m) track_.push_back(where.pose);
      if (track_.size() > kTrackMost) track_.erase(track_.begin());
    }
    for (const pose_wall_planar_candidate& one : localiser_.candidates()) news->candidates.push_back(one.pose);
  }

  std::shared_ptr<const RoadwayMap> changed_map(std::int64_t) override { return std::exchange(map_, nullptr); }
  std::vector<pose_wall_planar_pose> track() const override { return track_; }

  std::vector<std::pair<std::string, std::string>> facts() const override {
    const pose_wall_planar_localise_result& where = localiser_.last();
    return {{"searches", std::to_string(where.searches)},
            {"progress", fmt::format("{:.2f}", where.progress)},
            {"candidates", std::to_string(where.candidates_all)},
            {"place lost", std::to_string(where.lost)}};
  }

 private:
  MapLocaliser localiser_;
  std::shared_ptr<const RoadwayMap> map_;
  std::vector<pose_wall_planar_pose> track_;
};

}  // namespace

std::unique_ptr<PlaceFinder> make_localisation(const PlanarSettings& settings) {
  try {
    return std::make_unique<Localisation>(read_known_map(settings.map), settings);
  } catch (const std::runtime_error& fault) {
    throw std::runtime_error(fmt::format("planar_map: {}", fault.what()));
  }
}

}  // namespace pose_wall::tools::live
