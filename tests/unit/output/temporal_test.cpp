// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: states, ages, protection levels and flags follow the specification frame by frame, for measurements, gaps,
// jumps, stale values and stamps that stand still, jump back or leap ahead; and that no NaN stands where a number is
// promised, nor a number where there is none.

#include "engine/output/temporal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/estimation/protection.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr std::int64_t kMs = 1000000;
constexpr double kRoundingS = 1e-9;
const double kSigmas = sigmas_at_risk(1e-6);  // by the default of integrity_risk

// One quantity's life, frame by frame.
class Life {
 public:
  explicit Life(std::initializer_list<test::KeyValue> settings = {}, std::uint32_t quantity = POSE_WALL_D_LF)
      : settings_(test::settings_with(settings)), quantity_(quantity) {}

  pose_wall_value measured(std::int64_t stamp_ms, double raw, double protection = 0.02, bool stale = false) {
    Measurements m;
    Measurement& q = m.quantity[quantity_];
    q.measured = true;
    q.raw = raw;
    q.sigma = protection / 5.0;
    q.protection[POSE_WALL_PART_RANDOM] = protection;
    q.stale = stale;
    return frame(stamp_ms, m);
  }
  // Another plane may be the wall: the level reaches to it.
  pose_wall_value ambiguous(std::int64_t stamp_ms, double raw, double protection) {
    Measurements m;
    Measurement& q = m.quantity[quantity_];
    q.measured = true;
    q.raw = raw;
    q.sigma = 0.004;
    q.protection[POSE_WALL_PART_RANDOM] = protection;
    q.reasons = POSE_WALL_R_WALL_AMBIGUOUS;
    return frame(stamp_ms, m);
  }
  pose_wall_value missing(std::int64_t stamp_ms) {
    Measurements m;
    m.quantity[quantity_].reasons = POSE_WALL_R_WALL_NOT_FOUND;
    return frame(stamp_ms, m);
  }
  void know(const pose_wall_inputs& inputs) { inputs_ = inputs; }
  bool contradicted() const { return contradicted_; }
  const FrameTiming& timing() const { return timing_; }
  const Settings& settings() const { return settings_; }

 private:
  pose_wall_value frame(std::int64_t stamp_ms, const Measurements& m) {
    const std::int64_t stamp = stamp_ms * kMs;
    timing_ = time_frame(state_, stamp, settings_);
    const double elapsed_s = elapsed_of(state_, timing_);
    Change change = change_by_config(settings_, elapsed_s);
    if (inputs_.given != 0) {
      EXPECT_TRUE(change_by_inputs(inputs_, settings_, elapsed_s, &change));
      contradicted_ = contradict(change, m, timing_, state_);
    }
    pose_wall_value values[POSE_WALL_QUANTITIES];
    smooth_and_hold(m, timing_, stamp, change, settings_, &state_, &values);
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      if (q != quantity_) {
        EXPECT_EQ(values[q].state, POSE_WALL_INVALID) << "an untouched quantity came to life";
      }
    }
    check(values[quantity_], m.quantity[quantity_]);
    return values[quantity_];
  }

  static void check(const pose_wall_value& v, const Measurement& m) {
    const bool live = v.state == POSE_WALL_VALID || v.state == POSE_WALL_DEGRADED;
    EXPECT_EQ(live, m.measured);
    EXPECT_EQ(std::isnan(v.raw), !live);
    EXPECT_EQ(v.state == POSE_WALL_INVALID, v.confidence == 0.0);
    EXPECT_GE(v.confidence, 0.0);
    EXPECT_LE(v.confidence, 1.0);
    EXPECT_GE(v.age_s, 0.0);
    if (v.state != POSE_WALL_INVALID) {
      EXPECT_TRUE(std::isfinite(v.value) && std::isfinite(v.sigma) && std::isfinite(v.protection_level));
    }
    if (v.state == POSE_WALL_VALID) {
      EXPECT_EQ(v.reasons & POSE_WALL_R_ALERT_LIMIT, 0U);
    }
    EXPECT_EQ(v.raw_state, live ? v.state : static_cast<std::uint32_t>(POSE_WALL_INVALID));
    check_parts(v, m);
  }

  static void check_parts(const pose_wall_value& v, const Measurement& m) {
    if (std::isnan(v.protection_level)) {
      EXPECT_EQ(v.cause, static_cast<std::uint32_t>(POSE_WALL_PARTS));
      return;
    }
    double sum = 0.0, largest = 0.0;
    for (const double part : v.part) {
      EXPECT_GE(part, 0.0);
      sum += part;
      largest = std::max(largest, part);
    }
    EXPECT_EQ(v.protection_level, sum);
    ASSERT_LT(v.cause, static_cast<std::uint32_t>(POSE_WALL_PARTS));
    EXPECT_EQ(v.part[v.cause], largest);
    if (!m.measured) return;
    EXPECT_NEAR(v.raw_protection_level, sum - v.part[POSE_WALL_PART_LAG], 1e-12);
    EXPECT_GE(v.part[POSE_WALL_PART_LAG], std::fabs(v.value - v.raw));
    EXPECT_LE(v.protection_level, 1.25 * v.raw_protection_level * (1.0 + 1e-12)) << "smoothing widens by a quarter";
  }

  Settings settings_;
  std::uint32_t quantity_;
  TemporalState state_;
  FrameTiming timing_;
  pose_wall_inputs inputs_{};
  bool contradicted_ = false;
};

