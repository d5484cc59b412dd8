// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How often any thread of this program asked the heap for something, or gave it back.

#pragma once

#include <cstdint>

namespace pose_wall::tools {

void start_counting_heap_calls();
std::uint64_t heap_calls();

// Resident memory in kB, by /proc; 0 where that is not there. Does not allocate.
std::int64_t resident_kb();

}  // namespace pose_wall::tools
