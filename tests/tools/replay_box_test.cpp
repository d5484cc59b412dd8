// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: replay-box says of a good box that every bit came out again, names event, field and both values of the first
// that did not, finds damage and missing events, and its exit status tells these apart. That a box is read whatever its
// bytes, tests/runtime/box_test.cpp proves.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "box/box_replay.hpp"
#include "box/file_sink.hpp"
#include "pose_wall_box.h"
#include "pose_wall_runtime.h"
#include "ran_command.hpp"
#include "support/room.hpp"
#include "test_files.hpp"

namespace pose_wall::tools::test {
namespace {

using pose_wall::test::AlignedBlock;
using pose_wall::test::Dirt;

// Five frames and an empty one, as the runtime records them.
void record(const std::string& path, bool clouds = true) {
  const pose_wall_config config = pose_wall::test::small_config();
  FileSink sink(path);
  pose_wall_runtime_options options;
  pose_wall_runtime_options_init(&options);
  options.cloud_points_max = 30000;
  options.watchdog_ns = 0;
  options.sink = FileSink::write;
  options.sink_user = &sink;
  options.box_bytes = 64 << 20;
  options.box_clouds = clouds ? 1 : 0;
  std::uint64_t bytes = 0;
  ASSERT_EQ(pose_wall_runtime_memory_needed(&config, &options, &bytes), POSE_WALL_OK);
  AlignedBlock block(bytes, Dirt::kRandom);
  pose_wall_runtime* runtime = nullptr;
  ASSERT_EQ(pose_wall_runtime_open(&config, &options, block.data(), bytes, &runtime), POSE_WALL_OK);
  ASSERT_EQ(pose_wall_runtime_start(runtime), POSE_WALL_OK);
  for (std::uint32_t i = 0; i < 6; ++i) {
    const pose_wall::test::Points points = i == 3 ? pose_wall::test::Points() : pose_wall::test::room_points(i);
    const pose_wall_cloud cloud = pose_wall::test::cloud_of(points, 100000000 * i);
    ASSERT_EQ(pose_wall_runtime_push(runtime, &cloud), POSE_WALL_OK);
    ASSERT_EQ(pose_wall_runtime_wait_idle(runtime), POSE_WALL_OK);
  }
  ASSERT_EQ(pose_wall_runtime_stop(runtime), POSE_WALL_OK);
  ASSERT_EQ(pose_wall_runtime_close(runtime), POSE_WALL_OK);
}

std::vector<char> read_all(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write_all(const std::string& path, const std::vector<char>& bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

Ran replay(const std::string& path) {
  return command({"replay-box", "--quiet", path});
}

class ReplayBox : public ::testing::Test {
 protected:
  void SetUp() override { record(path_); }
  // Offset of the record in the file.
  std::uint64_t place_of(std::uint64_t sequence) {
    const std::vector<char> bytes = read_all(path_);
    std::uint64_t offset = POSE_WALL_BOX_HEADER_BYTES;
    pose_wall_box_record record;
    while (pose_wall_box_next(bytes.data(), bytes.size(), &offset, &record) == POSE_WALL_OK) {
      if (record.sequence == sequence) return record.offset;
    }
    return 0;
  }

  TempFolder folder_;
  const std::string path_ = folder_.file("box.pwbox");
};

TEST_F(ReplayBox, AGoodBoxComesOutAgain) {
  const Ran ran = replay(path_);
  EXPECT_EQ(ran.exit_status, 0) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "6 events (0 to 5): 6 frames, 0 silences")) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "6 bit for bit as recorded, 0 otherwise")) << ran.printed;
}

TEST_F(ReplayBox, TheLastBitOfOneValueIsNamed) {
  const BoxReplay good = replay_box(path_, nullptr);
  EXPECT_EQ(good.equal, 6U);
  pose_wall_result recorded{}, computed{};
  computed.quantity[POSE_WALL_YAW].sigma = 5e-324;
  const auto difference = first_difference(recorded, computed);
  ASSERT_TRUE(difference.has_value());
  EXPECT_EQ(difference->field, "quantity[yaw].sigma");
  EXPECT_EQ(difference->recorded, "0 (0x0000000000000000)");
  EXPECT_EQ(difference->computed, "4.9406564584124654e-324 (0x0000000000000001)");
  computed = recorded;
  computed.stage_ns[2] = 7;
  EXPECT_FALSE(first_difference(recorded, computed).has_value()) << "the clock's";
  computed.wall_points = 1;
  EXPECT_EQ(first_difference(recorded, computed)->field, "wall_points");
}

