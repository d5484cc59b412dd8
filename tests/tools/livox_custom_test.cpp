// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: Livox's CustomMsg gives the same points, times, stamp and frame_id from ROS 1 and from CDR of either byte
// order, as a topic of a bag too; what is cut or counts beyond its bytes is refused with the place.

#include <gtest/gtest.h>

#include "bag_files.hpp"
#include "io/bags/cloud_message.hpp"
#include "io/frames/field_value.hpp"
#include "packet_files.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

constexpr std::uint64_t kBase_ns = 1'700'000'000'000'000'123;

struct CustomMessage {
  std::uint32_t sec = 1'700'000'000, nsec = 7;
  std::uint32_t points = 3;
  std::uint32_t count = 3;  // as the list says
};

std::string custom_in_ros1(const CustomMessage& m) {
  std::string text = raw(9U) + raw(m.sec) + raw(m.nsec) + with_length("livox") + raw(kBase_ns) + raw(m.points) +
                     "\x01\x02\x03\x04" + raw(m.count);
  for (std::uint32_t i = 0; i < m.points; ++i) {
    const auto x_m = static_cast<float>(i);
    text +=
        raw(1000U * i) + raw(x_m) + raw(-2.5F) + raw(3.5F) + static_cast<char>(10 + i) + "\x10" + static_cast<char>(i);
  }
  return text;
}

std::string custom_in_cdr(const CustomMessage& m, bool big_endian) {
  CdrWriter out(big_endian);
  out.put(m.sec);
  out.put(m.nsec);
  out.put_text("livox");
  out.put(kBase_ns);
  out.put(m.points);
  for (const char byte : {'\1', '\2', '\3', '\4'}) out.put(byte);
  out.put(m.count);
  for (std::uint32_t i = 0; i < m.points; ++i) {
    out.put(1000U * i);
    out.put(static_cast<float>(i));
    out.put(-2.5F);
    out.put(3.5F);
    out.put(static_cast<std::uint8_t>(10 + i));
    out.put(std::uint8_t{0x10});
    out.put(static_cast<std::uint8_t>(i));
  }
  return out.text();
}

DecodedCloud decode(MessageEncoding encoding, const std::string& bytes) {
  return decode_cloud("livox_ros_driver2/msg/CustomMsg", encoding, test::view_of(bytes), {1000, ""});
}

std::string refusal_of(MessageEncoding encoding, const std::string& bytes) {
  return test::said_by<FrameError>([&] { decode(encoding, bytes); });
}

void expect_points(const DecodedCloud& decoded) {
  EXPECT_EQ(decoded.stamp_ns, 1'700'000'000'000'000'007);
  EXPECT_EQ(decoded.source.frame_id, "livox");
  const pose_wall_cloud& cloud = decoded.frame.cloud;
  ASSERT_EQ(cloud.width, 3U);
  EXPECT_EQ(cloud.data_bytes, std::uint64_t{3} * cloud.point_step);
  EXPECT_GE(decoded.frame.bytes.size(), cloud.data_bytes);
  ASSERT_EQ(pose_wall_cloud_check(&cloud), POSE_WALL_OK);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(field_value(cloud, 0, i, cloud.x), i);
    EXPECT_EQ(field_value(cloud, 0, i, cloud.y), -2.5);
    EXPECT_EQ(field_value(cloud, 0, i, cloud.z), 3.5);
    EXPECT_EQ(field_value(cloud, 0, i, cloud.intensity), 10 + i);
    EXPECT_EQ(field_value(cloud, 0, i, cloud.time), 1000 * i);
    EXPECT_EQ(field_value(cloud, 0, i, decoded.frame.fields.back().where), i) << "line";
  }
}

TEST(LivoxCustom, EverySerialisationGivesTheSamePoints) {
  expect_points(decode(MessageEncoding::kRos1, custom_in_ros1({})));
  expect_points(decode(MessageEncoding::kCdr, custom_in_cdr({}, false)));
  expect_points(decode(MessageEncoding::kCdr, custom_in_cdr({}, true)));
  for (const char* type : {"livox_ros_driver/CustomMsg", "livox_ros_driver2/CustomMsg",
                           "livox_ros_driver/msg/CustomMsg", "livox_ros_driver2/msg/CustomMsg"}) {
    EXPECT_TRUE(is_cloud_type(type));
  }
  EXPECT_FALSE(is_cloud_type("livox_ros_driver2/msg/CustomPoint"));
  EXPECT_THROW(decode_cloud("std_msgs/String", MessageEncoding::kRos1, {}), FrameError);
}

TEST(LivoxCustom, WithoutAStampTheTimeOfTheFirstPointIsIt) {
  CustomMessage message;
  message.sec = message.nsec = 0;
  EXPECT_EQ(decode(MessageEncoding::kRos1, custom_in_ros1(message)).stamp_ns, static_cast<std::int64_t>(kBase_ns));
}

TEST(LivoxCustom, NoPointsAreACloudOfNone) {
  CustomMessage message;
  message.points = message.count = 0;
  EXPECT_EQ(decode(MessageEncoding::kRos1, custom_in_ros1(message)).frame.cloud.width, 0U);
  EXPECT_EQ(decode(MessageEncoding::kCdr, custom_in_cdr(message, false)).frame.cloud.width, 0U);
}

TEST(LivoxCustom, WhatIsCutOrCountsBeyondItsBytesIsRefusedWithThePlace) {
  for (const auto& [encoding, whole] : {std::pair(MessageEncoding::kRos1, custom_in_ros1({})),
                                        std::pair(MessageEncoding::kCdr, custom_in_cdr({}, false))}) {
    for (std::size_t size = 0; size < whole.size(); ++size) {
      EXPECT_TRUE(contains(refusal_of(encoding, whole.substr(0, size)), "offset ")) << size;
    }
  }
  CustomMessage message;
  message.count = 0xFFFFFFFFU;
  EXPECT_TRUE(contains(refusal_of(MessageEncoding::kRos1, custom_in_ros1(message)), "4294967295 points need"));
  EXPECT_TRUE(contains(refusal_of(MessageEncoding::kCdr, custom_in_cdr(message, true)), "4294967295 points need"));
}

TEST(LivoxCustom, IsATopicOfClouds) {
  const test::TempFolder folder;
  const std::string type = "livox_ros_driver2/CustomMsg";
  const test::ReadCapture bag = test::read(
      folder.write("a.bag", test::ros1_bag({{"/livox/lidar", type}}, {{0, custom_in_ros1({})}, {0, "short"}})));
  ASSERT_EQ(bag.frames.size(), 1U);
  EXPECT_EQ(bag.frames.front().frame->cloud.width, 3U);
  EXPECT_EQ(*bag.frames.front().stamp_ns, 1'700'000'000'000'000'007);
  EXPECT_EQ(bag.errors.size(), 1U);
}

}  // namespace
}  // namespace pose_wall::tools
