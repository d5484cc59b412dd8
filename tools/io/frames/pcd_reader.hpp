// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Point Cloud Data files (.pcd): ascii, binary and binary_compressed.

#pragma once

#include "io/frames/frame.hpp"

namespace pose_wall::tools {

// binary: described in place. ascii and binary_compressed: decoded, since the engine reads neither.
// VIEWPOINT is ignored: the engine works in the sensor's frame. Throws FrameError.
Frame read_pcd(Bytes bytes);

}  // namespace pose_wall::tools
