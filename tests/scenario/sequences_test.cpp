// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: over sequences in which something goes wrong for a while, states, ages and levels follow the specification,
// the fault is noticed, nothing wrong is claimed meanwhile, and the engine is back soon after.

#include <gtest/gtest.h>

#include <cmath>

#include "support/sim_run.hpp"

namespace pose_wall::test {
namespace {

constexpr std::uint32_t kRecoveryFrames = 10;

sim::SceneSetup scene(const char* name) {
  sim::SceneSetup setup = sim::make_setup(name, "os1-64", false, 1);
  setup.machine.turned_left_deg = 2.0;
  return setup;
}

bool is_live(const pose_wall_value& v) {
  return v.state == POSE_WALL_VALID || v.state == POSE_WALL_DEGRADED;
}

// Held counts, too: a controller goes on acting on it.
void expect_within_level(const JudgedFrame& f, std::uint32_t frame) {
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value& v = f.result.quantity[q];
    if (v.state == POSE_WALL_INVALID || std::isnan(f.truth.value[q])) continue;
    EXPECT_LE(std::fabs(f.error(q)), v.protection_level + 1e-3)
        << "frame " << frame << " " << pose_wall_quantity_name(q);
  }
}

std::uint32_t frame_at(const sim::SceneSetup& setup, double seconds) {
  return static_cast<std::uint32_t>(std::lround(seconds * setup.sequence.rate_hz));
}

// Frames after `from` until the quantity is valid for good (to the end).
std::uint32_t frames_to_recover(const std::vector<JudgedFrame>& frames, std::uint32_t from, std::uint32_t q) {
  std::uint32_t last_bad = from;
  for (std::uint32_t i = from; i < frames.size(); ++i) {
    if (!frames[i].is(q, POSE_WALL_VALID)) last_bad = i + 1;
  }
  return last_bad - from;
}

TEST(Sequences, AWallIsLostAndFoundAgain) {
  const sim::SceneSetup setup = scene("wall_lost");  // the left one, from 1 to 3 s
  const std::vector<JudgedFrame> frames = run_frames(setup, 1, 45);
  const std::uint32_t lost = frame_at(setup, 1.0), found = frame_at(setup, 3.0);
  double level = 0.0, confidence = 1.0;
  for (std::uint32_t i = 0; i < frames.size(); ++i) {
    expect_within_level(frames[i], i);
    const pose_wall_value& left = frames[i].result.quantity[POSE_WALL_D_LF];
    if (i < lost) {
      EXPECT_TRUE(is_live(left)) << i;
    }
    if (i <= lost || i >= found) continue;
    EXPECT_FALSE(is_live(left)) << i;
    if (left.state == POSE_WALL_HELD) {
      EXPECT_NEAR(left.age_s, 0.1 * (i - lost + 1), 0.011) << i;
    }
    EXPECT_GT(left.protection_level, level) << "the level of a held value grows";
    EXPECT_LE(left.confidence, confidence) << "its confidence falls";
    level = left.protection_level;
    confidence = left.confidence;
    EXPECT_TRUE(is_live(frames[i].result.quantity[POSE_WALL_D_RF])) << "the other side is there, frame " << i;
    EXPECT_TRUE(is_live(frames[i].result.quantity[POSE_WALL_YAW])) << "yaw from the wall that is left, frame " << i;
  }
  EXPECT_LE(frames_to_recover(frames, found + 1, POSE_WALL_D_LF), kRecoveryFrames);
}

// Copies of old clouds under new stamps, while the machine turns: nothing of them is valid, and what is told of them
// holds of the machine as it stands now, whether empty frames come between or buffers come by turns.
TEST(Sequences, OldCloudsAreNoticedWhateverComesBetween) {
  constexpr std::uint32_t kFresh = 8, kAll = 40;
  sim::SceneSetup setup = scene("clean");
  setup.machine.turn_rate_dps = 2.0;
  const sim::Simulator simulator(setup, 1);
  std::vector<sim::Frame> fresh;
  for (std::uint32_t i = 0; i < kFresh; ++i) fresh.push_back(simulator.render(i));
  for (const std::uint32_t buffers : {1U, 2U, 3U, 4U}) {
    for (const std::uint32_t empty_every : {0U, 2U, 5U}) {
      SCOPED_TRACE(::testing::Message() << buffers << " buffers, empty every " << empty_every);
      EngineUnderTest engine(config_for(setup));
      for (std::uint32_t i = 0; i < kAll; ++i) {
        const bool is_empty = i >= kFresh && empty_every > 0 && i % empty_every == 0;
        const sim::Frame& frame = fresh[i < kFresh ? i : kFresh - 1 - i % buffers];
        pose_wall_cloud cloud = is_empty ? cloud_of(Points(), 0) : cloud_of(frame);
        const tools::TruthRow truth = simulator.truth(i);
        cloud.stamp_ns = truth.stamp_ns;
        const JudgedFrame judged{engine.process(cloud), truth, truth};
        expect_within_level(judged, i);
        for (std::uint32_t q = 0; i >= kFresh && q < POSE_WALL_QUANTITIES; ++q) {
          EXPECT_FALSE(judged.is(q, POSE_WALL_VALID)) << "frame " << i;
        }
      }
    }
  }
}

TEST(Sequences, AFrozenSensorIsNoticed) {
  sim::SceneSetup setup = scene("frozen");  // from 1 to 2 s
  const std::vector<JudgedFrame> frames = run_frames(setup, 1, 35);
  const std::uint32_t from = frame_at(setup, setup.sequence.freeze_from_s);
  const std::uint32_t to = frame_at(setup, setup.sequence.freeze_to_s);
  std::uint32_t flagged = 0;
  for (std::uint32_t i = 0; i < frames.size(); ++i) {
    const pose_wall_result& r = frames[i].result;
    const bool flag = (r.frame_reasons & POSE_WALL_R_FROZEN) != 0;
    flagged += flag ? 1U : 0U;
    if (i < from || i > to + 1) {
      EXPECT_FALSE(flag) << i;
    }
    if (flag) {
      for (const pose_wall_value& v : r.quantity) EXPECT_NE(v.state, static_cast<std::uint32_t>(POSE_WALL_VALID)) << i;
    }
    // Two repeats are measured as degraded; after that nothing new is claimed.
    if (i >= from + 4 && i < to) {
      for (const pose_wall_value& v : r.quantity) EXPECT_FALSE(is_live(v)) << i;
    }
  }
  EXPECT_GE(flagged, to - from - 1);
  EXPECT_LE(frames_to_recover(frames, to + 1, POSE_WALL_YAW), kRecoveryFrames);
}

TEST(Sequences, ASuddenTurnIsFollowedByTheLimitAndTold) {
  const sim::SceneSetup setup = scene("turn_step");  // 10 degrees at 1 s
  const std::vector<JudgedFrame> frames = run_frames(setup, 1, 40);
  const std::uint32_t at = frame_at(setup, 1.0);
  double last = frames[0].result.quantity[POSE_WALL_YAW].value;
  for (std::uint32_t i = 1; i < frames.size(); ++i) {
    const pose_wall_value& yaw = frames[i].result.quantity[POSE_WALL_YAW];
    const double behind = std::fabs(yaw.value - yaw.raw), quarter = 0.25 * yaw.raw_protection_level;
    EXPECT_LE(behind, quarter + 1e-9) << i;
    EXPECT_TRUE(std::fabs(yaw.value - last) <= 3.0 * kRadPerDeg + 1e-9 || behind >= quarter - 1e-9) << i;
    last = yaw.value;
    expect_within_level(frames[i], i);
  }
  EXPECT_NE(frames[at].result.quantity[POSE_WALL_YAW].state, static_cast<std::uint32_t>(POSE_WALL_VALID));
  EXPECT_NEAR(frames[at].raw_error(POSE_WALL_YAW), 0.0, 0.2 * kRadPerDeg) << "raw is there at once";
  // Three confirmations, four frames at 3 degrees, and smoothing of 0.3 s into the alert limit.
  EXPECT_LE(frames_to_recover(frames, at, POSE_WALL_YAW), 15U);
}

TEST(Sequences, UnsteadyFrameRatesAreNoFault) {
  for (const JudgedFrame& f : run_frames(scene("jitter"), 1, 25)) {
    EXPECT_EQ(f.result.frame_reasons & (POSE_WALL_R_STAMP_BACK | POSE_WALL_R_STAMP_LEAP | POSE_WALL_R_FROZEN), 0U);
    for (const pose_wall_value& v : f.result.quantity) EXPECT_EQ(v.state, static_cast<std::uint32_t>(POSE_WALL_VALID));
  }
}

TEST(Sequences, PartialFramesClaimNothingWrong) {
  const std::vector<JudgedFrame> frames = run_frames(scene("partial"), 1, 30);
  for (std::uint32_t i = 0; i < frames.size(); ++i) expect_within_level(frames[i], i);
}

// 45 degrees is where a side and the face become ambiguous: right or refused, never swapped.
TEST(Sequences, BeyondTheGreatestYawNothingIsSwapped) {
  for (const double turned : {-58.0, -52.0, -47.0, 47.0, 52.0, 58.0, 75.0, 90.0}) {
    sim::SceneSetup setup = sim::make_setup("turned", "os1-64", false, 1);
    setup.machine.turned_left_deg = turned;
    const JudgedFrame f = run_frames(setup, 1, 1)[0];
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      if (!f.is(q, POSE_WALL_VALID)) continue;
      EXPECT_LE(std::fabs(f.error(q)), f.result.quantity[q].protection_level + 1e-3)
          << turned << " " << pose_wall_quantity_name(q);
    }
  }
}

}  // namespace
}  // namespace pose_wall::test