TEST(Temporal, NeverMeasuredIsInvalidAndHasNoNumber) {
  Life life;
  for (int i = 0; i < 3; ++i) {
    const pose_wall_value v = life.missing(100 * i);
    EXPECT_EQ(v.state, POSE_WALL_INVALID);
    EXPECT_TRUE(std::isnan(v.value) && std::isnan(v.raw) && std::isnan(v.sigma) && std::isnan(v.protection_level));
    EXPECT_NE(v.reasons & POSE_WALL_R_NEVER_MEASURED, 0U);
    EXPECT_NE(v.reasons & POSE_WALL_R_WALL_NOT_FOUND, 0U) << "why it was not measured stays readable";
  }
}

TEST(Temporal, TheFirstMeasurementIsTakenAsItIs) {
  Life life;
  const pose_wall_value v = life.measured(0, 2.5);
  EXPECT_EQ(v.state, POSE_WALL_VALID);
  EXPECT_EQ(v.value, 2.5);
  EXPECT_EQ(v.raw, 2.5);
  EXPECT_EQ(v.age_s, 0.0);
  EXPECT_EQ(v.protection_level, 0.02);
  EXPECT_NEAR(v.confidence, 0.10 / 0.12, 1e-12);
}

// The first look that is not refused is one of several at the same thing, and the others said no.
TEST(Temporal, WhatWasRefusedBeforeItWasEverGoodMustComeAgain) {
  Life life;
  life.missing(0);
  for (int i = 1; i <= 3; ++i) {
    const pose_wall_value v = life.measured(100 * i, 2.5);
    EXPECT_EQ(v.state, POSE_WALL_DEGRADED) << i;
    EXPECT_NE(v.reasons & POSE_WALL_R_INNOVATION, 0U) << i;
    EXPECT_GE(v.protection_level, 0.10) << i << ": no better than the alert limit";
  }
  EXPECT_EQ(life.measured(400, 2.5).state, POSE_WALL_VALID) << "it came three times more";
  EXPECT_EQ(life.missing(500).state, POSE_WALL_HELD);
  EXPECT_EQ(life.measured(600, 2.5).state, POSE_WALL_VALID) << "it had been good";
}

TEST(Temporal, WhatIsRefusedAgainAndAgainOrNeverComesAlikeIsNeverValid) {
  Life now_and_then, never_alike;
  for (int i = 0; i < 40; ++i) {
    const pose_wall_value v = i % 3 == 0 ? now_and_then.missing(100 * i) : now_and_then.measured(100 * i, 2.5);
    EXPECT_NE(v.state, POSE_WALL_VALID) << i;
    const pose_wall_value w = i == 0 ? never_alike.missing(0) : never_alike.measured(100 * i, 2.0 + i % 4);
    EXPECT_NE(w.state, POSE_WALL_VALID) << i;
  }
}

// A level of 0.12 lets smoothing be 0.03 off.
TEST(Temporal, SmoothingFollowsWithTheTimeConstantAndTheLevelCoversTheLag) {
  Life life({{"temporal_smoothing_tau", "0.3"}, {"alert_limit_distance", "1"}});
  for (int i = -20; i <= 0; ++i) life.measured(100 * i, 2.00, 0.12);
  pose_wall_value v{};
  for (int i = 1; i <= 30; ++i) {
    v = life.measured(100 * i, 2.03, 0.12);
    EXPECT_GE(v.value, 2.0);
    EXPECT_LE(v.value, 2.03 + 0.14 * 0.03) << "swings over by e^-2 of the step";
    EXPECT_GE(v.protection_level, std::fabs(v.value - 2.03) + 0.12 - 1e-12);
    if (i == 1) {
      EXPECT_NEAR(v.value, 2.0 + 0.03 * (1 - 0.75 * 0.75), 1e-12) << "g = 1 - theta^2 of theta = 0.3 / 0.4";
    }
  }
  EXPECT_NEAR(v.value, 2.03, 0.0003);
}

