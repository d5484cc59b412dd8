// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/terminal/whole_lines.hpp"

#include <cstdio>

namespace pose_wall::tools {

void write_whole_lines() {
  // Into a file or a pipe the C library would write blocks of 4096 bytes, that end within a line.
  std::setvbuf(stdout, nullptr, _IOLBF, 1 << 16);
}

}  // namespace pose_wall::tools
