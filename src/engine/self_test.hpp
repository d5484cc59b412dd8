// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Runs the engine on a known road through its own C ABI: the values must be right, and the same bits as noted.

#pragma once

#include <cstdint>

#include "pose_wall.h"

namespace pose_wall {

std::uint64_t self_test_bytes();

// Runs the scenes, compares the digest and computes the code's CRC. The caller has checked block and report.
std::int32_t self_test(std::uint64_t digest_expected, void* block, pose_wall_self_test_report* report);

}  // namespace pose_wall
