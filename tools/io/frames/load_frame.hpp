// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Frame files by what they begin with; by their ending where that does not tell.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/frames/bare_points.hpp"
#include "io/frames/frame.hpp"

namespace pose_wall::tools {

// How points are read that no header describes: bare numbers, and text without names of columns.
struct BareChoice {
  std::optional<BareLayout> given;      // by the user; goes for bare numbers and text
  std::optional<BareLayout> of_others;  // as other files of the recording are read; for bare numbers that do not tell
  std::optional<BareLayout> text_of_others;  // the same for text of five columns
};

// ".pcd, .bin, .ply, .xyz, .asc, .txt, .csv"
std::string frame_endings_text();

// True for a path whose ending names a format with a header or bare numbers: .pcd, .bin, .ply; upper and lower case
// alike.
bool has_frame_ending(const std::filesystem::path& path);

// True for .xyz, .asc, .txt and .csv.
bool has_text_ending(const std::filesystem::path& path);

// True for .bin.
bool has_bare_ending(const std::filesystem::path& path);

// The whole of a regular file. Throws FrameError, without naming the path.
Bytes read_frame_bytes(const std::filesystem::path& path);

// Reads a frame file. cloud.stamp_ns is left at 0. Throws FrameError, without naming the path.
Frame load_frame(const std::filesystem::path& path, const BareChoice& bare = {});

}  // namespace pose_wall::tools
