// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How often any thread of this program asked the heap for something, or gave it back. Who links this has its malloc
// replaced; under AddressSanitizer its hooks count instead.

#pragma once

#include <cstdint>

namespace pose_wall::tools {

// False under ThreadSanitizer, which has a malloc of its own and no hooks: nothing is counted there.
bool heap_calls_are_counted();

void start_counting_heap_calls();
// How many there were since.
std::uint64_t stop_counting_heap_calls();

// Resident memory in kB, by /proc; kResidentUnknown_kb where that is not there. Does not allocate.
constexpr std::int64_t kResidentUnknown_kb = -1;
std::int64_t resident_kb();

}  // namespace pose_wall::tools
