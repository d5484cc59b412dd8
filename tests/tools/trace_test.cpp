// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the engine that takes notes gives the bits of the one that does not, frame by frame; its notes are complete:
// every reason of floor, walls, frame and outcome has a note that failed, and no note failed without its reason. Limits
// that are set, and gates that let pass, hold until they are forgotten. Does not prove: that values in the notes are
// those of the gates; that is what they are written beside.

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "io/config_file/key_table.hpp"
#include "study/explain/traced_frame.hpp"
#include "support/sim_run.hpp"

namespace pose_wall::tools {
namespace {

using namespace pose_wall::test;

struct Case {
  const char* scene;
  const char* sensor;
  std::uint64_t seed;
  std::uint32_t frames;
};

void PrintTo(const Case& c, std::ostream* os) {
  *os << c.scene << " " << c.sensor << " " << c.seed;
}

pose_wall_trace_info info_of(std::uint32_t gate) {
  pose_wall_trace_info info{};
  EXPECT_EQ(pose_wall_trace_gate_info(gate, &info), POSE_WALL_OK);
  return info;
}

// Reasons of the notes with this outcome, of one subject; for the floor, of the radius that was taken.
std::uint32_t noted(const pose_wall_trace& trace, std::uint32_t subject,
                    pose_wall_trace_answer answer = POSE_WALL_TRACE_FAILED) {
  std::uint32_t reasons = 0;
  for (std::uint32_t i = 0; i < trace.gates; ++i) {
    const pose_wall_trace_gate& g = trace.gate[i];
    if (g.subject != subject || g.passed != static_cast<std::uint32_t>(answer)) continue;
    if (subject == POSE_WALL_TRACE_FLOOR && g.attempt != trace.floor_attempt) continue;
    reasons |= info_of(g.gate).reasons;
  }
  return reasons;
}

constexpr std::uint32_t kOfFrame = POSE_WALL_R_NO_POINTS | POSE_WALL_R_LEAF_GROWN;
constexpr std::uint32_t kOfTime =
    POSE_WALL_R_STAMP_STILL | POSE_WALL_R_STAMP_BACK | POSE_WALL_R_STAMP_LEAP | POSE_WALL_R_FROZEN;
constexpr std::uint32_t kOfOutcome = POSE_WALL_R_ALERT_LIMIT | POSE_WALL_R_INNOVATION | POSE_WALL_R_RATE_LIMITED |
                                     POSE_WALL_R_HOLD_EXPIRED | POSE_WALL_R_NEVER_MEASURED;

void expect_complete(const pose_wall_result& result, const pose_wall_trace& trace) {
  EXPECT_EQ(trace.dropped, 0U);
  const std::uint32_t frame = noted(trace, POSE_WALL_TRACE_FRAME);
  const std::uint32_t walls = noted(trace, POSE_WALL_TRACE_WALLS);
  EXPECT_EQ(result.frame_reasons & (kOfFrame | kOfTime), frame);
  EXPECT_EQ(result.floor.reasons & ~kOfFrame, noted(trace, POSE_WALL_TRACE_FLOOR));
  // A refusal that the region's plane answers is told as a doubt. The floor's doubts are told no more.
  const auto told = [&](std::uint32_t side) {
    return noted(trace, side) | noted(trace, side, POSE_WALL_TRACE_ANSWERED);
  };
  EXPECT_EQ(result.left.reasons & ~kOfFrame, walls | told(POSE_WALL_TRACE_LEFT));
  EXPECT_EQ(result.right.reasons & ~kOfFrame, walls | told(POSE_WALL_TRACE_RIGHT));
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    EXPECT_EQ(result.quantity[q].reasons & kOfOutcome, noted(trace, POSE_WALL_TRACE_QUANTITY + q) & kOfOutcome) << q;
  }
}

class Trace : public ::testing::TestWithParam<Case> {};

TEST_P(Trace, TheSameBitsAndANoteForEveryReason) {
  const Case& c = GetParam();
  const sim::SceneSetup setup = sim::make_setup(c.scene, c.sensor, c.seed > 1, c.seed);
  const sim::Simulator simulator(setup, c.seed);
  api::Config config;
  *config.get() = config_for(setup);
  EngineUnderTest engine(*config.get());
  for (std::uint32_t i = 0; i < c.frames; ++i) {
    SCOPED_TRACE(i);
    const sim::Frame frame = simulator.render(i);
    const Memento before = memento_of(engine.get());
    const pose_wall_result plain = engine.process(cloud_of(frame));
    const TracedFrame traced = trace_frame(config, before, cloud_of(frame));
    ASSERT_TRUE(same_bits(plain, traced.result));
    EXPECT_GT(traced.trace->gates, 0U);
    expect_complete(plain, *traced.trace);
  }
}

const Case kCases[] = {
    {"nominal", "os1-64", 1, 2},
    {"no_floor", "os1-64", 1, 2},
    {"dark_floor", "os1-64", 1, 2},
    {"flooded", "os1-64", 2, 2},
    {"ghosts", "os1-64", 2, 2},
    {"humps", "os1-64", 1, 2},
    {"pipes", "os1-64", 1, 2},
    {"pipes_before_dark_wall", "os1-64", 1, 2},
    {"props_before_void", "os1-64", 1, 2},
    {"conveyor_before_dark_wall", "os1-64", 1, 2},
    {"curtain", "os1-64", 1, 2},
    {"vehicle", "os1-64", 3, 2},
    {"crossing", "os1-64", 2, 2},
    {"crosscut_at_sampling", "os1-64", 1, 2},
    {"cavern", "os1-64", 2, 2},
    {"one_wall", "os1-64", 1, 2},
    {"curved", "os1-64", 2, 2},
    {"splayed", "os1-64", 2, 2},
    {"dust_thickens", "os1-64", 1, 6},
    {"half_blocked", "os1-64", 1, 2},
    {"turned", "os1-64", 3, 2},
    {"turn_step", "os1-64", 1, 13},
    {"frozen", "os1-64", 1, 15},
    {"stamp_jump", "os1-64", 1, 12},
    {"stamp_still", "os1-64", 1, 14},
    {"wall_lost", "os1-64", 1, 22},
    {"below_range_min", "os1-64", 1, 2},
    {"millimetres", "os1-64", 1, 1},
    {"hard_day", "os1-64", 2, 2},
    {"nominal", "vlp16", 2, 2},
    {"face", "vlp16", 759560359, 1},
};

INSTANTIATE_TEST_SUITE_P(Scenes, Trace, ::testing::ValuesIn(kCases), [](const auto& test) {
  std::string name = std::string(test.param.scene) + "_" + test.param.sensor;
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
});

TEST(TraceGates, EveryGateIsTold) {
  std::set<std::string> names, keys;
  for (const pose_wall_key_info& key : config_keys()) keys.insert(key.name);
  for (std::uint32_t gate = 0; gate < POSE_WALL_TRACE_GATES; ++gate) {
    const pose_wall_trace_info info = info_of(gate);
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_STRNE(info.asks, "");
    const std::string key = info.key;
    for (std::size_t from = 0; from < key.size();) {
      const std::size_t end = std::min(key.find('|', from), key.size());
      EXPECT_EQ(keys.count(key.substr(from, end - from)), 1U) << info.name << ": " << key;
      from = end + 1;
    }
  }
  pose_wall_trace_info info{};
  EXPECT_EQ(pose_wall_trace_gate_info(POSE_WALL_TRACE_GATES, &info), POSE_WALL_E_INDEX);
  EXPECT_EQ(pose_wall_trace_gate_info(0, nullptr), POSE_WALL_E_NULL);
}

TEST(TraceLimits, ThereAreNoneOfAGateThatIsNoneAndTheFitKeepsItsPlane) {
  const LimitsRestored afterwards;
  EXPECT_EQ(pose_wall_trace_let_pass(POSE_WALL_TRACE_GATES), POSE_WALL_E_INDEX);
  EXPECT_EQ(pose_wall_trace_set_limit(POSE_WALL_TRACE_GATES, 1.0), POSE_WALL_E_INDEX);
  EXPECT_EQ(pose_wall_trace_let_pass(POSE_WALL_TRACE_FLOOR_PLANES), POSE_WALL_E_VALUE_RANGE);
}

TEST(TraceLimits, AGateThatLetsPassFailsAsBeforeAndStopsNothingUntilLimitsAreForgotten) {
  const sim::SceneSetup setup = sim::make_setup("nominal", "vlp16", false, 1);
  const sim::Frame frame = sim::Simulator(setup, 1).render(0);
  api::Config config;
  *config.get() = config_for(setup);
  const auto traced = [&] { return trace_frame(config, {}, cloud_of(frame)); };
  const TracedFrame of_table = traced();
  EXPECT_EQ(of_table.result.quantity[POSE_WALL_D_LF].state, POSE_WALL_VALID);
  {
    const LimitsRestored afterwards;
    ASSERT_EQ(pose_wall_trace_set_limit(POSE_WALL_TRACE_WALL_LENGTH, 100.0), POSE_WALL_OK);  // m; no wall is that long
    EXPECT_EQ(traced().result.quantity[POSE_WALL_D_LF].state, POSE_WALL_INVALID);
    ASSERT_EQ(pose_wall_trace_let_pass(POSE_WALL_TRACE_WALL_LENGTH), POSE_WALL_OK);
    const TracedFrame let_pass = traced();
    EXPECT_TRUE(has_failed(*let_pass.trace, POSE_WALL_TRACE_WALL_LENGTH));
    EXPECT_EQ(let_pass.result.quantity[POSE_WALL_D_LF].state, POSE_WALL_VALID);
  }
  const TracedFrame afterwards = traced();
  EXPECT_TRUE(same_bits(afterwards.result, of_table.result));
  EXPECT_EQ(afterwards.trace->failed[0], of_table.trace->failed[0]);
  EXPECT_EQ(afterwards.trace->failed[1], of_table.trace->failed[1]);
}

TEST(TraceFrame, WhatIsRefusedLeavesNoNotes) {
  pose_wall_trace trace;
  trace.gates = 7;
  pose_wall_result result = api::make_result();
  const api::Config config;
  EXPECT_EQ(pose_wall_trace_frame(config.get(), nullptr, 0, nullptr, nullptr, 0, &result, &trace), POSE_WALL_E_NULL);
  EXPECT_EQ(trace.gates, 0U);
}

}  // namespace
}  // namespace pose_wall::tools
