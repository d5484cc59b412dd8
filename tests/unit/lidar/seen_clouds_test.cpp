// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a cloud that comes again is known, and as old as its first copy, whatever came in between, as long as fewer
// than kCount others did; one that is new pushes out the oldest; a clock that went back gives an age below zero; no
// stamp overflows. A part of a cloud that comes again is known as well, wherever it lies, from 10 degrees on, and as
// old as its first copy. A scene that stands still under real noise is none, however coarse the steps of its ranges
// are.

#include "lidar/seen_clouds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/math/elementary.hpp"
#include "engine/cloud/direction_grid.hpp"
#include "support/clouds.hpp"

namespace pose_wall {
namespace {

constexpr std::int64_t kSecond_ns = 1000000000;

TEST(SeenClouds, ANewOneIsNoRepeat) {
  SeenClouds seen;
  for (std::uint64_t k = 1; k <= 20; ++k) EXPECT_FALSE(seen.keep(k, 0).is_one) << k;
}

TEST(SeenClouds, IsAsOldAsItsFirstCopy) {
  SeenClouds seen;
  seen.keep(7, kSecond_ns);
  for (int k = 2; k <= 10; ++k) {
    const Repeat repeat = seen.keep(7, k * kSecond_ns);
    EXPECT_TRUE(repeat.is_one);
    EXPECT_DOUBLE_EQ(repeat.age_s, k - 1.0);
  }
}

TEST(SeenClouds, BuffersThatAreHandedOutByTurnsAreKnownAgain) {
  for (std::uint32_t buffers = 1; buffers <= SeenClouds::kCount + 1; ++buffers) {
    SeenClouds seen;
    for (std::uint32_t k = 0; k < 3 * buffers; ++k) {
      const bool known = k >= buffers && buffers <= SeenClouds::kCount;
      EXPECT_EQ(seen.keep(1 + k % buffers, k * kSecond_ns).is_one, known) << buffers << " buffers, frame " << k;
    }
  }
}

TEST(SeenClouds, AClockThatWentBackGivesAnAgeBelowZero) {
  SeenClouds seen;
  seen.keep(7, kSecond_ns);
  EXPECT_LT(seen.keep(7, 0).age_s, 0.0);
  EXPECT_GT(seen.keep(7, INT64_MAX).age_s, 0.0);
  EXPECT_LT(seen.keep(7, INT64_MIN).age_s, 0.0);
}

// A sensor that stands between walls, in a fixed order of rings and columns. Its ranges have noise and steps.
struct Standing {
  int rings, columns;
  double noise_m, step_m, lost;  // lost: share of the packets of 16 columns
  std::mt19937 random{7};

