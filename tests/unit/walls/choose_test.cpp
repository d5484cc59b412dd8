// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: out of candidates on four sides the parallel pair with the most evidence is chosen, doubtful or
// crossing ones are refused with the reason, and a rival is named.

#include "engine/walls/choose/choose.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

WallCandidate candidate(double azimuth_rad, double d, double score_m2, std::uint32_t faults = 0) {
  WallCandidate c;
  c.plane.n = Eigen::Vector3d(std::cos(azimuth_rad), std::sin(azimuth_rad), 0.0);
  c.plane.d = d;
  c.evidence.score_m2 = c.evidence.area_m2 = score_m2;
  c.evidence.length_m = 12.0;
  c.failed = faults;
  return c;
}

// Normals point to the machine.
WallCandidate left_wall(double d, double score, double turned = 0.0, std::uint32_t faults = 0) {
  return candidate(-M_PI / 2 + turned, d, score, faults);
}
WallCandidate right_wall(double d, double score, double turned = 0.0, std::uint32_t faults = 0) {
  return candidate(M_PI / 2 + turned, d, score, faults);
}

WallCandidates list(std::initializer_list<WallCandidate> items) {
  WallCandidates l;
  for (const WallCandidate& c : items) l.item[l.count++] = c;
  return l;
}

struct Choice {
  WallCandidates left, right, ahead, behind;
  Settings settings = test::settings_with();
  WallChoice choose() const {
    WallChoice chosen = choose_walls(left, right, settings);
    refuse_if_across(ahead, behind, settings, &chosen);
    return chosen;
  }
};

TEST(WallSelect, TheParallelPairWins) {
  Choice c;
  c.left = list({left_wall(2.5, 20.0), left_wall(2.0, 25.0, 0.6)});
  c.right = list({right_wall(2.5, 20.0)});
  const WallChoice chosen = c.choose();
  EXPECT_EQ(chosen.side[0], &c.left.item[0]) << "not the larger one that is not parallel";
  EXPECT_EQ(chosen.side[1], &c.right.item[0]);
  EXPECT_FALSE(chosen.verdict[0].refused || chosen.verdict[1].refused);
}

TEST(WallSelect, FaultyOnesAreNeverChosenAndSayWhy) {
  Choice c;
  c.left = list({left_wall(2.5, 50.0, 0.0, POSE_WALL_R_WALL_SEEN_THROUGH)});
  c.right = list({right_wall(2.5, 20.0)});
  const WallChoice chosen = c.choose();
  EXPECT_EQ(chosen.side[0], nullptr);
  EXPECT_TRUE(chosen.verdict[0].refused);
  EXPECT_NE(chosen.verdict[0].reasons & POSE_WALL_R_WALL_SEEN_THROUGH, 0U);
  EXPECT_EQ(chosen.side[1], &c.right.item[0]);
}

TEST(WallSelect, TwoThatAreNotParallelCastDoubtOnEachOther) {
  Choice c;
  c.left = list({left_wall(2.5, 20.0)});
  c.right = list({right_wall(2.5, 18.0, 0.6)});
  const WallChoice chosen = c.choose();
  EXPECT_TRUE(chosen.verdict[0].refused && chosen.verdict[1].refused);
  EXPECT_NE(chosen.verdict[0].reasons & POSE_WALL_R_WALLS_NOT_PARALLEL, 0U);
  EXPECT_NE(chosen.verdict[1].reasons & POSE_WALL_R_WALLS_NOT_PARALLEL, 0U);
}

TEST(WallSelect, AMuchWeakerOneCastsNoDoubt) {
  Choice c;
  c.left = list({left_wall(2.5, 20.0)});
  c.right = list({right_wall(2.5, 2.0, 0.6)});
  const WallChoice chosen = c.choose();
  EXPECT_EQ(chosen.side[0], &c.left.item[0]);
  EXPECT_FALSE(chosen.verdict[0].refused);
  EXPECT_TRUE(chosen.verdict[1].refused);
}

// A strong wall on either side, apart by an angle, and beside one of them a weak plane that is parallel to the other.
struct SplayedRoad : Choice {
  static constexpr double kStrong_m2 = 20.0, kWeak_m2 = 3.0;  // far from the half from which a plane is a rival

  SplayedRoad(int splayed_side, double apart_rad) {
    const auto wall = [](int side, double d, double score, double turned) {
      return side == 0 ? left_wall(d, score, turned) : right_wall(d, score, -turned);
    };
    lists[splayed_side] =
        list({wall(splayed_side, 2.5, kStrong_m2, apart_rad), wall(splayed_side, 2.2, kWeak_m2, 0.0)});
    lists[1 - splayed_side] = list({wall(1 - splayed_side, 2.5, kStrong_m2, 0.0)});
    left = lists[0];
    right = lists[1];
  }

