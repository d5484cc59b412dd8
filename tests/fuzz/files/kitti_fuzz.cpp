// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: bytes as a file without a header, its layout found by the values.

#include "fuzz/files/reader_target.hpp"
#include "io/frames/bare_layout_guess.hpp"

POSE_WALL_FUZZ_READER(pose_wall::tools::read_guessed_points)
