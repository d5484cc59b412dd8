// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Numbers as they are saved: low byte first whatever the host, and a floating-point number by its bits.

#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

namespace pose_wall {

// As many bits as the number has.
template <typename Number>
using BitsOf = std::conditional_t<sizeof(Number) == sizeof(std::uint32_t), std::uint32_t, std::uint64_t>;

// The bits of a number, in the low end of a word.
template <typename Number>
std::uint64_t saved_word(Number number) {
  if constexpr (std::is_floating_point<Number>::value) {
    BitsOf<Number> bits;
    std::memcpy(&bits, &number, sizeof(bits));
    return bits;
  } else {
    return static_cast<std::uint64_t>(number);
  }
}

// Not inlined, both of them: the engine's memento has some hundreds of numbers.
[[gnu::noinline]] inline void put_low_bytes(std::uint64_t word, std::uint32_t bytes, unsigned char* to) {
  for (std::uint32_t k = 0; k < bytes; ++k) to[k] = static_cast<unsigned char>(word >> (8U * k));
}
[[gnu::noinline]] inline std::uint64_t low_bytes_at(const unsigned char* from, std::uint32_t bytes) {
  std::uint64_t word = 0;
  for (std::uint32_t k = 0; k < bytes; ++k) word |= static_cast<std::uint64_t>(from[k]) << (8U * k);
  return word;
}

class SavedWriter {
 public:
  explicit SavedWriter(unsigned char* to) : to_(to) {}
  template <typename Number>
  void put(Number number) {
    put_low_bytes(saved_word(number), sizeof(Number), to_);
    to_ += sizeof(Number);
  }
  void put_bytes(const void* bytes, std::uint32_t count) {
    std::memcpy(to_, bytes, count);
    to_ += count;
  }

 private:
  unsigned char* to_;
};

class SavedReader {
 public:
  explicit SavedReader(const unsigned char* from) : from_(from) {}
  template <typename Number>
  Number get() {
    const std::uint64_t word = low_bytes_at(from_, sizeof(Number));
    from_ += sizeof(Number);
    if constexpr (std::is_floating_point<Number>::value) {
      const auto bits = static_cast<BitsOf<Number>>(word);
      Number number;
      std::memcpy(&number, &bits, sizeof(number));
      return number;
    } else {
      return static_cast<Number>(word);
    }
  }
  void get_bytes(void* bytes, std::uint32_t count) {
    std::memcpy(bytes, from_, count);
    from_ += count;
  }

 private:
  const unsigned char* from_;
};

}  // namespace pose_wall
