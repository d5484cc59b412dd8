// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How many scans of a map fit what was seen before them, and what that makes of the map. A folder of `pose_wall map -o`
// keeps it as map.json, so that its report tells the same.

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "study/planar/scan_trail.hpp"

namespace pose_wall::tools {

enum class MapGrade { kGood, kDoubtful, kNotUsable };

struct MapFit {
  std::size_t scans = 0;
  std::size_t badly = 0;       // matched, but their points lie off the surfaces
  std::size_t blind = 0;       // too few points to be matched
  std::size_t new_trails = 0;  // began anew, as the way to them is unknown

  MapGrade grade() const;
  // One line; the same for terminal, picture and page.
  std::string verdict() const;
};

MapFit fit_of(const ScanTrail& trail);

// "3 (5.0 %)".
std::string part_of_scans(std::size_t part, std::size_t scans);

void write_fit(const std::filesystem::path& folder, const MapFit& fit);
// None: the folder has none, as of a version before it, or it is no such file.
std::optional<MapFit> read_fit(const std::filesystem::path& folder);

}  // namespace pose_wall::tools
