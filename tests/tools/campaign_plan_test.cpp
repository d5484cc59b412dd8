// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a campaign's plan is the same each time, holds each scene's event and its recovery, and sparse sensors are
// run with the shipped settings. Does not prove: that the sizes suffice.

#include "lab/campaign/plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>
#include <string_view>

#include "io/config_file/key_table.hpp"
#include "io/config_file/load_config.hpp"
#include "lab/campaign/event.hpp"
#include "lab/campaign/manifest.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/sensors.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools::campaign {
namespace {

std::string refusal_of(const PlanRequest& request) {
  return test::said_by<std::invalid_argument>([&] { make_plan(request); });
}

TEST(CampaignPlan, IsTheSameForTheSameRequestAndAnotherForAnotherSeed) {
  PlanRequest request;
  const auto first = make_plan(request);
  const auto second = make_plan(request);
  request.seed = 2;
  const auto other = make_plan(request);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].scene, second[i].scene);
    EXPECT_EQ(first[i].seed, second[i].seed);
    EXPECT_EQ(first[i].frames, second[i].frames);
    EXPECT_NE(first[i].seed, other[i].seed);
  }
}

TEST(CampaignPlan, HoldsEverySceneAndNoSeedTwice) {
  PlanRequest request;
  request.size = "medium";
  std::set<std::string> scenes;
  std::set<std::uint64_t> seeds;
  const auto runs = make_plan(request);
  for (const auto& run : runs) {
    scenes.insert(run.scene);
    seeds.insert(run.seed);
  }
  EXPECT_EQ(scenes.size(), sim::scenes().size());
  EXPECT_EQ(seeds.size(), runs.size());
}

TEST(CampaignPlan, LargeHasMoreThanThirtyThousandFrames) {
  PlanRequest request;
  request.size = "large";
  EXPECT_GE(frames_of(make_plan(request)), 30000U);
}

TEST(CampaignPlan, RunsOfAnEventGoOnTwoSecondsBehindIt) {
  PlanRequest request;
  request.size = "large";
  request.scenes = {"wall_lost", "turn_step"};
  for (const auto& run : make_plan(request)) {
    const sim::SceneSetup setup = sim::make_setup(run.scene, run.sensor, true, run.seed);
    const auto event = event_of(setup);
    ASSERT_TRUE(event);
    EXPECT_GE(run.frames, event->after + 2.0 * setup.sequence.rate_hz);
  }
}

TEST(CampaignPlan, RunsInWhichSomethingHappensShowItAll) {
  sim::SceneSetup setup;
  EXPECT_EQ(frames_to_watch(setup), 0U);
  setup.faults.dust = 0.5;
  EXPECT_EQ(frames_to_watch(setup), 0U);
  setup.faults.dust_rise_s = 4.0;
  EXPECT_EQ(frames_to_watch(setup), 50U);
  setup.sequence.duplicate_every = 3.0;
  EXPECT_EQ(frames_to_watch(setup), 50U);
  setup.machine.boom_sweep_deg = 30.0;
  setup.machine.boom_period_s = 12.0;
  EXPECT_EQ(frames_to_watch(setup), 60U);
  setup.faults.lost_side = sim::kSideLeft;
  setup.faults.lost_to_s = 10.0;
  EXPECT_EQ(frames_to_watch(setup), 120U);
}

TEST(CampaignPlan, EventIsInFramesAsTheSimulatorComparesTimes) {
  sim::SceneSetup setup;
  EXPECT_FALSE(event_of(setup));
  setup.sequence.freeze_from_s = 1.05;
  setup.sequence.freeze_to_s = 2.0;
  const auto event = event_of(setup);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->first, 11U);
  EXPECT_EQ(event->after, 20U);
}

TEST(CampaignPlan, KindChoosesClasses) {
  PlanRequest request;
  request.kind = "adversarial";
  for (const auto& run : make_plan(request)) {
    EXPECT_EQ(sim::find_scene(run.scene)->kind, sim::SceneKind::kAdversarial) << run.scene;
  }
  request.scenes = {"clean"};
  EXPECT_NE(refusal_of(request).find("adversarial"), std::string::npos);
}

