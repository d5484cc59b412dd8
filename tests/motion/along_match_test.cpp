// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: rock that was shifted by a known way is found there; smooth walls, floors that slope or roll, walls that lean
// or bend tell nothing; rock that repeats has a second place, whole pitches away.

#include "motion/along_match.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include "motion/pipeline.hpp"

namespace pose_wall::motion::test {
namespace {

// Rock that comes again nowhere: heights by chance at corners 40 cm apart, smooth between them.
double rock(int face, double u, double v) {
  const auto height = [face](int i, int j) {
    std::uint32_t h = static_cast<std::uint32_t>(i) * 73856093U ^ static_cast<std::uint32_t>(j) * 19349663U ^
                      static_cast<std::uint32_t>(face) * 83492791U;
    for (int k = 0; k < 2; ++k) h = (h ^ (h >> 15)) * 0x2C1B3C6DU;
    return 0.06 * ((h >> 8) / 16777216.0 - 0.5);
  };
  const double a = u / 0.4, b = v / 0.4;
  const int i = static_cast<int>(std::floor(a)), j = static_cast<int>(std::floor(b));
  const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double s = ease(a - i), t = ease(b - j);
  return (1.0 - t) * ((1.0 - s) * height(i, j) + s * height(i + 1, j)) +
         t * ((1.0 - s) * height(i, j + 1) + s * height(i + 1, j + 1));
}

struct SmoothRoad {
  const char* what;
  double (*relief)(int face, double u, double v);
};
constexpr SmoothRoad kAlikeEverywhere[] = {
    {"flat", [](int, double, double) { return 0.0; }},
    {"the floor slopes", [](int face, double u, double) { return face == 5   ? 0.04 * u
                                                                 : face == 4 ? -0.04 * u
                                                                             : 0.0; }},
    {"the floor falls to one side", [](int face, double, double v) { return face == 5 ? 0.06 * v : 0.0; }},
    {"the road bends",
     [](int face, double u, double) {
       return (face == 2 ? 1.0 : face == 3 ? -1.0 : 0.0) * u * u / 200.0;
     }},
    {"the walls lean", [](int face, double, double v) { return face == 2 || face == 3 ? 0.1 * v : 0.0; }},
    {"the roof is an arch", [](int face, double, double v) { return face == 4 ? 0.08 * v * v : 0.0; }},
};
constexpr SmoothRoad kOtherElsewhere[] = {
    {"the floor rolls", [](int face, double u, double) { return face == 5 ? 0.1 * std::sin(u / 3.0) : 0.0; }},
    {"the floor alone slopes", [](int face, double u, double) { return face == 5 ? 0.04 * u : 0.0; }},
    {"both walls close in", [](int face, double u, double) { return face == 2 || face == 3 ? 0.03 * u : 0.0; }},
    {"the left wall bends", [](int face, double u, double) { return face == 2 ? u * u / 120.0 : 0.0; }},
};

// As the odometry takes a curve, but for the refinement that follows there.
bool tells(const Curve& curve) {
  return is_evidence(curve) && !(curve.apart_m > 0.0);
}

class AlongTheRoad : public ::testing::Test {
 protected:
  AlongTheRoad() {
    room_.length_m = 60.0;
    scanner_.noise_m = 0.01;
  }

