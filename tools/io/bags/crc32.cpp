// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/crc32.hpp"

#include <array>

namespace pose_wall::tools {
namespace {

using Table = std::array<std::array<std::uint32_t, 256>, 8>;

// tables[k][b]: what byte b changes when k further bytes follow it, so that eight bytes are taken at a time.
Table make_tables() {
  Table tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    tables[0][byte] = crc;
  }
  for (std::size_t k = 1; k < tables.size(); ++k) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = tables[k - 1][byte];
      tables[k][byte] = (before >> 8U) ^ tables[0][before & 0xFFU];
    }
  }
  return tables;
}

}  // namespace

std::uint32_t crc32(ByteView bytes) {
  static const Table tables = make_tables();
  std::uint32_t crc = 0xFFFFFFFFU;
  std::size_t i = 0;
  const auto at = [&](std::size_t k) { return std::to_integer<std::uint32_t>(bytes.data[k]); };
  for (; i + 8 <= bytes.size; i += 8) {
    std::uint32_t next = 0;
    for (std::size_t k = 0; k < 4; ++k) next ^= tables[7 - k][((crc >> (8 * k)) ^ at(i + k)) & 0xFFU];
    for (std::size_t k = 4; k < 8; ++k) next ^= tables[7 - k][at(i + k)];
    crc = next;
  }
  for (; i < bytes.size; ++i) crc = (crc >> 8U) ^ tables[0][(crc ^ at(i)) & 0xFFU];
  return ~crc;
}

}  // namespace pose_wall::tools
