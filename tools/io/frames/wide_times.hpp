// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Types of fields beyond those that the engine reads. PCL's own type for a time is a whole number of 64 bits; the
// engine reads the time of a point from a float64, which takes the same bytes.

#pragma once

#include <cstddef>
#include <cstdint>

#include "io/frames/frame.hpp"

namespace pose_wall::tools {

// Behind those of pose_wall_field, numbered as sensor_msgs/PointField numbers them.
constexpr std::uint32_t kFieldInt64 = 9;
constexpr std::uint32_t kFieldUint64 = 10;
constexpr std::uint32_t kFieldBool = 11;  // one byte

// Bytes of one value, of these types and of pose_wall_field; 0: no such type.
std::uint32_t field_type_bytes(std::uint32_t type);

// Leaves only types that the engine reads: what it takes as a time, an intensity or a ring becomes float64 in its
// place, a bool uint8. Other 64-bit numbers, and those that share bytes with another field, become
// POSE_WALL_FIELD_NONE. Nanoseconds since 1970 are rounded to 256 ns. describe_frame() calls it.
void narrow_wide_fields(std::byte* points, PointLayout* layout);

}  // namespace pose_wall::tools
