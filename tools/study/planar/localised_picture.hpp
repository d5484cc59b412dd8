// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The way of localised scans on their map, coloured by state.

#pragma once

#include <string>
#include <vector>

#include "study/planar/known_map.hpp"
#include "study/planar/localised_rows.hpp"
#include "study/planar/map_picture.hpp"

namespace pose_wall::tools {

struct LocalisedWay {
  std::vector<LocalisedRow> rows;
  std::vector<pose_wall_planar_pose> odometry;         // of each row, or none at all
  std::vector<pose_wall_planar_candidate> candidates;  // of the last row
};

std::string localised_picture(const KnownMap& map, const LocalisedWay& way, const std::string& title);

}  // namespace pose_wall::tools
