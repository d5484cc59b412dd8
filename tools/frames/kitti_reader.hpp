// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// KITTI's velodyne files (.bin): little-endian float32 x, y, z, intensity, and nothing else.

#pragma once

#include "frames/frame.hpp"

namespace pose_wall::tools {

// Throws FrameError when the size is no multiple of 16 bytes.
Frame read_kitti(Bytes bytes);

}  // namespace pose_wall::tools
