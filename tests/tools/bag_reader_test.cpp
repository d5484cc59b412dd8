// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: ROS 1 bags and MCAP written by hand are read in every way of storing chunks; cut at any byte they give the
// frames before the cut, and then say so; bytes changed at random never do worse than an error. Files of other writers
// are checked by hand, they are too large to keep here.

#include <gtest/gtest.h>

#if POSE_WALL_HAS_LZ4
#include <lz4frame.h>
#endif
#if POSE_WALL_HAS_ZSTD
#include <zstd.h>
#endif
#if POSE_WALL_HAS_BZIP2
#include <bzlib.h>
#endif

#include <random>

#include "bag_files.hpp"
#include "io/inputs/frame_sequence.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

constexpr std::uint32_t kFrames = 2;
const std::vector<std::pair<std::string, std::string>> kRos1Topics = {{"/points", "sensor_msgs/PointCloud2"},
                                                                      {"/words", "std_msgs/String"}};
const std::vector<std::pair<std::string, std::string>> kRos2Topics = {{"/points", "sensor_msgs/msg/PointCloud2"},
                                                                      {"/words", "std_msgs/msg/String"}};

CloudMessage cloud(std::uint32_t number) {
  CloudMessage message;
  message.nsec = number;
  return message;
}

std::vector<WrittenMessage> messages(bool cdr) {
  std::vector<WrittenMessage> list;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    list.push_back({1, "hello"});
    list.push_back({0, cdr ? cdr_message(cloud(i)) : ros1_message(cloud(i))});
  }
  return list;
}

#if POSE_WALL_HAS_LZ4
std::string lz4(const std::string& text) {
  std::string packed(LZ4F_compressFrameBound(text.size(), nullptr), '\0');
  packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), text.data(), text.size(), nullptr));
  return packed;
}
#endif
#if POSE_WALL_HAS_ZSTD
std::string zstd(const std::string& text) {
  std::string packed(ZSTD_compressBound(text.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), text.data(), text.size(), 1));
  return packed;
}
#endif
#if POSE_WALL_HAS_BZIP2
std::string bz2(const std::string& text) {
  std::string packed(text.size() + 1000, '\0');
  auto size = static_cast<unsigned>(packed.size());
  std::string copy = text;
  BZ2_bzBuffToBuffCompress(packed.data(), &size, copy.data(), static_cast<unsigned>(copy.size()), 9, 0, 0);
  packed.resize(size);
  return packed;
}
#endif

std::vector<Packing> ros1_packings() {
  std::vector<Packing> packings = {{"none"}};
#if POSE_WALL_HAS_LZ4
  packings.push_back({"lz4", lz4});
#endif
#if POSE_WALL_HAS_BZIP2
  packings.push_back({"bz2", bz2});
#endif
  return packings;
}

std::vector<Packing> mcap_packings() {
  std::vector<Packing> packings = {{""}};
#if POSE_WALL_HAS_LZ4
  packings.push_back({"lz4", lz4});
#endif
#if POSE_WALL_HAS_ZSTD
  packings.push_back({"zstd", zstd});
#endif
  return packings;
}

struct ReadBag {
  std::vector<std::string> points;  // bytes of each frame
  std::vector<std::int64_t> stamps_ns;
  std::vector<std::string> errors;
  std::size_t announced = 0;
};

ReadBag read(const std::string& file) {
  FrameSequence frames({file});
  ReadBag bag;
  bag.errors = frames.errors();
  bag.announced = frames.frames();
  while (const std::optional<SourcedFrame> frame = frames.next()) {
    if (frame->frame) {
      const pose_wall_cloud& made = frame->frame->cloud;
      bag.points.emplace_back(static_cast<const char*>(made.data), made.data_bytes);
      bag.stamps_ns.push_back(frame->stamp_ns.value_or(-1));
    } else {
      bag.errors.push_back(frame->error);
    }
  }
  return bag;
}

void expect_whole(const ReadBag& bag, const std::string& what) {
  EXPECT_TRUE(bag.errors.empty()) << what << ": " << bag.errors.front();
  EXPECT_EQ(bag.announced, kFrames) << what;
  ASSERT_EQ(bag.points.size(), kFrames) << what;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    EXPECT_EQ(bag.points[i], cloud(i).bytes()) << what;
    EXPECT_EQ(bag.stamps_ns[i], 1700000000000000000 + i) << what;
  }
}

// Of a file cut anywhere: a beginning of the frames, then one error.
void expect_cuts_are_said(const std::string& whole, const std::string& name, std::size_t step) {
  const TempFolder folder;
  std::size_t frames_before = 0;
  for (std::size_t length = (whole.size() - 1) % step; length < whole.size(); length += step) {
    const ReadBag bag = read(folder.write(name, whole.substr(0, length)));
    ASSERT_EQ(bag.errors.size(), 1U) << name << " cut at " << length;
    EXPECT_NE(bag.errors.front().find("offset"), std::string::npos) << bag.errors.front();
    ASSERT_GE(bag.points.size(), frames_before) << length;
    ASSERT_LE(bag.points.size(), kFrames) << length;
    frames_before = bag.points.size();
    for (std::size_t i = 0; i < bag.points.size(); ++i) {
      ASSERT_EQ(bag.points[i], cloud(static_cast<std::uint32_t>(i)).bytes()) << length;
    }
  }
  EXPECT_EQ(frames_before, kFrames) << name << ": only its end was missing";
}

