// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: messages that rosbag2 compressed one by one are read from a file that is named alone and from its folder; a
// damaged one is said and the others follow. Topics without a serialisation are CDR where their bytes are.

#include <gtest/gtest.h>

#if POSE_WALL_HAS_ZSTD
#include <zstd.h>
#endif

#include "bag_files.hpp"
#include "io/inputs/frame_sequence.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

const std::vector<std::pair<std::string, std::string>> kPoints = {{"/points", "sensor_msgs/msg/PointCloud2"}};

struct ReadMessages {
  std::vector<std::int64_t> stamps_ns;  // of frames
  std::vector<std::string> errors;
};

ReadMessages read_messages(const std::string& input) {
  FrameSequence frames({input});
  ReadMessages read;
  read.errors = frames.errors();
  while (const std::optional<SourcedFrame> frame = frames.next()) {
    if (frame->frame) read.stamps_ns.push_back(frame->stamp_ns.value_or(0) - 1'700'000'000'000'000'000);
    if (!frame->frame) read.errors.push_back(frame->error);
  }
  return read;
}

std::string plain_message(std::uint32_t number) {
  test::CloudMessage cloud;
  cloud.nsec = number;
  return cdr_message(cloud);
}

#if POSE_WALL_HAS_ZSTD

std::string packed_message(std::uint32_t number) {
  const std::string plain = plain_message(number);
  std::string packed(ZSTD_compressBound(plain.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), plain.data(), plain.size(), 1));
  return packed;
}

void expect_two(const ReadMessages& read, const std::string& input) {
  EXPECT_TRUE(read.errors.empty()) << input << ": " << read.errors.front();
  EXPECT_EQ(read.stamps_ns, (std::vector<std::int64_t>{1, 2})) << input;
}

TEST(PackedMessages, AreReadFromAFileThatIsNamedAloneAndFromItsFolder) {
  const TempFolder folder;
  const std::vector<WrittenMessage> messages = {{0, packed_message(1)}, {0, packed_message(2)}};
  const std::string file = folder.write("bag/a.mcap", test::mcap(kPoints, messages, nullptr));
  expect_two(read_messages(file), file);
  folder.write("bag/metadata.yaml",
               "rosbag2_bagfile_information:\n  compression_format: zstd\n  compression_mode: MESSAGE\n"
               "  relative_file_paths: [a.mcap]\n");
  expect_two(read_messages(folder.file("bag")), "the folder");
#if POSE_WALL_HAS_SQLITE
  test::write_sqlite_bag(folder.file("a.db3"), kPoints, messages);
  expect_two(read_messages(folder.file("a.db3")), "a.db3");
#endif
}

TEST(PackedMessages, ADamagedOneIsSaidAndTheOthersAreRead) {
  const TempFolder folder;
  const std::string whole = packed_message(1);
  std::size_t said = 0;
  for (std::size_t length = 4; length < whole.size(); ++length) {
    const std::vector<WrittenMessage> messages = {{0, whole.substr(0, length)}, {0, packed_message(2)}};
    const ReadMessages read = read_messages(folder.write("a.mcap", test::mcap(kPoints, messages, nullptr)));
    EXPECT_EQ(read.stamps_ns, (std::vector<std::int64_t>{2})) << length;
    ASSERT_EQ(read.errors.size(), 1U) << length;
    if (contains(read.errors.front(), "a message that its recorder compressed: zstd: ")) ++said;
  }
  EXPECT_EQ(said, whole.size() - 4);
}

TEST(PackedMessages, WhatAnotherPluginCompressedIsRefusedByName) {
  const TempFolder folder;
  folder.write("bag/metadata.yaml",
               "rosbag2_bagfile_information:\n  compression_format: lz4\n  compression_mode: MESSAGE\n"
               "  relative_file_paths: [a.mcap]\n");
  const ReadMessages read = read_messages(folder.file("bag"));
  ASSERT_EQ(read.errors.size(), 1U);
  EXPECT_TRUE(contains(read.errors.front(), "compression_mode MESSAGE, compression_format lz4")) << read.errors.front();
}

#endif

#if POSE_WALL_HAS_SQLITE

TEST(SqliteTopics, WithoutASerialisationAreCdrWhereTheirBytesAre) {
  const TempFolder folder;
  const std::string file = folder.file("a.db3");
  test::write_sqlite_bag(file, kPoints, {{0, plain_message(1)}, {0, "\x7F\x45\x4C\x46 no CDR"}}, "");
  const ReadMessages read = read_messages(file);
  EXPECT_EQ(read.stamps_ns, (std::vector<std::int64_t>{1}));
  ASSERT_EQ(read.errors.size(), 1U);
  EXPECT_TRUE(contains(read.errors.front(), "CDR of kind 7f45")) << read.errors.front();
  test::write_sqlite_bag(folder.file("b.db3"), kPoints, {{0, plain_message(1)}}, "protobuf");
  EXPECT_TRUE(contains(read_messages(folder.file("b.db3")).errors.at(0), "neither CDR nor of ROS 1"));
}

#endif

}  // namespace
}  // namespace pose_wall::tools
