// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Polygon File Format files (.ply): ascii, binary_little_endian and binary_big_endian.

#pragma once

#include "io/frames/frame.hpp"

namespace pose_wall::tools {

// Reads element vertex; other elements are passed over. Binary points are described in place. Throws FrameError.
Frame read_ply(Bytes bytes);

}  // namespace pose_wall::tools
