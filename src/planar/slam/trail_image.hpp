// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A trail as bytes: head, keyframes, points, edges, CRC-32. Low bytes first, so that they mean the same on every
// machine.

#pragma once

#include <cstdint>

#include "planar/slam/trail.hpp"

namespace pose_wall::planar {

class TrailImage {
 public:
  static std::uint64_t bytes(const Trail& trail);
  static void write(const Trail& trail, unsigned char* to);
  // POSE_WALL_OK, POSE_WALL_PLANAR_E_MAP_FILE, POSE_WALL_E_BLOCK_SMALL. The trail is then unchanged.
  static std::int32_t read(const unsigned char* from, std::uint64_t bytes, Trail* trail);
};

}  // namespace pose_wall::planar
