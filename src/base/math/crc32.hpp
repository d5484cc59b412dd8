// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// CRC-32, reflected, begun and ended with all ones.

#pragma once

#include <cstdint>

namespace pose_wall {

constexpr std::uint32_t kCrcIeee = 0xEDB88320U;        // IEEE 802.3: polynomial 04C11DB7
constexpr std::uint32_t kCrcCastagnoli = 0x82F63B78U;  // CRC-32C: polynomial 1EDC6F41

// Without a table: an image has some 240 bytes, and a table of four words for each would be read cold.
class Crc32 {
 public:
  explicit Crc32(std::uint32_t polynomial = kCrcIeee) : polynomial_(polynomial) {}
  void add_byte(std::uint8_t byte) { add_low_bits(byte, 8); }
  // Low byte first, on every host.
  void add_word(std::uint32_t word) { add_low_bits(word, 32); }
  std::uint32_t value() const { return ~crc_; }

 private:
  void add_low_bits(std::uint32_t word, int bits);

  std::uint32_t polynomial_;
  std::uint32_t crc_ = 0xFFFFFFFFU;
};

}  // namespace pose_wall