TEST(Temporal, ASteadyTurnIsFollowedWithoutLag) {
  Life life({{"alert_limit_angle_deg", "20"}}, POSE_WALL_YAW);
  constexpr double kTurn_rad_s = 0.1;
  pose_wall_value v{};
  std::int64_t ms = 0;
  for (int i = 0; i < 60; ++i) {
    v = life.measured(ms, kTurn_rad_s * 1e-3 * static_cast<double>(ms), 0.2);
    ms += i % 2 == 0 ? 80 : 120;  // by the stamps, not by the frames
  }
  EXPECT_NEAR(v.value, v.raw, 1e-4) << "first order would be 0.03 behind";
}

// The third measurement is as good as any: there is nothing older that it would have to forget.
TEST(Temporal, ATurnIsFollowedFromItsSecondMeasurementOn) {
  Life life({{"alert_limit_angle_deg", "20"}}, POSE_WALL_YAW);
  for (int i = 0; i < 10; ++i) {
    const pose_wall_value v = life.measured(100 * i, 0.01 * i, 0.2);
    EXPECT_NEAR(v.value, v.raw, 1e-12) << i;
  }
}

// Twice as many frames in the same time are smoothed alike.
TEST(Temporal, SmoothingGoesByTheStampsNotByTheFrames) {
  Life slow({{"alert_limit_distance", "2"}}), fast({{"alert_limit_distance", "2"}});
  for (int i = -30; i <= 0; ++i) {
    slow.measured(100 * i, 2.0, 0.4);
    fast.measured(100 * i - 50, 2.0, 0.4);
    fast.measured(100 * i, 2.0, 0.4);
  }
  double by_slow = 0.0, by_fast = 0.0;
  for (int i = 1; i <= 4; ++i) {
    by_slow = slow.measured(100 * i, 2.05, 0.4).value;
    fast.measured(100 * i - 50, 2.05, 0.4);
    by_fast = fast.measured(100 * i, 2.05, 0.4).value;
    EXPECT_NEAR(by_slow, by_fast, 0.05 * 0.2) << i;
  }
}

// Where smoothing would take the level over the alert limit, the value follows raw.
TEST(Temporal, SmoothingTakesNoValidityAway) {
  Life life;
  std::mt19937 random(3);
  life.measured(0, 2.0, 0.09);
  for (int i = 1; i <= 200; ++i) {
    const double raw = 2.0 + 0.1 * static_cast<double>(random() % 1000) / 1000.0;
    const double level = 0.06 + 0.04 * static_cast<double>(random() % 1000) / 1000.0;
    EXPECT_EQ(life.measured(100 * i, raw, level).state, POSE_WALL_VALID) << i << " " << level;
  }
}

TEST(Temporal, WithoutATimeConstantTheValueIsRaw) {
  Life life({{"temporal_smoothing_tau", "0"}});
  life.measured(0, 2.0);
  EXPECT_EQ(life.measured(100, 2.04).value, 2.04);
}

TEST(Temporal, HeldValuesKeepTheirNumberAndLoseConfidence) {
  Life life({{"hold_rate_distance", "0.02"}});
  const pose_wall_value good = life.measured(0, 2.0);
  double last = good.confidence;
  for (int i = 1; i <= 10; ++i) {
    const pose_wall_value v = life.missing(100 * i);
    EXPECT_EQ(v.state, POSE_WALL_HELD);
    EXPECT_EQ(v.value, good.value);
    EXPECT_NEAR(v.age_s, 0.1 * i, kRoundingS);
    EXPECT_NEAR(v.protection_level, good.protection_level + 0.02 * 0.1 * i, 1e-9);
    EXPECT_LT(v.confidence, last);
    EXPECT_NE(v.reasons & POSE_WALL_R_WALL_NOT_FOUND, 0U);
    last = v.confidence;
  }
}

