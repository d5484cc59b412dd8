// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: bytes as a KITTI file.

#include "frames/kitti_reader.hpp"
#include "fuzz/files/reader_target.hpp"

POSE_WALL_FUZZ_READER(pose_wall::tools::read_kitti)
