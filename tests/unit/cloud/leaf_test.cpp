// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: over sequences of clouds that thicken and thin out, the leaf fits whenever one does and soon is the smallest
// that fits. It costs one pass a cloud as long as the clouds stay alike, and no sequence of clouds takes more than
// four.

#include "engine/cloud/leaf.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pose_wall {
namespace {

constexpr double kLeast_m = 0.05;
constexpr std::uint32_t kVoxelsMost = 60000;

// Voxels of a cloud, by the leaf: points that fill lines, 1, surfaces, 2, or space, 3. Above a leaf whose cells' faces
// lie within a wall's noise, half as many.
struct Cloud {
  double voxels_at_least_m;
  double dimension;
  double parted_up_to_m = 1.0;
  double at(double leaf_m) const {
    return voxels_at_least_m * std::pow(kLeast_m / leaf_m, dimension) * (leaf_m > parted_up_to_m ? 0.5 : 1.0);
  }
};

struct Outcome {
  double leaf_m = 0.0;
  bool fits = false;
  int passes = 0;
  LeafMemory memory;
};

Outcome outcome_of(const Cloud& cloud, const LeafMemory& last) {
  Outcome out;
  LeafSearch search(kLeast_m, kVoxelsMost, last);
  std::uint32_t voxels = 0;
  do {
    const double all = cloud.at(search.leaf_m());
    out.fits = all <= kVoxelsMost;
    voxels = static_cast<std::uint32_t>(out.fits ? all : kVoxelsMost);
    ++out.passes;
  } while (search.goes_on(out.fits, voxels) && out.passes < 100);
  EXPECT_LE(out.passes, static_cast<int>(LeafSearch::kPassesMost));
  out.leaf_m = search.leaf_m();
  out.memory = search.memory(out.fits, voxels);
  return out;
}

double smallest_that_fits_m(const Cloud& cloud) {
  double leaf_m = kLeast_m;
  while (leaf_m < 0.26 && cloud.at(leaf_m) > kVoxelsMost) leaf_m = std::min(leaf_m * 1.26, 0.26);
  return leaf_m;
}

// So many growths may be skipped at first, to the middle of those that are left or from there to the largest.
constexpr double kSkipped = 1.27 * 1.27 * 1.27;

TEST(VoxelLeaf, WithoutAPastItFitsAtOnceAndIsSoonTheSmallest) {
  for (const double dimension : {1.0, 2.0, 3.0}) {
    for (double voxels = 1000; voxels < 3e6; voxels *= 1.3) {
      const Cloud cloud{voxels, dimension};
      Outcome out = outcome_of(cloud, {});
      EXPECT_EQ(out.fits, cloud.at(0.26) <= kVoxelsMost) << voxels;
      EXPECT_LE(out.leaf_m, kSkipped * smallest_that_fits_m(cloud));
      for (int frame = 0; frame < 4; ++frame) out = outcome_of(cloud, out.memory);
      EXPECT_EQ(out.leaf_m, smallest_that_fits_m(cloud)) << voxels;
      EXPECT_EQ(outcome_of(cloud, out.memory).passes, 1) << voxels;
    }
  }
}

TEST(VoxelLeaf, AlikeCloudsTakeOnePassEach) {
  constexpr int kFrames = 100;
  for (const double dimension : {1.0, 2.0, 3.0}) {
    for (const double parted_up_to_m : {0.07, 0.09, 0.15, 1.0}) {
      for (double voxels = 1000; voxels < 5e5; voxels *= 1.17) {
        const Cloud cloud{voxels, dimension, parted_up_to_m};
        Outcome last = outcome_of(cloud, {});
        int passes = 0;
        for (int frame = 0; frame < kFrames; ++frame) {
          Cloud wobbling = cloud;
          wobbling.voxels_at_least_m *= 1.0 + 0.01 * std::sin(frame);
          last = outcome_of(wobbling, last.memory);
          passes += last.passes;
        }
        // A wobble may take them past the room, or to where a smaller leaf fits, a few times.
        EXPECT_LE(passes, kFrames + 12) << voxels << " " << dimension << " " << parted_up_to_m;
      }
    }
  }
}

// No larger, at most, than lets the voxels of the smallest that fits be halved, but for what was skipped; after a few
// clouds that are alike, the smallest.
TEST(VoxelLeaf, FollowsCloudsThatThickenAndThinOut) {
  for (const double dimension : {1.0, 2.0, 3.0}) {
    LeafMemory memory;
    for (int frame = 0; frame < 2000; ++frame) {
      const double voxels = 4e4 * std::pow(10.0, 0.8 * std::sin(0.05 * frame) + (frame % 300 < 3 ? 0.7 : 0.0));
      const Cloud cloud{voxels, dimension};
      const Outcome out = outcome_of(cloud, memory);
      const double smallest_m = smallest_that_fits_m(cloud);
      EXPECT_EQ(out.fits, cloud.at(0.26) <= kVoxelsMost) << frame;
      EXPECT_LE(out.leaf_m, std::pow(1.27, 3.0 / dimension) * kSkipped * smallest_m) << dimension << " " << frame;
      EXPECT_GE(out.leaf_m, 0.999 * smallest_m) << frame;
      memory = out.memory;
    }
    const Cloud still{5e4 * std::pow(1.2, dimension), dimension};
    Outcome last = outcome_of(still, memory);
    for (int frame = 0; frame < 5; ++frame) last = outcome_of(still, last.memory);
    EXPECT_EQ(last.leaf_m, smallest_that_fits_m(still)) << dimension;
  }
}

// A memory may come from a file that somebody made up, or from another config.
TEST(VoxelLeaf, AnyMemoryEndsSoon) {
  for (const std::uint32_t begin_with : {1U, 7U, 8U, 20U, 0x80000000U, 0xFFFFFFFFU}) {
    for (const std::uint32_t voxels : {0U, 1U, 30000U, 0xFFFFFFFFU}) {
      for (const double count : {0.0, 1.0, 2e4, 5e4, 1e5, 1e9}) {
        const Outcome out = outcome_of({count, 2.0}, {begin_with, voxels});
        EXPECT_LE(out.passes, 4) << begin_with << " " << voxels << " " << count;
        EXPECT_EQ(out.fits, Cloud({count, 2.0}).at(0.26) <= kVoxelsMost);
        EXPECT_LE(out.memory.begin_with, 8U);
      }
    }
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

// What costs most: isolated points are as many voxels whatever the leaf, so each leaf is tried in vain, or fits and
// promises that a smaller one would, too. As each leaf has other faces, any of them may be the one that fits.
TEST(VoxelLeaf, NoCloudIsReadMoreThanFourTimes) {
  for (const double least_m : {0.01, 0.05, 0.2, 0.26}) {
    for (std::uint32_t begin_with = 0; begin_with < 17; ++begin_with) {
      for (std::uint32_t those_that_fit = 0; those_that_fit < 1U << 16; those_that_fit += 37) {
        LeafSearch search(least_m, kVoxelsMost, {begin_with, LeafMemory::kAnyFewer});
        std::uint32_t passes = 0, growths = 0;
        bool fits = false;
        do {
          growths = 0;
          for (double leaf_m = least_m; leaf_m < 0.999 * search.leaf_m(); leaf_m *= 1.26) ++growths;
          fits = (those_that_fit >> growths & 1U) != 0;
          ++passes;
        } while (search.goes_on(fits, fits ? 7 : kVoxelsMost) && passes < 100);
        ASSERT_LE(passes, LeafSearch::kPassesMost) << least_m << " " << begin_with << " " << those_that_fit;
        ASSERT_TRUE(fits || search.leaf_m() == 0.26) << least_m << " " << begin_with << " " << those_that_fit;
        ASSERT_LT(search.memory(fits, 7).begin_with, 16U);
      }
    }
  }
}

}  // namespace
}  // namespace pose_wall
