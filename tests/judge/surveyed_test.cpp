// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: on smooth rock the judge's two truths are one. On rock as rough as in a blasted gallery the simulator's
// surveyor, who knows nothing of the road's planes, finds the same ones as the judge's. What the engine calls valid
// there is not wrong by both truths.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "judge/court.hpp"
#include "judge/surveyed.hpp"
#include "judge/tally.hpp"
#include "lab/sim/survey_truth.hpp"

namespace pose_wall::judge {
namespace {

namespace sim = tools::sim;

// The judge's rock for the simulator's surveyor.
class RockOfRoad final : public sim::RockSurface {
 public:
  explicit RockOfRoad(const Road& road) : road_(road) {}
  sim::Hit trace(const sim::Ray& ray, double t_max_m) const override {
    double nearest_m = t_max_m;
    for (const Panel& panel : road_.panels) nearest_m = panel.hit_m({ray.origin, ray.direction}, nearest_m);
    if (nearest_m >= t_max_m) return {};
    return {nearest_m, 1.0, sim::Label::kFace, 0};
  }

 private:
  const Road& road_;
};

struct Place {
  Place(std::uint64_t seed, Furnishing furnishing) : road(draw_road(seed, furnishing)) {
    Draw draw(seed);
    machine = draw_machine(road, Hung::kUpright, &draw);
    pose = draw_stance(road, false, &draw).pose(road, machine);
  }
  Road road;
  Machine machine;
  Pose pose;
};

TEST(SurveyedTruth, OfSmoothRockIsTheRoads) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Place place(seed, Furnishing::kQuiet);
    const Truth road = truth_of(place.road, place.machine, place.pose);
    const Truth surveyed = surveyed_truth(place.road, place.machine, place.pose);
    for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      EXPECT_NEAR(surveyed.low[q], road.low[q], 1e-3) << "road " << seed << ", " << q;
      EXPECT_NEAR(surveyed.high[q], road.high[q], 1e-3) << "road " << seed << ", " << q;
    }
  }
}

// Two estimators of one definition: they begin apart and weigh alike, so where rock has a plane they agree. One in
// twenty places may be at an opening, where a half of the wall leads to one plane and the other half to another.
TEST(SurveyedTruth, IsThatOfTheSimulatorsSurveyor) {
  int places = 0, apart = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Place place(seed, Furnishing::kRich);
    sim::Machine machine;
    const char* const axes[] = {"+X", "-X", "+Y", "-Y"};
    for (int k = 0; k < 4; ++k) machine.forward_axis = place.machine.forward_axis == axes[k] ? k : machine.forward_axis;
    machine.s_front_m = place.machine.s_front_m, machine.s_back_m = place.machine.s_back_m;
    if (place.machine.offset_left_m != 0.0 || place.machine.offset_right_m != 0.0) continue;
    const auto other = sim::survey_truth(RockOfRoad(place.road), {place.pose.turn, place.pose.position_m}, machine);
    const Truth own = surveyed_truth(place.road, place.machine, place.pose);
    for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      if (q == POSE_WALL_YAW || !std::isfinite(own.low[q]) || !std::isfinite(other.value[q])) continue;
      ++places;
      const double allowed = q < POSE_WALL_YAW ? 0.0035 : 0.02;  // a fifth of the alert limits
      const bool is_apart = std::abs(own.low[q] - other.value[q]) > allowed;
      if (is_apart)
        std::printf("road %llu, %zu: %.4f, %.4f\n", static_cast<unsigned long long>(seed), q, own.low[q],
                    other.value[q]);
      apart += is_apart ? 1 : 0;
    }
    if (!std::isfinite(own.low[POSE_WALL_YAW]) || !std::isfinite(other.value[POSE_WALL_YAW])) continue;
    ++places;
    apart += std::abs(own.error(POSE_WALL_YAW, other.value[POSE_WALL_YAW])) > 0.0035 ? 1 : 0;
  }
  EXPECT_GT(places, 100);
  EXPECT_LT(apart, places / 20);
}

TEST(SurveyedTruth, NothingValidIsWrongByBothTruths) {
  Tallies tallies;
  for (std::uint64_t seed = 300; seed < 312; ++seed) {
    Case tried;
    tried.seed = seed;
    tried.furnishing = Furnishing::kRich;
    const Verdict verdict = hear(tried);
    add(&tallies, verdict);
    for (const Finding& finding : verdict.findings) EXPECT_FALSE(finding.misleading()) << verdict.text(finding);
  }
  int valid = 0;
  for (const Tally& tally : tallies) valid += static_cast<int>(tally.valid_surveyed_errors.size());
  EXPECT_GT(valid, 50);
  EXPECT_NE(truths_table(tallies).find("survey 95%"), std::string::npos);
}

}  // namespace
}  // namespace pose_wall::judge
