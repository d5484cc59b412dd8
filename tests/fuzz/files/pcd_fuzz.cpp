// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: bytes as a PCD file.

#include "fuzz/files/reader_target.hpp"
#include "io/frames/pcd_reader.hpp"

POSE_WALL_FUZZ_READER(pose_wall::tools::read_pcd)