TEST(Temporal, HoldEndsAtTheAlertLimit) {
  Life life({{"hold_rate_distance", "0.1"}, {"hold_max", "60"}});
  life.measured(0, 2.0);
  // 0.02 + 0.1 t passes 0.10 after 0.8 s.
  EXPECT_EQ(life.missing(790).state, POSE_WALL_HELD);
  const pose_wall_value expired = life.missing(820);
  EXPECT_EQ(expired.state, POSE_WALL_INVALID);
  EXPECT_NE(expired.reasons & POSE_WALL_R_HOLD_EXPIRED, 0U);
  EXPECT_EQ(expired.value, 2.0) << "the last number stays readable";
  EXPECT_EQ(expired.confidence, 0.0);
}

TEST(Temporal, HoldEndsAtItsGreatestTime) {
  Life life({{"hold_rate_distance", "0"}, {"hold_max", "1.5"}});
  life.measured(0, 2.0);
  EXPECT_EQ(life.missing(1000).state, POSE_WALL_HELD);
  EXPECT_EQ(life.missing(1490).state, POSE_WALL_HELD);
  EXPECT_EQ(life.missing(1510).state, POSE_WALL_INVALID);
  EXPECT_EQ(life.missing(1520).state, POSE_WALL_INVALID) << "what has expired does not come back by itself";
}

TEST(Temporal, AfterExpiryAMeasurementStartsAfresh) {
  Life life({{"hold_max", "0.5"}});
  life.measured(0, 2.0);
  life.missing(600);
  const pose_wall_value v = life.measured(700, 3.0);
  EXPECT_EQ(v.value, 3.0) << "not smoothed with the value before the gap";
  EXPECT_EQ(v.state, POSE_WALL_DEGRADED) << "but a metre in 0.7 s is to be confirmed";
  EXPECT_NE(v.reasons & POSE_WALL_R_INNOVATION, 0U);
  EXPECT_GE(v.protection_level, 1.0) << "the value before the gap stays possible";
  EXPECT_EQ(v.age_s, 0.0);
  life.measured(800, 3.0);
  life.measured(900, 3.0);
  EXPECT_EQ(life.measured(1000, 3.0).state, POSE_WALL_VALID) << "it came three times more";
}

TEST(Temporal, ADegradedFrameDoesNotLaunderAJump) {
  Life life;
  life.measured(0, 2.0, 0.05);
  life.measured(100, 1.5, 0.6);  // its own level reaches to the old value
  const pose_wall_value v = life.measured(200, 1.5, 0.04);
  EXPECT_EQ(v.state, POSE_WALL_DEGRADED);
  EXPECT_NE(v.reasons & POSE_WALL_R_INNOVATION, 0U);
  EXPECT_GE(v.protection_level, 0.5 - 0.05);
}

TEST(Temporal, HeldIsTheLastGoodValueNotTheDegradedOneAfterIt) {
  Life life;
  life.measured(0, 2.0, 0.05);
  life.measured(100, 2.02, 0.3);
  life.missing(150);
  const pose_wall_value v = life.missing(200);
  EXPECT_EQ(v.state, POSE_WALL_HELD);
  EXPECT_EQ(v.value, 2.0);
  EXPECT_NEAR(v.age_s, 0.2, 1e-9);
}

TEST(Temporal, AClockThatStandsStillDoesNotHoldForEver) {
  Life life;
  life.measured(0, 2.0, 0.02);
  life.measured(100, 2.0, 0.02);
  EXPECT_EQ(life.missing(100).state, POSE_WALL_HELD);
  EXPECT_EQ(life.missing(100).state, POSE_WALL_HELD);
  EXPECT_EQ(life.missing(100).state, POSE_WALL_INVALID);
}

// Nobody knows how much time a frame takes.
TEST(Temporal, AClockThatStandsStillFromTheFirstFrameHoldsNothing) {
  Life life;
  life.measured(0, 2.0, 0.02);
  EXPECT_EQ(life.missing(0).state, POSE_WALL_INVALID);
}

TEST(Temporal, StaleIsDegradedHoweverSmallItsLevel) {
  Life life;
  EXPECT_EQ(life.measured(0, 2.0, 0.001, true).state, POSE_WALL_DEGRADED);
  EXPECT_EQ(life.measured(100, 2.0, 0.001, false).state, POSE_WALL_VALID);
}

TEST(Temporal, BeyondTheAlertLimitIsDegraded) {
  Life life;
  const pose_wall_value v = life.measured(0, 2.0, 0.11);
  EXPECT_EQ(v.state, POSE_WALL_DEGRADED);
  EXPECT_NE(v.reasons & POSE_WALL_R_ALERT_LIMIT, 0U);
}