 private:
  WallCandidates lists[2];
};

// Beyond what a pair may be apart (wall_parallel_cos: 26 degrees), up to 37.
constexpr double kApart_rad[] = {-0.6, -0.47, 0.47, 0.6};

TEST(WallSelect, AStrongWallThatRunsApartIsTheRivalOfAWeakParallelPlane) {
  for (const int side : {0, 1}) {
    for (const double apart_rad : kApart_rad) {
      const SplayedRoad road(side, apart_rad);
      const WallChoice chosen = road.choose();
      SCOPED_TRACE(::testing::Message() << side << " " << apart_rad);
      const WallCandidates& on_side = side == 0 ? road.left : road.right;
      EXPECT_EQ(chosen.side[side], &on_side.item[1]) << "the parallel one";
      EXPECT_EQ(chosen.rivals[side], 1U << 0) << "so the levels reach to the strong one";
      EXPECT_EQ(chosen.rivals[1 - side], 0U);
    }
  }
}

TEST(WallSelect, ABetterRoadwayAcrossRefusesBoth) {
  Choice c;
  c.left = list({left_wall(6.0, 8.0)});
  c.right = list({right_wall(6.0, 8.0)});
  c.ahead = list({candidate(M_PI, 2.0, 30.0)});
  c.behind = list({candidate(0.0, 2.0, 30.0)});
  const WallChoice chosen = c.choose();
  EXPECT_TRUE(chosen.verdict[0].refused && chosen.verdict[1].refused);
  EXPECT_NE(chosen.verdict[0].reasons & POSE_WALL_R_CROSS_ROAD, 0U);
}

TEST(WallSelect, APairAcrossTellsWhyNothingStandsBeside) {
  Choice c;
  c.ahead = list({candidate(M_PI, 2.0, 30.0)});
  const WallChoice by_one = c.choose();
  EXPECT_EQ((by_one.verdict[0].reasons | by_one.verdict[1].reasons) & POSE_WALL_R_CROSS_ROAD, 0U);
  c.behind = list({candidate(0.0, 2.0, 30.0)});
  const WallChoice by_two = c.choose();
  for (int side = 0; side < 2; ++side) {
    EXPECT_TRUE(by_two.verdict[side].refused);
    EXPECT_NE(by_two.verdict[side].reasons & POSE_WALL_R_WALL_NOT_FOUND, 0U);
    EXPECT_NE(by_two.verdict[side].reasons & POSE_WALL_R_CROSS_ROAD, 0U);
  }
}

TEST(WallSelect, AFaceAloneRefusesNoPair) {
  Choice c;
  c.left = list({left_wall(2.5, 15.0)});
  c.right = list({right_wall(2.5, 15.0)});
  c.ahead = list({candidate(M_PI, 4.0, 40.0)});
  const WallChoice chosen = c.choose();
  EXPECT_FALSE(chosen.verdict[0].refused || chosen.verdict[1].refused);
}

TEST(WallSelect, ARivalNearlyAsGoodIsNamed) {
  Choice c;
  c.left = list({left_wall(2.5, 20.0), left_wall(2.1, 19.0)});
  c.right = list({right_wall(2.5, 20.0)});
  const WallChoice chosen = c.choose();
  EXPECT_EQ(chosen.side[0], &c.left.item[0]);
  EXPECT_EQ(chosen.rivals[0], 1U << 1);
  EXPECT_EQ(chosen.rivals[1], 0U);
}

WallCandidate from_to(WallCandidate c, double from_m, double to_m, double solid_m) {
  c.evidence.along_min_m = from_m;
  c.evidence.along_max_m = to_m;
  c.evidence.length_m = solid_m;
  return c;
}

// With a solid column of three cells in each half metre from here to there.
WallCandidate solid_from_to(WallCandidate c, double from_m, double to_m) {
  c.along_level = Eigen::Vector3d(-c.plane.n.y(), c.plane.n.x(), 0.0);
  for (double along_m = from_m; along_m < to_m; along_m += kWallColumn_m) {
    c.evidence.solid_rows[static_cast<std::uint32_t>(along_m / kWallColumn_m + 0.5 * kWallColumns)] = 3;
  }
  return c;
}

