// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what the black box holds computes to the same bits again, frame by frame, in any order, also after the ring
// came round; cut off at any byte it still gives all whole records; any flipped bit is found; a slow disk stops
// nothing but the record, and is counted. Records of another run are told apart and not computed; forged heads
// cost no more than a pass. What the machine gave with its frames: inputs_test.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <map>
#include <set>
#include <thread>
#include <vector>

#include "base/math/crc32.hpp"
#include "base/math/fnv1a.hpp"
#include "pose_wall_box.h"
#include "runtime/box_layout.hpp"
#include "support/engine_under_test.hpp"
#include "support/record.hpp"
#include "support/runtime_under_test.hpp"

namespace pose_wall::test {
namespace {

using Bytes = Record;

// A disk in memory, with a gate before it. One that breaks is in tests/faults/runtime_faults_test.cpp.
struct Disk {
  Bytes bytes;
  Gate gate;

  static std::int32_t write(void* self, std::uint64_t offset, const void* from, std::uint64_t count) {
    Disk& disk = *static_cast<Disk*>(self);
    disk.gate.pass();
    return write_record(&disk.bytes, offset, from, count);
  }
};

RuntimeUnderTest::Change onto(Disk* disk, std::uint64_t box_bytes, bool clouds = true) {
  return [=](pose_wall_runtime_options* o) {
    o->sink = Disk::write;
    o->sink_user = disk;
    o->box_bytes = box_bytes;
    o->box_clouds = clouds ? 1 : 0;
  };
}

struct Found {
  std::map<std::uint64_t, pose_wall_box_record> whole;  // by sequence
  std::size_t damaged = 0;
  std::uint64_t passed_over = 0;
};

Found read(const Bytes& bytes) {
  Found found;
  std::uint64_t offset = POSE_WALL_BOX_HEADER_BYTES;
  pose_wall_box_record record;
  while (pose_wall_box_next(bytes.data(), bytes.size(), &offset, &record) == POSE_WALL_OK) {
    found.passed_over += record.passed_over;
    if (record.damaged != 0) {
      ++found.damaged;
    } else {
      EXPECT_TRUE(found.whole.emplace(record.sequence, record).second) << "twice: " << record.sequence;
    }
  }
  found.passed_over += record.passed_over;
  return found;
}

// Frames, a silence, a bad cloud of garbage, a gap; few points, so that bits can be flipped one by one where `small`.
RuntimeUnderTest::Publications record(RuntimeUnderTest* runtime, int frames, bool small) {
  runtime->start();
  for (int i = 0; i < frames; ++i) {
    const Points points = small || i % 5 == 4 ? Points(static_cast<std::size_t>(i) % 3, {1, 2, 3})
                                              : room_points(static_cast<std::uint32_t>(i));
    runtime->push(points, i * 100 * kMs);
    runtime->wait_idle();
    if (i % 4 == 2) runtime->pass(400 * kMs);
  }
  EXPECT_EQ(pose_wall_runtime_stop(runtime->get()), POSE_WALL_OK);
  return runtime->published();
}

void expect_computes_to(const pose_wall_box_record& record, const pose_wall_publication& published,
                        EngineUnderTest* engine) {
  pose_wall_result again{};
  again.struct_size = sizeof again;
  ASSERT_EQ(pose_wall_box_compute(&record, engine->get(), &again), POSE_WALL_OK);
  EXPECT_EQ(std::memcmp(&again, record.result, sizeof again), 0) << "event " << record.sequence;
  EXPECT_EQ(std::memcmp(&published.result, record.result, sizeof again), 0) << "event " << record.sequence;
  EXPECT_EQ(record.received_ns, published.received_ns);
}

TEST(Box, EveryEventComputesToTheSameBits) {
  Disk disk;
  RuntimeUnderTest runtime(onto(&disk, 64 << 20));
  const auto published = record(&runtime, 12, false);
  pose_wall_box_info info;
  ASSERT_EQ(pose_wall_box_open(disk.bytes.data(), disk.bytes.size(), &info), POSE_WALL_OK);
  EXPECT_STREQ(info.version, pose_wall_version());
  const Found found = read(disk.bytes);
  ASSERT_EQ(found.whole.size(), published.size());
  EXPECT_EQ(found.damaged, 0U);
  EXPECT_EQ(found.passed_over, 0U);
  EngineUnderTest engine(info.config);
  for (auto it = found.whole.rbegin(); it != found.whole.rend(); ++it) {
    expect_computes_to(it->second, published[it->first], &engine);
  }
  EXPECT_EQ(runtime.statistics().box_written, published.size());
  EXPECT_EQ(runtime.statistics().box_bytes_written, disk.bytes.size());
}

TEST(Box, TheNewestRemainWhenTheRingComesRound) {
  Disk disk;
  const std::uint64_t room_for_few = 3 << 20;
  RuntimeUnderTest runtime(onto(&disk, room_for_few));
  const auto published = record(&runtime, 40, false);
  EXPECT_LE(disk.bytes.size(), room_for_few);
  const Found found = read(disk.bytes);
  ASSERT_GE(found.whole.size(), 5U);
  ASSERT_LT(found.whole.size(), published.size());
  EXPECT_EQ(found.whole.rbegin()->first, published.size() - 1);
  // At the ring's end a small record of an earlier lap may remain, where a larger one had no room.
  std::size_t in_a_row = 0;
  while (found.whole.count(published.size() - 1 - in_a_row) != 0) ++in_a_row;
  EXPECT_GE(in_a_row, 5U);
  EXPECT_LE(found.whole.size() - in_a_row, 1U);
  EngineUnderTest engine(small_config());
  for (const auto& [sequence, record] : found.whole) expect_computes_to(record, published[sequence], &engine);
}

TEST(Box, CutOffAnywhereAllWholeRecordsRemain) {
  Disk disk;
  RuntimeUnderTest runtime(onto(&disk, 4 << 20));
  record(&runtime, 4, true);
  std::vector<std::uint64_t> ends;
  for (const auto& [sequence, record] : read(disk.bytes).whole) ends.push_back(record.offset);
  ends.push_back(disk.bytes.size());
  ends.erase(ends.begin());
  ASSERT_EQ(ends.size(), 5U) << "four frames and a silence";
  pose_wall_box_info info;
  for (std::size_t size = 0; size <= disk.bytes.size(); ++size) {
    const Bytes cut(disk.bytes.begin(), disk.bytes.begin() + static_cast<std::ptrdiff_t>(size));
    const std::int32_t expected = size < POSE_WALL_BOX_HEADER_BYTES ? int{POSE_WALL_BOX_E_FORMAT} : int{POSE_WALL_OK};
    ASSERT_EQ(pose_wall_box_open(cut.data(), cut.size(), &info), cut.data() == nullptr ? POSE_WALL_E_NULL : expected);
    if (size < POSE_WALL_BOX_HEADER_BYTES) continue;
    const auto whole = std::count_if(ends.begin(), ends.end(), [&](std::uint64_t end) { return end <= size; });
    const Found found = read(cut);
    ASSERT_EQ(found.whole.size(), static_cast<std::size_t>(whole)) << size << " bytes";
    const bool at_an_end = size == POSE_WALL_BOX_HEADER_BYTES || std::count(ends.begin(), ends.end(), size) > 0;
    ASSERT_EQ(found.damaged + found.passed_over == 0, at_an_end) << size << " bytes";
  }
}

TEST(Box, EveryFlippedBitIsFound) {
  Disk disk;
  RuntimeUnderTest runtime(onto(&disk, 4 << 20));
  record(&runtime, 2, true);
  const std::size_t all = read(disk.bytes).whole.size();
  ASSERT_EQ(all, 2U);
  pose_wall_box_info info;
  for (std::size_t bit = 0; bit < 8 * disk.bytes.size(); ++bit) {
    Bytes bad = disk.bytes;
    bad[bit / 8] = static_cast<unsigned char>(bad[bit / 8] ^ (1U << bit % 8));
    if (bit / 8 < POSE_WALL_BOX_HEADER_BYTES) {
      ASSERT_NE(pose_wall_box_open(bad.data(), bad.size(), &info), POSE_WALL_OK) << "bit " << bit;
      continue;
    }
    const Found found = read(bad);
    ASSERT_EQ(found.whole.size(), all - 1) << "bit " << bit;
    ASSERT_GT(found.damaged + found.passed_over, 0U) << "bit " << bit;
  }
}

TEST(Box, ASlowDiskLosesRecordsAndNothingElse) {
  Disk disk;
  RuntimeUnderTest runtime(onto(&disk, 4 << 20));
  disk.gate.shut();
  runtime.start();
  const Points few(3, {1, 1, 1});
  constexpr std::uint64_t kFrames = 20;
  for (std::uint64_t i = 0; i < kFrames; ++i) {
    runtime.push(few, static_cast<std::int64_t>(i));
    while (runtime.statistics().processed <= i) std::this_thread::yield();
  }
  pose_wall_runtime_statistics s = runtime.statistics();
  EXPECT_EQ(s.processed, kFrames);
  EXPECT_EQ(dropped(s), 0U);
  EXPECT_EQ(s.box_lost, kFrames - 2) << "two wait for the disk";
  disk.gate.open();
  EXPECT_EQ(pose_wall_runtime_stop(runtime.get()), POSE_WALL_OK);
  s = runtime.statistics();
  EXPECT_EQ(s.box_written, 2U) << "stop waits for what is due";
  EXPECT_EQ(read(disk.bytes).whole.size(), 2U);
}

TEST(Box, DigestsAloneAreSmallAndSaySo) {
  Disk disk;
  RuntimeUnderTest runtime(onto(&disk, 4 << 20, false));
  const Points room = room_points(1);
  runtime.start();
  runtime.push(room, 5);
  runtime.wait_idle();
  runtime.stop();
  EXPECT_LT(disk.bytes.size(), 20000U);
  const Found found = read(disk.bytes);
  ASSERT_EQ(found.whole.size(), 1U);
  const pose_wall_box_record& r = found.whole.at(0);
  EXPECT_EQ(r.points, nullptr);
  EXPECT_EQ(r.digest, fnv1a(room.data(), 12 * room.size()));
  EngineUnderTest engine(small_config());
  pose_wall_result result{};
  result.struct_size = sizeof result;
  EXPECT_EQ(pose_wall_box_compute(&r, engine.get(), &result), POSE_WALL_BOX_E_EMPTY);
}

void mend_record(unsigned char* head) {
  using namespace runtime;
  const auto bytes = get<std::uint64_t>(head + kAtRecordBytes);
  put(crc32(head + kHeadBytes, bytes - kHeadBytes), head + kAtBodyCrc);
  put(crc32(head, kAtHeadCrc), head + kAtHeadCrc);
}

std::vector<pose_wall_box_record> all_records(const Bytes& bytes) {
  std::vector<pose_wall_box_record> records;
  std::uint64_t offset = POSE_WALL_BOX_HEADER_BYTES;
  pose_wall_box_record record;
  while (pose_wall_box_next(bytes.data(), bytes.size(), &offset, &record) == POSE_WALL_OK) records.push_back(record);
  return records;
}

void expect_the_old_ones_apart(const Bytes& bytes, std::size_t of_the_new_run, std::size_t in_all) {
  const auto records = all_records(bytes);
  ASSERT_EQ(records.size(), in_all);
  EngineUnderTest engine(small_config());
  pose_wall_result result{};
  result.struct_size = sizeof result;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const bool is_new = i < of_the_new_run;
    const std::int32_t computed = is_new ? std::int32_t{POSE_WALL_OK} : std::int32_t{POSE_WALL_BOX_E_RUN};
    EXPECT_EQ(records[i].damaged, is_new ? POSE_WALL_BOX_WHOLE : POSE_WALL_BOX_OTHER_RUN) << i;
    EXPECT_EQ(pose_wall_box_compute(&records[i], engine.get(), &result), computed) << i;
    EXPECT_NE(records[i].result, nullptr) << "as it was published";
  }
}

void start_work_stop(RuntimeUnderTest* runtime, int frames) {
  runtime->start();
  for (int i = 0; i < frames; ++i) {
    runtime->push(Points(3, {1, 2, 3}), i * 100 * kMs);
    runtime->wait_idle();
  }
  runtime->stop();
}

TEST(Box, RecordsOfAnEarlierStartAreToldApart) {
  Disk disk;
  RuntimeUnderTest runtime(onto(&disk, 4 << 20));
  start_work_stop(&runtime, 5);
  expect_the_old_ones_apart(disk.bytes, 5, 5);
  start_work_stop(&runtime, 2);
  expect_the_old_ones_apart(disk.bytes, 2, 5);
}

// The number of the run may come out the same by chance: the config's sum tells them apart as well.
TEST(Box, RecordsOfAnotherConfigAreToldApart) {
  using namespace runtime;
  Disk disk;
  RuntimeUnderTest first(onto(&disk, 4 << 20));
  record(&first, 2, true);
  Bytes bytes = disk.bytes;
  pose_wall_config other = small_config();
  ASSERT_EQ(pose_wall_config_set_number(&other, "range_max", 17.0), POSE_WALL_OK);
  std::uint32_t crc = 0;
  ASSERT_EQ(pose_wall_config_crc(&other, &crc), POSE_WALL_OK);
  std::memcpy(bytes.data() + kAtConfig, &other, sizeof other);
  put(crc, bytes.data() + kAtHeaderConfigCrc);
  put(crc32(bytes.data(), kAtHeaderCrc), bytes.data() + kAtHeaderCrc);
  pose_wall_box_info info;
  ASSERT_EQ(pose_wall_box_open(bytes.data(), bytes.size(), &info), POSE_WALL_OK);
  expect_the_old_ones_apart(bytes, 0, 2);
}

TEST(Box, AKindThatNobodyKnowsIsNoFrame) {
  using namespace runtime;
  Disk disk;
  RuntimeUnderTest runtime(onto(&disk, 4 << 20));
  record(&runtime, 1, true);
  EngineUnderTest engine(small_config());
  pose_wall_result result{};
  result.struct_size = sizeof result;
  for (const std::uint32_t kind : {0U, 3U, 0x80000001U}) {
    put(kind, disk.bytes.data() + POSE_WALL_BOX_HEADER_BYTES + kAtKind);
    mend_record(disk.bytes.data() + POSE_WALL_BOX_HEADER_BYTES);
    const Found found = read(disk.bytes);
    ASSERT_EQ(found.whole.size(), 1U);
    EXPECT_EQ(pose_wall_box_compute(&found.whole.at(0), engine.get(), &result), POSE_WALL_BOX_E_KIND) << kind;
  }
}

// A head that claims all bytes from itself to the file's end, with sizes that fit each other.
void forge_head(Bytes* bytes, std::uint64_t at) {
  using namespace runtime;
  unsigned char* const head = bytes->data() + at;
  put(kRecordSync, head + kAtSync);
  put<std::uint32_t>(POSE_WALL_BOX_FRAME, head + kAtKind);
  put<std::uint64_t>(bytes->size() - at, head + kAtRecordBytes);
  put<std::uint64_t>(bytes->size() - at - kHeadBytes - body_without_cloud(), head + kAtCloudBytes);
  put(crc32(head, kAtHeadCrc), head + kAtHeadCrc);
}

// Each forged head makes the reader sum what it claims. That they are passed over at once, not one by one, is what
// bounds the sums; and it is told.
TEST(Box, ForgedHeadsAreNotSummedEachToTheEnd) {
  Bytes bytes(4 << 20);
  const std::uint64_t last = bytes.size() - runtime::kHeadBytes - runtime::body_without_cloud();
  for (std::uint64_t at = POSE_WALL_BOX_HEADER_BYTES; at <= last; at += 64) forge_head(&bytes, at);
  std::uint64_t offset = POSE_WALL_BOX_HEADER_BYTES;
  pose_wall_box_record record;
  ASSERT_EQ(pose_wall_box_next(bytes.data(), bytes.size(), &offset, &record), POSE_WALL_OK);
  EXPECT_EQ(record.damaged, POSE_WALL_BOX_OVERLAPPED);
  EXPECT_EQ(offset, bytes.size());
  EXPECT_EQ(pose_wall_box_next(bytes.data(), bytes.size(), &offset, &record), POSE_WALL_BOX_E_END);
}

// The disk kept an old head and lost the record that was written over it, but not the next ones.
TEST(Box, WhatADamagedRecordOverlapsIsToldAndCanBeFound) {
  Disk disk;
  RuntimeUnderTest runtime(onto(&disk, 4 << 20));
  record(&runtime, 3, true);
  const auto good = all_records(disk.bytes);
  ASSERT_GE(good.size(), 3U);
  forge_head(&disk.bytes, good[0].offset);
  std::uint64_t offset = POSE_WALL_BOX_HEADER_BYTES;
  pose_wall_box_record record;
  ASSERT_EQ(pose_wall_box_next(disk.bytes.data(), disk.bytes.size(), &offset, &record), POSE_WALL_OK);
  EXPECT_EQ(record.damaged, POSE_WALL_BOX_OVERLAPPED);
  EXPECT_EQ(offset, disk.bytes.size());
  offset = record.offset + 64;
  ASSERT_EQ(pose_wall_box_next(disk.bytes.data(), disk.bytes.size(), &offset, &record), POSE_WALL_OK);
  EXPECT_EQ(record.offset, good[1].offset);
  EXPECT_EQ(record.damaged, POSE_WALL_BOX_WHOLE);
}

TEST(Box, HeadsSayTheLap) {
  Disk disk;
  RuntimeUnderTest runtime(onto(&disk, 500000));
  runtime.start();
  std::vector<std::uint16_t> laps;
  for (int i = 0; i < 40; ++i) {
    runtime.push(Points(8000, {1, 2, 3}), i * 100 * kMs);
    runtime.wait_idle();
    laps.push_back(runtime::get<std::uint16_t>(disk.bytes.data() + POSE_WALL_BOX_HEADER_BYTES + runtime::kAtLap));
  }
  EXPECT_EQ(laps.front(), 0U);
  EXPECT_TRUE(std::is_sorted(laps.begin(), laps.end()));
  EXPECT_EQ(std::set<std::uint16_t>(laps.begin(), laps.end()).size(), laps.back() + 1U) << "none is left out";
  EXPECT_GT(laps.back(), 5U);
}

// The reader's own word for it: known answers of both sums.
TEST(Box, Checksums) {
  EXPECT_EQ(crc32("123456789", 9), 0xCBF43926U);
  EXPECT_EQ(fnv1a("a", 1), 0xAF63DC4C8601EC8CULL);
}

}  // namespace
}  // namespace pose_wall::test
