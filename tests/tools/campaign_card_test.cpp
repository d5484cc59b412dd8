// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the card counts and averages what hand-made records hold, and finds the worst events and the times of an
// event. Does not prove: that real records are right.

#include "lab/campaign/card.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "campaign_records.hpp"
#include "lab/campaign/card_files.hpp"
#include "lab/campaign/card_words.hpp"
#include "lab/campaign/rate_bound.hpp"
#include "lab/campaign/recipe.hpp"

namespace pose_wall::tools::campaign {
namespace {

using namespace test;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(RateBound, IsClopperPearsons) {
  EXPECT_NEAR(rate_bound_95(0, 10), 0.258866, 1e-6);
  EXPECT_NEAR(rate_bound_95(1, 10), 0.394163, 1e-6);
  EXPECT_NEAR(rate_bound_95(5, 10), 0.777559, 1e-6);
  EXPECT_NEAR(rate_bound_95(0, 30000), 3.0 / 30000.0, 2e-7);
  EXPECT_NEAR(rate_bound_95(3, 30000), 2.584347e-4, 1e-9);
  EXPECT_NEAR(rate_bound_95(100, 5000), 0.0235730, 1e-6);
  EXPECT_EQ(rate_bound_95(10, 10), 1.0);
  EXPECT_EQ(rate_bound_95(0, 0), 1.0);
}

TEST(CampaignCard, CountsFramesStatesAndErrors) {
  RunRecord run = good_run("clean", 0, 4);
  run.frames[1].quantity[POSE_WALL_D_LF] = value_with_error(0.03, 0.01, 0.2, POSE_WALL_DEGRADED);
  run.frames[2].quantity[POSE_WALL_D_LF] = value_with_error(0.0, 0.01, 0.05, POSE_WALL_HELD);
  run.frames[2].quantity[POSE_WALL_D_LF].measured.raw = kNaN;
  run.frames[3].quantity[POSE_WALL_D_LF].truth = kNaN;
  run.frames[3].quantity[POSE_WALL_D_LF].measured.state = POSE_WALL_INVALID;
  const Card card = card_of({run, good_run("clean", 1, 2)});
  ASSERT_EQ(card.classes.size(), 1U);
  const ClassCard& one = card.classes.front();
  EXPECT_EQ(one.draws, 2U);
  EXPECT_EQ(one.frames.frames, 6U);
  const ErrorStatistics& d_lf = one.quantities[POSE_WALL_D_LF];
  EXPECT_EQ(d_lf.frames(), 5U);  // one has no truth
  EXPECT_EQ(d_lf.in_state(POSE_WALL_VALID), 3U);
  EXPECT_EQ(d_lf.in_state(POSE_WALL_DEGRADED), 1U);
  EXPECT_EQ(d_lf.in_state(POSE_WALL_HELD), 1U);
  EXPECT_NEAR(d_lf.raw().rmse, std::sqrt((3 * 0.01 * 0.01 + 0.03 * 0.03) / 4.0), 1e-12);
  EXPECT_NEAR(d_lf.raw().absolute_max, 0.03, 1e-12);
  EXPECT_NEAR(d_lf.mean_z2(), (3.0 + 9.0) / 4.0, 1e-9);
  EXPECT_NEAR(state_shares(d_lf).valid, 3.0 / 5.0, 1e-12);
  EXPECT_NEAR(state_shares(one.quantities).valid, 39.0 / 41.0, 1e-12);
}

TEST(CampaignCard, CountsAFrameOnceHoweverManyOfItsValuesAreBeyond) {
  RunRecord run = good_run("clean", 0, 3);
  run.frames[1].quantity[POSE_WALL_ROLL] = value_with_error(0.016, 0.01, 0.015);
  run.frames[1].quantity[POSE_WALL_PITCH] = value_with_error(0.016, 0.01, 0.015);
  run.frames[2].quantity[POSE_WALL_D_RB] = value_with_error(0.11, 0.01, 0.05);
  const Card card = card_of({run, good_run("props", 0, 5)});
  EXPECT_EQ(card.nominal.frames.frames, 3U);
  EXPECT_EQ(card.nominal.frames.value_beyond_protection, 2U);
  EXPECT_EQ(card.nominal.frames.raw_beyond_protection, 2U);
  EXPECT_EQ(card.nominal.frames.misleading, 1U);
  EXPECT_EQ(card.adversarial.frames.frames, 5U);
  EXPECT_EQ(card.adversarial.frames.misleading, 0U);
  EXPECT_EQ(card.judged.frames.frames, 8U);
  EXPECT_EQ(card.distances.regions().misleading_if_valid, 1U);
  EXPECT_EQ(card.angles.regions().beyond_protection, 2U);
  EXPECT_EQ(card.angles.regions().within, 8U * 3U - 2U);
}

TEST(CampaignCard, AValidValueWithoutTruthMisleads) {
  RunRecord run = good_run("one_wall", 0, 2);
  run.frames[1].quantity[POSE_WALL_D_LF].truth = kNaN;
  const Card card = card_of({run});
  EXPECT_EQ(card.judged.frames.misleading, 1U);
  EXPECT_EQ(card.classes.front().quantities[POSE_WALL_D_LF].valid_without_truth(), 1U);
  EXPECT_EQ(card.classes.front().times.alert_max, 1U);
}

TEST(CampaignCard, ListsMisleadingEventsFirstAndOneOfEachRunAndQuantity) {
  RunRecord slight = good_run("props", 0, 3);
  for (auto& frame : slight.frames) frame.quantity[POSE_WALL_D_LF] = value_with_error(0.09, 0.01, 0.01);
  slight.frames[2].quantity[POSE_WALL_D_LF] = value_with_error(0.095, 0.01, 0.01);
  RunRecord misleading = good_run("props", 1, 3);
  misleading.frames[1].quantity[POSE_WALL_YAW] = value_with_error(0.02, 0.01, 0.0101);
  const Card card = card_of({slight, misleading});
  ASSERT_EQ(card.events.size(), 2U);
  EXPECT_EQ(card.events[0].breach, Breach::kMisleading);
  EXPECT_EQ(card.events[0].run.draw, 1U);
  EXPECT_NEAR(card.events[0].excess, 0.02 / kAngleLimit_rad, 1e-9);
  EXPECT_EQ(card.events[1].frame, 2U);
  EXPECT_NEAR(card.events[1].error, 0.095, 1e-9);
}

TEST(CampaignCard, EachEventNamesACommandThatFitsIt) {
  RunRecord run = good_run("props", 1, 3);
  run.frames[1].quantity[POSE_WALL_YAW] = value_with_error(0.02, 0.01, 0.0101);
  Manifest manifest = test::manifest_of({run});
  const auto command = [&] { return recipe(make_card(manifest, {run}, 1).events.at(0), manifest); };
  const std::string sim = "pose_wall sim --scene props --sensor os1-64 --random --seed 101 --frames 2 --output DIR && ";
  EXPECT_EQ(command(), sim + "pose_wall run --config DIR/pose_wall.yaml --output DIR/out.csv DIR/frames");
  manifest.engine.settings = {"forward_axis=+Y", "body_box_1=[0, 1, 0, 1, 0, 1]"};
  const std::string settings = " --set forward_axis=+Y --set 'body_box_1=[0, 1, 0, 1, 0, 1]'";
  EXPECT_EQ(command(),
            sim + "pose_wall run --config DIR/pose_wall.yaml" + settings + " --output DIR/out.csv DIR/frames");
  manifest.plan.seed = 7;
  const std::string campaign =
      "pose_wall campaign --seed 7 --scenes props --sensors os1-64 --first-draw 1 --draws 1 --frames 2";
  run.frames[2].stamp_ns += 1;
  EXPECT_EQ(command().rfind(sim, 0), 0U) << "what comes after the event does not matter";
  run.frames[0].stamp_ns += 1;
  EXPECT_EQ(command(), campaign + settings + " --output DIR");
  run.frames[0].stamp_ns -= 1;
  manifest.engine.config_file = "my road.yaml";
  EXPECT_EQ(command(), campaign + " --config 'my road.yaml'" + settings + " --output DIR");
}

RunRecord run_with_event(std::size_t first, std::size_t after, std::uint32_t frames) {
  RunRecord run = good_run("wall_lost", 0, frames);
  for (std::size_t i = 0; i < frames; ++i) {
    run.frames[i].phase = i < first ? Phase::kBefore : (i < after ? Phase::kEvent : Phase::kAfter);
  }
  return run;
}

void set_state(RunRecord& run, std::size_t from, std::size_t to, std::size_t q, std::uint32_t state) {
  for (std::size_t i = from; i < to; ++i) run.frames[i].quantity[q].measured.state = state;
}

TEST(CampaignCard, TimesNoticingAndRecovery) {
  RunRecord run = run_with_event(10, 20, 40);
  set_state(run, 0, 40, POSE_WALL_D_RF, POSE_WALL_DEGRADED);  // was not valid before: is not waited for
  set_state(run, 12, 25, POSE_WALL_D_LF, POSE_WALL_HELD);
  EventTimes times;
  times.add(run, {kAngleLimit_rad, kDistanceLimit_m});
  EXPECT_EQ(times.noticed, std::vector<std::size_t>{2});
  EXPECT_EQ(times.recovered, std::vector<std::size_t>{5});
  set_state(run, 12, 40, POSE_WALL_D_LF, POSE_WALL_HELD);
  times.add(run, {kAngleLimit_rad, kDistanceLimit_m});
  EXPECT_EQ(times.never_recovered, 1U);
  set_state(run, 0, 40, POSE_WALL_D_LF, POSE_WALL_VALID);
  times.add(run, {kAngleLimit_rad, kDistanceLimit_m});
  EXPECT_EQ(times.never_noticed, 1U);
}

TEST(CampaignCard, AnEventAtOnceIsTimedFromTheFrameBehindIt) {
  RunRecord run = run_with_event(10, 10, 30);
  set_state(run, 10, 13, POSE_WALL_YAW, POSE_WALL_DEGRADED);
  EventTimes times;
  times.add(run, {kAngleLimit_rad, kDistanceLimit_m});
  EXPECT_EQ(times.noticed, std::vector<std::size_t>{0});
  EXPECT_EQ(times.recovered, std::vector<std::size_t>{3});
}

TEST(CampaignCard, TimeToAlertIsTheLongestStretchOfMisleadingFrames) {
  RunRecord run = good_run("props", 0, 10);
  for (const std::size_t i : {1U, 2U, 3U, 6U}) run.frames[i].quantity[POSE_WALL_D_LF] = value_with_error(0.2);
  EventTimes times;
  times.add(run, {kAngleLimit_rad, kDistanceLimit_m});
  EXPECT_EQ(times.alert_max, 3U);
  EXPECT_TRUE(times.noticed.empty());
}

TEST(CampaignCard, SharesAreNotRoundedToAllOrNone) {
  EXPECT_EQ(percent(1.0), "100 %");
  EXPECT_EQ(percent(0.7 + 0.2 + 0.1), "100 %");
  EXPECT_EQ(percent(0.9998), "> 99.9 %");
  EXPECT_EQ(percent(0.9994), "99.9 %");
  EXPECT_EQ(percent(0.0006), "0.1 %");
  EXPECT_EQ(percent(0.0001), "< 0.1 %");
  EXPECT_EQ(percent(0.0), "0 %");
  EXPECT_EQ(percent(kNaN), "-");
}

TEST(CampaignCard, OneIsNoPlural) {
  const std::string page = card_page(card_of({good_run("clean", 0, 1)}));
  EXPECT_NE(page.find("1 frame in 1 of 1 run, 1 class (scene and sensor)"), std::string::npos) << page.substr(0, 200);
}

TEST(CampaignCard, LevelsAreComparedWithTheErrorsOfTheSameValues) {
  RunRecord run = good_run("clean", 0, 100);
  for (std::size_t i = 0; i < 100; ++i) {
    run.frames[i].quantity[POSE_WALL_ROLL] = value_with_error(0.0001 * static_cast<double>(i), 0.01, 0.015);
  }
  run.frames[98].quantity[POSE_WALL_ROLL] = value_with_error(0.5, 0.01, 0.9, POSE_WALL_DEGRADED);
  run.frames[99].quantity[POSE_WALL_ROLL] = value_with_error(0.5, 0.01, 0.9, POSE_WALL_HELD);
  const Card card = card_of({run});
  const ErrorStatistics& roll = card.classes.front().quantities[POSE_WALL_ROLL];
  EXPECT_DOUBLE_EQ(roll.valid_levels().median, 0.015);
  EXPECT_NEAR(roll.valid_levels().absolute_error_95, 0.0092, 1e-12) << "of 98 errors, the one of rank 92";
  EXPECT_NEAR(roll.valid_levels().over_error(), 0.015 / 0.0092, 1e-9);
  const ErrorStatistics none(true, kAngleLimit_rad);
  EXPECT_TRUE(std::isnan(none.valid_levels().median));
}

TEST(CampaignCard, ShowsValidSharesByKindAndSensorBesideTheirFloors) {
  RunRecord other = good_run("clean", 0, 4);
  other.run.sensor = "vlp16";
  for (std::size_t i = 0; i < 2; ++i) other.frames[i].quantity[POSE_WALL_ROLL].measured.state = POSE_WALL_DEGRADED;
  const Card card = card_of({good_run("clean", 0, 4), other, good_run("props", 0, 4), good_run("axes_swapped", 0, 4)});
  ASSERT_EQ(card.kinds.size(), 4U) << "two sensors and all for nominal, one sensor for adversarial";
  EXPECT_EQ(card.kinds[1].sensor, "vlp16");
  EXPECT_DOUBLE_EQ(card.kinds[1].valid[0].share(), 0.5);
  EXPECT_EQ(card.kinds[2].sensor, "all");
  EXPECT_DOUBLE_EQ(card.kinds[2].valid[0].share(), 0.75);
  EXPECT_EQ(card.kinds[2].valid[3].values(), 2U * 4U * 4U) << "four distances";
  EXPECT_EQ(card.kinds[3].kind, sim::SceneKind::kAdversarial);
  const auto page = nlohmann::json::parse(card_json(card));
  EXPECT_EQ(page["kinds"][1]["valid"]["roll"]["share"], 0.5);
  EXPECT_EQ(page["kinds"][1]["valid"]["roll"]["floor"], card.kinds[1].valid[0].floor());
  EXPECT_TRUE(page["classes"][3]["valid"]["roll"]["floor"].is_null()) << "unobservable";
  EXPECT_EQ(page["classes"][0]["valid"]["distances"]["level"]["median"], 0.015);
}

TEST(CampaignCard, AValueBelowItsFloorStandsInBold) {
  std::vector<RunRecord> records;
  for (std::uint32_t draw = 0; draw < 24; ++draw) records.push_back(good_run("clean", draw, 2));
  const std::string passed = card_page(card_of(records));
  EXPECT_NE(passed.find("| clean | os1-64 | nominal | 24 | 48 | 100 % ≥ "), std::string::npos);
  EXPECT_EQ(passed.find("% < "), std::string::npos);
  for (RunRecord& record : records) record.frames[0].quantity[POSE_WALL_YAW].measured.state = POSE_WALL_DEGRADED;
  const std::string failed = card_page(card_of(records));
  EXPECT_NE(failed.find("| **50.0 % < "), std::string::npos);
}

TEST(CampaignCard, PagesSayTheSameAsTheCounts) {
  RunRecord run = good_run("clean", 0, 3);
  run.frames[2].quantity[POSE_WALL_D_RB] = value_with_error(0.11, 0.01, 0.05);
  const Card card = card_of({run});
  const auto page = nlohmann::json::parse(card_json(card));
  EXPECT_EQ(page["totals"]["nominal"]["counts"]["misleading"]["frames"], 1);
  EXPECT_EQ(page["classes"][0]["quantities"]["d_rb"]["valid_beyond_alert"], 1);
  EXPECT_EQ(page["worst_events"][0]["seed"], 100);
  EXPECT_TRUE(page["totals"]["adversarial"]["quantities"]["roll"]["mean_z2"].is_null());
  EXPECT_NE(card_page(card).find("| misleading | clean | os1-64 | 0 | 2 | d_rb | 110.0 mm | 50.0 mm |"),
            std::string::npos);
  EXPECT_NE(card_summary(card).find("nominal"), std::string::npos);
}

}  // namespace
}  // namespace pose_wall::tools::campaign