// Whatever comes out, it comes out as frames and errors.
void expect_damage_is_survived(const std::string& whole, const std::string& name) {
  const TempFolder folder;
  std::mt19937 random(11);
  for (int round = 0; round < 150; ++round) {
    std::string damaged = whole;
    for (int flips = 0; flips < 1 + round % 3; ++flips) {
      damaged[random() % damaged.size()] = static_cast<char>(round % 2 == 0 ? 0xFF : random());
    }
    const ReadBag bag = read(folder.write(name, damaged));
    EXPECT_LE(bag.points.size(), kFrames + 1);
    EXPECT_LE(bag.errors.size(), 40U) << "errors do not multiply";
  }
}

TEST(Ros1Bag, EveryCompressionGivesTheMessages) {
  const TempFolder folder;
  for (const Packing& packing : ros1_packings()) {
    expect_whole(read(folder.write("a.bag", ros1_bag(kRos1Topics, messages(false), packing))), packing.name);
  }
}

TEST(Mcap, EveryCompressionGivesTheMessages) {
  const TempFolder folder;
  for (const Packing& packing : mcap_packings()) {
    expect_whole(read(folder.write("a.mcap", mcap(kRos2Topics, messages(true), &packing))), packing.name);
  }
  expect_whole(read(folder.write("b.mcap", mcap(kRos2Topics, messages(true), nullptr))), "no chunks");
  expect_whole(read(folder.write("c.mcap", mcap(kRos1Topics, messages(false), nullptr, "ros1"))), "ROS 1 in MCAP");
}

TEST(Mcap, ContentDecidesNotTheEnding) {
  const TempFolder folder;
  expect_whole(read(folder.write("a.bin", mcap(kRos2Topics, messages(true), nullptr))), "named .bin");
}

TEST(Ros1Bag, CutAnywhereItGivesTheFramesBeforeTheCutAndAnError) {
  for (const Packing& packing : ros1_packings()) {
    expect_cuts_are_said(ros1_bag(kRos1Topics, messages(false), packing), "cut.bag", packing.pack == nullptr ? 1 : 23);
  }
}

TEST(Mcap, CutAnywhereItGivesTheFramesBeforeTheCutAndAnError) {
  expect_cuts_are_said(mcap(kRos2Topics, messages(true), nullptr), "cut.mcap", 11);
  for (const Packing& packing : mcap_packings()) {
    expect_cuts_are_said(mcap(kRos2Topics, messages(true), &packing), "cut.mcap", packing.pack == nullptr ? 1 : 23);
  }
}

TEST(Ros1Bag, DamageIsSurvived) {
  for (const Packing& packing : ros1_packings()) {
    expect_damage_is_survived(ros1_bag(kRos1Topics, messages(false), packing), "damaged.bag");
  }
}

TEST(Mcap, DamageIsSurvived) {
  for (const Packing& packing : mcap_packings()) {
    expect_damage_is_survived(mcap(kRos2Topics, messages(true), &packing), "damaged.mcap");
  }
}

TEST(Mcap, ADamagedChunkCostsItselfOnly) {
  const TempFolder folder;
  const Packing plain{""};
  std::string file = mcap(kRos2Topics, messages(true), &plain);
  const std::size_t first = file.find(cloud(0).bytes());
  ASSERT_NE(first, std::string::npos);
  file[first] = static_cast<char>(file[first] ^ 1);
  const ReadBag bag = read(folder.write("a.mcap", file));
  EXPECT_EQ(bag.points, (std::vector<std::string>{cloud(1).bytes()}));
  ASSERT_EQ(bag.errors.size(), 1U);
  EXPECT_NE(bag.errors.front().find("checksum"), std::string::npos) << bag.errors.front();
  EXPECT_EQ(bag.announced, 2U);
}

TEST(Mcap, SizesOfChunksThatLieAreRefused) {
  const TempFolder folder;
  for (const Packing& packing : mcap_packings()) {
    const std::string file = mcap(kRos2Topics, messages(true), &packing);
    // Where the first chunk begins, a file without messages ends its data.
    const std::size_t chunk = mcap(kRos2Topics, {}, nullptr).find(test::mcap_record(15, test::raw(0U)));
    ASSERT_NE(chunk, std::string::npos);
    for (const std::uint64_t size : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1'000'000}, ~std::uint64_t{0}}) {
      std::string lying = file;
      lying.replace(chunk + 9 + 16, 8, test::raw(size));
      const ReadBag bag = read(folder.write("lying.mcap", lying));
      EXPECT_EQ(bag.points.size(), kFrames) << "the chunk holds a word only";
      ASSERT_EQ(bag.errors.size(), 1U) << packing.name << " " << size;
    }
  }
}

TEST(Ros1Bag, OneWithoutAnIndexIsReadAndSaid) {
  const TempFolder folder;
  std::string file = ros1_bag(kRos1Topics, messages(false));
  const std::size_t index = file.find("index_pos=") + 10;
  file.replace(index, 8, test::raw(std::uint64_t{0}));
  const ReadBag bag = read(folder.write("open.bag", file));
  EXPECT_EQ(bag.points.size(), kFrames);
  ASSERT_EQ(bag.errors.size(), 1U);
  EXPECT_NE(bag.errors.front().find("no index"), std::string::npos) << bag.errors.front();
}

}  // namespace
}  // namespace pose_wall::tools
