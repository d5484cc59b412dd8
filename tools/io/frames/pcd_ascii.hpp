// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The body of an ascii PCD file.

#pragma once

#include "io/frames/frame.hpp"
#include "io/frames/pcd_header.hpp"

namespace pose_wall::tools {

// Decodes the fields the engine knows; the others are counted and passed over. Throws FrameError naming the line.
Frame parse_pcd_ascii(const Bytes& bytes, const PcdHeader& header);

}  // namespace pose_wall::tools
