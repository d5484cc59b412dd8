// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A map from above, with ways, links and places on it: one SVG.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pose_wall_planar_grid.h"

namespace pose_wall::tools {

// Colours of lines on a map.
inline constexpr std::string_view kTrailColour = "#2274a5";
inline constexpr std::string_view kClosureColour = "#d9720f";
inline constexpr std::string_view kPathColour = "#1e8e4f";
inline constexpr std::string_view kReverseColour = "#7a4ea3";
inline constexpr std::string_view kTruthColour = "#737b83";
inline constexpr std::string_view kBadColour = "#b3261e";

struct MapPlace {
  double x_m = 0.0, y_m = 0.0;
};

struct MapLine {
  std::vector<MapPlace> places;
  std::string_view colour;
  double width_px = 1.5;
  std::string_view dashes = "";
};

// A machine that stands there; its outline in its own frame.
struct MapMachine {
  pose_wall_planar_pose base{};
  std::vector<MapPlace> outline_m;  // empty: an arrow
  std::string_view colour = kTrailColour;
  std::string words;
};

struct MapDot {
  MapPlace at;
  std::string_view colour;
  std::string words;
};

struct LegendEntry {
  std::string_view colour;
  std::string words;
};

struct MapScene {
  pose_wall_planar_grid grid{};
  std::string title, subtitle, warning;  // a warning stands in red
  std::vector<MapLine> lines;
  std::vector<MapMachine> machines;
  std::vector<MapDot> dots;
  std::vector<LegendEntry> legend;
  // Shown of the map, about all lines and machines; 0: all of it.
  double margin_m = 0.0;
};

// Cells of many metres are drawn coarser; a thing stays a thing.
std::string map_picture(const MapScene& scene);

// The roadheader: 4.5 x 1.2 m about its base.
std::vector<MapPlace> roadheader_outline();

}  // namespace pose_wall::tools
