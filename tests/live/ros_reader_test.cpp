// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what messages of ROS become frames, and under which stamp and frame. Whatever bytes others send, nothing is
// thrown. Of two sensors on one topic none is taken for the other. The extrinsic is told when it is known, and when it
// is gone.

#include "apps/live/ros_messages/ros_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "io/bags/message_writer.hpp"
#include "live/frame_catcher.hpp"
#include "live/tf_message.hpp"

namespace pose_wall::tools::live {
namespace {

using namespace pose_wall::test;

constexpr const char* kCloudType = "sensor_msgs/PointCloud2";

// One point at (1, 2, 3).
std::string cloud_message(std::uint32_t seconds, std::uint32_t nanoseconds, const std::string& frame_id) {
  MessageWriter message(MessageEncoding::kRos1);
  message.number(std::uint32_t{0});
  message.number(seconds);
  message.number(nanoseconds);
  message.text(frame_id);
  message.number(std::uint32_t{1});
  message.number(std::uint32_t{1});
  message.count(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    message.text(std::string(1, static_cast<char>('x' + i)));
    message.number(4 * i);
    message.number(std::uint8_t{POSE_WALL_FIELD_FLOAT32});
    message.number(std::uint32_t{1});
  }
  message.number(std::uint8_t{0});
  message.number(std::uint32_t{12});
  message.number(std::uint32_t{12});
  const float point[] = {1.0F, 2.0F, 3.0F};
  message.block({reinterpret_cast<const char*>(point), sizeof point});
  message.number(std::uint8_t{1});
  return message.take();
}

struct Reading {
  explicit Reading(const std::vector<std::string>& settings = {})
      : reader(load_config("", settings), MessageEncoding::kRos1) {
    reader.deliver_to(&taker);
  }
  void cloud(std::uint32_t seconds, std::uint32_t nanoseconds, const std::string& frame_id) {
    reader.take_cloud(kCloudType, view_of(cloud_message(seconds, nanoseconds, frame_id)));
  }
  PartHealth health() const { return reader.health("source"); }

