// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Structs of callers that were built against another header. They grow at their end only, so struct_size tells the
// version: what an earlier one lacks is read as zero and is not written.

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "pose_wall.h"

namespace pose_wall {

// The sizes of one struct: under ABI 1, in the first header of this ABI, and in this one.
struct StructSizes {
  std::uint32_t abi1, first, now;
};

// Larger than any struct here: what was never initialised is no newer version.
constexpr std::uint32_t kStructMost = 1U << 16U;

constexpr std::int32_t check_struct_size(std::uint32_t size, const StructSizes& sizes) {
  if (size >= sizes.first && size <= sizes.now) return POSE_WALL_OK;
  if (size == sizes.abi1) return POSE_WALL_E_ABI;
  return size > sizes.now && size <= kStructMost ? POSE_WALL_E_STRUCT_NEWER : POSE_WALL_E_STRUCT_SIZE;
}

// The whole struct of what a caller gave.
template <typename Struct>
Struct read_struct(const void* from, std::uint32_t size) {
  Struct whole{};
  std::memcpy(static_cast<void*>(&whole), from, size);
  return whole;
}

// As much of it as the caller has room for; its struct_size stays the caller's.
template <typename Struct>
void write_struct(const Struct& whole, std::uint32_t size, Struct* to) {
  std::memcpy(static_cast<void*>(to), &whole, size);
  to->struct_size = size;
}

constexpr StructSizes kCloudSizes = {offsetof(pose_wall_cloud, inputs), sizeof(pose_wall_cloud),
                                     sizeof(pose_wall_cloud)};
constexpr StructSizes kResultSizes = {864, sizeof(pose_wall_result), sizeof(pose_wall_result)};
constexpr StructSizes kInputsSizes = {0, sizeof(pose_wall_inputs), sizeof(pose_wall_inputs)};
constexpr StructSizes kMomentSizes = {0, sizeof(pose_wall_moment), sizeof(pose_wall_moment)};
// Not of ABI 1: a size of 0 was forgotten.
constexpr StructSizes kSourceSizes = {sizeof(pose_wall_image_source), sizeof(pose_wall_image_source),
                                      sizeof(pose_wall_image_source)};

}  // namespace pose_wall
