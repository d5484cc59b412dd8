// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// CRC-32 of IEEE 802.3: polynomial 04C11DB7 reflected, begun and ended with all ones.

#pragma once

#include <cstdint>

namespace pose_wall {

// Without a table: an image has 240 bytes, and a table of four words for each would be read cold.
class Crc32 {
 public:
  void add_byte(std::uint8_t byte) { add_low_bits(byte, 8); }
  // Low byte first, on every host.
  void add_word(std::uint32_t word) { add_low_bits(word, 32); }
  std::uint32_t value() const { return ~crc_; }

 private:
  void add_low_bits(std::uint32_t word, int bits);

  std::uint32_t crc_ = 0xFFFFFFFFU;
};

}  // namespace pose_wall
