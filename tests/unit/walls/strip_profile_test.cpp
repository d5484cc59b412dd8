// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: strips of several depths, widths and pitches stand out of rough rock, with their step, and rough rock without
// strips, ledges, steps and one or two things at the wall are no strips; what was found near is told apart
// further out. Residuals come from the true plane. Does not prove
// it where the plane is off, see walls_strips_test, nor that the two edges of wide bulges are no strips.

#include "engine/walls/fit/strip_profile.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "support/rock.hpp"

namespace pose_wall {
namespace {

using test::Noise;
using test::Rock;

constexpr double kLow_m = -1.15, kHigh_m = 1.1, kReach_m = 4.0, kGate_m = 0.2, kProfile_m = 32.0;

struct SteelSets {
  double depth_m, width_m, pitch_m;
  bool at(double u) const { return std::fabs(u - pitch_m * std::round(u / pitch_m)) < 0.5 * width_m; }
};

using Surface = std::function<double(double u, double v)>;

// The plane is upright: v is the height.
void add(StripProfile* profile, double u, double v, double r) {
  const auto four = [](double x) { return all_four(static_cast<float>(x)); };
  profile->add(four(u), four(v), four(r), four(v), FourTruths{-1, 0, 0, 0});
}

// A point every 2.5 cm along and 7 cm up.
void fill(StripProfile* profile, double from_m, double to_m, Noise* noise, const Surface& surface) {
  for (double u = from_m; u < to_m; u += 0.025) {
    for (double v = kLow_m + 0.02; v < kHigh_m; v += 0.07) add(profile, u, v, surface(u, v) + noise->normal(0.01));
  }
}

bool find(StripProfile* profile, Noise* noise, const Surface& surface, double length_m = 2.0 * kReach_m) {
  profile->begin(-kProfile_m, kLow_m, kHigh_m);
  fill(profile, -0.5 * length_m, 0.5 * length_m, noise, surface);
  return profile->find(PlaneOver{}, 0.0, kReach_m, kGate_m);
}

Surface with_strips(const Rock& rock, const SteelSets& strips) {
  return [&rock, strips](double u, double v) { return strips.at(u) ? strips.depth_m : rock.at(u, v); };
}

struct Verdicts {
  int right = 0, wrong = 0;
  void add(bool correct) { ++(correct ? right : wrong); }
  double share() const { return static_cast<double>(right) / (right + wrong); }
};

// At the middles of the strips and half way between them, within the reach.
Verdicts judged(const StripProfile& profile, const SteelSets& strips, double from_m, double to_m) {
  Verdicts out;
  for (double u = strips.pitch_m * std::ceil(from_m / strips.pitch_m); u + strips.pitch_m < to_m; u += strips.pitch_m) {
    out.add(profile.is_strip(u) && profile.surface_probability(u) < 0.5);
    const double between = u + 0.5 * strips.pitch_m;
    out.add(!profile.is_strip(between) && profile.surface_probability(between) > 0.5);
  }
  return out;
}

TEST(StripProfile, FindsStripsInRoughRock) {
  test::Placed<StripProfile> profile;
  const SteelSets all[] = {{0.10, 0.15, 1.0}, {0.15, 0.15, 0.8}, {0.15, 0.25, 1.2}, {0.12, 0.20, 1.5}};
  for (const SteelSets& strips : all) {
    int found = 0;
    Verdicts verdicts;
    constexpr int kSeeds = 20;
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
      Noise noise(seed);
      const Rock rock(0.03, 0.3, &noise);
      if (!find(profile.get(), &noise, with_strips(rock, strips))) continue;
      ++found;
      // Columns that a strip's edge cuts stand out by a part of its depth, in the narrow ones every second.
      EXPECT_GT(profile->layers().step_m, 0.4 * strips.depth_m) << strips.depth_m;
      EXPECT_LT(profile->layers().step_m, 1.2 * strips.depth_m) << strips.depth_m;
      const Verdicts here = judged(*profile, strips, -3.5, 3.5);
      verdicts.right += here.right;
      verdicts.wrong += here.wrong;
    }
    EXPECT_GE(found, kSeeds - 1) << strips.depth_m << " " << strips.pitch_m;
    EXPECT_GE(verdicts.share(), 0.95) << strips.depth_m << " " << strips.pitch_m;
  }
}

TEST(StripProfile, RoughRockHasNone) {
  test::Placed<StripProfile> profile;
  for (const double sigma_m : {0.0, 0.02, 0.05}) {
    for (const double length_m : {0.1, 0.2, 0.4, 1.0}) {
      int found = 0;
      for (std::uint32_t seed = 1; seed <= 30; ++seed) {
        Noise noise(seed);
        const Rock rock(sigma_m, length_m, &noise);
        found += find(profile.get(), &noise, [&](double u, double v) { return rock.at(u, v); }) ? 1 : 0;
      }
      EXPECT_LE(found, 1) << sigma_m << " m over " << length_m << " m";
    }
  }
}

TEST(StripProfile, OtherThingsAreNoStrips) {
  test::Placed<StripProfile> profile;
  const Surface things[] = {
      [](double u, double) { return std::fabs(u) < 0.08 ? 0.15 : 0.0; },                   // a single one
      [](double u, double) { return std::fabs(std::fabs(u) - 1.0) < 0.08 ? 0.15 : 0.0; },  // two
      [](double, double v) { return std::fabs(v) < 0.1 ? 0.15 : 0.0; },                    // a pipe along the wall
      [](double u, double) { return u > 0.3 ? 0.15 : 0.0; },                               // a step
      [](double u, double) { return 0.02 * u; },                                           // a plane that is off
      // Niches: the other way round.
      [](double u, double) {
        return SteelSets{0.15, 0.15, 1.0}.at(u) ? -0.15 : 0.0;
      },
  };
  int thing = 0;
  for (const Surface& surface : things) {
    Noise noise(7);
    EXPECT_FALSE(find(profile.get(), &noise, surface)) << "thing " << thing;
    ++thing;
  }
}

// One ring of a lidar, or a few: nothing tells that a strip goes on up and down.
TEST(StripProfile, ColumnsSeenAtFewHeightsSayNothing) {
  test::Placed<StripProfile> profile;
  const SteelSets strips{0.15, 0.15, 1.0};
  for (const int rings : {1, 3, 8}) {
    profile->begin(-kProfile_m, kLow_m, kHigh_m);
    for (double u = -kReach_m; u < kReach_m; u += 0.01) {
      for (int ring = 0; ring < rings; ++ring) {
        add(profile.get(), u, -1.0 + 0.25 * ring, strips.at(u) ? strips.depth_m : 0.0);
      }
    }
    EXPECT_EQ(profile->find(PlaneOver{}, 0.0, kReach_m, kGate_m), rings == 8) << rings;
  }
}

TEST(StripProfile, TellsThemApartFurtherOut) {
  test::Placed<StripProfile> profile;
  const SteelSets strips{0.15, 0.15, 1.0};
  Noise noise(3);
  const Rock rock(0.03, 0.3, &noise);
  const Surface surface = with_strips(rock, strips);
  ASSERT_TRUE(find(profile.get(), &noise, surface, 40.0));
  EXPECT_EQ(profile->surface_probability(9.5), 0.0) << "nothing is known there yet";
  EXPECT_FALSE(profile->is_strip(10.0));
  const double near_before = profile->surface_probability(0.5);
  EXPECT_NEAR(profile->judge(PlaneOver{}, 0.0, 12.0), 1.0 - kReach_m / 12.0, 0.02) << "points lie evenly";
  EXPECT_GE(judged(*profile, strips, 4.0, 11.5).share(), 0.9);
  EXPECT_GE(judged(*profile, strips, -11.5, -4.0).share(), 0.9);
  EXPECT_EQ(profile->surface_probability(0.5), near_before) << "what was judged stays";
  EXPECT_EQ(profile->surface_probability(15.5), 0.0) << "out of the second reach";
  EXPECT_EQ(profile->judge(PlaneOver{}, 0.0, 12.0), 0.0) << "there is nothing new";
}

// Points are looked at once; from another plane the columns' means are told by the points' own.
TEST(StripProfile, SeenFromAnotherPlaneAsIfThePointsWereItsOwn) {
  test::Placed<StripProfile> own, other;
  const PlaneOver over{0.3, 0.05, -0.1};
  const double foreshortening = over.foreshortening();
  const SteelSets strips{0.12, 0.15, 1.0};
  Noise noise(6);
  const Rock rock(0.03, 0.3, &noise);
  for (StripProfile* profile : {own.get(), other.get()}) profile->begin(-kProfile_m, kLow_m, kHigh_m);
  for (double u = -20.0; u < 20.0; u += 0.025) {
    for (double v = kLow_m + 0.02; v < kHigh_m; v += 0.07) {
      const double residual = strips.at(u) ? strips.depth_m : rock.at(u, v);
      add(own.get(), u, v, residual);
      add(other.get(), u, v, residual / foreshortening + over.offset_m + over.slope_u * u + over.slope_v * v);
    }
  }
  ASSERT_TRUE(own->find(PlaneOver{}, 0.0, kReach_m, kGate_m));
  ASSERT_TRUE(other->find(over, 0.0, kReach_m, kGate_m));
  ASSERT_GT(own->judge(PlaneOver{}, 0.0, 12.0), 0.0);
  ASSERT_GT(other->judge(over, 0.0, 12.0), 0.0);
  EXPECT_NEAR(other->layers().step_m, own->layers().step_m, 1e-4);
  for (double u = -11.5; u < 11.5; u += 0.05) {
    EXPECT_NEAR(other->surface_probability(u), own->surface_probability(u), 0.02) << u;
  }
}

TEST(StripProfile, HarmlessOutsideAndEmpty) {
  test::Placed<StripProfile> profile;
  profile->begin(-kProfile_m, kLow_m, kHigh_m);
  EXPECT_FALSE(profile->find(PlaneOver{}, 0.0, kReach_m, kGate_m));
  for (const double wild : {-1e30, -33.0, 33.0, 1e30, std::nan("")}) {
    add(profile.get(), wild, 0.0, 0.1);
    add(profile.get(), 0.0, wild, 0.1);
    EXPECT_FALSE(profile->is_strip(wild));
    EXPECT_EQ(profile->surface_probability(wild), 0.0);
  }
  EXPECT_FALSE(profile->find(PlaneOver{}, 0.0, 1e3, kGate_m));
  EXPECT_EQ(profile->surface_probability(0.0), 0.0);
}

TEST(StripProfile, FourColumnsAreThoseOfEach) {
  test::Placed<StripProfile> profile;
  Noise noise(4);
  const Rock rock(0.03, 0.3, &noise);
  ASSERT_TRUE(find(profile.get(), &noise, with_strips(rock, SteelSets{0.15, 0.15, 1.0})));
  int strips = 0;
  for (float u = -33.0F; u < 33.5F; u += 0.013F) {
    const FourFloats four{u, u + 0.3F, -u, u + 40.0F};
    const StripProfile::FourColumns columns = profile->columns_of(four);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      const auto place = static_cast<double>(four[lane]);
      // At a column's border the sum of floats may fall to the other side.
      if (std::fabs(20.0 * place - std::round(20.0 * place)) < 1e-3) continue;
      EXPECT_EQ(static_cast<double>(columns.surface_probability[lane]), profile->surface_probability(place)) << place;
      EXPECT_EQ(columns.is_strip[lane] != 0, profile->is_strip(place)) << place;
      strips += columns.is_strip[lane] != 0 ? 1 : 0;
    }
  }
  EXPECT_GT(strips, 100);
}

