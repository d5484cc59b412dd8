// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: replay-box says of a good box that every bit came out again, names event, field and both values of the first
// that did not, finds damage and missing events, and its exit status tells these apart, also when the ring came round:
// what it overwrote is no gap, what is damaged is no remnant. A file that holds a box is not written over. That a box
// is read whatever its bytes, tests/runtime/box_test.cpp proves.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/box/box_replay.hpp"
#include "io/box/file_sink.hpp"
#include "io/csv/csv_table.hpp"
#include "io/terminal/interrupt.hpp"
#include "pose_wall_box.h"
#include "pose_wall_runtime.h"
#include "ran_command.hpp"
#include "support/room.hpp"
#include "test_files.hpp"

namespace pose_wall::tools::test {
namespace {

using pose_wall::test::AlignedBlock;
using pose_wall::test::Dirt;

using Clouds = std::vector<pose_wall::test::Points>;

// Each a frame, as the runtime records them.
void record(const Clouds& frames, pose_wall_runtime_sink to, void* sink, std::uint64_t box_bytes, bool clouds,
            bool motion = false) {
  const pose_wall_config config = pose_wall::test::small_config();
  pose_wall_runtime_options options;
  pose_wall_runtime_options_init(&options);
  options.cloud_points_max = box_bytes > 1 << 20 ? 30000 : 4000;
  options.watchdog_ns = 0;
  options.motion = motion ? pose_wall_motion_functions_get() : nullptr;
  options.sink = to;
  options.sink_user = sink;
  options.box_bytes = box_bytes;
  options.box_clouds = clouds ? 1 : 0;
  std::uint64_t bytes = 0;
  ASSERT_EQ(pose_wall_runtime_memory_needed(&config, &options, &bytes), POSE_WALL_OK);
  AlignedBlock block(bytes, Dirt::kRandom);
  pose_wall_runtime* runtime = nullptr;
  ASSERT_EQ(pose_wall_runtime_open(&config, &options, block.data(), bytes, &runtime), POSE_WALL_OK);
  ASSERT_EQ(pose_wall_runtime_start(runtime), POSE_WALL_OK);
  std::int64_t stamp_ns = 0;
  for (const pose_wall::test::Points& points : frames) {
    const pose_wall_cloud cloud = pose_wall::test::cloud_of(points, stamp_ns);
    stamp_ns += 100000000;
    ASSERT_EQ(pose_wall_runtime_push(runtime, &cloud), POSE_WALL_OK);
    ASSERT_EQ(pose_wall_runtime_wait_idle(runtime), POSE_WALL_OK);
  }
  ASSERT_EQ(pose_wall_runtime_stop(runtime), POSE_WALL_OK);
  ASSERT_EQ(pose_wall_runtime_close(runtime), POSE_WALL_OK);
}

// Five frames and an empty one.
void record(const std::string& path, bool clouds = true) {
  Clouds frames;
  for (std::uint32_t i = 0; i < 6; ++i) {
    frames.push_back(i == 3 ? pose_wall::test::Points() : pose_wall::test::room_points(i));
  }
  FileSink sink(path);
  record(frames, FileSink::write, &sink, 64 << 20, clouds);
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
  // The record's bytes are no record any more.
  BoxReplay replay_without_head(std::uint64_t sequence) {
    std::vector<char> bytes = read_all(path_);
    bytes[place_of(sequence)] ^= 1;
    write_all(path_, bytes);
    return replay_box(path_, nullptr);
  }

  TempFolder folder_;
  const std::string path_ = folder_.file("box.pwbox");
};

TEST_F(ReplayBox, TellsTheMotionThatWasRecorded) {
  const std::string with_motion = folder_.file("motion.pwbox"), table = folder_.file("events.csv");
  {
    FileSink sink(with_motion);
    Clouds frames;
    for (std::uint32_t i = 0; i < 4; ++i) frames.push_back(pose_wall::test::ribbed_room_points(i + 1));
    frames.emplace_back();
    record(frames, FileSink::write, &sink, 64 << 20, true, true);
  }
  const Ran ran = command({"replay-box", "--quiet", "--table", table, with_motion});
  EXPECT_EQ(ran.exit_status, 0) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "5 frames with motion: ")) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "1 lost")) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "; travel from 0.000 to ")) << ran.printed;
  std::ifstream stream(table);
  const CsvTable events = CsvTable::parse(stream);
  ASSERT_EQ(events.rows(), 5U);
  const std::size_t state = events.find_column("along_state").value(), along = events.find_column("along_m").value();
  const std::size_t computed = events.find_column("computed").value();
  for (std::size_t row = 0; row < 5; ++row) {
    EXPECT_EQ(events.cell(row, computed), "same");
    EXPECT_EQ(events.cell(row, state) == "lost", row == 4) << events.cell(row, state);
    EXPECT_EQ(events.cell(row, along).empty(), row == 4);
  }
  EXPECT_FALSE(contains(replay(path_).printed, "with motion")) << "of a runtime without";
}