TEST(Temporal, AJumpIsDoubtedUntilItHasComeAgain) {
  Life life({{"hold_rate_distance", "0.2"}});
  for (int i = 0; i < 10; ++i) EXPECT_EQ(life.measured(100 * i, 2.0).state, POSE_WALL_VALID);
  const pose_wall_value jumped = life.measured(1000, 2.8);
  EXPECT_NE(jumped.state, POSE_WALL_VALID);
  EXPECT_NE(jumped.reasons & POSE_WALL_R_INNOVATION, 0U);
  // The old value may be the true one: the level reaches to it.
  EXPECT_GE(jumped.protection_level, std::fabs(jumped.value - 2.0));
  int valid_after = -1;
  for (int i = 1; i <= 30 && valid_after < 0; ++i) {
    if (life.measured(1000 + 100 * i, 2.8).state == POSE_WALL_VALID) valid_after = i;
  }
  EXPECT_GE(valid_after, 3);
  EXPECT_LE(valid_after, 15) << "recovery in a few good frames";
}

// Whether the jump was one is not known while nothing is seen: a hold forgets neither side of it.
TEST(Temporal, AHoldAfterAJumpReachesToBothSides) {
  Life life({{"hold_rate_distance", "0.2"}, {"alert_limit_distance", "1"}});
  for (int i = 0; i < 10; ++i) life.measured(100 * i, 2.0);
  double level = life.measured(1000, 2.3).protection_level;
  for (int i = 1; i <= 3; ++i) {
    const pose_wall_value held = life.missing(1000 + 100 * i);
    ASSERT_EQ(held.state, POSE_WALL_HELD);
    EXPECT_GT(held.protection_level, level) << "grows";
    EXPECT_LE(std::fabs(held.value - 2.0), held.protection_level);
    EXPECT_LE(std::fabs(held.value - 2.3), held.protection_level);
    level = held.protection_level;
  }
}

TEST(Temporal, ARivalStaysInTheLevelUntilThreeFramesShowNone) {
  Life life;
  for (int i = 0; i < 10; ++i) life.measured(100 * i, 2.0);
  EXPECT_EQ(life.ambiguous(1000, 2.0, 0.6).state, POSE_WALL_DEGRADED);
  for (int i = 1; i <= 3; ++i) {
    const pose_wall_value v = life.measured(1000 + 100 * i, 2.0);
    EXPECT_EQ(v.state, POSE_WALL_DEGRADED) << i;
    EXPECT_GE(v.protection_level, 0.6) << i;
    EXPECT_NE(v.reasons & POSE_WALL_R_WALL_AMBIGUOUS, 0U) << i;
  }
  const pose_wall_value after = life.measured(1400, 2.0);
  EXPECT_EQ(after.state, POSE_WALL_VALID);
  EXPECT_EQ(after.reasons & POSE_WALL_R_WALL_AMBIGUOUS, 0U);
}

// The smaller one answers nothing about the larger one.
TEST(Temporal, ASmallRivalDoesNotHideALargeOneThatWasSeen) {
  Life life;
  life.measured(0, 2.0);
  life.ambiguous(100, 2.0, 1.0);
  for (int i = 2; i < 5; ++i) {
    const pose_wall_value v = life.ambiguous(100 * i, 2.0, 0.05);
    EXPECT_EQ(v.state, POSE_WALL_DEGRADED) << i;
    EXPECT_GE(v.protection_level, 1.0) << i;
  }
  for (int i = 5; i < 40; ++i) {
    const pose_wall_value v = life.ambiguous(100 * i, 2.0, 0.05);
    EXPECT_EQ(v.state, POSE_WALL_VALID) << i << ": the small one alone, within the alert limit";
    EXPECT_EQ(v.reasons & POSE_WALL_R_WALL_AMBIGUOUS, 0U) << "its level holds the doubt";
    EXPECT_LT(v.protection_level, 0.1) << i << ": and it does not grow";
  }
}

TEST(Temporal, ARivalThatFlickersIsDoubtedThroughout) {
  Life life;
  for (int i = 0; i < 40; ++i) {
    const bool seen = i % 3 == 0;
    const pose_wall_value v = seen ? life.ambiguous(100 * i, 2.0, 0.6) : life.measured(100 * i, 2.0);
    EXPECT_EQ(v.state, POSE_WALL_DEGRADED) << i;
    EXPECT_GE(v.protection_level, 0.6) << i;
  }
}