std::uint32_t crc32(const char* bytes, std::size_t count) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (std::size_t i = 0; i < count; ++i) {
    crc ^= static_cast<unsigned char>(bytes[i]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? 0xEDB88320U ^ (crc >> 1) : crc >> 1;
  }
  return ~crc;
}

// Another roll in the third record, with all checksums right: as if another engine had published it.
TEST_F(ReplayBox, ADifferenceIsNamedAndHasAStatusOfItsOwn) {
  std::vector<char> bytes = read_all(path_);
  char* const head = bytes.data() + place_of(2);
  std::uint64_t record_bytes = 0;
  std::memcpy(&record_bytes, head + 8, 8);
  const std::size_t at_result = 128 + (pose_wall_memento_bytes() + 63) / 64 * 64;
  const double other = 7.5;
  std::memcpy(head + at_result + offsetof(pose_wall_result, quantity), &other, 8);
  std::uint32_t crc = crc32(head + 64, record_bytes - 64);
  std::memcpy(head + 52, &crc, 4);
  crc = crc32(head, 60);
  std::memcpy(head + 60, &crc, 4);
  write_all(path_, bytes);
  const Ran ran = replay(path_);
  EXPECT_EQ(ran.exit_status, 3) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "5 bit for bit as recorded, 1 otherwise")) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "event 2, frame 2, stamp 200000000: quantity[roll].value")) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "recorded 7.5 (0x401e000000000000)")) << ran.printed;
}

// Every byte of a result but stage_ns belongs to a named field.
TEST_F(ReplayBox, NoByteOfAResultIsOverlooked) {
  for (std::size_t i = 0; i < sizeof(pose_wall_result); ++i) {
    pose_wall_result a{}, b{};
    reinterpret_cast<unsigned char*>(&b)[i] = 1;
    const bool of_clock =
        i >= offsetof(pose_wall_result, stage_ns) && i < offsetof(pose_wall_result, stage_ns) + sizeof a.stage_ns;
    EXPECT_EQ(first_difference(a, b).has_value(), !of_clock) << i;
  }
}

TEST_F(ReplayBox, DamageIsTold) {
  std::vector<char> bytes = read_all(path_);
  bytes[place_of(2) + 1000] ^= 4;
  write_all(path_, bytes);
  const Ran ran = replay(path_);
  EXPECT_EQ(ran.exit_status, 1) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "1 event missing")) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "1 record damaged")) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "5 bit for bit")) << ran.printed;
}

TEST_F(ReplayBox, CutOffInTheMiddleTheRestStands) {
  std::filesystem::resize_file(path_, place_of(4) + 5000);
  const Ran ran = replay(path_);
  EXPECT_EQ(ran.exit_status, 1) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "4 bit for bit as recorded, 0 otherwise")) << ran.printed;
}

TEST_F(ReplayBox, DigestsAndOtherFilesAreNoReplay) {
  const std::string other = folder_.file("digests.pwbox");
  record(other, false);
  const Ran digests = replay(other);
  EXPECT_EQ(digests.exit_status, 1) << digests.printed;
  EXPECT_TRUE(contains(digests.printed, "only as digests")) << digests.printed;
  write_all(path_, std::vector<char>(5000, 'x'));
  EXPECT_EQ(replay(path_).exit_status, 1);
  write_all(path_, {});
  EXPECT_EQ(replay(path_).exit_status, 1);
  EXPECT_EQ(replay(path_ + ".none").exit_status, 1);
}

TEST_F(ReplayBox, AFileThatHoldsABoxIsNotWrittenOver) {
  const std::vector<char> before = read_all(path_);
  EXPECT_THROW(FileSink sink(path_), std::runtime_error);
  EXPECT_EQ(read_all(path_), before);
  const std::string empty = folder_.file("empty.pwbox");
  write_all(empty, {});
  EXPECT_NO_THROW(FileSink sink(empty));
}

}  // namespace
}  // namespace pose_wall::tools::test
