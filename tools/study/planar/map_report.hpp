// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A page about maps, localised scans and routes: pictures and figures in both languages, one HTML file.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pose_wall::tools {

// A folder that `map` or `localise` wrote, a table of `localise` or `plan`, or a picture (SVG).
bool is_map_result(const std::string& input);

struct MapReport {
  std::string page;
  std::size_t pictures = 0;
  std::vector<std::filesystem::path> files;  // all that were read
};

// A section for each input. It opens in the chosen language. Throws TrailFileError, MapFileError, CsvError.
MapReport map_report(const std::vector<std::string>& inputs, const std::string& title);

}  // namespace pose_wall::tools