TEST_F(ReplayBox, AGoodBoxComesOutAgain) {
  const Ran ran = replay(path_);
  EXPECT_EQ(ran.exit_status, 0) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "events 6 (0 to 5), frames 6, silences 0")) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "6 bit for bit as recorded, 0 otherwise")) << ran.printed;
}

TEST_F(ReplayBox, AnInterruptEndsItAtTheEventAtWork) {
  const InterruptWatch watch;
  ASSERT_EQ(std::raise(SIGINT), 0);
  const std::string table = folder_.file("events.csv");
  EXPECT_EQ(command({"replay-box", "--quiet", "--table", table, path_}).exit_status, 130);
  std::ifstream stream(table);
  EXPECT_EQ(CsvTable::parse(stream).rows(), 1U) << "of six";
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

// A box of the format before, or of a later one.
TEST_F(ReplayBox, ABoxOfAnotherFormatIsRefusedByName) {
  std::vector<char> bytes = read_all(path_);
  const std::uint32_t format = 2;
  std::memcpy(bytes.data() + 8, &format, sizeof format);
  std::memcpy(bytes.data() + 40, "0.1.9", 6);
  const std::uint32_t crc = crc32(bytes.data(), 4092);
  std::memcpy(bytes.data() + 4092, &crc, sizeof crc);
  write_all(path_, bytes);
  const Ran ran = replay(path_);
  EXPECT_EQ(ran.exit_status, 1);
  EXPECT_TRUE(contains(ran.errors, "recorded by pose_wall 0.1.9 in format 2; this is pose_wall")) << ran.errors;
}

// Another roll in the third record, with all checksums right: as if another engine had published it.
TEST_F(ReplayBox, ADifferenceIsNamedAndHasAStatusOfItsOwn) {
  std::vector<char> bytes = read_all(path_);
  char* const head = bytes.data() + place_of(2);
  std::uint64_t record_bytes = 0;
  std::memcpy(&record_bytes, head + 8, 8);
  const std::size_t at_memento = 192 + (sizeof(pose_wall_inputs) + 63) / 64 * 64;
  const std::size_t at_result = at_memento + (pose_wall_memento_bytes() + 63) / 64 * 64;
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

TEST_F(ReplayBox, AKindThatNobodyKnowsIsRefused) {
  std::vector<char> bytes = read_all(path_);
  char* const head = bytes.data() + place_of(2);
  head[4] = 9;
  const std::uint32_t crc = crc32(head, 60);
  std::memcpy(head + 60, &crc, 4);
  write_all(path_, bytes);
  const BoxReplay result = replay_box(path_, nullptr);
  EXPECT_EQ(result.refused, 1U);
  EXPECT_EQ(result.frames, 5U);
  EXPECT_EQ(replay(path_).exit_status, 1);
}

TEST_F(ReplayBox, LostAtTheBeginningIsAGap) {
  const BoxReplay result = replay_without_head(0);
  EXPECT_EQ(result.missing, 1U);
  EXPECT_GT(result.torn, 0U);
  EXPECT_EQ(replay(path_).exit_status, 1);
}

// The process died before it wrote the head.
TEST_F(ReplayBox, ALastRecordWithoutAHeadIsTold) {
  const BoxReplay result = replay_without_head(5);
  EXPECT_EQ(result.equal, 5U);
  EXPECT_EQ(result.missing, 0U);
  EXPECT_GT(result.torn, 0U);
  EXPECT_EQ(replay(path_).exit_status, 1);
}

// A file in memory that does not forget what was there before.
struct Ring {
  std::vector<char> bytes;
  static std::int32_t write(void* self, std::uint64_t offset, const void* from, std::uint64_t count) {
    std::vector<char>& bytes = static_cast<Ring*>(self)->bytes;
    if (bytes.size() < offset + count) bytes.resize(offset + count);
    std::memcpy(bytes.data() + offset, from, count);
    return 0;
  }
};

constexpr std::uint64_t kRing = 160000;  // bytes: room for a memento and some frames

// Some large, most small: laps end far apart from each other.
Clouds uneven(std::uint32_t seed, std::uint32_t frames) {
  Clouds clouds;
  for (std::uint32_t i = 0; i < frames; ++i) {
    seed = seed * 1664525U + 1013904223U;
    const std::uint32_t points = (seed >> 24U) % 4U == 0 ? (seed >> 8U) % 4000U : (seed >> 8U) % 40U;
    clouds.emplace_back(points, pose_wall::test::Points::value_type{1, 2, 3});
  }
  return clouds;
}

std::uint64_t first_without_a_gap(const std::vector<char>& bytes, std::uint64_t last) {
  std::set<std::uint64_t> there;
  std::uint64_t offset = POSE_WALL_BOX_HEADER_BYTES;
  pose_wall_box_record r;
  while (pose_wall_box_next(bytes.data(), bytes.size(), &offset, &r) == POSE_WALL_OK) there.insert(r.sequence);
  while (last > 0 && there.count(last - 1) > 0) --last;
  return last;
}

class ReplayRing : public ::testing::Test {
 protected:
  BoxReplay replayed(const std::vector<char>& bytes) {
    write_all(path_, bytes);
    return replay_box(path_, nullptr);
  }
  TempFolder folder_;
  const std::string path_ = folder_.file("ring.pwbox");
};

TEST_F(ReplayRing, ASoundOneHasNoGapWhateverTheSizes) {
  std::uint64_t rounds = 0, left_over = 0;
  for (std::uint32_t seed = 0; seed < 24; ++seed) {
    Ring ring;
    const std::uint32_t frames = 10 + 5 * seed;
    record(uneven(seed, frames), Ring::write, &ring, kRing, true);
    const BoxReplay result = replayed(ring.bytes);
    EXPECT_TRUE(result.is_whole() && result.reproduced()) << seed;
    EXPECT_EQ(result.missing, 0U) << seed;
    EXPECT_EQ(result.torn, 0U) << seed;
    EXPECT_EQ(result.damaged, 0U) << seed;
    EXPECT_EQ(result.last_sequence, frames - 1) << seed;
    EXPECT_EQ(result.last_sequence - result.first_sequence + 1 + result.left_over, result.records) << seed;
    EXPECT_EQ(command({"replay-box", "--quiet", path_}).exit_status, 0) << seed;
    EXPECT_EQ(result.first_sequence, first_without_a_gap(ring.bytes, frames - 1)) << seed;
    rounds += result.first_sequence > 0 ? 1 : 0;
    left_over += result.left_over;
  }
  EXPECT_GT(rounds, 10U);
  EXPECT_GT(left_over, 0U) << "else nothing was proved about remnants";
}

// In every record that follows on another one: a bit of the head, of the body, and both sectors gone.
TEST_F(ReplayRing, DamageInTheMiddleIsNoRemnant) {
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    Ring ring;
    record(uneven(seed, 60), Ring::write, &ring, kRing, true);
    const BoxReplay sound = replayed(ring.bytes);
    ASSERT_GT(sound.first_sequence, 0U) << "it came round";
    std::uint64_t offset = POSE_WALL_BOX_HEADER_BYTES;
    pose_wall_box_record r;
    while (pose_wall_box_next(ring.bytes.data(), ring.bytes.size(), &offset, &r) == POSE_WALL_OK) {
      if (r.sequence <= sound.first_sequence) continue;
      for (const std::uint64_t at : {r.offset + 20, r.offset + 1000}) {
        std::vector<char> bad = ring.bytes;
        bad[at] ^= 16;
        const bool is_last = r.sequence == sound.last_sequence;
        const bool is_head = at < r.offset + 64;
        // Of a last one without a head nothing is left that tells it from what the ring had still to overwrite; but a
        // lap begins with a head.
        const bool begins_a_lap = r.offset == POSE_WALL_BOX_HEADER_BYTES;
        EXPECT_EQ(replayed(bad).is_whole(), is_last && is_head && !begins_a_lap)
            << "seed " << seed << ", event " << r.sequence;
      }
    }
  }
}

// A start into the file of another one: the old records count the events of their own run.
TEST_F(ReplayRing, RecordsOfAnEarlierRunAreNotComputed) {
  Ring ring;
  record(uneven(1, 20), Ring::write, &ring, kRing, true);
  const std::uint64_t before = replayed(ring.bytes).records;
  record(uneven(2, 4), Ring::write, &ring, kRing, true);
  const BoxReplay result = replayed(ring.bytes);
  EXPECT_EQ(result.records, 4U);
  EXPECT_EQ(result.last_sequence, 3U);
  EXPECT_EQ(result.missing, 0U);
  EXPECT_GT(result.of_other_runs, 0U);
  EXPECT_LT(result.of_other_runs, before);
  const Ran ran = command({"replay-box", "--quiet", path_});
  EXPECT_EQ(ran.exit_status, 0) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "events 4 (0 to 3)")) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "of another run: not computed")) << ran.printed;
}

