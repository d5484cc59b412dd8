// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The options' defaults and ranges, and the memory they need.

#pragma once

#include <cstdint>

#include "pose_wall_runtime.h"

namespace pose_wall::runtime {

void set_defaults(pose_wall_runtime_options* options);

// Reads the caller's options of any version. Returns POSE_WALL_OK, the fault of their struct_size, or
// POSE_WALL_RUNTIME_E_OPTION and the option's name on request. *whole: as this version reads them.
std::int32_t read_options(const pose_wall_runtime_options& options, const char** option,
                          pose_wall_runtime_options* whole);

std::uint32_t slots_of(const pose_wall_runtime_options& options);
std::uint64_t cloud_bytes_max(const pose_wall_runtime_options& options);

}  // namespace pose_wall::runtime
