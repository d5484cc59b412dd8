// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Points as bare little-endian numbers, one point after the other, without any header: KITTI's .bin, nuScenes' .bin,
// what numpy.tofile writes.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/frames/frame.hpp"

namespace pose_wall::tools {

// One letter per value: x y z, i intensity, t time, r ring, _ passed over.
struct BareLayout {
  std::string columns;
  std::uint32_t value_bytes = 4;  // float32, or 8: float64

  std::uint32_t point_step() const { return static_cast<std::uint32_t>(columns.size()) * value_bytes; }
  bool same_bytes(const BareLayout& other) const {
    return columns.size() == other.columns.size() && value_bytes == other.value_bytes;
  }
};

// "xyzi", "xyz64"; nothing where a letter is unknown or twice, or x, y or z is missing.
std::optional<BareLayout> parse_bare_layout(std::string_view word);

// "letters of x y z i (intensity) ..., as xyzi", for errors and help.
std::string bare_layout_rule();

// "xyzi"
std::string bare_layout_word(const BareLayout& layout);

// "float32 x y z intensity, 16 bytes a point"
std::string bare_layout_words(const BareLayout& layout);

// What a letter stands for, as readers name fields; "" for '_'.
std::string_view bare_column_name(char letter);

// Throws FrameError when the size is no multiple of a point's.
Frame read_bare_points(Bytes bytes, const BareLayout& layout);

}  // namespace pose_wall::tools