TEST(Temporal, AJumpThereAndBackIsNeverValidWhereItIsWrong) {
  Life life({{"hold_rate_distance", "0.2"}});
  for (int i = 0; i < 10; ++i) life.measured(100 * i, 2.0);
  for (int i = 10; i < 40; ++i) {
    const bool wrong = i % 5 == 0;
    const pose_wall_value v = life.measured(100 * i, wrong ? 2.8 : 2.0);
    if (v.state == POSE_WALL_VALID) {
      EXPECT_LE(std::fabs(v.value - 2.0), v.protection_level);
    }
  }
}

TEST(Temporal, YawFollowsByItsLimitPerFrameWithinAQuarterOfItsLevel) {
  constexpr double kDeg = M_PI / 180.0;
  for (const double level_deg : {16.0, 0.5}) {
    Life life({{"yaw_rate_limit_deg", "3"}, {"temporal_smoothing_tau", "0"}, {"alert_limit_angle_deg", "20"}},
              POSE_WALL_YAW);
    life.measured(0, 0.0, level_deg * kDeg);
    const pose_wall_value v = life.measured(100, 5.0 * kDeg, level_deg * kDeg);
    EXPECT_EQ(v.raw, 5.0 * kDeg) << "raw is untouched";
    EXPECT_LE(v.raw - v.value, 0.25 * v.raw_protection_level + 1e-12);
    const bool has_room = level_deg > 8.0;
    EXPECT_EQ((v.reasons & POSE_WALL_R_RATE_LIMITED) != 0, has_room) << level_deg;
    if (has_room) {
      EXPECT_NEAR(v.value, 3.0 * kDeg, 1e-12);
    }
    const pose_wall_value next = life.measured(200, 5.0 * kDeg, level_deg * kDeg);
    EXPECT_NEAR(next.value, 5.0 * kDeg, 1e-12);
    EXPECT_EQ(next.reasons & POSE_WALL_R_RATE_LIMITED, 0U);
  }
}

pose_wall_inputs inputs_of(std::uint32_t given, double speed_m_s = 0.0, double turn_rate_rad_s = 0.0) {
  pose_wall_inputs inputs{};
  inputs.struct_size = sizeof inputs;
  inputs.given = given;
  inputs.speed_m_s = speed_m_s;
  inputs.turn_rate_rad_s = turn_rate_rad_s;
  inputs.speed_sigma_m_s = inputs.turn_rate_sigma_rad_s = 0.001;
  return inputs;
}

TEST(TemporalInputs, WhatStandsStillDoesNotAge) {
  Life life;
  const pose_wall_value good = life.measured(0, 2.0);
  life.know(inputs_of(POSE_WALL_INPUT_STANDING));
  pose_wall_value held{};
  for (int i = 1; i <= 15; ++i) held = life.missing(100 * i);
  EXPECT_EQ(held.state, POSE_WALL_HELD);
  EXPECT_EQ(held.protection_level, good.protection_level);
  EXPECT_NEAR(held.age_s, 1.5, kRoundingS);
  EXPECT_EQ(life.missing(2100).state, POSE_WALL_INVALID) << "hold_max stays";
}

TEST(TemporalInputs, AHeldYawTurnsWithTheMachine) {
  Life life({}, POSE_WALL_YAW);
  life.measured(0, 0.10, 0.005);
  life.know(inputs_of(POSE_WALL_INPUT_TURN_RATE, 0.0, 0.2));
  const pose_wall_value held = life.missing(500);
  EXPECT_EQ(held.state, POSE_WALL_HELD);
  EXPECT_NEAR(held.value, 0.10 - 0.2 * 0.5, 1e-12) << "a turn to the left makes yaw smaller";
  EXPECT_NEAR(held.part[POSE_WALL_PART_AGE], kSigmas * 0.001 * 0.5, 1e-12);
  const pose_wall_value again = life.measured(600, 0.10 - 0.2 * 0.6, 0.005);
  EXPECT_EQ(again.state, POSE_WALL_VALID);
  EXPECT_FALSE(life.contradicted());
}

TEST(TemporalInputs, ADistanceChangesNoFasterThanItsSamplingPoint) {
  Life life;
  life.measured(0, 2.0);
  life.know(inputs_of(POSE_WALL_INPUT_SPEED | POSE_WALL_INPUT_TURN_RATE, 0.05, 0.0));
  EXPECT_NEAR(life.missing(1000).part[POSE_WALL_PART_AGE], 0.05 + kSigmas * 0.001 + 2.0 * kSigmas * 0.001, 1e-12);
}

