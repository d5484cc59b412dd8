// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// CRC-32 of records and FNV-1a of clouds, for bytes that come in parts.

#pragma once

#include <cstdint>

namespace pose_wall::runtime {

struct CrcTable {
  std::uint32_t word[256] = {};
  constexpr CrcTable() {
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t c = i;
      for (int bit = 0; bit < 8; ++bit) c = (c & 1U) != 0 ? 0xEDB88320U ^ (c >> 1) : c >> 1;
      word[i] = c;
    }
  }
};
constexpr CrcTable kCrcTable{};  // not inline: that would be a unique symbol, which objcopy keeps global

// zlib's and Ethernet's: reflected 0xEDB88320.
class Crc32 {
 public:
  void add(const void* bytes, std::uint64_t count) {
    const unsigned char* const b = static_cast<const unsigned char*>(bytes);
    for (std::uint64_t i = 0; i < count; ++i) state_ = kCrcTable.word[(state_ ^ b[i]) & 0xFFU] ^ (state_ >> 8);
  }
  std::uint32_t value() const { return ~state_; }

 private:
  std::uint32_t state_ = 0xFFFFFFFFU;
};

inline std::uint32_t crc32(const void* bytes, std::uint64_t count) {
  Crc32 crc;
  crc.add(bytes, count);
  return crc.value();
}

// Each step maps different sums to different ones, whether it takes a byte or a word: no change of a single one goes
// unnoticed.
constexpr std::uint64_t kFnv1aOfNothing = 0xCBF29CE484222325ULL;
constexpr std::uint64_t fnv1a_with(std::uint64_t sum, std::uint64_t next) {
  return (sum ^ next) * 0x100000001B3ULL;
}

inline std::uint64_t fnv1a(const void* bytes, std::uint64_t count) {
  const unsigned char* const b = static_cast<const unsigned char*>(bytes);
  std::uint64_t sum = kFnv1aOfNothing;
  for (std::uint64_t i = 0; i < count; ++i) sum = fnv1a_with(sum, b[i]);
  return sum;
}

}  // namespace pose_wall::runtime
