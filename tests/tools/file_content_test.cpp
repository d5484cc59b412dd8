// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every kind of input is read whatever its file is called, or refused by a sentence that says what it is and
// what to do: each kind that is read and each that is not, under each ending.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bag_files.hpp"
#include "io/frames/file_content.hpp"
#include "io/inputs/frame_sequence.hpp"
#include "packet_files.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

const char* const kEndings[] = {".pcd",  ".PCD",    ".bin", ".ply",  ".xyz", ".txt", ".csv", ".asc",
                                ".pcap", ".pcapng", ".bag", ".mcap", ".db3", ".dat", ""};

struct Kind {
  const char* name;
  std::string content;
};

std::string mcap_of_one_cloud() {
  return test::mcap({{"/points", "sensor_msgs/msg/PointCloud2"}}, {{0, test::cdr_message(test::CloudMessage())}},
                    nullptr);
}

std::string ros1_bag_of_one_cloud() {
  return test::ros1_bag({{"/points", "sensor_msgs/PointCloud2"}}, {{0, test::ros1_message(test::CloudMessage())}},
                        {"none"});
}

std::string capture_of_one_turn() {
  std::vector<std::string> payloads;
  for (int i = 0; i < 4; ++i) payloads.push_back(test::payload_of(test::VelodynePacket()));
  return test::capture_of(payloads);
}

