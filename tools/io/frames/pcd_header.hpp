// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The header of a Point Cloud Data file, versions 0.5 to 0.7.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/frames/frame.hpp"

namespace pose_wall::tools {

enum class PcdEncoding { kAscii, kBinary, kBinaryCompressed };

struct PcdField {
  std::string name;
  char type = 'F';           // F, I, U or B
  std::uint32_t size = 4;    // bytes of one element
  std::uint32_t count = 1;   // elements
  std::uint32_t offset = 0;  // bytes from the start of a point
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint32_t point_step = 0;
  std::uint64_t points = 0;  // POINTS, or WIDTH x HEIGHT where POINTS is absent
  PcdEncoding encoding = PcdEncoding::kAscii;
  std::size_t data_offset = 0;
  std::size_t lines = 0;                 // of the header, for messages about ascii points
  std::optional<std::int64_t> stamp_ns;  // of a comment "# stamp_ns N": the format has none of its own
};

// Throws FrameError naming the line.
PcdHeader parse_pcd_header(const Bytes& bytes);

// The declared number of points; where it is zero and `available` bytes are a whole number of points, that number: some
// writers stream and leave every count at zero.
std::uint64_t points_or_held(const PcdHeader& header, std::uint64_t available);

// The type of a field of one element, also of those in wide_times.hpp; POSE_WALL_FIELD_NONE where it has several.
std::uint32_t field_type_of(const PcdField& field);

}  // namespace pose_wall::tools
