// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What the self test must come to, the same on every machine. After a change of the engine that is meant to change
// results: tests/digest/note_self_test.py src/engine/self_test_digest.hpp build/release/tests/pose_wall_digest

#pragma once

#include <cstdint>

namespace pose_wall {

// What the self test's own road came to when that script noted it; tests/digest holds every build to it.
constexpr std::uint64_t kSelfTestDigest = 0x47108BC1F659ABBAULL;

}  // namespace pose_wall
