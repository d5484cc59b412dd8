// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The header of a Polygon File Format file.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/frames/frame.hpp"

namespace pose_wall::tools {

enum class PlyEncoding { kAscii, kBinaryLittleEndian, kBinaryBigEndian };

struct PlyProperty {
  std::string name;
  std::uint32_t type =
      POSE_WALL_FIELD_FLOAT32;  // also those in wide_times.hpp; of the value, or of each item of a list
  std::uint32_t length_type = POSE_WALL_FIELD_NONE;  // of a list's length; NONE: not a list
  bool is_list() const { return length_type != POSE_WALL_FIELD_NONE; }
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;  // in the file's order
  std::size_t data_offset = 0;
  std::size_t lines = 0;
};

// Throws FrameError naming the line.
PlyHeader parse_ply_header(const Bytes& bytes);

}  // namespace pose_wall::tools
