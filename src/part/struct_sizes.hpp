// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Structs of callers built against another header. Structs grow at their end only, so struct_size gives the version.
// Members that an earlier one lacks read as zero and are not written. For all parts.

#pragma once

#include <cstdint>
#include <cstring>

#include "pose_wall.h"

namespace pose_wall {

// The sizes of one struct: under the ABI before (0: there was none), in the first header of this ABI, and in this one.
struct StructSizes {
  std::uint32_t before, first, now;
};

// Larger than any struct here: uninitialised memory is no newer version.
constexpr std::uint32_t kStructMost = 1U << 16U;

constexpr std::int32_t check_struct_size(std::uint32_t size, const StructSizes& sizes) {
  if (size >= sizes.first && size <= sizes.now) return POSE_WALL_OK;
  if (size == sizes.before && size != 0) return POSE_WALL_E_ABI;
  return size > sizes.now && size <= kStructMost ? POSE_WALL_E_STRUCT_NEWER : POSE_WALL_E_STRUCT_SIZE;
}

// Of a struct that has had one version so far.
template <typename Struct>
constexpr std::int32_t check_struct(const Struct& from) {
  return check_struct_size(from.struct_size, {sizeof(Struct), sizeof(Struct), sizeof(Struct)});
}

// The whole struct, from the one that a caller gave.
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

}  // namespace pose_wall
