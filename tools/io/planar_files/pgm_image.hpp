// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Grey images (netpbm's PGM) in memory.

#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pose_wall::tools {

struct PgmImage {
  std::uint32_t width = 0, height = 0;
  std::uint32_t most = 255;           // white
  std::vector<std::uint16_t> pixels;  // row by row from the top
};

// The message names no file.
class PgmError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// P5 or P2, with comments. Sides up to 32,768 pixels. Throws PgmError.
PgmImage parse_pgm(std::string_view bytes);

// P5; white is 255 at most.
std::string pgm_bytes(const PgmImage& image, std::string_view comment);

}  // namespace pose_wall::tools
