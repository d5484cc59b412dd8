// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every class that is judged has its measured shares in the table, floors follow from them by the stated rule,
// and the curve over scaled levels counts by its definition. Does not prove: that the measured shares are good enough.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

#include "campaign_records.hpp"
#include "lab/campaign/card_sections.hpp"
#include "lab/campaign/level_curve.hpp"
#include "lab/campaign/valid_floors.hpp"
#include "lab/sim/sensors.hpp"

namespace pose_wall::tools::campaign {
namespace {

using namespace test;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr AlertLimits kLimits = {kAngleLimit_rad, kDistanceLimit_m};

TEST(ValidFloors, TheTableHasEachJudgedClassOnce) {
  std::map<std::pair<std::string_view, std::string_view>, int> rows;
  for (const ClassShares& one : valid_shares()) {
    ++rows[{one.scene, one.sensor}];
    for (const ValidShare& group : one.groups) {
      EXPECT_GE(group.share, 0.0) << one.scene << " " << one.sensor;
      EXPECT_LE(group.share, 1.0) << one.scene << " " << one.sensor;
      EXPECT_GT(group.spread, 0.0) << one.scene << " " << one.sensor << ": a few runs never show that none differs";
      EXPECT_LE(group.spread, 1.0) << one.scene << " " << one.sensor;
    }
  }
  std::size_t judged = 0;
  for (const sim::SceneChoice& scene : sim::scenes()) {
    if (scene.kind == sim::SceneKind::kUnobservable) continue;
    for (const sim::SensorModel& sensor : sim::sensor_models()) {
      ++judged;
      EXPECT_EQ((rows[{scene.name, sensor.sensor.name}]), 1) << scene.name << " " << sensor.sensor.name;
    }
  }
  EXPECT_EQ(rows.size(), judged);
}

// Ordinary rock, by the table: should a class of it be promised nothing, the floors prove nothing.
TEST(ValidFloors, OrdinaryRockIsPromisedMuch) {
  for (const char* scene : {"clean", "shotcrete", "body"}) {
    const ClassShares* const one = find_valid_shares(scene, "os1-64");
    ASSERT_NE(one, nullptr) << scene;
    for (const ValidShare& group : one->groups) EXPECT_GE(group.share, 0.9) << scene;
  }
}

TEST(ValidFloors, TheSlackShrinksWithTheRootOfTheRuns) {
  const auto floor_of = [](std::size_t runs) {
    ValidCount count;
    count.add({0.9, 0.2}, 100, 80, runs);
    return count.floor();
  };
  EXPECT_NEAR(floor_of(100), 0.9 - 4 * 0.2 / 10 - 1.0 / 100, 1e-12);
  EXPECT_NEAR(floor_of(25), 0.9 - 4 * 0.2 / 5 - 1.0 / 25, 1e-12);
  EXPECT_EQ(floor_of(1), 0.0) << "never below nothing";
}

TEST(ValidFloors, SeveralClassesWeighByTheirValues) {
  ValidCount both, other;
  both.add({1.0, 0.1}, 300, 300, 100);
  other.add({0.6, 0.2}, 100, 40, 25);
  both.merge(other);
  const double share = (300 * 1.0 + 100 * 0.6) / 400;
  const double spread = std::hypot(300 * 0.1 / 10, 100 * 0.2 / 5) / 400;
  EXPECT_NEAR(both.floor(), share - 4 * spread - 1.0 / 125, 1e-12);
  EXPECT_DOUBLE_EQ(both.share(), 340.0 / 400);
  EXPECT_FALSE(other.holds() && other.share() < other.floor());
}

TEST(ValidFloors, NothingIsAskedOfNothing) {
  ValidCount none;
  none.add({1.0, 0.1}, 0, 0, 10);
  EXPECT_TRUE(none.holds());
  EXPECT_TRUE(std::isnan(none.floor()));
  EXPECT_EQ(find_valid_shares("axes_swapped", "os1-64"), nullptr);
}

QuantityRecord kept_back(double level, std::uint32_t reasons, std::uint32_t state = POSE_WALL_DEGRADED) {
  QuantityRecord value = value_with_error(0.0, 0.01, level, state);
  value.reasons = reasons;
  return value;
}

TEST(LevelCurve, OnlyWhatItsLevelAloneKeepsBackBecomesValid) {
  const double wide = 1.5 * kDistanceLimit_m;
  const auto valid_at = [](double scale, const QuantityRecord& value) {
    return is_valid_under(scale, value, kDistanceLimit_m);
  };
  EXPECT_TRUE(valid_at(0.5, kept_back(wide, POSE_WALL_R_ALERT_LIMIT)));
  EXPECT_FALSE(valid_at(0.7, kept_back(wide, POSE_WALL_R_ALERT_LIMIT))) << "0.7 * 1.5 is still above";
  EXPECT_TRUE(valid_at(0.5, kept_back(wide, POSE_WALL_R_ALERT_LIMIT | POSE_WALL_R_STAMP_LEAP)));
  EXPECT_TRUE(valid_at(0.5, kept_back(wide, POSE_WALL_R_ALERT_LIMIT | POSE_WALL_R_WALL_AMBIGUOUS)))
      << "the level holds it";
  EXPECT_FALSE(valid_at(0.5, kept_back(wide, POSE_WALL_R_ALERT_LIMIT | POSE_WALL_R_INNOVATION)));
  EXPECT_FALSE(valid_at(0.5, kept_back(0.01, POSE_WALL_R_FROZEN)));
  EXPECT_FALSE(valid_at(0.5, kept_back(0.01, POSE_WALL_R_ALERT_LIMIT, POSE_WALL_HELD)));
  EXPECT_FALSE(valid_at(0.5, kept_back(kNothing, POSE_WALL_R_ALERT_LIMIT, POSE_WALL_INVALID)));
}

TEST(LevelCurve, AValidValueIsSoWhileItsScaledLevelIsWithinTheLimit) {
  const QuantityRecord value = value_with_error(0.0, 0.01, 0.9 * kDistanceLimit_m);
  EXPECT_TRUE(is_valid_under(1.0, value, kDistanceLimit_m));
  EXPECT_FALSE(is_valid_under(1.2, value, kDistanceLimit_m));
}

std::size_t index_of(double scale) {
  std::size_t i = 0;
  while (i < kLevelScales.size() && kLevelScales[i] != scale) ++i;
  return i;
}

TEST(LevelCurve, CountsMisleadingAndBeyondUnderEachScale) {
  RunRecord run = good_run("clean", 0, 4);
  for (auto& frame : run.frames) {
    for (auto& q : frame.quantity) q = value_with_error(0.001);
  }
  // Its level holds and is told: only a smaller one misleads.
  run.frames[1].quantity[POSE_WALL_D_LF] = kept_back(0.15, POSE_WALL_R_ALERT_LIMIT);
  run.frames[1].quantity[POSE_WALL_D_LF].truth += 0.12;
  // Wrong by less than its limit, beyond half its level.
  run.frames[2].quantity[POSE_WALL_ROLL] = value_with_error(0.009, 0.01, 0.015);
  LevelCurve curve{};
  add_run(curve, run, kLimits);
  const ScaledCounts &third = curve[index_of(0.3)], &half = curve[index_of(0.5)], &as_is = curve[index_of(1.0)];
  EXPECT_EQ(as_is.frames, 4U);
  EXPECT_EQ(as_is.misleading, 0U);
  EXPECT_EQ(as_is.beyond, 0U);
  EXPECT_EQ(as_is.valid_distances, 15U);
  EXPECT_EQ(half.misleading, 1U);
  EXPECT_EQ(half.valid_distances, 16U);
  EXPECT_EQ(half.beyond, 2U) << "the frame that misleads is beyond as well";
  EXPECT_EQ(third.beyond, 2U);
  EXPECT_EQ(half.angles, 12U);
  EXPECT_EQ(curve[index_of(1.5)].valid_angles, 0U) << "0.015 rad times 1.5 is above the limit";
}

TEST(LevelCurve, AtOneItIsTheCard) {
  RunRecord run = good_run("clean", 0, 3);
  run.frames[0].quantity[POSE_WALL_D_RB] = value_with_error(0.11, 0.01, 0.05);
  run.frames[1].quantity[POSE_WALL_D_LF] = value_with_error(0.0, 0.01, 0.05, POSE_WALL_HELD);
  run.frames[2].quantity[POSE_WALL_D_LF].truth = kNothing;
  run.frames[2].quantity[POSE_WALL_YAW] = value_with_error(0.016, 0.01, 0.015, POSE_WALL_DEGRADED);
  const Card card = card_of({run, good_run("props", 0, 5)});
  const ScaledCounts& nominal = card.nominal_curve[index_of(1.0)];
  EXPECT_EQ(nominal.frames, card.nominal.frames.frames);
  EXPECT_EQ(nominal.misleading, card.nominal.frames.misleading);
  EXPECT_EQ(nominal.beyond, card.nominal.frames.value_beyond_protection);
  EXPECT_EQ(nominal.valid_distances, grouped(card.nominal.quantities).back().statistics.valid());
  EXPECT_EQ(card.adversarial_curve[index_of(1.0)].frames, 5U);
}

TEST(LevelCurve, StandsInTheCsv) {
  const std::string csv = curve_csv(card_of({good_run("clean", 0, 3)}));
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "scale,kind,frames,valid_angles,valid_distances,misleading,beyond");
  EXPECT_NE(csv.find("\n1,nominal,3,1,1,0,0\n"), std::string::npos) << csv;
  EXPECT_EQ(csv.find("adversarial"), std::string::npos) << "none was measured";
}

}  // namespace
}  // namespace pose_wall::tools::campaign