// A wall that is no exact plane has planes through its ends that hold most of its points.
TEST(WallSelect, WhatAPlaneSharesWithTheChosenOneIsNoEvidenceForIt) {
  constexpr double kTurned_rad = 0.035, kCross_m = 4.0;  // within 15 cm from 0 to 8 m
  struct Case {
    double turned_rad, d_m, from_m, to_m;
    bool is_rival;
  };
  const double d_m = 2.5 - kCross_m * kTurned_rad;
  for (const Case& other : {Case{kTurned_rad, d_m, 0.0, 8.0, false}, Case{kTurned_rad, d_m, 0.0, 12.0, false},
                            Case{kTurned_rad, d_m, 0.0, 20.0, true}, Case{kTurned_rad, d_m, -12.0, 8.0, true},
                            Case{0.0, 2.1, 0.0, 8.0, true}, Case{0.0, 2.9, 0.0, 8.0, true}}) {
    Choice c;
    c.left = list({solid_from_to(left_wall(2.5, 20.0), -10.0, 10.0),
                   solid_from_to(left_wall(other.d_m, 19.0, other.turned_rad), other.from_m, other.to_m)});
    c.right = list({right_wall(2.5, 20.0)});
    const WallChoice chosen = c.choose();
    EXPECT_EQ(chosen.side[0], &c.left.item[0]);
    EXPECT_EQ(chosen.rivals[0], other.is_rival ? 1U << 1 : 0U)
        << other.turned_rad << " " << other.d_m << " " << other.from_m << " " << other.to_m;
  }
}

// The end of a crosscut shows more of itself than is left of the wall to both sides of its mouth.
TEST(WallSelect, AWallThatGoesOnBesideWhatItsOpeningShowsIsARival) {
  struct Case {
    double at_m, from_m, to_m, solid_m;
    bool is_rival;
  };
  for (const Case& near :
       {Case{2.0, -9.0, 6.0, 7.0, true}, Case{2.0, -7.5, 4.0, 3.5, true}, Case{2.0, -5.0, 5.0, 10.0, false},
        Case{2.0, -9.0, 6.0, 2.0, false}, Case{12.0, -9.0, 6.0, 7.0, false}}) {
    Choice c;
    c.left = list({from_to(left_wall(15.0, 20.0), -4.0, 4.0, 8.0),
                   from_to(left_wall(near.at_m, 5.0), near.from_m, near.to_m, near.solid_m)});
    c.right = list({from_to(right_wall(2.5, 20.0), -9.0, 9.0, 18.0)});
    const WallChoice chosen = c.choose();
    EXPECT_EQ(chosen.side[0], &c.left.item[0]);
    EXPECT_EQ(chosen.rivals[0], near.is_rival ? 1U << 1 : 0U) << near.from_m << " " << near.solid_m;
  }
}

// Ghosts of a wall, thrown by a wet or shining face, lie behind it in as many cells as there are of them.
TEST(WallSelect, WhatStandsBeforeAWallAndStopsNearlyAllIsARivalHoweverSmall) {
  struct Case {
    double at_m, score_m2, stopped, turned_rad;
    bool is_rival;
  };
  for (const Case& near :
       {Case{1.0, 3.0, 0.9, 0.0, true}, Case{1.0, 3.0, 0.6, 0.0, false}, Case{1.0, 1.5, 0.9, 0.0, false},
        Case{1.0, 3.0, 0.9, 0.2, false}, Case{2.4, 3.0, 0.9, 0.0, false}, Case{4.0, 3.0, 0.9, 0.0, false}}) {
    Choice c;
    c.left = list({left_wall(2.5, 20.0), left_wall(near.at_m, near.score_m2, near.turned_rad)});
    c.left.item[1].evidence.stopped = near.stopped;
    c.right = list({right_wall(2.5, 20.0)});
    const WallChoice chosen = c.choose();
    EXPECT_EQ(chosen.side[0], &c.left.item[0]);
    EXPECT_EQ(chosen.rivals[0], near.is_rival ? 1U << 1 : 0U)
        << near.at_m << " " << near.score_m2 << " " << near.stopped << " " << near.turned_rad;
  }
}

TEST(WallSelect, NothingAnywhere) {
  const WallChoice chosen = Choice().choose();
  for (int side = 0; side < 2; ++side) {
    EXPECT_EQ(chosen.side[side], nullptr);
    EXPECT_TRUE(chosen.verdict[side].refused);
    EXPECT_NE(chosen.verdict[side].reasons & POSE_WALL_R_WALL_NOT_FOUND, 0U);
  }
}

}  // namespace
}  // namespace pose_wall
