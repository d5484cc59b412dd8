// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A saved map in which a machine can be found: a trail, or cells.

#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "io/planar_files/map_files.hpp"
#include "study/planar/saved_trail.hpp"

namespace pose_wall::tools {

struct KnownMap {
  std::filesystem::path file;                // that holds the places
  std::unique_ptr<SavedTrail> trail;         // nullptr: cells alone
  MapFile cells;                             // for pictures, and for localisation where there is no trail
  std::vector<std::filesystem::path> files;  // all that were read

  // What a keyframe saw there has gone since: the cells round it are free.
  bool has_moved(double x_m, double y_m) const;
};

// What `pose_wall map -o` wrote: its folder, its trail.pwt, or a map's YAML file (then the cells count). Throws
// TrailFileError or MapFileError; the message says what to give instead.
KnownMap read_known_map(const std::filesystem::path& map);

}  // namespace pose_wall::tools
