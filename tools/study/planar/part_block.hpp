// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Memory for a part of pose_wall_planar, and its failures as exceptions.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>

#include "pose_wall.h"

namespace pose_wall::tools {

// The block of a part of the library.
class PartBlock {
 public:
  explicit PartBlock(std::uint64_t bytes)
      : lines_(static_cast<std::size_t>((bytes + sizeof(Line) - 1) / sizeof(Line))), place_(new Line[lines_]) {}
  void* data() const { return place_.get(); }
  std::uint64_t bytes() const { return lines_ * sizeof(Line); }

 private:
  struct alignas(POSE_WALL_BLOCK_ALIGNMENT) Line {
    unsigned char bytes[POSE_WALL_BLOCK_ALIGNMENT];
  };
  std::size_t lines_;
  std::unique_ptr<Line[]> place_;  // not touched before it is used: memory that a short trail never takes
};

// A call of the library that failed; the message names the call's purpose.
class PlanarError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};
// Throws PlanarError where status is not POSE_WALL_OK.
void require_ok(std::int32_t status, const char* purpose);

}  // namespace pose_wall::tools
