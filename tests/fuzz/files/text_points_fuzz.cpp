// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: bytes as points in plain text.

#include "fuzz/files/reader_target.hpp"
#include "io/frames/text_points.hpp"

namespace {

pose_wall::tools::Frame read_plain(const pose_wall::tools::Bytes& bytes) {
  return pose_wall::tools::read_text_points(bytes);
}

}  // namespace

POSE_WALL_FUZZ_READER(read_plain)
