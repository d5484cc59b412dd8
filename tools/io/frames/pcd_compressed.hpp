// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The body of a binary_compressed PCD file.

#pragma once

#include "io/frames/frame.hpp"
#include "io/frames/pcd_header.hpp"

namespace pose_wall::tools {

// The points, one after another as in a binary file. Throws FrameError.
Bytes decompress_pcd_points(const Bytes& bytes, const PcdHeader& header);

}  // namespace pose_wall::tools
