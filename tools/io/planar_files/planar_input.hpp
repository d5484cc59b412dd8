// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What is no frame but belongs to planar scans: named to those who give it to the wrong verb.

#pragma once

#include <filesystem>
#include <string>

namespace pose_wall::tools {

// By its first bytes, packed or not; by its name (.clf, .log) where they leave it open. False for what cannot be read.
bool is_carmen_log(const std::filesystem::path& file);

// "this is a map as `pose_wall map -o` writes it; localise, plan and report take it": logs of CARMEN, maps, their parts
// and tables, with the verbs that take them. Empty: nothing of that kind, or nothing that can be read.
std::string planar_input_text(const std::filesystem::path& input);

// The YAML file of cells that is meant: of a folder its map.yaml, else the file itself. Throws std::invalid_argument
// for what is not there, MapFileError for what holds no cells; both say what to give.
std::filesystem::path cells_file_of(const std::filesystem::path& map);

}  // namespace pose_wall::tools