// What is told of a column is the least of what was found of it and of the two to each side.
TEST(StripProfile, AStripReachesTwoColumnsToEachSide) {
  for (const double reach_m : {kReach_m, kProfile_m + 5.0}) {  // beyond both ends of the profile, too
    test::Placed<StripProfile> profile;
    Noise noise(4);
    const Rock rock(0.03, 0.3, &noise);
    ASSERT_TRUE(find(profile.get(), &noise, with_strips(rock, SteelSets{0.15, 0.15, 1.0})));
    profile->judge(PlaneOver{}, 0.0, reach_m);
    const auto middle_of = [](int column) { return (column + 0.5) / 20.0; };
    int flanks = 0, clear = 0;
    for (int column = -76; column < 76; ++column) {
      const double shown = profile->surface_probability(middle_of(column));
      bool near_a_strip = false;
      for (int away = -2; away <= 2; ++away) near_a_strip |= profile->is_strip(middle_of(column + away));
      EXPECT_EQ(shown < 0.2, near_a_strip) << middle_of(column);
      flanks += near_a_strip && !profile->is_strip(middle_of(column)) ? 1 : 0;
      clear += near_a_strip ? 0 : 1;
    }
    EXPECT_GT(flanks, 10);
    EXPECT_GT(clear, 40);
  }
}

