// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What an Ouster sensor says of itself: the JSON file that is recorded beside its packets.

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pose_wall::tools {

enum class OusterProfile { kLegacy, kSingle, kDual, kLowRate };

struct OusterMetadata {
  OusterProfile profile = OusterProfile::kLegacy;
  std::string product;
  std::uint32_t rings = 0;
  std::uint32_t columns_per_frame = 0;
  std::uint32_t columns_per_packet = 0;
  std::vector<double> altitude_deg, azimuth_deg;  // of each ring, from the top
  double beam_origin_out_m = 0.0, beam_origin_up_m = 0.0;
  std::array<double, 16> sensor_from_lidar{};  // row by row, the last column in metres
};

// Throws FrameError that names what is missing or wrong.
OusterMetadata parse_ouster_metadata(const std::string& text);

}  // namespace pose_wall::tools
