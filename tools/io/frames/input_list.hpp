// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the words INPUT... of a command line stand for: frame files in the order they are to be processed.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pose_wall::tools {

struct FrameInputs {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> errors;  // folders that gave nothing, each naming the folder and why
  std::vector<std::string> notes;   // what a person should know of the order, each naming the folder
};

// A file stays as it is, existing or not: load_frame says what is wrong with it. A folder gives its frame files (not
// those of folders inside it) in natural order of their names, 9.pcd before 10.pcd; links that lead nowhere are among
// them. Its files of text count where it has no other frames, and only those that begin like points: tables lie beside
// recordings. Files with other endings are passed over.
FrameInputs collect_inputs(const std::vector<std::string>& arguments);

}  // namespace pose_wall::tools
