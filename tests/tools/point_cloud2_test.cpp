// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: sensor_msgs/PointCloud2 is decoded alike from ROS 1 and from CDR of either byte order, its points stay as
// they lie, and lengths that do not fit are refused with the place.

#include <gtest/gtest.h>

#include "bag_files.hpp"
#include "io/bags/point_cloud2.hpp"
#include "io/frames/field_value.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

DecodedCloud decode(MessageEncoding encoding, const std::string& message) {
  const Bytes bytes = test::bytes_of(message);
  return decode_point_cloud2(encoding, {bytes.data(), bytes.size()}, {1000, ""});
}

std::string refusal(MessageEncoding encoding, const std::string& message) {
  return test::said_by<FrameError>([&] { decode(encoding, message); });
}

std::string refusal(const CloudMessage& cloud) {
  const std::string of_ros1 = refusal(MessageEncoding::kRos1, ros1_message(cloud));
  const std::string of_cdr = refusal(MessageEncoding::kCdr, cdr_message(cloud));
  EXPECT_EQ(of_ros1.substr(of_ros1.find(": ")), of_cdr.substr(of_cdr.find(": "))) << "one decoder, one answer";
  return of_cdr;
}

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(PointCloud2, BothSerialisationsGiveTheSamePoints) {
  CloudMessage cloud;
  cloud.nsec = 5;
  cloud.height = 2;
  cloud.width = 3;
  cloud.row_step = 55;
  for (const bool big_endian_data : {false, true}) {
    cloud.big_endian_data = big_endian_data;
    for (const DecodedCloud& decoded :
         {decode(MessageEncoding::kRos1, ros1_message(cloud)), decode(MessageEncoding::kCdr, cdr_message(cloud, false)),
          decode(MessageEncoding::kCdr, cdr_message(cloud, true))}) {
      EXPECT_EQ(decoded.stamp_ns, 1700000000000000005);
      EXPECT_EQ(decoded.source.frame_id, "lidar");
      const pose_wall_cloud& made = decoded.frame.cloud;
      EXPECT_EQ(made.width, 3U);
      EXPECT_EQ(made.height, 2U);
      EXPECT_EQ(made.row_step, 55U);
      EXPECT_EQ(made.data_bytes, 55U + 48U);
      EXPECT_EQ(made.big_endian, big_endian_data ? 1U : 0U);
      EXPECT_EQ(std::string(static_cast<const char*>(made.data), 110), cloud.bytes());
      EXPECT_EQ(number_at(decoded.frame, made.x, 2), 7.0);
      ASSERT_EQ(decoded.frame.fields.size(), 4U);
      EXPECT_EQ(decoded.frame.fields[3].name, "ring");
      EXPECT_EQ(decoded.frame.fields[3].where.offset, 12U);
    }
  }
}

TEST(PointCloud2, AliasesOfIntensityAndTimeAreUnderstood) {
  CloudMessage cloud;
  cloud.names = {"x", "y", "z", "reflectivity"};
  EXPECT_EQ(decode(MessageEncoding::kCdr, cdr_message(cloud)).frame.cloud.intensity.type, 4U);
  for (const char* name : {"t", "time", "timestamp", "offset_time", "time_stamp"}) {
    cloud.names[3] = name;
    EXPECT_EQ(decode(MessageEncoding::kCdr, cdr_message(cloud)).frame.cloud.time.offset, 12U) << name;
  }
}

// Rows with a gap between them, so that a time is not looked for where none is.
CloudMessage with_wide_field(const std::string& name, std::uint8_t type, bool big_endian_data) {
  CloudMessage cloud;
  cloud.height = cloud.width = 2;
  cloud.point_step = 24;
  cloud.row_step = 53;
  cloud.big_endian_data = big_endian_data;
  cloud.names = {"x", "y", "z", name, "valid"};
  cloud.types = {7, 7, 7, type, 11};
  cloud.offsets = {0, 4, 8, 12, 20};
  for (std::uint64_t i = 0; i < 4; ++i) {
    cloud.data += test::raw(static_cast<float>(i), big_endian_data) + test::raw(2.0F, big_endian_data) +
                  test::raw(3.0F, big_endian_data) +
                  test::raw(std::uint64_t{1'700'000'000'000'000'000} + i * 1'048'576, big_endian_data) + "\1---";
    if (i % 2 == 1) cloud.data += "#####";
  }
  return cloud;
}

