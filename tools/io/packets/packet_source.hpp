// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Captures of packets as frames.

#pragma once

#include <filesystem>
#include <memory>

#include "io/frames/frame_source.hpp"
#include "io/packets/sensors.hpp"

namespace pose_wall::tools {

// By content; by its ending where that does not tell.
bool is_packet_capture(const std::filesystem::path& file);

// Where no metadata is named, that of an Ouster is the JSON file beside the capture that has its name. Goes through the
// capture once. Throws FrameError.
std::unique_ptr<FrameSource> open_packet_capture(const std::filesystem::path& file, const SensorOptions& options);

}  // namespace pose_wall::tools
