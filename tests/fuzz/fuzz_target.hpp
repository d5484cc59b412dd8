// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What every fuzz target has: its one function, a way to complain, and numbers taken from the input. Nothing of the C++
// library that is compiled elsewhere: MemorySanitizer would not know what it writes.

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "pose_wall.h"

#if defined(__has_feature)
#if __has_feature(memory_sanitizer)
#include <sanitizer/msan_interface.h>
#define POSE_WALL_MEMORY_SANITIZER
#endif
#endif

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace pose_wall::test {

// Ends the program where it does not hold: a finding.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "BROKEN: %s\n", what);
  std::abort();
}

inline void require_ok(std::int32_t status, const char* what) {
  if (status == POSE_WALL_OK) return;
  std::fprintf(stderr, "BROKEN: %s: %s (%d)\n", what, pose_wall_status_text(status), static_cast<int>(status));
  std::abort();
}

// Numbers off the front of the input; zeros once it is used up.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  template <typename Number>
  Number take() {
    Number number{};
    const std::size_t bytes = left_ < sizeof number ? left_ : sizeof number;
    if (bytes > 0) std::memcpy(&number, data_, bytes);
    data_ += bytes;
    left_ -= bytes;
    return number;
  }
  std::uint8_t byte() { return take<std::uint8_t>(); }
  std::uint32_t below(std::uint32_t count) { return byte() % count; }  // count <= 256
  // In 256 steps, ends included.
  double between(double from, double to) { return from + (to - from) * byte() / 255.0; }

  bool empty() const { return left_ == 0; }
  const std::uint8_t* rest() const { return data_; }
  std::size_t left() const { return left_; }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

// A block of exactly the size an engine asks for, kept from input to input, filled alike before each: what an input
// does must not hang on those before it.
class KeptBlock {
 public:
  void* filled(std::uint64_t bytes, int with) {
    if (bytes != bytes_) {
      std::free(data_);
      // What an engine asks for is whole lines of the alignment, so that a write behind the end is seen.
      data_ = std::aligned_alloc(POSE_WALL_BLOCK_ALIGNMENT, static_cast<std::size_t>(bytes));
      require(data_ != nullptr, "memory for a block");
      bytes_ = bytes;
    }
    std::memset(data_, with, static_cast<std::size_t>(bytes));
#ifdef POSE_WALL_MEMORY_SANITIZER
    __msan_poison(data_, static_cast<std::size_t>(bytes));  // what the caller left in it is nothing to go by
#endif
    return data_;
  }

 private:
  void* data_ = nullptr;
  std::uint64_t bytes_ = 0;
};

// Opens an engine whose config is known to be good.
inline pose_wall_engine* open_engine(const pose_wall_config& config, KeptBlock* block, int filled_with) {
  std::uint64_t bytes = 0;
  require_ok(pose_wall_memory_needed(&config, &bytes), "memory needed");
  require(bytes % POSE_WALL_BLOCK_ALIGNMENT == 0, "a block of whole lines");
  pose_wall_engine* engine = nullptr;
  require_ok(pose_wall_open(&config, block->filled(bytes, filled_with), bytes, &engine), "open");
  return engine;
}

inline pose_wall_result empty_result() {
  pose_wall_result result;
  std::memset(&result, 0, sizeof result);
  result.struct_size = sizeof result;
  return result;
}

}  // namespace pose_wall::test
