// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What an Ouster sensor says of itself: the JSON file that is recorded beside its packets.

#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/packets/ouster_profiles.hpp"

namespace pose_wall::tools {

// Columns that the sensor measures, both included; it may go on beyond the last one with column 0.
struct OusterWindow {
  std::uint32_t first = 0, last = 0;

  bool holds(std::uint32_t column) const {
    return first <= last ? first <= column && column <= last : column >= first || column <= last;
  }
  std::uint32_t columns(std::uint32_t of_frame) const {
    return first <= last ? last - first + 1 : of_frame - first + last + 1;
  }
};

struct OusterMetadata {
  OusterProfile profile = ouster_profiles().front();
  OusterHeader header = OusterHeader::kNone;
  std::string product;
  std::uint64_t serial = 0;  // 0: not told
  std::uint32_t rings = 0;
  std::uint32_t columns_per_frame = 0;
  std::uint32_t columns_per_packet = 0;
  std::optional<OusterWindow> window;  // nothing: not told
  // The sensor puts the strongest or the farthest of two returns first, as it is set up; or the nearest, which may be
  // dust before a wall: then the farther is taken.
  bool takes_farther = false;
  std::vector<double> altitude_deg, azimuth_deg;  // of each ring, from the top; no laser is there: NaN
  double beam_origin_out_m = 0.0, beam_origin_up_m = 0.0;
  std::array<double, 16> sensor_from_lidar{};  // row by row, the last column in metres

  bool has_laser(std::size_t ring) const { return !std::isnan(altitude_deg[ring]); }
};

// Throws FrameError that names what is missing or wrong.
OusterMetadata parse_ouster_metadata(const std::string& text);

// The metadata of a capture NAME.pcap: NAME.json, else NAME_0.json, as ouster-cli calls it; NAME.json where none is.
std::filesystem::path ouster_metadata_beside(const std::filesystem::path& capture);

}  // namespace pose_wall::tools