  FrameCatcher taker;
  RosReader reader;
};

TEST(RosReader, StampAndFrameAreThoseOfTheHeader) {
  Reading reading;
  reading.cloud(1700000000, 123456789, "/lidar");
  ASSERT_EQ(reading.taker.frames().size(), 1U);
  const LiveFrame& frame = reading.taker.frames().front();
  EXPECT_EQ(frame.stamp_ns, 1'700'000'000'123'456'789);
  EXPECT_EQ(frame.frame.cloud.stamp_ns, frame.stamp_ns);
  EXPECT_EQ(frame.frame_id, "lidar") << "without the slash of old";
  EXPECT_EQ(frame.frame.cloud.width, 1U);
  EXPECT_EQ(reading.health().grade, Grade::kGood);
}

// A sensor that counts from its power-on: 12.5 s are copied as they are.
TEST(RosReader, StampsSincePowerOnAreCopied) {
  Reading reading;
  reading.cloud(12, 500'000'000, "lidar");
  ASSERT_EQ(reading.taker.frames().size(), 1U);
  EXPECT_EQ(reading.taker.frames().front().frame.cloud.stamp_ns, 12'500'000'000);
}

TEST(RosReader, WithoutAStampTheEngineGetsTheTimeOfArrivalAndTheHeaderStays) {
  Reading reading;
  reading.cloud(0, 0, "lidar");
  reading.cloud(0, 0, "lidar");
  ASSERT_EQ(reading.taker.frames().size(), 2U);
  const LiveFrame &first = reading.taker.frames()[0], &second = reading.taker.frames()[1];
  EXPECT_EQ(first.stamp_ns, 0);
  EXPECT_GT(first.frame.cloud.stamp_ns, 0);
  EXPECT_GE(second.frame.cloud.stamp_ns, first.frame.cloud.stamp_ns);
  EXPECT_EQ(fact(reading.health(), "clouds without stamp"), "2");
}

TEST(RosReader, OtherTypesAndCutMessagesAreCountedAndNamed) {
  Reading reading;
  const std::string whole = cloud_message(1, 0, "lidar");
  reading.reader.take_cloud("sensor_msgs/LaserScan", view_of(whole));
  EXPECT_NE(fact(reading.health(), "last refusal").find("sensor_msgs/LaserScan"), std::string::npos);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    reading.reader.take_cloud(kCloudType, view_of(whole.substr(0, size)));
  }
  EXPECT_TRUE(reading.taker.frames().empty());
  EXPECT_EQ(fact(reading.health(), "messages refused"), std::to_string(whole.size() + 1));
  reading.cloud(2, 0, "lidar");
  EXPECT_EQ(reading.taker.frames().size(), 1U) << "the next sound one is taken";
}

// Each byte in turn set to 0xff: nothing is thrown, and what comes through is described soundly.
TEST(RosReader, BytesThatWereChangedDoNoHarm) {
  const std::string whole = cloud_message(1, 0, "lidar");
  for (std::size_t at = 0; at < whole.size(); ++at) {
    Reading reading;
    std::string changed = whole;
    changed[at] = '\xff';
    EXPECT_NO_THROW(reading.reader.take_cloud(kCloudType, view_of(changed))) << at;
    for (const LiveFrame& frame : reading.taker.frames()) {
      EXPECT_EQ(pose_wall_cloud_check(&frame.frame.cloud), POSE_WALL_OK) << at;
    }
  }
}

// Nobody can tell two sensors' walls from those of one that jumps.
TEST(RosReader, OfTwoSensorsOnOneTopicTheFirstIsTaken) {
  Reading reading;
  reading.cloud(1, 0, "front");
  reading.cloud(1, 1, "rear");
  reading.cloud(2, 0, "front");
  ASSERT_EQ(reading.taker.frames().size(), 2U);
  for (const LiveFrame& frame : reading.taker.frames()) EXPECT_EQ(frame.frame_id, "front");
  EXPECT_EQ(fact(reading.health(), "clouds of another frame_id, dropped"), "1");
}

// The second one is mounted elsewhere: that the first is silent makes it no better.
TEST(RosReader, TheKeyChoosesTheSensorAndNamesTheOthers) {
  Reading reading({"source=ros1", "ros_source=frame_id rear"});
  reading.cloud(1, 0, "front");
  EXPECT_EQ(reading.health().grade, Grade::kBad);
  EXPECT_NE(reading.health().summary.find("ros_source is 'frame_id rear'; clouds come from frame_id front"),
            std::string::npos)
      << reading.health().summary;
  reading.cloud(1, 1, "rear");
  ASSERT_EQ(reading.taker.frames().size(), 1U);
  EXPECT_EQ(reading.taker.frames().front().frame_id, "rear");
  EXPECT_NE(fact(reading.health(), "sources").find("frame_id front (1 cloud) is not"), std::string::npos)
      << fact(reading.health(), "sources");
}

TEST(RosReader, TheExtrinsicIsToldWhenItIsThereAndBeforeTheCloudThatItIsFor) {
  Reading reading({"source=ros1", "extrinsic_from=tf"});
  reading.cloud(1, 0, "mast");
  ASSERT_FALSE(reading.taker.extrinsics().empty());
  EXPECT_FALSE(reading.taker.extrinsics().back().has_value());
  EXPECT_EQ(reading.health().grade, Grade::kBad);
  EXPECT_EQ(reading.health().summary, "no transform from 'mast' to 'base_link': nothing is measured");
  // lidar_frame's does not stand for the frame that the clouds have.
  reading.reader.take_transforms(view_of(tf_message({{"base_link", "lidar", {9, 9, 9}}})), true);
  EXPECT_FALSE(reading.taker.extrinsics().back().has_value());
  reading.reader.take_transforms(view_of(tf_message({{"base_link", "mast", {1, 2, 3}}})), true);
  ASSERT_TRUE(reading.taker.extrinsics().back().has_value());
  EXPECT_EQ(reading.taker.extrinsics().back()->y_m, 2.0);
  EXPECT_EQ(reading.health().grade, Grade::kGood);
  reading.reader.take_transforms(view_of(tf_message({{"base_link", "mast", {1, -2, 3}}})), true);
  EXPECT_EQ(reading.taker.extrinsics().back()->y_m, -2.0);
}

TEST(RosReader, GarbageByTfTakesNothingAway) {
  Reading reading({"source=ros1", "extrinsic_from=tf"});
  reading.reader.take_transforms(view_of(tf_message({{"base_link", "lidar", {1, 2, 3}}})), true);
  EXPECT_NO_THROW(reading.reader.take_transforms(view_of("\xff\xff\xff\xff garbage"), false));
  ASSERT_TRUE(reading.taker.extrinsics().back().has_value());
  EXPECT_EQ(fact(reading.health(), "messages refused"), "1");
}

TEST(RosReader, NothingIsDeliveredAfterTheEnd) {
  Reading reading({"source=ros1", "extrinsic_from=tf"});
  reading.reader.deliver_to(nullptr);
  reading.cloud(1, 0, "lidar");
  reading.reader.take_transforms(view_of(tf_message({{"base_link", "lidar"}})), true);
  EXPECT_TRUE(reading.taker.frames().empty());
  EXPECT_TRUE(reading.taker.extrinsics().empty());
}

}  // namespace
}  // namespace pose_wall::tools::live