TEST(TemporalInputs, WhatIsMeasuredSpeaksAgainstThem) {
  Life life;
  life.measured(0, 2.0);
  life.know(inputs_of(POSE_WALL_INPUT_STANDING));
  life.measured(100, 2.03);
  EXPECT_FALSE(life.contradicted()) << "two levels of 0.02 bridge it";
  life.measured(200, 2.09);
  EXPECT_TRUE(life.contradicted());
}

TEST(TemporalInputs, ThoseThatContradictEachOtherOrAreNoNumbersAreRefused) {
  const Settings settings = test::settings_with();
  const auto refused = [&](const pose_wall_inputs& inputs) {
    constexpr double kElapsed_s = 0.1;
    Change change = change_by_config(settings, kElapsed_s);
    const Change before = change;
    const bool sound = change_by_inputs(inputs, settings, kElapsed_s, &change);
    if (!sound) {
      EXPECT_EQ(change.growth[0], before.growth[0]);
    }
    return !sound;
  };
  EXPECT_FALSE(refused(inputs_of(POSE_WALL_INPUT_STANDING | POSE_WALL_INPUT_SPEED, 0.004)));
  EXPECT_TRUE(refused(inputs_of(POSE_WALL_INPUT_STANDING | POSE_WALL_INPUT_SPEED, 0.3)));
  EXPECT_TRUE(refused(inputs_of(POSE_WALL_INPUT_STANDING | POSE_WALL_INPUT_TURN_RATE, 0.0, -0.3)));
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinite, -infinite, 51.0, -51.0}) {
    EXPECT_TRUE(refused(inputs_of(POSE_WALL_INPUT_SPEED, bad))) << bad;
    EXPECT_FALSE(refused(inputs_of(POSE_WALL_INPUT_TURN_RATE, bad))) << "what is not given is not read";
  }
  for (const double bad : {nan, infinite, 0.0, -0.1}) {
    pose_wall_inputs inputs = inputs_of(POSE_WALL_INPUT_TURN_RATE, 0.0, 0.1);
    inputs.turn_rate_sigma_rad_s = bad;
    EXPECT_TRUE(refused(inputs)) << bad;
  }
}

TEST(Temporal, OtherAnglesAreNotLimited) {
  Life life({{"yaw_rate_limit_deg", "3"}, {"temporal_smoothing_tau", "0"}}, POSE_WALL_ROLL);
  life.measured(0, 0.0, 0.005);
  EXPECT_EQ(life.measured(100, 0.2, 0.005).value, 0.2);
}

TEST(TemporalStamps, FlagsOfTheFrame) {
  Life life({{"stamp_gap_max", "1.0"}});
  life.measured(1000, 2.0);
  EXPECT_TRUE(life.timing().first);
  life.measured(1100, 2.0);
  EXPECT_EQ(life.timing().reasons, 0U);
  EXPECT_NEAR(life.timing().dt_s, 0.1, kRoundingS);
  life.missing(1100);
  EXPECT_EQ(life.timing().reasons, static_cast<std::uint32_t>(POSE_WALL_R_STAMP_STILL));
  life.measured(600, 2.0);
  EXPECT_EQ(life.timing().reasons, static_cast<std::uint32_t>(POSE_WALL_R_STAMP_BACK));
  life.measured(1599, 2.0);
  EXPECT_EQ(life.timing().reasons, 0U);
  life.measured(2700, 2.0);
  EXPECT_EQ(life.timing().reasons, static_cast<std::uint32_t>(POSE_WALL_R_STAMP_LEAP));
}

// A machine moves on while its clock stands still.
TEST(TemporalStamps, StandingStillAgesByTheUsualPeriod) {
  Life life;
  life.measured(0, 2.0);
  life.missing(100);
  EXPECT_NEAR(life.missing(100).age_s, 0.2, kRoundingS);
  EXPECT_NEAR(life.missing(100).age_s, 0.3, kRoundingS);
  EXPECT_NEAR(life.missing(400).age_s, 0.6, kRoundingS);
  Life first;
  first.measured(0, 2.0);
  const pose_wall_value unknown = first.missing(0);
  EXPECT_EQ(unknown.age_s, 0.0) << "no period is known yet";
  EXPECT_NE(unknown.reasons & POSE_WALL_R_HOLD_EXPIRED, 0U);
  Life leapt;  // further than stamp_gap_max: that is no period
  leapt.measured(0, 2.0);
  leapt.measured(2000, 2.0);
  EXPECT_EQ(leapt.missing(2000).state, POSE_WALL_INVALID);
}