  void map_road() {
    for (double x = -1.0; x < 1.3; x += 0.2) {
      const Pose at = pose_of(x, 0.0, 0.0, 0.0, 0.0, 0.0);
      pipeline_->see(scan_of(room_, at, scanner_), at);
      ++scanner_.seed;
      pipeline_->take_in(at);
    }
  }
  void map_smooth(const SmoothRoad& road, double noise_m) {
    room_.relief = road.relief;
    scanner_.noise_m = noise_m;
    pipeline_ = std::make_unique<Pipeline>();
    map_road();
  }
  // Of a scan that stands ahead of where it is thought to stand.
  Curve curve_of(double ahead_m) {
    pipeline_->see(scan_of(room_, pose_of(ahead_m, 0.0, 0.0, 0.0, 0.0, 0.0), scanner_), Pose{});
    ++scanner_.seed;
    alignment_ = pipeline_->align(Pose{}, false);
    const Curve curve = match_along(pipeline_->scan(), alignment_, kReachMost_m, kShiftsMost, pipeline_->curve.get());
    return curve;
  }
  // What is told lies within its level of the truth, as the odometry takes it.
  bool is_right(const Curve& curve, double ahead_m) {
    if (!tells(curve)) return true;
    Alignment there = alignment_;
    there.pose.t += curve.best_m * there.axes.along;
    const FinePlace fine = refine_along(pipeline_->scan(), there, pipeline_->curve.get());
    const double level_m = std::max({0.03, 5.0 * fine.sigma_m, curve.around_m});
    return !fine.told || !passes<gate::HALVES>(fine.halves_m) ||
           std::fabs(curve.best_m + fine.best_m - ahead_m) < level_m;
  }

