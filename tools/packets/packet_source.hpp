// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Captures of packets as frames: Ouster where its metadata is there, Velodyne VLP-16 else.

#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "frames/frame_source.hpp"

namespace pose_wall::tools {

// By content, or by its ending where it is too short to tell.
bool is_packet_capture(const std::filesystem::path& file);

// `metadata` is a JSON file; where it is empty, the one beside the capture that has its name. Goes through the capture
// once. A turn at either end that the capture did not see whole is left out, unless there is no other. Throws
// FrameError.
std::unique_ptr<FrameSource> open_packet_capture(const std::filesystem::path& file, const std::string& metadata);

}  // namespace pose_wall::tools
