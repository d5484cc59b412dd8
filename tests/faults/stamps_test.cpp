// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: for stamps that stand still, go back, leap or lie at the ends of their type, the states of good frames and of
// frames that show nothing are those of the table, and nothing told is wrong. No stamp is refused.

#include <climits>
#include <vector>

#include "fault_room.hpp"

namespace pose_wall::test {
namespace {

constexpr std::int64_t kMs_ns = 1000000, kHour_ns = 3600000000000;

struct StampCase {
  const char* name;
  std::vector<std::int64_t> stamps_ns;
  char good;   // states of the last frame, if it shows the room
  char empty;  // if it shows nothing: what is held then
  std::uint32_t frame_reason;
};

void PrintTo(const StampCase& c, std::ostream* out) {
  *out << c.name;
}

constexpr std::int64_t kAt = 100 * kMs_ns;

const StampCase kStampCases[] = {
    {"goes_on", {0, kAt}, 'V', 'H', 0},
    {"stands_still_once", {0, kAt, kAt}, 'H', 'H', POSE_WALL_R_STAMP_STILL},
    {"stands_still_twice", {0, kAt, kAt, kAt}, 'H', 'H', POSE_WALL_R_STAMP_STILL},
    {"stands_still_three_times", {0, kAt, kAt, kAt, kAt}, 'I', 'I', POSE_WALL_R_STAMP_STILL},
    {"stands_still_from_the_first", {0, 0}, 'I', 'I', POSE_WALL_R_STAMP_STILL},
    {"never_moves", {0, 0, 0, 0, 0, 0}, 'I', 'I', POSE_WALL_R_STAMP_STILL},
    {"goes_on_after_standing_still", {0, kAt, kAt, kAt, kAt, 2 * kAt}, 'V', 'I', 0},
    {"back_by_1_ns", {0, kAt, kAt - 1}, 'V', 'I', POSE_WALL_R_STAMP_BACK},
    {"back_by_a_frame", {0, kAt, 2 * kAt, kAt}, 'V', 'I', POSE_WALL_R_STAMP_BACK},
    {"back_by_an_hour", {0, kAt, kAt - kHour_ns}, 'V', 'I', POSE_WALL_R_STAMP_BACK},
    {"goes_on_after_5_s_back", {0, kAt, kAt - 5000 * kMs_ns, 2 * kAt - 5000 * kMs_ns}, 'V', 'H', 0},
    {"goes_on_after_a_leap", {0, kAt, kHour_ns, kHour_ns + kAt}, 'V', 'H', 0},
    {"ever_back", {0, -kAt, -2 * kAt, -3 * kAt}, 'V', 'I', POSE_WALL_R_STAMP_BACK},
    {"swapped_with_the_next", {0, kAt, 3 * kAt, 2 * kAt, 4 * kAt}, 'V', 'H', 0},
    {"ahead_by_1_ns", {0, kAt, kAt + 1}, 'H', 'H', POSE_WALL_R_STAMP_STILL},
    {"ahead_by_a_millisecond_but_1_ns", {0, kAt, kAt + kMs_ns - 1}, 'H', 'H', POSE_WALL_R_STAMP_STILL},
    {"ahead_by_a_millisecond", {0, kAt, kAt + kMs_ns}, 'V', 'H', 0},
    {"creeps_while_it_stands", {0, kAt, kAt + 1, kAt + 2, kAt + 3}, 'I', 'I', POSE_WALL_R_STAMP_STILL},
    {"ahead_by_stamp_gap_max", {0, 1000 * kMs_ns}, 'V', 'I', 0},
    {"ahead_by_stamp_gap_max_and_1_ns", {0, 1000 * kMs_ns + 1}, 'V', 'I', POSE_WALL_R_STAMP_LEAP},
    {"ahead_by_an_hour", {0, kAt, kHour_ns}, 'V', 'I', POSE_WALL_R_STAMP_LEAP},
    {"to_the_greatest", {0, kAt, INT64_MAX}, 'V', 'I', POSE_WALL_R_STAMP_LEAP},
    {"to_the_least", {0, kAt, INT64_MIN}, 'V', 'I', POSE_WALL_R_STAMP_BACK},
    {"from_the_least_to_the_greatest", {INT64_MIN, INT64_MAX}, 'V', 'I', POSE_WALL_R_STAMP_LEAP},
    {"from_the_greatest_to_the_least", {INT64_MAX, INT64_MIN}, 'V', 'I', POSE_WALL_R_STAMP_BACK},
    {"begins_at_the_least", {INT64_MIN, INT64_MIN + kAt}, 'V', 'H', 0},
    {"ends_at_the_greatest", {INT64_MAX - kAt, INT64_MAX}, 'V', 'H', 0},
    {"stays_at_the_greatest", {INT64_MAX - kAt, INT64_MAX, INT64_MAX}, 'H', 'H', POSE_WALL_R_STAMP_STILL},
    {"microseconds_for_nanoseconds", {0, 100000, 200000, 300000}, 'I', 'I', POSE_WALL_R_STAMP_STILL},
    {"seconds_for_nanoseconds", {1700000000, 1700000000, 1700000000, 1700000000}, 'I', 'I', POSE_WALL_R_STAMP_STILL},
};

class Stamps : public ::testing::TestWithParam<StampCase> {};

TEST_P(Stamps, OfGoodFrames) {
  FaultRoom room;
  pose_wall_result r{};
  int held = 0;
  for (const std::int64_t stamp_ns : GetParam().stamps_ns) {
    r = room.good(stamp_ns);
    held = states_of(r) == "HHHHHHH" ? held + 1 : 0;
    if (held == 0) continue;
    for (const pose_wall_value& v : r.quantity) {
      EXPECT_NEAR(v.age_s, 0.1 * held, 1e-6) << "a frame takes as long as the last one did";
    }
  }
  EXPECT_EQ(states_of(r), std::string(POSE_WALL_QUANTITIES, GetParam().good));
  EXPECT_EQ(r.frame_reasons, GetParam().frame_reason);
  EXPECT_EQ(r.stamp_ns, GetParam().stamps_ns.back());
}

TEST_P(Stamps, OfAFrameThatShowsNothing) {
  FaultRoom room;
  for (std::size_t i = 0; i + 1 < GetParam().stamps_ns.size(); ++i) room.good(GetParam().stamps_ns[i]);
  const pose_wall_result r = room.process(cloud_of(Points(), GetParam().stamps_ns.back()));
  EXPECT_EQ(states_of(r), std::string(POSE_WALL_QUANTITIES, GetParam().empty));
  EXPECT_EQ(r.frame_reasons, GetParam().frame_reason | POSE_WALL_R_NO_POINTS);
}

// Between frames. The contract holds at any time that is asked for, and frames go on as if nobody had asked.
TEST_P(Stamps, AskedForByAge) {
  FaultRoom room;
  pose_wall_result r{};
  r.struct_size = sizeof r;
  room.good(0);
  for (const std::int64_t stamp_ns : GetParam().stamps_ns) {
    ASSERT_EQ(pose_wall_age(room.engine(), stamp_ns, &r), POSE_WALL_OK);
    EXPECT_EQ(room.watch().aged(r), "") << stamp_ns;
    EXPECT_EQ(r.stamp_ns, stamp_ns);
  }
  EXPECT_EQ(states_of(room.good(kPeriod_ns)), "VVVVVVV");
}

INSTANTIATE_TEST_SUITE_P(Faults, Stamps, ::testing::ValuesIn(kStampCases),
                         [](const auto& test) { return name_of(test.param.name); });

}  // namespace
}  // namespace pose_wall::test
