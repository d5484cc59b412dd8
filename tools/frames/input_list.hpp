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
};

// A file stays as it is, existing or not: load_frame says what is wrong with it. A folder gives its frame files (not
// those of folders inside it) in plain byte order of their names, so that 10.pcd comes before 9.pcd; links that lead
// nowhere are among them; files with other endings are passed over.
FrameInputs collect_inputs(const std::vector<std::string>& arguments);

}  // namespace pose_wall::tools
