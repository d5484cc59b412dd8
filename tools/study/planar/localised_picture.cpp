// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/localised_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/language/language.hpp"
#include "study/planar/plane_pose.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::string_view kLocaliseColours[kLocaliseStates] = {"#9aa1a8", kReverseColour, kClosureColour, kPathColour,
                                                                kBadColour};

// Where base stood at each row. While the place was not known yet, odometry leads back from where it was found.
std::vector<std::optional<pose_wall_planar_pose>> places_of(const LocalisedWay& way) {
  std::vector<std::optional<pose_wall_planar_pose>> places(way.rows.size());
  const std::size_t none = way.rows.size();
  std::size_t found = none;
  for (std::size_t k = way.rows.size(); k-- > 0;) {
    const LocalisedRow& row = way.rows[k];
    if (row.has_pose()) {
      places[k] = row.base;
      if (row.is_unique()) found = k;
    } else if (found != none && k < way.odometry.size()) {
      places[k] = combined(way.rows[found].base, seen_from(way.odometry[found], way.odometry[k]));
    }
    if (row.is_restart) found = none;
  }
  return places;
}

// One line as long as the state stays, from the last place of the state before it.
void draw_way(const LocalisedWay& way, const std::vector<std::optional<pose_wall_planar_pose>>& places,
              MapScene* scene) {
  bool goes_on = false;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (!places[k] || way.rows[k].is_restart) goes_on = false;
    if (!places[k]) continue;
    const std::string_view colour = kLocaliseColours[way.rows[k].state];
    const MapPlace here{places[k]->x_m, places[k]->y_m};
    if (!goes_on) {
      scene->lines.push_back({{here}, colour, 2.0});
    } else if (scene->lines.back().colour != colour) {
      const MapPlace last = scene->lines.back().places.back();
      scene->lines.push_back({{last}, colour, 2.0});
    }
    scene->lines.back().places.push_back(here);
    goes_on = true;
    if (way.rows[k].is_restart) scene->dots.push_back({here, kTruthColour, ""});
  }
}

void draw_candidates(const LocalisedWay& way, MapScene* scene) {
  std::size_t number = 1;
  for (const pose_wall_planar_candidate& candidate : way.candidates) {
    scene->machines.push_back(
        {candidate.pose, {}, kClosureColour, fmt::format("{}: {:.0f} %", number++, 100.0 * candidate.weight)});
  }
}

}  // namespace

std::string localised_picture(const KnownMap& map, const LocalisedWay& way, const std::string& title) {
  const LocaliseFigures figures = figures_of(way.rows);
  MapScene scene;
  scene.grid = map.cells.grid();
  scene.title = title;
  scene.subtitle = say("{} scans, {} unique, {} restarts", figures.scans,
                       figures.of_state[POSE_WALL_PLANAR_LOCALISE_UNIQUE], figures.restarts.size());
  draw_way(way, places_of(way), &scene);
  draw_candidates(way, &scene);
  if (!way.rows.empty() && way.rows.back().has_pose()) {
    scene.machines.push_back({way.rows.back().base, {}, kLocaliseColours[way.rows.back().state], tr("end")});
  }
  for (const std::uint32_t state :
       {POSE_WALL_PLANAR_LOCALISE_UNIQUE, POSE_WALL_PLANAR_LOCALISE_DOUBTFUL, POSE_WALL_PLANAR_LOCALISE_AMBIGUOUS,
        POSE_WALL_PLANAR_LOCALISE_UNKNOWN, POSE_WALL_PLANAR_LOCALISE_SEARCHING}) {
    scene.legend.push_back({kLocaliseColours[state], place_state_words(state)});
  }
  return map_picture(scene);
}

}  // namespace pose_wall::tools
