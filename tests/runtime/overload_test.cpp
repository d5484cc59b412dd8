// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: points are left out only after frames were dropped and the period was still too long, step by step and no
// further than allowed; it does not swing; and what is left out is an even share of every line of a sensor.

#include "runtime/thinning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pose_wall::runtime {
namespace {

constexpr std::int64_t kPeriod = 1000;

void note(Overload* overload, int times, std::int64_t work_ns, bool dropped) {
  for (int i = 0; i < times; ++i) overload->note(overload->thinning(), work_ns, dropped);
}

TEST(Overload, NeverThinsUnlessAllowed) {
  Overload overload(1, kPeriod);
  note(&overload, 1000, 100 * kPeriod, true);
  EXPECT_EQ(overload.thinning(), 1U);
}

TEST(Overload, SlowFramesAloneAreNoOverload) {
  Overload overload(8, kPeriod);
  note(&overload, 1000, 100 * kPeriod, false);
  EXPECT_EQ(overload.thinning(), 1U) << "none was dropped: the sensor is as slow";
}

TEST(Overload, DroppingIsEnoughWithinThePeriod) {
  Overload overload(8, kPeriod);
  note(&overload, 1000, kPeriod, true);
  EXPECT_EQ(overload.thinning(), 1U);
}

TEST(Overload, ThinsInStepsUpToTheLimit) {
  Overload overload(4, kPeriod);
  note(&overload, 2, 5 * kPeriod, true);
  EXPECT_EQ(overload.thinning(), 1U) << "two frames may be chance";
  note(&overload, 1, 5 * kPeriod, true);
  EXPECT_EQ(overload.thinning(), 2U);
  note(&overload, 3, 3 * kPeriod, true);
  EXPECT_EQ(overload.thinning(), 4U);
  note(&overload, 100, 2 * kPeriod, true);
  EXPECT_EQ(overload.thinning(), 4U);
}

TEST(Overload, OneGoodFrameBeginsTheCountAnew) {
  Overload overload(4, kPeriod);
  for (int i = 0; i < 100; ++i) {
    note(&overload, 2, 5 * kPeriod, true);
    note(&overload, 1, kPeriod / 2, true);
  }
  EXPECT_EQ(overload.thinning(), 1U);
}

TEST(Overload, ComesBackWhenThereIsRoomForTwiceThePoints) {
  Overload overload(2, kPeriod);
  note(&overload, 3, 5 * kPeriod, true);
  note(&overload, 1000, kPeriod * 4 / 10, true);
  EXPECT_EQ(overload.thinning(), 2U) << "twice that is 0.8 of the period: too near to it";
  note(&overload, 19, kPeriod * 3 / 10, true);
  EXPECT_EQ(overload.thinning(), 2U);
  note(&overload, 1, kPeriod * 3 / 10, true);
  EXPECT_EQ(overload.thinning(), 1U);
}

TEST(Overload, FramesQueuedBeforeAChangeSayNothing) {
  Overload overload(8, kPeriod);
  note(&overload, 3, 5 * kPeriod, true);
  for (int i = 0; i < 10; ++i) overload.note(1, 5 * kPeriod, true);
  EXPECT_EQ(overload.thinning(), 2U);
}

// Column by column, as spinning sensors deliver: every line keeps its share, to five sigma of the binomial law.
TEST(EvenChoice, EveryLineKeepsItsShare) {
  constexpr std::uint32_t kColumns = 4096;
  for (const std::uint32_t lines : {1U, 16U, 32U, 64U, 89U, 128U, 144U}) {
    for (const std::uint32_t thinning : {1U, 2U, 4U, 8U, 16U}) {
      EvenChoice choice(thinning);
      std::vector<std::uint32_t> kept(lines, 0);
      for (std::uint32_t i = 0; i < lines * kColumns; ++i) kept[i % lines] += choice.takes_next() ? 1U : 0U;
      const double share = 1.0 / thinning, spread = std::sqrt(kColumns * share * (1.0 - share));
      for (const std::uint32_t n : kept)
        EXPECT_NEAR(n, kColumns * share, 5.0 * spread + 0.5) << lines << "/" << thinning;
    }
  }
}

}  // namespace
}  // namespace pose_wall::runtime
