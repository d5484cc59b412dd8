// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: calls out of order, twice, in between or with the wrong bytes are refused or mean what the header says.

#include <vector>

#include "fault_room.hpp"
#include "support/moments.hpp"

namespace pose_wall::test {
namespace {

using Bytes = std::vector<unsigned char>;

pose_wall_result empty_result() {
  pose_wall_result r{};
  r.struct_size = sizeof r;
  return r;
}

// A block that an engine may be opened in.
struct Site {
  explicit Site(Dirt dirt = Dirt::kRandom) : config(small_config()), block(bytes_of(config), dirt) {}

  std::int32_t open() { return pose_wall_open(&config, block.data(), block.size(), &engine); }
  std::int32_t process(std::int64_t stamp_ns) {
    const pose_wall_cloud cloud = cloud_of(room_frame(frame++), stamp_ns);
    return pose_wall_process(engine, &cloud, &result);
  }
  std::string states_after(std::int64_t stamp_ns) {
    return process(stamp_ns) == POSE_WALL_OK ? states_of(result) : "refused";
  }
  Bytes saved() const {
    Bytes memento(pose_wall_memento_bytes());
    EXPECT_EQ(pose_wall_save(engine, nullptr, memento.data(), memento.size()), POSE_WALL_OK);
    return memento;
  }
  std::int32_t load(const Bytes& memento) {
    return pose_wall_load(engine, &pose_wall::test::kSameClock, memento.data(), memento.size());
  }

  static std::uint64_t bytes_of(const pose_wall_config& config) {
    std::uint64_t bytes = 0;
    EXPECT_EQ(pose_wall_memory_needed(&config, &bytes), POSE_WALL_OK);
    return bytes;
  }

