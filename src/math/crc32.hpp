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
  void add_byte(std::uint8_t byte) {
    crc_ ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc_ = (crc_ >> 1U) ^ ((crc_ & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  // Low byte first, on every host.
  void add_word(std::uint32_t word) {
    for (unsigned shift = 0; shift < 32; shift += 8) add_byte(static_cast<std::uint8_t>(word >> shift & 0xFFU));
  }
  std::uint32_t value() const { return ~crc_; }

 private:
  std::uint32_t crc_ = 0xFFFFFFFFU;
};

}  // namespace pose_wall
