// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// States what cannot be known: a road that is mirrored or a little scaled is a road. In a sequence the jump gives it
// away (degraded, and the level reaches to both); from the first frame on nothing does.

#include <array>

#include "fault_room.hpp"

namespace pose_wall::test {
namespace {

using Point = std::array<float, 3>;

void scale(Points* points, float factor) {
  for (Point& p : *points) {
    for (float& c : p) c *= factor;
  }
}
void mirror(Points* points, std::size_t k) {
  for (Point& p : *points) p[k] = -p[k];
}
// From the first frame on. What these clouds show is a road, and the engine measures it: no cloud can tell that its
// axes are mirrored, its units wrong by a little or its sensor turned by half a turn. A wrong extrinsic is as
// invisible; check-config shows the axes that were configured.
struct Undetectable {
  const char* name;
  double distance_m[2];  // what is measured, left and right
  void (*spoil)(Points*);
};

void PrintTo(const Undetectable& c, std::ostream* out) {
  *out << c.name;
}

const Undetectable kUndetectable[] = {
    {"x_mirrored", {2.0, 3.0}, [](auto* p) { mirror(p, 0); }},
    {"y_mirrored", {3.0, 2.0}, [](auto* p) { mirror(p, 1); }},
    {"z_mirrored", {2.0, 3.0}, [](auto* p) { mirror(p, 2); }},
    {"x_and_y_mirrored", {3.0, 2.0}, [](auto* p) { mirror(p, 0), mirror(p, 1); }},
    {"scaled_by_a_fifth_more", {2.4, 3.6}, [](auto* p) { scale(p, 1.2F); }},
};

// The room with the machine half a metre left of its middle.
Points room_left_of_the_middle(std::uint32_t seed) {
  return room_points(seed, 0.5);
}

class UndetectableFaults : public ::testing::TestWithParam<Undetectable> {};

TEST_P(UndetectableFaults, FromTheFirstFrameOnAreARoad) {
  FaultRoom room;
  Points points = room_left_of_the_middle(0);
  GetParam().spoil(&points);
  const pose_wall_result r = room.process(cloud_of(points, 0));
  const double* const d = GetParam().distance_m;
  const double truth[POSE_WALL_QUANTITIES] = {0.0, 0.0, 0.0, d[0], d[0], d[1], d[1]};
  EXPECT_TRUE(matches(states_of(r), "L")) << states_of(r);
  EXPECT_EQ(misleading(r, truth), "");
}

TEST_P(UndetectableFaults, InASequenceTheJumpIsDoubted) {
  FaultRoom room;
  room.process(cloud_of(room_left_of_the_middle(0), 0));
  Points points = room_left_of_the_middle(1);
  GetParam().spoil(&points);
  const pose_wall_result r = room.process(cloud_of(points, kPeriod_ns));
  for (std::uint32_t q = POSE_WALL_D_LF; q < POSE_WALL_QUANTITIES; ++q) {
    const double was_m = q <= POSE_WALL_D_LB ? 2.0 : 3.0, is_m = GetParam().distance_m[q <= POSE_WALL_D_LB ? 0 : 1];
    if (std::fabs(was_m - is_m) < 0.3) continue;  // no jump
    EXPECT_EQ(r.quantity[q].state, std::uint32_t{POSE_WALL_DEGRADED});
    EXPECT_NE(r.quantity[q].reasons & POSE_WALL_R_INNOVATION, 0U);
    EXPECT_LE(std::fabs(r.quantity[q].value - was_m), r.quantity[q].protection_level);
    EXPECT_LE(std::fabs(r.quantity[q].value - is_m), r.quantity[q].protection_level);
  }
}

INSTANTIATE_TEST_SUITE_P(Faults, UndetectableFaults, ::testing::ValuesIn(kUndetectable),
                         [](const auto& test) { return name_of(test.param.name); });

}  // namespace
}  // namespace pose_wall::test