  pose_wall_config config;
  AlignedBlock block;
  pose_wall_engine* engine = nullptr;
  pose_wall_result result = empty_result();
  std::uint32_t frame = 0;
};

// Blocks in which nothing was opened, by what they hold.
class NotOpened : public ::testing::TestWithParam<Dirt> {};

TEST_P(NotOpened, EveryCallIsRefused) {
  Site site(GetParam());
  site.engine = static_cast<pose_wall_engine*>(site.block.data());
  Bytes memento(pose_wall_memento_bytes());
  pose_wall_points points;
  pose_wall_image image{};
  image.struct_size = sizeof image;
  EXPECT_EQ(site.process(0), POSE_WALL_E_ENGINE);
  EXPECT_EQ(pose_wall_age(site.engine, 0, &site.result), POSE_WALL_E_ENGINE);
  EXPECT_EQ(pose_wall_reset(site.engine), POSE_WALL_E_ENGINE);
  EXPECT_EQ(pose_wall_set_clock(site.engine, nullptr, nullptr), POSE_WALL_E_ENGINE);
  EXPECT_EQ(pose_wall_save(site.engine, nullptr, memento.data(), memento.size()), POSE_WALL_E_ENGINE);
  EXPECT_EQ(site.load(memento), POSE_WALL_E_ENGINE);
  EXPECT_EQ(pose_wall_last_points(site.engine, &points), POSE_WALL_E_ENGINE);
  EXPECT_EQ(pose_wall_image_fill(&site.result, &image), POSE_WALL_E_RESULT);
}

INSTANTIATE_TEST_SUITE_P(Faults, NotOpened, ::testing::Values(Dirt::kZeros, Dirt::kOnes, Dirt::kRandom),
                         [](const auto& test) {
                           return test.param == Dirt::kZeros ? "zeros"
                                                             : (test.param == Dirt::kOnes ? "ones" : "random");
                         });

TEST(CallFaults, AgeBeforeTheFirstFrame) {
  FaultRoom room;
  pose_wall_result r = empty_result();
  ASSERT_EQ(pose_wall_age(room.engine(), 0, &r), POSE_WALL_OK);
  EXPECT_EQ(room.watch().aged(r), "");
  EXPECT_EQ(states_of(r), "IIIIIII");
  for (const pose_wall_value& v : r.quantity) EXPECT_NE(v.reasons & POSE_WALL_R_NEVER_MEASURED, 0U);
  EXPECT_EQ(states_of(room.good(0)), "VVVVVVV");
}

TEST(CallFaults, LastPointsBeforeTheFirstFrame) {
  FaultRoom room;
  pose_wall_points points;
  ASSERT_EQ(pose_wall_last_points(room.engine(), &points), POSE_WALL_OK);
  EXPECT_EQ(points.count, 0U);
}

TEST(CallFaults, LastPointsAfterAnEmptyFrame) {
  FaultRoom room;
  room.good(0);
  room.process(cloud_of(Points(), kPeriod_ns));
  pose_wall_points points;
  ASSERT_EQ(pose_wall_last_points(room.engine(), &points), POSE_WALL_OK);
  EXPECT_EQ(points.count, 0U);
}

TEST(CallFaults, LastPointsAfterAReset) {
  FaultRoom room;
  room.good(0);
  ASSERT_EQ(pose_wall_reset(room.engine()), POSE_WALL_OK);
  pose_wall_points points;
  ASSERT_EQ(pose_wall_last_points(room.engine(), &points), POSE_WALL_OK);
  EXPECT_EQ(points.count, 0U);
}

TEST(CallFaults, ResetForgetsAll) {
  FaultRoom room;
  room.good(0);
  ASSERT_EQ(pose_wall_reset(room.engine()), POSE_WALL_OK);
  room.watch().forget();
  const pose_wall_result r = room.process(cloud_of(Points(), kPeriod_ns));
  EXPECT_EQ(states_of(r), "IIIIIII");
  EXPECT_EQ(r.frame_index, 0U);
}

TEST(CallFaults, ResetTwiceIsResetOnce) {
  FaultRoom room;
  room.good(0);
  EXPECT_EQ(pose_wall_reset(room.engine()), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_reset(room.engine()), POSE_WALL_OK);
  room.watch().forget();
  EXPECT_EQ(states_of(room.good(-5 * kPeriod_ns)), "VVVVVVV") << "no stamp is remembered";
}

TEST(CallFaults, AgeAfterAReset) {
  FaultRoom room;
  room.good(0);
  (void)pose_wall_reset(room.engine());
  pose_wall_result r = empty_result();
  ASSERT_EQ(pose_wall_age(room.engine(), 0, &r), POSE_WALL_OK);
  EXPECT_EQ(states_of(r), "IIIIIII");
}

TEST(CallFaults, OpenedTwiceIsOpenedAfresh) {
  Site site;
  ASSERT_EQ(site.open(), POSE_WALL_OK);
  EXPECT_EQ(site.states_after(0), "VVVVVVV");
  ASSERT_EQ(site.open(), POSE_WALL_OK);
  EXPECT_EQ(site.states_after(-kPeriod_ns), "VVVVVVV");
  EXPECT_EQ(site.result.frame_index, 0U);
}

TEST(CallFaults, ARefusedOpenLeavesTheEngineThatIsThere) {
  Site site;
  ASSERT_EQ(site.open(), POSE_WALL_OK);
  site.process(0);
  set(&site.config, "s_front", -3.0);
  EXPECT_EQ(site.open(), POSE_WALL_E_CONFIG_RULE);
  EXPECT_EQ(site.states_after(kPeriod_ns), "VVVVVVV");
  EXPECT_EQ(site.result.frame_index, 1U);
}

TEST(CallFaults, OpenedWithOtherSettingsOnTheSameBlock) {
  Site site;
  ASSERT_EQ(site.open(), POSE_WALL_OK);
  site.process(0);
  set(&site.config, "points_max", 5000.0);
  set(&site.config, "voxel_leaf", 0.10);
  ASSERT_EQ(site.open(), POSE_WALL_OK);
  EXPECT_TRUE(matches(site.states_after(0), "..LLLLL")) << states_of(site.result);
  EXPECT_EQ(misleading(site.result, kRoomTruth), "");
}

TEST(CallFaults, TheBlockHoldsGarbageAgain) {
  Site site;
  ASSERT_EQ(site.open(), POSE_WALL_OK);
  site.process(0);
  std::memset(site.block.data(), 0xA5, static_cast<std::size_t>(site.block.size()));
  EXPECT_EQ(site.process(kPeriod_ns), POSE_WALL_E_ENGINE);
}

TEST(CallFaults, TheBlockWasClearedBehindTheEngine) {
  Site site;
  ASSERT_EQ(site.open(), POSE_WALL_OK);
  site.process(0);
  // The far half of a block is scratch: who clears it between frames does no harm.
  unsigned char* const half = static_cast<unsigned char*>(site.block.data()) + site.block.size() / 2;
  std::memset(half, 0, static_cast<std::size_t>(site.block.size() / 2));
  EXPECT_EQ(site.states_after(kPeriod_ns), "VVVVVVV");
}

TEST(CallFaults, ConfigChangedAfterOpen) {
  Site site;
  ASSERT_EQ(site.open(), POSE_WALL_OK);
  std::memset(&site.config, 0xFF, sizeof site.config);
  EXPECT_EQ(site.states_after(0), "VVVVVVV") << "the config was copied";
}

TEST(CallFaults, CloudBytesChangedAfterTheCall) {
  FaultRoom room;
  Points points = room_frame(0);
  const pose_wall_result before = room.process(cloud_of(points, 0));
  std::fill(points.begin(), points.end(), std::array<float, 3>{9, 9, 9});
  pose_wall_result r = empty_result();
  ASSERT_EQ(pose_wall_age(room.engine(), 0, &r), POSE_WALL_OK);
  EXPECT_EQ(r.quantity[POSE_WALL_D_LF].value, before.quantity[POSE_WALL_D_LF].value) << "nothing is kept of a cloud";
}

TEST(CallFaults, AClockThatStandsStillOrGoesBack) {
  FaultRoom room;
  std::int64_t now_ns = 0;
  const auto back = [](void* now) { return *static_cast<std::int64_t*>(now) -= 5; };
  const auto still = [](void* now) { return *static_cast<std::int64_t*>(now); };
  ASSERT_EQ(pose_wall_set_clock(room.engine(), back, &now_ns), POSE_WALL_OK);
  EXPECT_EQ(states_of(room.good(0)), "VVVVVVV");
  ASSERT_EQ(pose_wall_set_clock(room.engine(), still, &now_ns), POSE_WALL_OK);
  const pose_wall_result r = room.good(kPeriod_ns);
  EXPECT_EQ(states_of(r), "VVVVVVV");
  for (const std::int64_t stage_ns : r.stage_ns) EXPECT_EQ(stage_ns, 0);
}

TEST(CallFaults, ResultUsedForTheNextCallAsItIs) {
  FaultRoom room;
  pose_wall_result r = empty_result();
  for (std::uint32_t i = 0; i < 3; ++i) {
    const pose_wall_cloud cloud = cloud_of(room_frame(i), i * kPeriod_ns);
    ASSERT_EQ(pose_wall_process(room.engine(), &cloud, &r), POSE_WALL_OK);
    EXPECT_EQ(room.watch().processed(r), "");
  }
}

TEST(CallFaults, AnImageOfAResultThatNobodyFilled) {
  FaultRoom room;
  const pose_wall_result r = empty_result();
  pose_wall_image image{};
  image.struct_size = sizeof image;
  EXPECT_EQ(pose_wall_image_fill(&r, &image), POSE_WALL_E_RESULT);
  EXPECT_NE(pose_wall_image_check(&image), POSE_WALL_OK) << "nothing was written";
}

TEST(CallFaults, AnImageThatWasNeverFilled) {
  pose_wall_image image{};
  EXPECT_NE(pose_wall_image_check(&image), POSE_WALL_OK);
}

// What load is given: the saved bytes, spoilt.
struct Memento {
  const char* name;
  std::int32_t status;
  void (*spoil)(Bytes*);
};

void PrintTo(const Memento& m, std::ostream* out) {
  *out << m.name;
}

const Memento kMementos[] = {
    {"as_saved", POSE_WALL_OK, [](Bytes*) {}},
    {"with_more_behind", POSE_WALL_OK, [](Bytes* m) { m->push_back(7); }},
    {"one_byte_short", POSE_WALL_E_MEMENTO, [](Bytes* m) { m->pop_back(); }},
    {"of_no_bytes", POSE_WALL_E_MEMENTO, [](Bytes* m) { m->resize(0), m->reserve(1); }},
    {"all_zeros", POSE_WALL_E_MEMENTO, [](Bytes* m) { std::fill(m->begin(), m->end(), std::uint8_t{0}); }},
    {"all_ones", POSE_WALL_E_MEMENTO, [](Bytes* m) { std::fill(m->begin(), m->end(), std::uint8_t{0xFF}); }},
    {"of_another_version", POSE_WALL_E_MEMENTO, [](Bytes* m) { ++m->front(); }},
    {"with_another_sum", POSE_WALL_E_MEMENTO, [](Bytes* m) { ++(*m)[8]; }},
    {"with_the_first_byte_changed", POSE_WALL_E_MEMENTO, [](Bytes* m) { (*m)[16] ^= 1; }},
    {"with_the_last_byte_changed", POSE_WALL_E_MEMENTO, [](Bytes* m) { m->back() ^= 0x80; }},
    {"moved_by_a_word", POSE_WALL_E_MEMENTO, [](Bytes* m) { std::rotate(m->begin() + 16, m->begin() + 24, m->end()); }},
    {"backwards", POSE_WALL_E_MEMENTO, [](Bytes* m) { std::reverse(m->begin(), m->end()); }},
};

class Mementos : public ::testing::TestWithParam<Memento> {};

TEST_P(Mementos, AreTakenWholeOrNotAtAll) {
  Site from, to;
  ASSERT_EQ(from.open(), POSE_WALL_OK);
  ASSERT_EQ(to.open(), POSE_WALL_OK);
  from.process(0);
  Bytes memento = from.saved();
  GetParam().spoil(&memento);
  EXPECT_EQ(to.load(memento), GetParam().status);
  const bool taken = GetParam().status == POSE_WALL_OK;
  ASSERT_EQ(pose_wall_age(to.engine, kPeriod_ns, &to.result), POSE_WALL_OK);
  EXPECT_EQ(states_of(to.result), taken ? "HHHHHHH" : "IIIIIII");
}

INSTANTIATE_TEST_SUITE_P(Faults, Mementos, ::testing::ValuesIn(kMementos),
                         [](const auto& test) { return name_of(test.param.name); });

}  // namespace
}  // namespace pose_wall::test
