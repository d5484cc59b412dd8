// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every field type is read at any offset and in both byte orders, and every malformed description of a cloud
// gets the status that the header names, with arithmetic that no 32-bit number can overflow.

#include "lidar/cloud_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

namespace pose_wall {
namespace {

template <typename T>
void expect_read(std::uint32_t type, T value) {
  EXPECT_EQ(field_bytes(type), sizeof(T));
  for (const std::uint32_t offset : {0U, 1U, 7U, 18U}) {
    for (const bool swapped : {false, true}) {
      std::vector<unsigned char> point(offset + sizeof(T), 0xEE);  // ends with the field: a read past it is seen
      std::memcpy(point.data() + offset, &value, sizeof(T));
      if (swapped) std::reverse(point.begin() + offset, point.end());
      EXPECT_EQ(read_field(point.data(), {offset, type}, swapped), static_cast<double>(value)) << type << " " << offset;
    }
  }
}

TEST(CloudReader, ReadsEveryTypeAnywhereInBothByteOrders) {
  expect_read<std::int8_t>(POSE_WALL_FIELD_INT8, -100);
  expect_read<std::uint8_t>(POSE_WALL_FIELD_UINT8, 200);
  expect_read<std::int16_t>(POSE_WALL_FIELD_INT16, -30000);
  expect_read<std::uint16_t>(POSE_WALL_FIELD_UINT16, 60000);
  expect_read<std::int32_t>(POSE_WALL_FIELD_INT32, -2000000000);
  expect_read<std::uint32_t>(POSE_WALL_FIELD_UINT32, 4000000000U);
  expect_read<float>(POSE_WALL_FIELD_FLOAT32, -12.375F);
  expect_read<double>(POSE_WALL_FIELD_FLOAT64, 1.0 / 3.0);
  for (const std::uint32_t unknown : {0U, 9U, 77U, 0xFFFFFFFFU}) EXPECT_EQ(field_bytes(unknown), 0U);
}

unsigned char bytes[1000];

pose_wall_cloud good() {
  pose_wall_cloud c{};
  c.struct_size = sizeof c;
  c.data = bytes;
  c.data_bytes = 10 * 4 * 16;
  c.width = 10;
  c.height = 4;
  c.point_step = 16;
  c.row_step = 160;
  c.x = {0, POSE_WALL_FIELD_FLOAT32};
  c.y = {4, POSE_WALL_FIELD_FLOAT32};
  c.z = {8, POSE_WALL_FIELD_FLOAT32};
  return c;
}

template <typename Change>
std::int32_t status_with(const Change& change) {
  pose_wall_cloud c = good();
  change(&c);
  return check_cloud(c);
}

TEST(CloudReader, AcceptsWhatIsWellFormed) {
  EXPECT_EQ(check_cloud(good()), POSE_WALL_OK);
  EXPECT_EQ(status_with([](auto* c) { c->row_step = 0; }), POSE_WALL_OK);
  EXPECT_EQ(status_with([](auto* c) { c->width = 0; }), POSE_WALL_OK);
  EXPECT_EQ(status_with([](auto* c) {
              c->height = 0;
              c->data = nullptr;
              c->data_bytes = 0;
            }),
            POSE_WALL_OK);
  EXPECT_EQ(status_with([](auto* c) { c->z = {12, POSE_WALL_FIELD_FLOAT32}; }), POSE_WALL_OK);
  EXPECT_EQ(status_with([](auto* c) { c->intensity = {15, POSE_WALL_FIELD_UINT8}; }), POSE_WALL_OK);
  // A last row without its padding.
  EXPECT_EQ(status_with([](auto* c) {
              c->row_step = 200;
              c->data_bytes = 3 * 200 + 160;
            }),
            POSE_WALL_OK);
}

TEST(CloudReader, RefusesFieldsThatCannotBeRead) {
  for (const std::uint32_t type : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 9U, 0xFFFFFFFFU}) {
    EXPECT_EQ(status_with([&](auto* c) { c->x.type = type; }), POSE_WALL_E_CLOUD_FIELD) << type;
    EXPECT_EQ(status_with([&](auto* c) { c->y.type = type; }), POSE_WALL_E_CLOUD_FIELD) << type;
    EXPECT_EQ(status_with([&](auto* c) { c->z.type = type; }), POSE_WALL_E_CLOUD_FIELD) << type;
  }
  EXPECT_EQ(status_with([](auto* c) { c->intensity = {0, 9}; }), POSE_WALL_E_CLOUD_FIELD);
  EXPECT_EQ(status_with([](auto* c) { c->big_endian = 2; }), POSE_WALL_E_CLOUD_FIELD);
}

TEST(CloudReader, RefusesFieldsBeyondTheirPoint) {
  EXPECT_EQ(status_with([](auto* c) { c->z.offset = 13; }), POSE_WALL_E_CLOUD_STEP);
  EXPECT_EQ(status_with([](auto* c) { c->x.offset = 0xFFFFFFFF; }), POSE_WALL_E_CLOUD_STEP);
  EXPECT_EQ(status_with([](auto* c) { c->x.offset = 0xFFFFFFFD; }), POSE_WALL_E_CLOUD_STEP);  // would wrap to 1
  EXPECT_EQ(status_with([](auto* c) { c->x = {9, POSE_WALL_FIELD_FLOAT64}; }), POSE_WALL_E_CLOUD_STEP);
  EXPECT_EQ(status_with([](auto* c) { c->point_step = 11; }), POSE_WALL_E_CLOUD_STEP);
  EXPECT_EQ(status_with([](auto* c) { c->point_step = 0; }), POSE_WALL_E_CLOUD_STEP);
  EXPECT_EQ(status_with([](auto* c) { c->intensity = {16, POSE_WALL_FIELD_UINT8}; }), POSE_WALL_E_CLOUD_STEP);
  EXPECT_EQ(status_with([](auto* c) { c->row_step = 159; }), POSE_WALL_E_CLOUD_STEP);
}

TEST(CloudReader, RefusesDataThatHoldsTooLittle) {
  EXPECT_EQ(status_with([](auto* c) { c->data_bytes = 639; }), POSE_WALL_E_CLOUD_SIZE);
  EXPECT_EQ(status_with([](auto* c) { c->data_bytes = 0; }), POSE_WALL_E_CLOUD_SIZE);
  EXPECT_EQ(status_with([](auto* c) {
              c->width = 11;
              c->row_step = 0;
            }),
            POSE_WALL_E_CLOUD_SIZE);
  EXPECT_EQ(status_with([](auto* c) { c->height = 5; }), POSE_WALL_E_CLOUD_SIZE);
  EXPECT_EQ(status_with([](auto* c) { c->row_step = 161; }), POSE_WALL_E_CLOUD_SIZE);
  EXPECT_EQ(status_with([](auto* c) { c->data = nullptr; }), POSE_WALL_E_NULL);
}

constexpr std::uint32_t kMost = 0xFFFFFFFF;

TEST(CloudReader, HugeDescriptionsDoNotWrap) {
  EXPECT_EQ(status_with([](auto* c) {
              c->width = c->height = kMost;
              c->row_step = 0;
            }),
            POSE_WALL_E_CLOUD_SIZE);
  EXPECT_EQ(status_with([](auto* c) {
              c->width = c->point_step = kMost;
              c->row_step = 0;
            }),
            POSE_WALL_E_CLOUD_SIZE);
  EXPECT_EQ(status_with([](auto* c) {
              c->width = c->height = c->point_step = kMost;
              c->row_step = 0;
              c->data_bytes = std::numeric_limits<std::uint64_t>::max();
            }),
            POSE_WALL_E_CLOUD_SIZE);
  EXPECT_EQ(status_with([](auto* c) { c->height = c->row_step = kMost; }), POSE_WALL_E_CLOUD_SIZE);
  // 65536 x 65536 points of 16 bytes are 2^36: 0 in 32 bits.
  EXPECT_EQ(status_with([](auto* c) {
              c->width = c->height = 65536;
              c->row_step = 0;
            }),
            POSE_WALL_E_CLOUD_SIZE);
}

TEST(CloudReader, RowsLieRowStepApart) {
  pose_wall_cloud c = good();
  EXPECT_EQ(row_of(c, 3), bytes + 480);
  c.row_step = 0;
  EXPECT_EQ(row_of(c, 3), bytes + 480);
  c.row_step = 200;
  EXPECT_EQ(row_of(c, 3), bytes + 600);
  // Beyond 4 GiB: described only, never read here.
  c.row_step = 0x80000000U;
  EXPECT_EQ(row_of(c, 4) - bytes, 0x200000000LL);
}

TEST(CloudReader, TheFastPathIsForNativeFloatsOnly) {
  pose_wall_cloud c = good();
  c.big_endian = needs_swap(c) ? 1 : 0;
  EXPECT_TRUE(is_plain_xyz32(c));
  c.big_endian ^= 1U;
  EXPECT_FALSE(is_plain_xyz32(c));
  c.big_endian ^= 1U;
  c.y.type = POSE_WALL_FIELD_FLOAT64;
  EXPECT_FALSE(is_plain_xyz32(c));
}

// Four floats are read where x, y and z begin: the fourth must be of the point, too.
TEST(CloudReader, ReadAtOnceIsWhatLiesInARowWithAFourthBehindIt) {
  pose_wall_cloud c = good();
  EXPECT_TRUE(is_xyz32_in_a_row(c));
  const auto in_a_row = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t point_step) {
    c.x.offset = x;
    c.y.offset = y;
    c.z.offset = z;
    c.point_step = point_step;
    return is_xyz32_in_a_row(c);
  };
  EXPECT_TRUE(in_a_row(16, 20, 24, 32));
  EXPECT_FALSE(in_a_row(16, 20, 24, 31));
  EXPECT_FALSE(in_a_row(0, 4, 8, 12)) << "packed";
  EXPECT_FALSE(in_a_row(8, 4, 0, 48));
  EXPECT_FALSE(in_a_row(0, 8, 16, 48));
  EXPECT_FALSE(in_a_row(4, 8, 0, 48));
  c = good();
  c.big_endian = 1;
  EXPECT_FALSE(is_xyz32_in_a_row(c));
}

}  // namespace
}  // namespace pose_wall
