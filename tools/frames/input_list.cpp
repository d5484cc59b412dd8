// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "frames/input_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "frames/load_frame.hpp"

namespace pose_wall::tools {
namespace {

namespace fs = std::filesystem;

void add_folder(const fs::path& folder, FrameInputs& inputs) {
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  if (error) {
    inputs.errors.push_back(fmt::format("{}: {}", folder.string(), error.message()));
    return;
  }
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : entries) {
    std::error_code ignored;
    if (has_frame_ending(entry.path()) && entry.is_regular_file(ignored)) files.push_back(entry.path());
  }
  if (files.empty()) {
    inputs.errors.push_back(fmt::format("{}: no frame in this folder; files ending in {} are looked for",
                                        folder.string(), frame_endings_text()));
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) { return a.native() < b.native(); });
  inputs.files.insert(inputs.files.end(), files.begin(), files.end());
}

}  // namespace

FrameInputs collect_inputs(const std::vector<std::string>& arguments) {
  FrameInputs inputs;
  for (const std::string& argument : arguments) {
    std::error_code ignored;
    if (fs::is_directory(argument, ignored)) {
      add_folder(argument, inputs);
    } else {
      inputs.files.emplace_back(argument);
    }
  }
  return inputs;
}

}  // namespace pose_wall::tools
