// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The sizes of the runtime's structs in each version of the header; struct_sizes.hpp explains them.

#pragma once

#include <cstddef>

#include "part/struct_sizes.hpp"
#include "pose_wall_runtime.h"

namespace pose_wall::runtime {

constexpr StructSizes kOptionsSizes = {offsetof(pose_wall_runtime_options, reserved_2),
                                       offsetof(pose_wall_runtime_options, motion), sizeof(pose_wall_runtime_options)};
constexpr StructSizes kPublicationSizes = {912, offsetof(pose_wall_publication, has_motion),
                                           sizeof(pose_wall_publication)};
constexpr StructSizes kStatisticsSizes = {664, offsetof(pose_wall_runtime_statistics, motion_refused),
                                          sizeof(pose_wall_runtime_statistics)};

// Motion stands behind the result: one that grows moves it, and needs another ABI of the runtime.
static_assert(sizeof(void*) != 8 || offsetof(pose_wall_publication, has_motion) == 1552);

// How much of the motion's result was written follows from the publication's size.
inline void write_publication(const pose_wall_publication& whole, std::uint32_t size, pose_wall_publication* to) {
  // Of the public struct: an older caller's ends within motion, or before it.
  constexpr auto kMotionAt = static_cast<std::uint32_t>(offsetof(pose_wall_publication, motion));
  pose_wall_publication told = whole;
  const bool is_cut = size > kMotionAt && size - kMotionAt < sizeof(told.motion);
  if (told.motion.struct_size != 0 && is_cut) told.motion.struct_size = size - kMotionAt;
  write_struct(told, size, to);
}

}  // namespace pose_wall::runtime