TEST(PointCloud2, WholeNumbersOf64BitsAndBooleansAreReadAndMayBeTimes) {
  for (const std::uint8_t type : {std::uint8_t{9}, std::uint8_t{10}}) {
    for (const bool big_endian_data : {false, true}) {
      const CloudMessage cloud = with_wide_field("timestamp", type, big_endian_data);
      for (const DecodedCloud& decoded :
           {decode(MessageEncoding::kRos1, ros1_message(cloud)), decode(MessageEncoding::kCdr, cdr_message(cloud))}) {
        const pose_wall_cloud& made = decoded.frame.cloud;
        ASSERT_EQ(made.time.type, static_cast<std::uint32_t>(POSE_WALL_FIELD_FLOAT64));
        EXPECT_EQ(pose_wall_cloud_check(&made), POSE_WALL_OK);
        for (std::uint32_t i = 0; i < 4; ++i) {
          EXPECT_EQ(field_value(made, i / 2, i % 2, made.x), i);
          EXPECT_EQ(field_value(made, i / 2, i % 2, made.time), 1.7e18 + 1'048'576.0 * i) << "a power of two: exact";
        }
      }
    }
  }
}

TEST(PointCloud2, FieldsThatTheEngineDoesNotTakeRefuseNoCloud) {
  const CloudMessage cloud = with_wide_field("label", 10, false);
  const DecodedCloud decoded = decode(MessageEncoding::kCdr, cdr_message(cloud));
  EXPECT_EQ(decoded.frame.cloud.time.type, static_cast<std::uint32_t>(POSE_WALL_FIELD_NONE));
  EXPECT_EQ(field_value(decoded.frame.cloud, 1, 1, decoded.frame.cloud.x), 3.0);
}

TEST(PointCloud2, EveryCutIsRefused) {
  const CloudMessage cloud;
  for (const bool is_cdr : {false, true}) {
    const std::string whole = is_cdr ? cdr_message(cloud) : ros1_message(cloud);
    const MessageEncoding encoding = is_cdr ? MessageEncoding::kCdr : MessageEncoding::kRos1;
    ASSERT_EQ(refusal(encoding, whole), "");
    for (std::size_t length = 0; length < whole.size(); ++length) {
      expect_part(refusal(encoding, whole.substr(0, length)), "offset 1");
    }
  }
}

TEST(PointCloud2, WhatDoesNotFitIsRefusedWithItsFigures) {
  CloudMessage cloud;
  cloud.data = std::string(31, '\0');
  expect_part(refusal(cloud), "1 x 2 points of 16 bytes, rows of 32 bytes, need 32 bytes, but data has 31");
  cloud = {};
  cloud.height = 2;
  cloud.row_step = 31;
  expect_part(refusal(cloud), "rows of 2 points of 16 bytes do not fit the row step of 31 bytes");
  cloud = {};
  cloud.height = cloud.width = 0x10000;
  cloud.data = "x";
  cloud.row_step = 0x100000;
  expect_part(refusal(cloud), "4294967296 points; at most 4294967295");
  cloud = {};
  cloud.offsets[3] = 15;
  expect_part(refusal(cloud), "field 'ring' ends at byte 17 of points of 16 bytes");
  cloud = {};
  cloud.offsets[3] = 0xFFFFFFFF;
  expect_part(refusal(cloud), "field 'ring' ends at byte 4294967297");
  cloud = {};
  cloud.types[3] = 12;
  expect_part(refusal(cloud), "field 'ring' is of type 12; 1 to 11 are allowed");
  cloud = {};
  cloud.types[3] = 10;
  expect_part(refusal(cloud), "field 'ring' ends at byte 20 of points of 16 bytes");
  cloud = {};
  cloud.types[0] = 10;
  expect_part(refusal(cloud), "field 'x' must be a float");
  cloud = {};
  cloud.types[0] = 5;
  expect_part(refusal(cloud), "field 'x' must be a float");
  cloud = {};
  cloud.names[2] = "zz";
  expect_part(refusal(cloud), "field 'z' is missing; fields present: x, y, zz, ring");
  cloud = {};
  cloud.nsec = 1'000'000'000;
  expect_part(refusal(cloud), "less than 1000000000 are allowed");
  expect_part(refusal(MessageEncoding::kCdr, std::string("\x00\x03\x00\x00", 4)), "CDR of kind 0003");
}

}  // namespace
}  // namespace pose_wall::tools