  BoxRoom room_;
  Scanner scanner_;
  std::unique_ptr<Pipeline> pipeline_ = std::make_unique<Pipeline>();
  Alignment alignment_;
};

TEST_F(AlongTheRoad, RoughRockIsFoundWhereItIs) {
  room_.relief = rock;
  map_road();
  for (const double ahead_m : {0.0, 0.013, 0.05, -0.11, 0.2, -0.3}) {
    SCOPED_TRACE(ahead_m);
    const Curve curve = curve_of(ahead_m);
    ASSERT_TRUE(curve.told);
    EXPECT_NEAR(curve.best_m, ahead_m, 0.02);
    EXPECT_TRUE(tells(curve));
    EXPECT_LE(curve.around_m, 0.08);  // three steps
    EXPECT_GT(curve.contrast, 0.5);
    EXPECT_GT(curve.patches, 8.0);
    EXPECT_LT(curve.second_gain, 0.7);
  }
}

TEST_F(AlongTheRoad, ARefinedPlaceIsNearAndKnowsHowNear) {
  scanner_.noise_m = 0.0;
  room_.relief = rock;
  map_road();
  for (const double ahead_m : {0.0, 0.004, -0.01, 0.02}) {
    curve_of(ahead_m);
    const FinePlace fine = refine_along(pipeline_->scan(), alignment_, pipeline_->curve.get());
    ASSERT_TRUE(fine.told) << ahead_m;
    EXPECT_NEAR(fine.best_m, ahead_m, 8e-3);
    EXPECT_GT(fine.sigma_m, 0.0);
    EXPECT_LT(fine.sigma_m, 8e-3);  // with the halves as the tiles' numbers part them
    EXPECT_LE(std::fabs(fine.best_m - ahead_m), 5.0 * fine.sigma_m) << "beyond five of its own deviations";
  }
}

TEST_F(AlongTheRoad, ARefinedPlaceKnowsWhatNoiseLeavesOfIt) {
  room_.relief = rock;
  map_road();
  for (const double ahead_m : {0.0, 0.01, -0.02}) {
    curve_of(ahead_m);
    const FinePlace fine = refine_along(pipeline_->scan(), alignment_, pipeline_->curve.get());
    ASSERT_TRUE(fine.told) << ahead_m;
    EXPECT_LT(fine.sigma_m, 0.02);
    EXPECT_LE(std::fabs(fine.best_m - ahead_m), 5.0 * fine.sigma_m) << ahead_m << " " << fine.best_m;
  }
}

TEST_F(AlongTheRoad, RockBeyondTheReachIsSaidToLieAtTheEdgeOrToTellNothing) {
  room_.relief = rock;
  map_road();
  for (const double ahead_m : {0.5, 0.6, 0.75, 1.0, -0.6, -0.8}) {
    const Curve curve = curve_of(ahead_m);
    EXPECT_FALSE(tells(curve)) << ahead_m << ": " << curve.best_m << " contrast " << curve.contrast << " patches "
                               << curve.patches;
  }
}

// Whatever is shifted along these looks as before once the other five directions are fitted.
TEST_F(AlongTheRoad, SmoothSurfacesTellNothing) {
  for (const SmoothRoad& road : kAlikeEverywhere) {
    SCOPED_TRACE(road.what);
    map_smooth(road, 0.012);
    for (const double ahead_m : {0.0, 0.1}) {
      const Curve curve = curve_of(ahead_m);
      EXPECT_FALSE(tells(curve)) << curve.best_m << " contrast " << curve.contrast << " patches " << curve.patches;
    }
  }
}

// These differ from place to place, by little: what is told of them is right.
TEST_F(AlongTheRoad, SmoothSurfacesThatDifferTellNothingWrong) {
  for (const SmoothRoad& road : kOtherElsewhere) {
    SCOPED_TRACE(road.what);
    map_smooth(road, 0.012);
    for (const double ahead_m : {0.0, 0.1}) {
      const Curve curve = curve_of(ahead_m);
      EXPECT_TRUE(is_right(curve, ahead_m))
          << ahead_m << ": best " << curve.best_m << " contrast " << curve.contrast << " patches " << curve.patches;
    }
  }
}

// A sensor that is better than what the library counts on: a small misfit divided by a smaller one is no contrast.
TEST_F(AlongTheRoad, AnExactSensorIsToldNothingWrongBySmoothSurfaces) {
  for (const double noise_m : {0.003, 0.001}) {
    for (const SmoothRoad& road : kAlikeEverywhere) {
      SCOPED_TRACE(road.what);
      map_smooth(road, noise_m);
      const Curve curve = curve_of(0.1);
      EXPECT_TRUE(is_right(curve, 0.1)) << noise_m << ": best " << curve.best_m << " contrast " << curve.contrast
                                        << " patches " << curve.patches;
    }
  }
}

TEST_F(AlongTheRoad, RockThatRepeatsHasASecondPlaceWholePitchesAway) {
  constexpr double kPitch_m = 0.3;
  room_.relief = [](int face, double u, double v) {
    return face < 2 ? 0.0 : 0.02 * std::sin(2.0 * M_PI * u / kPitch_m + face + 0.7 * v);
  };
  map_road();
  for (const double ahead_m : {0.0, 0.05}) {
    const Curve curve = curve_of(ahead_m);
    ASSERT_TRUE(curve.told);
    EXPECT_GT(curve.second_gain, 0.7);
    EXPECT_GT(std::fabs(curve.second_m), 0.5 * kPitch_m);
    EXPECT_NEAR(std::remainder(curve.second_m, kPitch_m), 0.0, 0.04);
    const double rest = std::remainder(curve.best_m - ahead_m, kPitch_m);
    EXPECT_NEAR(rest, 0.0, 6e-3) << "at one of them";
  }
}

// One prop stands out of smooth walls: one patch's word is no evidence.
TEST_F(AlongTheRoad, OneThingIsNoEvidence) {
  room_.relief = [](int face, double u, double v) {
    return face == 2 && std::fabs(u - 2.05) < 0.08 && v > -1.0 ? 0.15 : 0.0;
  };
  map_road();
  const Curve curve = curve_of(0.0);
  EXPECT_FALSE(tells(curve)) << "contrast " << curve.contrast << " patches " << curve.patches;
}

TEST_F(AlongTheRoad, AnEmptyMapDrawsNoCurve) {
  const Curve curve = curve_of(0.0);
  EXPECT_FALSE(curve.told);
  EXPECT_FALSE(refine_along(pipeline_->scan(), alignment_, pipeline_->curve.get()).told);
}

}  // namespace
}  // namespace pose_wall::motion::test
