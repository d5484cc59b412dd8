// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the CRC is the one of IEEE 802.3, by its published check value; words count as four bytes, the low one first.

#include "base/math/crc32.hpp"

#include <gtest/gtest.h>

#include <string>

namespace pose_wall {
namespace {

std::uint32_t crc_of(const std::string& text) {
  Crc32 crc;
  for (const char c : text) crc.add_byte(static_cast<std::uint8_t>(c));
  return crc.value();
}

TEST(Crc32, PublishedCheckValue) {
  EXPECT_EQ(crc_of("123456789"), 0xCBF43926U);
}

TEST(Crc32, OfNothingAndOfZeros) {
  EXPECT_EQ(crc_of(""), 0U);
  EXPECT_EQ(crc_of(std::string(4, '\0')), 0x2144DF1CU);
}

TEST(Crc32, WordsLowByteFirst) {
  Crc32 words;
  words.add_word(0x34333231U);
  words.add_word(0x38373635U);
  EXPECT_EQ(words.value(), crc_of("12345678"));
}

}  // namespace
}  // namespace pose_wall
