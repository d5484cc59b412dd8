// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The caller's block, as a hostile caller would hand it over: exactly as long as asked, aligned to no more than asked,
// and full of garbage.

#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <random>

#include "pose_wall.h"

namespace pose_wall::test {

enum class Dirt { kZeros, kOnes, kRandom };

class AlignedBlock {
 public:
  AlignedBlock(std::uint64_t bytes, Dirt dirt) : bytes_(bytes) {
    // Exact: a write behind the end is then seen by AddressSanitizer. aligned_alloc wants whole alignments.
    const std::size_t rounded =
        (static_cast<std::size_t>(bytes) + POSE_WALL_BLOCK_ALIGNMENT - 1) & ~std::size_t{POSE_WALL_BLOCK_ALIGNMENT - 1};
    data_.reset(static_cast<unsigned char*>(std::aligned_alloc(POSE_WALL_BLOCK_ALIGNMENT, rounded)));
    if (data_ == nullptr) throw std::bad_alloc();
    fill(dirt, rounded);
  }

  void* data() { return data_.get(); }
  std::uint64_t size() const { return bytes_; }

 private:
  struct Free {
    void operator()(unsigned char* p) const { std::free(p); }
  };

  void fill(Dirt dirt, std::size_t rounded) {
    std::memset(data_.get(), dirt == Dirt::kOnes ? 0xFF : 0x00, rounded);
    if (dirt != Dirt::kRandom) return;
    std::mt19937_64 random(20260101);
    for (std::size_t i = 0; i + 8 <= rounded; i += 8) {
      const std::uint64_t word = random();
      std::memcpy(data_.get() + i, &word, 8);
    }
  }

  std::unique_ptr<unsigned char, Free> data_;
  std::uint64_t bytes_;
};

}  // namespace pose_wall::test
