// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: over sequences of clouds that thicken and thin out, the leaf fits whenever one does, is hardly larger than
// that of an engine without a past and soon no larger, and costs one pass a cloud as long as the clouds stay alike.

#include "stages/voxel_leaf.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pose_wall {
namespace {

constexpr double kLeast_m = 0.05;
constexpr std::uint32_t kRoom = 60000;

// Voxels of a cloud, by the leaf: points that fill surfaces, 2, or space, 3.
struct Cloud {
  double voxels_at_least_m;
  double dimension;
  double at(double leaf_m) const { return voxels_at_least_m * std::pow(kLeast_m / leaf_m, dimension); }
};

struct Outcome {
  double leaf_m = 0.0;
  bool fits = false;
  int passes = 0;
  LeafMemory memory;
};

Outcome outcome_of(const Cloud& cloud, const LeafMemory& last) {
  Outcome out;
  LeafSearch search(kLeast_m, kRoom, last);
  std::uint32_t voxels = 0;
  do {
    const double all = cloud.at(search.leaf_m());
    out.fits = all <= kRoom;
    voxels = static_cast<std::uint32_t>(out.fits ? all : kRoom);
    ++out.passes;
  } while (search.goes_on(out.fits, voxels) && out.passes < 100);
  out.leaf_m = search.leaf_m();
  out.memory = search.memory(out.fits, voxels);
  EXPECT_EQ(search.has_grown(), out.leaf_m > kLeast_m);
  return out;
}

TEST(VoxelLeaf, WithoutAPastTheSmallestThatFits) {
  for (const double dimension : {1.0, 2.0, 3.0}) {
    for (double voxels = 1000; voxels < 3e6; voxels *= 1.3) {
      const Cloud cloud{voxels, dimension};
      const Outcome out = outcome_of(cloud, {});
      EXPECT_LE(out.leaf_m, 0.26);
      EXPECT_EQ(out.fits, cloud.at(0.26) <= kRoom) << voxels;
      EXPECT_TRUE(out.leaf_m == kLeast_m || cloud.at(out.leaf_m / 1.26) > 0.99 * kRoom || out.leaf_m == 0.26) << voxels;
    }
  }
}

TEST(VoxelLeaf, AlikeCloudsTakeOnePassEach) {
  for (double voxels = 1000; voxels < 5e5; voxels *= 1.17) {
    Outcome last = outcome_of({voxels, 2.0}, {});
    for (int frame = 0; frame < 50; ++frame) {
      const double wobble = 1.0 + 0.01 * std::sin(frame);
      const Outcome next = outcome_of({wobble * voxels, 2.0}, last.memory);
      EXPECT_TRUE(next.fits);
      // A wobble may take it past the room, or past what is tried again, once.
      if (next.leaf_m == last.leaf_m && frame > 10) {
        EXPECT_EQ(next.passes, 1) << voxels << " " << frame;
      }
      last = next;
    }
  }
}

// One leaf larger, at most, than without a past; and after a few clouds that are alike, no larger.
TEST(VoxelLeaf, FollowsCloudsThatThickenAndThinOut) {
  for (const double dimension : {1.0, 2.0, 3.0}) {
    LeafMemory memory;
    for (int frame = 0; frame < 2000; ++frame) {
      const double voxels = 4e4 * std::pow(10.0, 0.8 * std::sin(0.05 * frame) + (frame % 300 < 3 ? 0.7 : 0.0));
      const Cloud cloud{voxels, dimension};
      const Outcome out = outcome_of(cloud, memory), anew = outcome_of(cloud, {});
      EXPECT_EQ(out.fits, anew.fits) << frame;
      // So many fewer that the next smaller would have fitted even in space: 2 = 1.26^3.
      EXPECT_LE(out.leaf_m, std::pow(1.27, 3.0 / dimension) * anew.leaf_m) << dimension << " " << frame;
      EXPECT_GE(out.leaf_m, 0.999 * anew.leaf_m) << frame;
      memory = out.memory;
    }
    const Cloud still{5e4 * std::pow(1.2, dimension), dimension};
    Outcome last = outcome_of(still, memory);
    for (int frame = 0; frame < 5; ++frame) last = outcome_of(still, last.memory);
    EXPECT_EQ(last.leaf_m, outcome_of(still, {}).leaf_m) << dimension;
  }
}

TEST(VoxelLeaf, AfterACloudThatFitsNowhereTheNextIsReadAsItShouldBe) {
  const Outcome spread = outcome_of({1e9, 3.0}, {});
  EXPECT_FALSE(spread.fits);
  const Outcome again = outcome_of({1e9, 3.0}, spread.memory);
  EXPECT_FALSE(again.fits);
  EXPECT_EQ(again.passes, 1);
  const Outcome road = outcome_of({3e4, 2.0}, spread.memory);
  EXPECT_EQ(road.leaf_m, kLeast_m);
  EXPECT_LE(road.passes, 3);
  const Outcome empty = outcome_of({0.0, 2.0}, spread.memory);
  EXPECT_EQ(empty.leaf_m, kLeast_m);
}

}  // namespace
}  // namespace pose_wall
