// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Images of few colours as PNG, without a library: the same bytes everywhere.

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pose_wall::tools {

struct Rgb {
  std::uint8_t red, green, blue;
};

// Pixels row by row from the top, each the number of one of four colours. Long equal stretches take few bytes.
std::string indexed_png(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& pixels,
                        const std::array<Rgb, 4>& colours);

}  // namespace pose_wall::tools