// Heads that all claim the rest of the file: the search within them is given up, and that is told.
TEST_F(ReplayRing, ForgedHeadsDoNotHoldItUp) {
  Ring ring;
  record(uneven(1, 2), Ring::write, &ring, kRing, true);
  std::vector<char> bytes = ring.bytes;
  const auto room = [](std::uint64_t count) { return (count + 63) / 64 * 64; };
  const std::uint64_t from = bytes.size(), fixed = 64 + 128 + room(sizeof(pose_wall_inputs)) +
                                                   room(pose_wall_memento_bytes()) + room(sizeof(pose_wall_result)) +
                                                   room(sizeof(pose_wall_motion_result));
  bytes.resize(from + (4 << 20));
  for (std::uint64_t at = from; at + fixed <= bytes.size(); at += 64) {
    std::memcpy(bytes.data() + at, ring.bytes.data() + POSE_WALL_BOX_HEADER_BYTES, 64);
    const std::uint64_t all = bytes.size() - at, cloud = all - fixed;
    std::memcpy(bytes.data() + at + 8, &all, 8);
    std::memcpy(bytes.data() + at + 40, &cloud, 8);
    const std::uint32_t crc = crc32(bytes.data() + at, 60);
    std::memcpy(bytes.data() + at + 60, &crc, 4);
  }
  const BoxReplay result = replayed(bytes);
  EXPECT_EQ(result.equal, 2U);
  EXPECT_LE(result.damaged, 2U) << "not one by one";
  EXPECT_GT(result.not_searched, 0U);
  EXPECT_FALSE(result.is_whole());
}

}  // namespace
}  // namespace pose_wall::tools::test
