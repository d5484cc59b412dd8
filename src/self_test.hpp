// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The engine on a road that it knows, through its own C ABI: what comes out must be right, and the same bits as noted.

#pragma once

#include <cstdint>

#include "pose_wall.h"

namespace pose_wall {

std::uint64_t self_test_bytes();

// Scenes, digest and the code's CRC. Block and report were looked at.
std::int32_t self_test(std::uint64_t digest_expected, void* block, pose_wall_self_test_report* report);

}  // namespace pose_wall
