// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: of several sensors on one topic of a bag, whatever the bag, one is read; the others are counted and named,
// and --source chooses. What nobody is called is refused with those that are there.

#include <gtest/gtest.h>

#include <algorithm>

#include "bag_files.hpp"
#include "io/inputs/frame_sequence.hpp"
#include "ran_command.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

using BagTopics = std::vector<std::pair<std::string, std::string>>;

// Points that tell which message they are of: x counts from `nsec` on.
test::CloudMessage cloud_of(const std::string& frame_id, std::uint32_t number) {
  test::CloudMessage message;
  message.frame_id = frame_id;
  message.nsec = number * 100'000'000;
  return message;
}

// Of one point, `end_ns` behind the scan's beginning.
std::string custom_of(bool is_cdr, std::uint8_t lidar_id, std::uint32_t number, std::uint64_t base_ns = 7,
                      std::uint32_t end_ns = 0) {
  const std::string rest = std::string(1, static_cast<char>(lidar_id)) + "123";
  const std::string marks = "\x0A\x10\x01";
  const std::uint32_t nsec = number * 100'000'000;
  if (!is_cdr) {
    return test::raw(9U) + test::raw(1'700'000'000U) + test::raw(nsec) + test::with_length("livox_frame") +
           test::raw(base_ns) + test::raw(1U) + rest + test::raw(1U) + test::raw(end_ns) + test::raw(1.0F) +
           test::raw(2.0F) + test::raw(3.0F) + marks;
  }
  test::CdrWriter out(false);
  out.put(1'700'000'000);
  out.put(nsec);
  out.put_text("livox_frame");
  out.put(base_ns);
  out.put(1U);
  for (const char byte : rest) out.put(byte);
  out.put(1U);
  out.put(end_ns);
  for (const float value : {1.0F, 2.0F, 3.0F}) out.put(value);
  out.put_bytes(marks);
  return out.text();
}

// One bag of each kind that this build reads, all of the same messages: `of` makes the message by number.
template <typename MessageOf>
std::vector<std::string> bags(const TempFolder& folder, const std::string& type, std::uint32_t count, MessageOf of) {
  const std::string ros2_type = type.substr(0, type.find('/')) + "/msg" + type.substr(type.find('/'));
  const BagTopics ros1 = {{"/points", type}}, ros2 = {{"/points", ros2_type}};
  std::vector<WrittenMessage> in_ros1, in_cdr;
  for (std::uint32_t i = 0; i < count; ++i) {
    in_ros1.push_back({0, of(false, i)});
    in_cdr.push_back({0, of(true, i)});
  }
  std::vector<std::string> files = {folder.write("a.bag", test::ros1_bag(ros1, in_ros1)),
                                    folder.write("a.mcap", test::mcap(ros2, in_cdr, nullptr))};
#if POSE_WALL_HAS_SQLITE
  files.push_back(folder.file("a.db3"));
  test::write_sqlite_bag(files.back(), ros2, in_cdr);
#endif
  return files;
}

std::vector<std::string> bags_of_two_frames(const TempFolder& folder, std::uint32_t count = 6) {
  return bags(folder, "sensor_msgs/PointCloud2", count, [](bool is_cdr, std::uint32_t i) {
    const test::CloudMessage cloud = cloud_of(i % 2 == 0 ? "left" : "right", i);
    return is_cdr ? cdr_message(cloud) : ros1_message(cloud);
  });
}

std::vector<std::string> bags_of_two_lidars(const TempFolder& folder) {
  return bags(folder, "livox_ros_driver2/CustomMsg", 6,
              [](bool is_cdr, std::uint32_t i) { return custom_of(is_cdr, static_cast<std::uint8_t>(i % 2), i); });
}

struct ReadFrames {
  std::vector<std::int64_t> tenths;  // stamps behind the second
  std::vector<std::string> names, notes;
  std::size_t announced = 0;
};

ReadFrames frames_of(const std::string& file, const std::string& source) {
  InputOptions options;
  options.source = source;
  FrameSequence frames({file}, options);
  ReadFrames read;
  read.announced = frames.frames();
  read.notes = frames.notes();
  while (const std::optional<SourcedFrame> frame = frames.next()) {
    EXPECT_TRUE(frame->frame) << frame->error;
    read.tenths.push_back((frame->stamp_ns.value_or(0) - 1'700'000'000'000'000'000) / 100'000'000);
    read.names.push_back(frame->name);
  }
  return read;
}

void expect_even(const ReadFrames& read, const std::string& file) {
  EXPECT_EQ(read.tenths, (std::vector<std::int64_t>{0, 2, 4})) << file;
  EXPECT_EQ(read.announced, 3U) << file;
}

TEST(BagSources, TheFirstFrameIdIsReadAndTheOtherIsNamed) {
  const TempFolder folder;
  for (const std::string& file : bags_of_two_frames(folder)) {
    const ReadFrames read = frames_of(file, "");
    expect_even(read, file);
    EXPECT_EQ(read.names.back(), file + "#4") << "the number of the message on its topic";
    ASSERT_EQ(read.notes.size(), 1U);
    EXPECT_EQ(read.notes.front(), file +
                                      ": 2 sources on /points: frame_id left is read; frame_id right (3 messages) is "
                                      "not; --source chooses");
  }
}

TEST(BagSources, LivoxTellsSensorsApartByTheirLidarId) {
  const TempFolder folder;
  for (const std::string& file : bags_of_two_lidars(folder)) {
    const ReadFrames read = frames_of(file, "");
    expect_even(read, file);
    ASSERT_EQ(read.notes.size(), 1U);
    EXPECT_TRUE(contains(read.notes.front(), "lidar_id 0 is read; lidar_id 1 (3 messages) is not"));
    EXPECT_EQ(frames_of(file, "lidar_id 1").tenths, (std::vector<std::int64_t>{1, 3, 5})) << file;
  }
}

// livox_ros_driver2 gives all its sensors one frame_id and the first byte of their address.
TEST(BagSources, SensorsThatNothingTellsApartAreRefusedByTheirScansThatOverlap) {
  // A moment of 2023, as a driver with a set clock stamps, and 10 Hz.
  constexpr std::uint64_t kStart_ns = 1'700'000'000'000'000'000, kScan_ns = 100'000'000;
  for (const std::uint64_t behind_ns : {std::uint64_t{0}, std::uint64_t{5'000'000}, std::uint64_t{50'000'000}}) {
    const TempFolder of_two;
    for (const std::string& file :
         bags(of_two, "livox_ros_driver2/CustomMsg", 12, [behind_ns](bool is_cdr, std::uint32_t i) {
           return custom_of(is_cdr, 192, i, kStart_ns + i / 2 * kScan_ns + i % 2 * behind_ns, kScan_ns);
         })) {
      const FrameSequence frames({file});
      ASSERT_EQ(frames.errors().size(), 1U) << file << " " << behind_ns;
      EXPECT_TRUE(contains(frames.errors().front(), "frame_id livox_frame, lidar_id 192 on /points overlap in time"))
          << frames.errors().front();
    }
  }
  // One sensor, whose scans touch by what the network delays.
  const TempFolder of_one;
  for (const std::string& file : bags(of_one, "livox_ros_driver2/CustomMsg", 12, [](bool is_cdr, std::uint32_t i) {
         return custom_of(is_cdr, 192, i, kStart_ns + i * kScan_ns, kScan_ns + 5'000'000);
       })) {
    EXPECT_TRUE(FrameSequence({file}).errors().empty()) << file;
  }
}

TEST(BagSources, TheOneThatIsNamedIsReadThoughItIsNotTheFirst) {
  const TempFolder folder;
  for (const std::string& file : bags_of_two_frames(folder)) {
    for (const char* name : {"right", "frame_id right"}) {
      const ReadFrames read = frames_of(file, name);
      EXPECT_EQ(read.tenths, (std::vector<std::int64_t>{1, 3, 5})) << file;
      EXPECT_EQ(read.announced, 3U);
    }
  }
}

TEST(BagSources, OneSensorIsNotWorthAWord) {
  const TempFolder folder;
  for (const std::string& file : bags_of_two_frames(folder, 1)) EXPECT_TRUE(frames_of(file, "").notes.empty()) << file;
}

// A message whose sender cannot be read is an unreadable frame as ever, and not another sensor's.
TEST(BagSources, WhatTellsNoSenderIsNoOtherSensor) {
  const TempFolder folder;
  const std::string file =
      folder.write("a.mcap", test::mcap({{"/points", "sensor_msgs/msg/PointCloud2"}},
                                        {{0, "cut"}, {0, cdr_message(cloud_of("left", 1))}}, nullptr));
  FrameSequence frames({file});
  EXPECT_EQ(frames.frames(), 2U);
  EXPECT_TRUE(frames.notes().empty());
  const std::optional<SourcedFrame> cut = frames.next(), sound = frames.next();
  ASSERT_TRUE(cut && sound);
  EXPECT_FALSE(cut->frame);
  EXPECT_TRUE(sound->frame);
}

TEST(BagSources, VerbsSayWhoIsReadAndRefuseANameOfNobody) {
  const TempFolder folder;
  const std::string out = folder.file("o.csv");
  for (const std::string& file : bags_of_two_frames(folder)) {
    const Ran ran = command({"run", "-o", out, file});
    EXPECT_EQ(ran.exit_status, 0) << ran.errors;
    EXPECT_EQ(test::table_of(out).rows(), 3U);
    EXPECT_TRUE(contains(ran.errors, "frame_id right (3 messages) is not; --source chooses")) << ran.errors;
    const Ran wrong = command({"run", "-o", out, "--source", "rear", file});
    EXPECT_EQ(wrong.exit_status, 2);
    EXPECT_TRUE(contains(wrong.errors,
                         "--source rear: nobody on /points is called this; there: frame_id left (3 "
                         "messages), frame_id right (3 messages)"))
        << wrong.errors;
    const Ran info = command({"info", file});
    EXPECT_TRUE(contains(info.printed, "frame_id right") && contains(info.printed, "not read")) << info.printed;
    EXPECT_TRUE(contains(command({"info", "--json", file}).printed, "\"name\": \"frame_id right\""));
  }
  const TempFolder of_livox;
  for (const std::string& file : bags_of_two_lidars(of_livox)) {
    EXPECT_TRUE(test::says(command({"run", "-o", out, "--source", "livox_frame", file}), 2,
                           "several on /points are meant: lidar_id 0 (3 messages), lidar_id 1"));
  }
  const std::string frame = folder.write("a.bin", std::string(16, '\0'));
  EXPECT_TRUE(contains(command({"run", "-o", out, "--source", "left", frame}).errors, "no input is a bag"));
}

}  // namespace
}  // namespace pose_wall::tools