// The clock stops within the second period: two have gone by when the same stamp comes again.
TEST(TemporalStamps, StandingStillMakesUpForThePeriodItCutShort) {
  Life life;
  life.measured(0, 2.0);
  life.measured(100, 2.0);
  life.missing(130);
  EXPECT_NEAR(life.missing(130).age_s, 0.2, kRoundingS);
  EXPECT_NEAR(life.missing(130).age_s, 0.3, kRoundingS);
}

TEST(TemporalStamps, ALongPauseBeforeIsForgotten) {
  Life life;
  life.measured(0, 2.0);
  for (const int ms : {900, 1000, 1100}) life.measured(ms, 2.0);
  EXPECT_NEAR(life.missing(1100).age_s, 0.1, kRoundingS);
}

TEST(TemporalStamps, BackEndsWhatIsHeldAndRestartsWhatIsMeasured) {
  Life held;
  held.measured(5000, 2.0);
  const pose_wall_value v = held.missing(1000);
  EXPECT_EQ(v.state, POSE_WALL_INVALID) << "nobody knows how old it is";
  EXPECT_GE(v.age_s, 0.0);
  Life live;
  live.measured(5000, 2.0);
  const pose_wall_value again = live.measured(1000, 2.2);
  EXPECT_EQ(again.value, 2.2) << "nothing from before is mixed in";
  EXPECT_EQ(again.age_s, 0.0);
  EXPECT_EQ(live.missing(1100).state, POSE_WALL_HELD) << "ages go on from the new stamp";
}

TEST(TemporalStamps, ALeapStartsSmoothingAfresh) {
  Life life({{"stamp_gap_max", "1.0"}});
  life.measured(0, 2.0);
  EXPECT_EQ(life.measured(30000, 2.4).value, 2.4);
}

// A rival that was seen before a leap, or frames that were refused, are of another place.
TEST(TemporalStamps, ALeapStartsDoubtsAndConfirmationsAfresh) {
  Life doubted({{"stamp_gap_max", "1.0"}});
  doubted.ambiguous(0, 2.0, 9.0);
  EXPECT_NE(doubted.measured(100, 2.0).state, POSE_WALL_VALID) << "the rival is not forgotten so soon";
  EXPECT_EQ(doubted.measured(30000, 2.4).state, POSE_WALL_VALID);
  Life refused({{"stamp_gap_max", "1.0"}});
  refused.missing(0);
  EXPECT_NE(refused.measured(100, 2.0).state, POSE_WALL_VALID) << "one of several looks at the same thing";
  EXPECT_EQ(refused.measured(30000, 2.4).state, POSE_WALL_VALID);
}

TEST(TemporalStamps, ALeapWhileHeldExpires) {
  Life life;
  life.measured(0, 2.0);
  EXPECT_EQ(life.missing(3600 * 1000).state, POSE_WALL_INVALID);
}

TEST(TemporalStamps, TheGreatestStampsDoNotOverflow) {
  const Settings settings = test::settings_with();
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min(),
                         kMost = std::numeric_limits<std::int64_t>::max();
  for (const auto& [from, to] :
       {std::pair(kLeast, kMost), std::pair(kMost, kLeast), std::pair(std::int64_t{0}, kLeast)}) {
    TemporalState state;
    state.has_stamp = true;
    state.stamp_ns = from;
    const FrameTiming t = time_frame(state, to, settings);
    EXPECT_TRUE(std::isfinite(t.dt_s));
    EXPECT_EQ(t.back, to < from);
    EXPECT_EQ(t.leap, to > from);
  }
}

// Whatever comes: the checks inside Life hold in every frame, and a valid value is never far from every measurement.
TEST(Temporal, ARandomLifeKeepsItsPromises) {
  std::mt19937 random(7);
  const auto upto = [&](double most) { return most * static_cast<double>(random() % 1000) / 1000.0; };
  for (int run = 0; run < 200; ++run) {
    Life life({{"hold_max", "1.0"}}, static_cast<std::uint32_t>(run % POSE_WALL_QUANTITIES));
    std::int64_t stamp = 0;
    for (int i = 0; i < 60; ++i) {
      const std::int64_t steps[] = {100, 100, 100, 50, 0, -300, 5000};
      stamp += steps[random() % 7];
      if (random() % 3 == 0) {
        life.missing(stamp);
      } else {
        const double raw = upto(1.0);
        life.measured(stamp, raw, upto(0.2), random() % 5 == 0);
      }
    }
  }
}

}  // namespace
}  // namespace pose_wall