TEST(CampaignPlan, NamesWhatWasMeant) {
  PlanRequest request;
  request.scenes = {"steel_set"};
  EXPECT_NE(refusal_of(request).find("'steel_sets'"), std::string::npos);
  request.scenes = {"clean"};
  request.sensors = {"os1-46"};
  EXPECT_NE(refusal_of(request).find("'os1-64'"), std::string::npos);
  request.size = "meduim";
  EXPECT_NE(refusal_of(request).find("'medium'"), std::string::npos);
}

Manifest manifest_for(const PlanRequest& request) {
  return make_manifest(request, make_plan(request), {});
}

TEST(CampaignPlan, OtherPlansDifferInWords) {
  PlanRequest request;
  request.scenes = {"clean", "jitter"};
  PlanRequest other = request;
  EXPECT_EQ(difference(manifest_for(request), manifest_for(other)), "");
  other.scenes = {"clean"};
  other.size = "medium";
  other.draws = 3;
  EXPECT_EQ(difference(manifest_for(request), manifest_for(other)),
            "  size: the records have small, this campaign has medium\n"
            "  scenes: the records have clean,jitter, this campaign has clean\n"
            "  draws: the records have those of the size, this campaign has 3\n");
  Manifest drawn_otherwise = manifest_for(request);
  drawn_otherwise.runs = 7;
  drawn_otherwise.identity.back().second = "of another table of scenes";
  EXPECT_NE(difference(drawn_otherwise, manifest_for(request)).find("the records have 7 runs with"), std::string::npos);
}

TEST(CampaignPlan, NominalScenesAreDrawnMoreOften) {
  PlanRequest request;
  request.size = "large";
  request.sensors = {"os1-64"};
  const auto runs_of = [&request](const char* scene) {
    request.scenes = {scene};
    return make_plan(request).size();
  };
  EXPECT_GT(runs_of("nominal"), 2 * runs_of("conveyor"));
  EXPECT_EQ(runs_of("jitter"), runs_of("stamp_jump")) << "sequences are as few as ever";
  request.draws = 2;
  EXPECT_EQ(make_plan(request).size(), 2U) << "what was asked for";
}

// An engine for a simulated sensor.
LoadedConfig engine_for(const sim::SensorModel& sensor) {
  std::vector<std::string> settings;
  for (const EngineSetting& s : sensor.engine) settings.push_back(s.key + "=" + s.value);
  settings.push_back("floor_region_min=" + std::to_string(sensor.sensor.floor_from_m));
  settings.push_back("floor_region_max=" + std::to_string(sensor.sensor.floor_to_m));
  return load_config("", settings);
}

TEST(CampaignPlan, SensorsAreRunWithTheShippedSettings) {
  for (const std::string name : {"vlp16", "mid360", "os1-64"}) {
    const LoadedConfig shipped = load_config("config/" + name + ".yaml", {});
    const LoadedConfig ours = engine_for(*sim::find_sensor(name));
    EXPECT_NE(shipped.origins.count("range_bias_max"), 0U) << name << ": not by its data sheet";
    for (const pose_wall_key_info& key : config_keys()) {
      EXPECT_EQ(config_value_text(*ours.config.get(), key), config_value_text(*shipped.config.get(), key))
          << name << " " << key.name;
    }
  }
}

// A larger bias would be outside the levels by what the user was told.
TEST(CampaignPlan, NoSceneDrawsALargerBiasThanTheSensorsFileAllows) {
  for (const sim::SensorModel& sensor : sim::sensor_models()) {
    const double most_m = engine_for(sensor).config.number("range_bias_max");
    EXPECT_LE(std::fabs(sensor.sensor.range_bias_m), most_m) << sensor.sensor.name;
    for (const sim::SceneChoice& scene : sim::scenes()) {
      for (const sim::SceneValue& value : scene.values) {
        if (std::string_view(value.key) != "range_bias_m") continue;
        const double fixed_m = std::stod(value.fixed);
        for (const double drawn_m : {value.low, value.high, fixed_m}) {
          EXPECT_LE(std::fabs(drawn_m), most_m) << scene.name << ", " << sensor.sensor.name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace pose_wall::tools::campaign