std::vector<Kind> kinds_that_are_read() {
  const std::string head = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\n";
  const std::string point = raw(1.0F) + raw(2.0F) + raw(3.0F);
  return {{"PCD, ascii", "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + head + "DATA ascii\n1 2 3\n"},
          {"PCD behind a comment", "# made by hand\nVERSION 0.7\n" + head + "DATA ascii\n1 2 3\n"},
          {"PCD, binary", "# .PCD v0.7\nVERSION 0.7\n" + head + "DATA binary\n" + point},
          {"PLY",
           "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
           "property float z\nend_header\n" +
               point},
          {"text", "1 2 3\n4 5 6\n"},
          {"text with names", "x,y,z\n1,2,3\n"},
          {"ROS 1 bag", ros1_bag_of_one_cloud()},
          {"MCAP", mcap_of_one_cloud()}};
}

// How many frames came, and what was said of those that did not.
struct Told {
  std::size_t frames = 0;
  std::string errors;
};

Told told_of(const std::string& file, const InputOptions& options = {}) {
  FrameSequence sequence({file}, options);
  Told told;
  for (const std::string& error : sequence.errors()) told.errors += error + '\n';
  while (const std::optional<SourcedFrame> frame = sequence.next()) {
    frame->frame ? static_cast<void>(++told.frames) : static_cast<void>(told.errors += frame->error + '\n');
  }
  return told;
}

TEST(FileContent, EveryKindIsReadUnderEveryEnding) {
  const TempFolder folder;
  for (const Kind& kind : kinds_that_are_read()) {
    for (const char* ending : kEndings) {
      const Told told = told_of(folder.write(std::string("a") + ending, kind.content));
      EXPECT_EQ(told.frames, 1U) << kind.name << " under '" << ending << "': " << told.errors;
      EXPECT_EQ(told.errors, "") << kind.name << " under '" << ending << "'";
    }
  }
}

#if POSE_WALL_HAS_PCAP
TEST(FileContent, ACaptureIsReadUnderEveryEnding) {
  const TempFolder folder;
  const std::string capture = capture_of_one_turn();
  for (const char* ending : kEndings) {
    const Told told = told_of(folder.write(std::string("a") + ending, capture));
    EXPECT_GE(told.frames, 1U) << ending << ": " << told.errors;
  }
}
#endif

TEST(FileContent, WhatIsNotReadSaysWhatItIsAndWhatToDo) {
  const std::string zeros(600, '\0');
  const std::string tar = std::string(257, 'n') + "ustar" + zeros;
  const std::pair<std::string, std::vector<std::string>> cases[] = {
      {"\x1F\x8B\x08" + zeros, {"gzip", "gunzip"}},
      {"PK\x03\x04" + zeros, {"zip", "unzip"}},
      {"BZh9" + zeros, {"bzip2", "bunzip2"}},
      {std::string("\xFD"
                   "7zXZ\0",
                   6) +
           zeros,
       {"xz", "unxz"}},
      {"\x28\xB5\x2F\xFD" + zeros, {"zstd", "unzstd"}},
      {"\x04\x22\x4D\x18" + zeros, {"lz4", "unlz4"}},
      {"7z\xBC\xAF\x27\x1C" + zeros, {"7-Zip", "7z x"}},
      {tar, {"tar", "tar xf"}},
      {"LASF" + zeros, {"LAS", "pdal translate FILE out.pcd --writers.pcd.compression=binary"}},
      {"ASTM-E57" + zeros, {"E57", "pdal translate FILE out.pcd --writers.pcd.compression=binary"}},
      {"CCB2" + zeros, {"CloudCompare", "as PLY"}},
      {"\x93NUMPY" + zeros, {"NumPy", "--layout"}},
      {"\x89HDF\r\n\x1A\n" + zeros, {"HDF5", "PCD"}},
      {std::string("\xFF\xFE"
                   "1\0 \0"
                   "2\0",
                   8),
       {"UTF-16", "UTF-8"}},
      {"\x89PNG" + zeros, {"picture"}},
      {"%PDF-1.4\n" + zeros, {"PDF"}},
      {"#ROSBAG V1.2\n" + zeros, {"old format", "rosbag"}},
  };
  const TempFolder folder;
  for (const auto& [content, parts] : cases) {
    for (const char* ending : kEndings) {
      const Told told = told_of(folder.write(std::string("a") + ending, content));
      EXPECT_EQ(told.frames, 0U) << ending;
      for (const std::string& part : parts) EXPECT_TRUE(contains(told.errors, part)) << ending << ": " << told.errors;
    }
  }
}

// Bare numbers look like nothing: .bin is where they are expected, and --layout says it of any file.
TEST(FileContent, BareNumbersAreReadFromBinAndElsewhereWhereItIsSaid) {
  const TempFolder folder;
  std::string points;
  for (int i = 0; i < 1000; ++i) {
    points += raw(5.0F + static_cast<float>(i % 97)) + raw(-3.0F - static_cast<float>(i % 7)) +
              raw(0.01F * static_cast<float>(i % 31) - 1.5F);
  }
  InputOptions said;
  said.layout = "xyz";
  for (const char* ending : kEndings) {
    const std::string file = folder.write(std::string("a") + ending, points);
    const Told told = told_of(file);
    const bool is_bin = ending == std::string(".bin");
    EXPECT_EQ(told.frames, is_bin ? 1U : 0U) << ending << ": " << told.errors;
    const bool is_recording = contains(".pcap .pcapng .bag .mcap .db3", ending) && *ending != '\0';
    EXPECT_EQ(told.errors.empty(), is_bin) << ending;
    EXPECT_TRUE(is_bin || is_recording || contains(told.errors, "--layout")) << ending << ": " << told.errors;
    EXPECT_TRUE(is_recording || told_of(file, said).frames == 1) << ending;
  }
}

TEST(FileContent, ABeginningThatWasCutLeavesTheEndingToDecide) {
  EXPECT_EQ(content_of(""), FileContent::kEmpty);
  EXPECT_EQ(content_of("#ROSBA"), FileContent::kUnknown);
  EXPECT_EQ(content_of("SQLite format 3"), FileContent::kUnknown);
  EXPECT_EQ(content_of("pl"), FileContent::kUnknown);
  EXPECT_EQ(content_of("1 2 3\n"), FileContent::kText);
  EXPECT_EQ(content_of(raw(1.0F) + raw(2.0F)), FileContent::kUnknown);
  EXPECT_EQ(content_of("\xFF\xFE\x80\x3F" + raw(2.5F)), FileContent::kUnknown) << "a float that begins like UTF-16";
}

}  // namespace
}  // namespace pose_wall::tools
