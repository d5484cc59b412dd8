// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The map, the place on it and the obstacle stop, as the page and scripts get them.

#pragma once

#include <string>

#include "apps/live/planar/planar_news.hpp"
#include "study/planar/stop_line.hpp"

namespace pose_wall::tools::live {

// JSON, and the same as events. line: tells why the stop stops, in both languages.
std::string stop_json(const StopNews& news, const StopLine& line);
std::string roadway_json(const RoadwayNews& news);
std::string stop_event(const StopNews& news, const StopLine& line);
std::string roadway_event(const RoadwayNews& news);
// The map as a picture, with its place.
std::string map_event(const RoadwayMap& map);

// PNG of the map, the most y on top; cells are joined where it is larger than kPictureMost pixels a side.
std::string map_png(const RoadwayMap& map);
constexpr std::uint32_t kPictureMost = 1600;

}  // namespace pose_wall::tools::live