TEST(StripProfile, FourPointsCountAsEachByItself) {
  test::Placed<StripProfile> one, four;
  for (auto* profile : {one.get(), four.get()}) profile->begin(-kProfile_m, kLow_m, kHigh_m);
  Noise noise(5);
  const Rock rock(0.03, 0.3, &noise);
  const Surface surface = with_strips(rock, SteelSets{0.15, 0.15, 1.0});
  for (int i = 0; i < 8000; ++i) {
    FourFloats u{}, v{}, r{};
    const auto lanes = static_cast<std::uint32_t>(1 + i % 4);  // the others must not count
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      const double at_u = noise.uniform(-kReach_m, kReach_m), at_v = noise.uniform(kLow_m, kHigh_m);
      const double residual = surface(at_u, at_v);
      u[lane] = static_cast<float>(at_u);
      v[lane] = static_cast<float>(at_v);
      r[lane] = static_cast<float>(residual);
      if (lane < lanes) add(one.get(), static_cast<double>(u[lane]), static_cast<double>(v[lane]), residual);
    }
    four->add(u, v, r, v, first_of_four(lanes));
  }
  ASSERT_TRUE(one->find(PlaneOver{}, 0.0, kReach_m, kGate_m));
  ASSERT_TRUE(four->find(PlaneOver{}, 0.0, kReach_m, kGate_m));
  EXPECT_EQ(four->layers().step_m, one->layers().step_m);
  for (double u = -kReach_m; u < kReach_m; u += 0.05) {
    EXPECT_EQ(four->surface_probability(u), one->surface_probability(u)) << u;
  }
}

}  // namespace
}  // namespace pose_wall
