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
  void add_low_bits(std::uint32_t word, int bits) {
    crc_ ^= word;  // bits go in from the low end: four bytes, low byte first, can be put in at once
    for (int bit = 0; bit < bits; ++bit) crc_ = (crc_ >> 1U) ^ ((crc_ & 1U) != 0 ? polynomial_ : 0U);
  }

  std::uint32_t polynomial_;
  std::uint32_t crc_ = 0xFFFFFFFFU;
};

// What each value of a byte makes of a sum, by IEEE's polynomial.
struct CrcTable {
  std::uint32_t sums[256] = {};

  constexpr CrcTable() {
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      std::uint32_t crc = byte;
      for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? (crc >> 1U) ^ kCrcIeee : crc >> 1U;
      sums[byte] = crc;
    }
  }
};
static constexpr CrcTable kCrcTable;  // of each file its own: an inline one would be a symbol to merge

// The same sum by that table, for maps and records: megabytes.
class BulkCrc32 {
 public:
  void add_byte(std::uint8_t byte) { crc_ = (crc_ >> 8U) ^ kCrcTable.sums[(crc_ ^ byte) & 0xFFU]; }
  void add(const void* bytes, std::uint64_t count) {
    const auto* const from = static_cast<const unsigned char*>(bytes);
    for (std::uint64_t k = 0; k < count; ++k) add_byte(from[k]);
  }
  // Low byte first, on every host.
  void add_number(std::uint64_t number, std::uint32_t bytes) {
    for (; bytes > 0; --bytes, number >>= 8U) add_byte(static_cast<std::uint8_t>(number & 0xFFU));
  }
  std::uint32_t value() const { return ~crc_; }

 private:
  std::uint32_t crc_ = 0xFFFFFFFFU;
};

inline std::uint32_t crc32(const void* bytes, std::uint64_t count) {
  BulkCrc32 crc;
  crc.add(bytes, count);
  return crc.value();
}

}  // namespace pose_wall
