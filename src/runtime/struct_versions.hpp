// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The sizes of the runtime's structs in each version of the header; what they are for: struct_sizes.hpp.

#pragma once

#include <cstddef>

#include "../struct_sizes.hpp"
#include "pose_wall_runtime.h"

namespace pose_wall::runtime {

constexpr StructSizes kOptionsSizes = {offsetof(pose_wall_runtime_options, reserved_2),
                                       sizeof(pose_wall_runtime_options), sizeof(pose_wall_runtime_options)};
constexpr StructSizes kPublicationSizes = {912, sizeof(pose_wall_publication), sizeof(pose_wall_publication)};
constexpr StructSizes kStatisticsSizes = {664, sizeof(pose_wall_runtime_statistics),
                                          sizeof(pose_wall_runtime_statistics)};

// The result stands last and grows at its end, as the publication does: its own size follows from the publication's.
inline void write_publication(const pose_wall_publication& whole, std::uint32_t size, pose_wall_publication* to) {
  write_struct(whole, size, to);
  to->result.struct_size = size - static_cast<std::uint32_t>(offsetof(pose_wall_publication, result));
}

}  // namespace pose_wall::runtime
