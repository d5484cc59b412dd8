// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The same sums as base/math/crc32.hpp with a table of bytes, for maps: megabytes, where an image has 240 bytes.

#pragma once

#include <cstdint>

#include "base/math/crc32.hpp"

namespace pose_wall::planar {

struct CrcTable {
  std::uint32_t sums[256] = {};

  constexpr CrcTable() {
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      std::uint32_t crc = byte;
      for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? (crc >> 1) ^ kCrcIeee : crc >> 1;
      sums[byte] = crc;
    }
  }
};
static constexpr CrcTable kCrcTable;  // of each file its own: an inline one would be a symbol to merge

class FastCrc32 {
 public:
  void add_byte(std::uint8_t byte) { crc_ = (crc_ >> 8) ^ kCrcTable.sums[(crc_ ^ byte) & 0xFFU]; }
  void add_bytes(const unsigned char* bytes, std::uint64_t count) {
    for (std::uint64_t k = 0; k < count; ++k) add_byte(bytes[k]);
  }
  // Low byte first, on every host.
  void add_number(std::uint64_t number, std::uint32_t bytes) {
    for (; bytes > 0; --bytes, number >>= 8) add_byte(static_cast<std::uint8_t>(number & 0xFFU));
  }
  std::uint32_t value() const { return ~crc_; }

 private:
  std::uint32_t crc_ = 0xFFFFFFFFU;
};

}  // namespace pose_wall::planar
