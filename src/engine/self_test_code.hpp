// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The engine's own machine code and constants, as they lie in the memory of this program.

#pragma once

#include <cstdint>

namespace pose_wall {

struct CodeSum {
  std::uint64_t bytes;  // under the sum; 0: these objects were not linked from the archive
  std::uint32_t crc32;
};

CodeSum sum_of_code();

}  // namespace pose_wall