  test::Points next() {
    std::normal_distribution<double> noise(0.0, noise_m);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    test::Points points(static_cast<std::size_t>(rings) * static_cast<std::size_t>(columns), {0.0F, 0.0F, 0.0F});
    bool is_lost = false;
    for (int column = 0; column < columns; ++column) {
      if (column % 16 == 0) is_lost = share(random) < lost;
      for (int ring = 0; ring < rings && !is_lost; ++ring) {
        const double up = -0.26 + 0.52 * ring / (rings - 1), azimuth = 2.0 * kPi * column / columns;
        const double x = std::cos(up) * std::cos(azimuth), y = std::cos(up) * std::sin(azimuth), z = std::sin(up);
        double range_m = std::min(2.5 / std::max(std::fabs(y), 1e-6), 1.3 / std::max(std::fabs(z), 1e-6));
        if (range_m > 40.0) continue;
        range_m = std::round((range_m + noise(random)) / step_m) * step_m;
        points[static_cast<std::size_t>(column * rings + ring)] = {
            static_cast<float>(range_m * x), static_cast<float>(range_m * y), static_cast<float>(range_m * z)};
      }
    }
    return points;
  }
};

// As the engine has them: sectors are half columns of directions.
CloudPrint print_of(const test::Points& points) {
  CloudPrint print;
  for (const auto& p : points) {
    const FourFloats x = all_four(p[0]), y = all_four(p[1]), z = all_four(p[2]), norm2 = x * x + y * y + z * z;
    FourInts half_columns;
    Directions::cells_of(x, y, z, norm2, &half_columns);
    if (norm2[0] > 0.0F) print.add(static_cast<std::uint32_t>(half_columns[0]), words_of({x, y, z})[0]);
  }
  return print;
}

Repeat keep(RepeatGuard* guard, const test::Points& points, std::int64_t stamp_ns) {
  return guard->keep(print_of(points), stamp_ns);
}

Standing standing_vlp16() {
  return {16, 1800, 0.01, 0.002, 0.0, std::mt19937(7)};
}

TEST(RepeatGuard, ARingOfOldCloudsIsKnownWhateverItsLength) {
  for (const std::uint32_t ring : {1U, 2U, 5U, 17U, 64U}) {
    Standing sensor = standing_vlp16();
    RepeatGuard guard;
    std::vector<test::Points> clouds;
    for (std::uint32_t k = 0; k < ring; ++k) clouds.push_back(sensor.next());
    for (std::uint32_t k = 0; k < 2 * ring; ++k) {
      const Repeat repeat = keep(&guard, clouds[k % ring], k * kSecond_ns);
      EXPECT_EQ(repeat.is_one, k >= ring) << ring << " clouds, frame " << k;
      if (repeat.is_one) {
        EXPECT_DOUBLE_EQ(repeat.age_s, ring);
      }
    }
  }
}

// Lost packets whose points the driver leaves as they were.
TEST(RepeatGuard, APartThatStaysOldIsKnownWhereverItLies) {
  for (const int degrees : {10, 20, 45, 90, 180}) {
    for (int from = 0; from < 360; from += degrees == 10 ? 1 : 47) {
      Standing sensor = standing_vlp16();
      RepeatGuard guard;
      const test::Points old = sensor.next();
      EXPECT_FALSE(keep(&guard, old, 0).is_one);
      for (int k = 1; k <= (degrees == 10 ? 1 : 5); ++k) {
        test::Points cloud = sensor.next();
        for (int c = 0; c < 5 * degrees; ++c) {
          const int begin = 16 * ((5 * from + c) % 1800);
          std::copy_n(old.begin() + begin, 16, cloud.begin() + begin);
        }
        const Repeat repeat = keep(&guard, cloud, k * kSecond_ns);
        ASSERT_TRUE(repeat.is_one) << degrees << " degrees from " << from << ", frame " << k;
        EXPECT_DOUBLE_EQ(repeat.age_s, k);
      }
    }
  }
}

// Prints of 32 bits are alike by chance: one sector alone, however full it is, tells nothing.
TEST(RepeatGuard, OneSectorAloneIsNoPart) {
  CloudPrint first, again;
  const auto fill = [](CloudPrint* print, std::uint32_t sector, std::uint32_t seed) {
    for (std::uint32_t k = 0; k < 1000; ++k) print->add(sector, 977U * k + seed);
  };
  for (std::uint32_t s = 0; s < CloudPrint::kSectors; ++s) fill(&first, s, s);
  for (std::uint32_t s = 0; s < CloudPrint::kSectors; ++s) fill(&again, s, s == 255 ? s : s + 5000U);
  RepeatGuard guard;
  guard.keep(first, 0);
  EXPECT_FALSE(guard.keep(again, kSecond_ns).is_one);
  again.clear();
  for (std::uint32_t s = 0; s < CloudPrint::kSectors; ++s) fill(&again, s, s == 255 || s == 0 ? s : s + 9000U);
  EXPECT_TRUE(guard.keep(again, 2 * kSecond_ns).is_one) << "across the first sector";
}

TEST(RepeatGuard, AStandingSceneUnderNoiseIsFresh) {
  for (const double step_m : {0.001, 0.002, 0.005}) {
    for (const double noise_m : {0.003, 0.01}) {
      for (const double lost : {0.0, 0.3}) {
        for (const int rings : {16, 64}) {
          Standing sensor{rings, rings == 16 ? 1800 : 512, noise_m, step_m, lost, std::mt19937(11)};
          RepeatGuard guard;
          for (int k = 0; k < 70; ++k) {
            ASSERT_FALSE(keep(&guard, sensor.next(), k * kSecond_ns).is_one)
                << rings << " rings, steps of " << step_m << ", noise " << noise_m << ", lost " << lost << ", " << k;
          }
        }
      }
    }
  }
}

TEST(RepeatGuard, TooFewReturnsTellNothing) {
  Standing sensor = standing_vlp16();
  test::Points points = sensor.next();
  std::fill(points.begin(), points.end() - 60, std::array<float, 3>{0.0F, 0.0F, 0.0F});
  RepeatGuard guard;
  for (int k = 0; k < 5; ++k) EXPECT_FALSE(keep(&guard, points, k * kSecond_ns).is_one);
}

TEST(RepeatGuard, WhatIsForgottenIsNew) {
  Standing sensor = standing_vlp16();
  const test::Points points = sensor.next();
  RepeatGuard guard;
  keep(&guard, points, 0);
  guard = RepeatGuard{};
  EXPECT_FALSE(keep(&guard, points, kSecond_ns).is_one);
}

// Prints are of the bits of points and not of their order.
TEST(CloudPrint, AnyChangeOfAPointIsAnother) {
  Standing sensor = standing_vlp16();
  test::Points points = sensor.next();
  const CloudPrint first = print_of(points);
  test::Points shuffled = points;
  test::shuffle(&shuffled, 3);
  EXPECT_EQ(print_of(shuffled).whole(), first.whole());
  EXPECT_EQ(print_of(shuffled).returns(), first.returns());
  std::mt19937 random(5);
  for (int trial = 0; trial < 500; ++trial) {
    test::Points other = points;
    auto& point = other[random() % other.size()];
    if (point[0] == 0.0F && point[1] == 0.0F) continue;
    float& number = point[random() % 3];
    number = std::nextafter(number, trial % 2 == 0 ? 100.0F : -100.0F);
    EXPECT_NE(print_of(other).whole(), first.whole());
  }
}

// Sums of changes in opposite ways, of which plain sums show nothing.
TEST(CloudPrint, ChangesOfTwoPointsDoNotCancel) {
  Standing sensor = standing_vlp16();
  test::Points points = sensor.next();
  const CloudPrint first = print_of(points);
  std::mt19937 random(6);
  for (int trial = 0; trial < 1500; ++trial) {
    test::Points other = points;
    const std::size_t at = random() % (other.size() - 16), coordinate = static_cast<std::size_t>(trial) % 3;
    float &one = other[at][coordinate], &next = other[at + 1][coordinate];
    if (one == 0.0F || next == 0.0F) continue;
    if (trial % 2 == 0) {
      std::swap(one, next);
      if (one == next) continue;
    } else {
      one = std::nextafter(one, 100.0F), next = std::nextafter(next, -100.0F);
    }
    EXPECT_NE(print_of(other).whole(), first.whole()) << "trial " << trial;
  }
}

TEST(CloudPrint, WhatIsNotAddedHasNoPart) {
  const FourPlaces four = {{1, 2, 3, 4}, {1, 2, 3, 4}, {1, 2, 3, 4}};
  CloudPrint some, first_two;
  some.add_four(FourInts{5, 5, 7, 9}, words_of(four), first_of_four(2));
  first_two.add(5, words_of(four)[0]);
  first_two.add(5, words_of(four)[1]);
  EXPECT_EQ(some.whole(), first_two.whole());
  EXPECT_EQ(some.returns(), 2U);
  EXPECT_EQ(some.returns(5), 2U);
  EXPECT_EQ(some.returns(7), 0U);
}

}  // namespace
}  // namespace pose_wall
