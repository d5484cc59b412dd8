// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "planar/encounter/draw.hpp"

namespace {

using pose_wall::default_settings;
using pose_wall::Span;
using namespace pose_wall::planar;
using pose_wall::test::Draw;

constexpr double kReaction_s = 0.8;

Hazard thing_at(double x, double y, double margin_m, double approach_m_s = 0.0) {
  return {static_cast<float>(x),
          static_cast<float>(y),
          static_cast<float>(margin_m),
          static_cast<float>(approach_m_s),
          0.0F,
          0,
          POSE_WALL_PLANAR_STOP_STANDING};
}

std::uint32_t level_with(const Sweep& sweep, const Hazard& hazard) {
  std::int32_t limiting = -1;
  return sweep.highest_level(Span<const Hazard>(&hazard, 1), &limiting);
}

SweepMotion arc(const StopSettings& s, double v, double w) {
  double most = 0.0;
  for (std::uint32_t k = 0; k < s.corners; ++k) {
    most = std::fmax(most, std::hypot(v - w * s.corner_m[k][1], w * s.corner_m[k][0]));
  }
  SweepMotion motion;
  motion.velocity = {v / most, 0.0};
  motion.turn_rad_m = w / most;
  return motion;
}

// The least distance from a convex outline to a point, by its half planes, as the sweep counts it.
double distance(const StopSettings& s, double x, double y, double at_x, double at_y, double yaw) {
  const double dx = x - at_x, dy = y - at_y, c = std::cos(yaw), n = std::sin(yaw);
  const double qx = c * dx + n * dy, qy = c * dy - n * dx;
  double most = -1e9;
  for (std::uint32_t k = 0; k < s.corners; ++k) {
    const double *a = s.corner_m[k], *b = s.corner_m[(k + 1) % s.corners];
    const double ex = b[0] - a[0], ey = b[1] - a[1];
    most = std::fmax(most, (ey * (qx - a[0]) - ex * (qy - a[1])) / std::hypot(ex, ey));
  }
  return most;
}

// visit(x, y, yaw of base) along an arc, in steps of the rim.
template <typename Visit>
void walk(const SweepMotion& motion, double path_m, double step_m, const Visit& visit) {
  double at_x = 0.0, at_y = 0.0, yaw = 0.0;
  const int steps = static_cast<int>(std::ceil(path_m / step_m));
  for (int k = 0; k <= steps; ++k) {
    visit(at_x, at_y, yaw);
    const double step = path_m / std::fmax(steps, 1), middle = yaw + 0.5 * motion.turn_rad_m * step;
    at_x += step * (std::cos(middle) * motion.velocity.x() - std::sin(middle) * motion.velocity.y());
    at_y += step * (std::sin(middle) * motion.velocity.x() + std::cos(middle) * motion.velocity.y());
    yaw += motion.turn_rad_m * step;
  }
}

// The same along a whole arc, in steps of a millimetre of the rim.
double finely(const StopSettings& s, const SweepMotion& motion, double path_m, double x, double y) {
  double least = 1e9;
  walk(motion, path_m, 0.001,
       [&](double at_x, double at_y, double yaw) { least = std::fmin(least, distance(s, x, y, at_x, at_y, yaw)); });
  return least;
}

double path_of(const StopSettings& s, double rim) {
  return rim * kReaction_s + rim * rim / (2.0 * s.deceleration_m_s2);
}

TEST(StopSweep, StraightAheadTheSpeedIsThatOfTheBrakingDistance) {
  const StopSettings settings = default_settings<StopTable>();
  Sweep sweep;
  sweep.open(settings);
  sweep.set_motion(arc(settings, 1.0, 0.0), kReaction_s);
  // 0.5 m to the margin: v 0.8 + v^2 / 2 = 0.5 gives v = 0.481.
  EXPECT_NEAR(sweep.speed_of(level_with(sweep, thing_at(2.25 + 0.5 + 0.2, 0.0, 0.2))), 0.481, 1.0 / kSweepLevels);
  EXPECT_EQ(level_with(sweep, thing_at(2.25 + 0.15, 0.0, 0.2)), 0U);
  EXPECT_EQ(level_with(sweep, thing_at(4.5, 0.0, 0.2)), kSweepLevels);
  EXPECT_EQ(level_with(sweep, thing_at(-2.5, 0.0, 0.2)), kSweepLevels);  // it drives away from it
  EXPECT_EQ(level_with(sweep, thing_at(0.0, 0.7, 0.2)), kSweepLevels);   // along it
}

TEST(StopSweep, OnTheSpotTheTailCounts) {
  const StopSettings settings = default_settings<StopTable>();
  Sweep sweep;
  sweep.open(settings);
  sweep.set_motion(arc(settings, 0.0, 1.0), kReaction_s);
  EXPECT_LT(level_with(sweep, thing_at(-2.0, -0.95, 0.1)), kSweepLevels / 2);  // the tail swings to the right
  EXPECT_LT(level_with(sweep, thing_at(2.0, 0.95, 0.1)), kSweepLevels / 2);    // and the front to the left
  EXPECT_EQ(level_with(sweep, thing_at(0.0, 2.6, 0.1)), kSweepLevels);         // out of its circle
}

// No gap between slices: at the speed that is allowed, footprints in steps of a millimetre keep the margin; and the
// sweep gives away little: three levels more come within 6 cm of it.
TEST(StopSweep, NothingSlipsThroughBetweenSlicesAndLittleIsGivenAway) {
  Draw draw(11);
  std::uint32_t limited = 0, tight = 0;
  for (int k = 0; k < 4000; ++k) {
    StopSettings settings = default_settings<StopTable>();
    pose_wall::planar::set_rectangle(&settings, draw.within(-2.5, -0.5), draw.within(0.5, 2.5), draw.within(-1.0, -0.3),
                                     draw.within(0.3, 1.0));
    Sweep sweep;
    sweep.open(settings);
    const SweepMotion motion = arc(settings, draw.within(-1.0, 1.0), draw.within(-1.0, 1.0));
    sweep.set_motion(motion, kReaction_s);
    const double x = draw.within(-4.0, 4.0), y = draw.within(-3.0, 3.0), margin = draw.within(0.0, 0.3);
    if (distance(settings, x, y, 0.0, 0.0, 0.0) < margin + 0.02) continue;
    const std::uint32_t level = level_with(sweep, thing_at(x, y, margin));
    EXPECT_GE(finely(settings, motion, path_of(settings, sweep.speed_of(level)), x, y), margin - 1e-3) << k;
    if (level == kSweepLevels) continue;
    ++limited;
    const std::uint32_t more = level + 3 < kSweepLevels ? level + 3 : kSweepLevels;
    tight += finely(settings, motion, path_of(settings, sweep.speed_of(more)), x, y) < margin + 0.06 ? 1U : 0U;
  }
  EXPECT_GT(limited, 300U);
  EXPECT_GT(tight, limited * 7 / 10);
}

TEST(StopSweep, WhatMayWalkNeedsRoomForItsWay) {
  const StopSettings settings = default_settings<StopTable>();
  Sweep sweep;
  sweep.open(settings);
  sweep.set_motion(arc(settings, 1.0, 0.0), kReaction_s);
  // 2 m beside the front edge: the machine must stand within 2 / 1.6 = 1.25 s, 0.8 s of which it does not brake.
  EXPECT_NEAR(sweep.speed_of(level_with(sweep, thing_at(2.25, 2.8, 0.2, 1.6))), 0.45, 1.5 / kSweepLevels);
  EXPECT_EQ(level_with(sweep, thing_at(2.25, 1.0, 0.2, 1.6)), 0U);
}

TEST(StopSweep, WhoWalksIsNotTouchedByWhatSlidesAlongOrRecedes) {
  const StopSettings settings = default_settings<StopTable>();
  Sweep sweep;
  sweep.open(settings);
  sweep.set_motion(arc(settings, 1.0, 0.0), kReaction_s);
  for (const auto& at : {thing_at(-1.5, 1.0, 0.2, 1.6), thing_at(-3.0, 0.0, 0.2, 1.6)}) {
    EXPECT_EQ(level_with(sweep, at), kSweepLevels);
  }
  // The way that somebody has to walk to the front edge counts from where they are.
  EXPECT_LT(level_with(sweep, thing_at(1.25, 1.0, 0.2, 1.6)), kSweepLevels);
  // Backwards the other edge is the one that touches.
  sweep.set_motion(arc(settings, -1.0, 0.0), kReaction_s);
  EXPECT_EQ(level_with(sweep, thing_at(-3.0, 0.0, 0.2, 1.6)), 0U);
  EXPECT_EQ(level_with(sweep, thing_at(3.0, 0.0, 0.2, 1.6)), kSweepLevels);
  // In a turn to the left the tail swings to the right.
  sweep.set_motion(arc(settings, 1.0, 0.25), kReaction_s);
  EXPECT_EQ(level_with(sweep, thing_at(-2.0, -1.0, 0.2, 1.6)), 0U);
  EXPECT_GT(level_with(sweep, thing_at(-2.0, 1.0, 0.2, 1.6)), 0U);
}

// From points of the rim that move outwards, along a whole arc in steps of a centimetre.
double least_to_advancing(const StopSettings& s, const SweepMotion& motion, double path_m, double x, double y) {
  double least = 1e9;
  walk(motion, path_m, 0.01, [&](double at_x, double at_y, double yaw) {
    const double c = std::cos(yaw), n = std::sin(yaw), qx = c * (x - at_x) + n * (y - at_y);
    const double qy = c * (y - at_y) - n * (x - at_x);
    for (std::uint32_t e = 0; e < s.corners; ++e) {
      const double *a = s.corner_m[e], *b = s.corner_m[(e + 1) % s.corners];
      const double ex = b[0] - a[0], ey = b[1] - a[1];
      for (double share = 0.0; share <= 1.0; share += 0.02) {
        const double px = a[0] + share * ex, py = a[1] + share * ey;
        const double outwards = (ey * (motion.velocity.x() - motion.turn_rad_m * py) -
                                 ex * (motion.velocity.y() + motion.turn_rad_m * px)) /
                                std::hypot(ex, ey);
        if (outwards > 0.01 / s.speed_max_m_s) least = std::fmin(least, std::hypot(qx - px, qy - py));
      }
    }
  });
  return least;
}

TEST(StopSweep, WhoWalksKeepsTheirWayFromAllThatMovesOutwards) {
  Draw draw(12);
  constexpr double kMargin_m = 0.2, kWalks_m_s = 1.6;  // as in the other tests; the default of approach_m_s
  std::uint32_t limited = 0;
  for (int k = 0; k < 400; ++k) {
    const StopSettings settings = default_settings<StopTable>();
    Sweep sweep;
    sweep.open(settings);
    const SweepMotion motion = arc(settings, draw.within(-1.0, 1.0), draw.within(-1.0, 1.0));
    sweep.set_motion(motion, kReaction_s);
    const double x = draw.within(-5.0, 5.0), y = draw.within(-4.0, 4.0);
    const std::uint32_t level = level_with(sweep, thing_at(x, y, kMargin_m, kWalks_m_s));
    if (level == 0) continue;
    limited += level < kSweepLevels ? 1U : 0U;
    const double speed = sweep.speed_of(level), time_s = kReaction_s + speed / settings.deceleration_m_s2;
    EXPECT_GT(least_to_advancing(settings, motion, path_of(settings, speed), x, y), kMargin_m + kWalks_m_s * time_s)
        << k;
  }
  EXPECT_GT(limited, 40U);
}

TEST(StopSweep, WithoutAKnownMotionEveryDirectionCounts) {
  const StopSettings settings = default_settings<StopTable>();
  Sweep sweep;
  sweep.open(settings);
  SweepMotion motion;
  motion.any = true;
  sweep.set_motion(motion, kReaction_s);
  const Hazard standing[] = {thing_at(-3.4, 0.0, 0.2), thing_at(3.4, 0.0, 0.2), thing_at(0.0, 1.9, 0.2)};
  const Hazard walking[] = {thing_at(-4.4, 0.0, 0.2, 1.6), thing_at(4.4, 0.0, 0.2, 1.6), thing_at(0.0, -2.9, 0.2, 1.6)};
  for (const Hazard& at : standing) EXPECT_EQ(level_with(sweep, at), 0U);
  for (const Hazard& at : walking) EXPECT_EQ(level_with(sweep, at), 0U);
  EXPECT_EQ(level_with(sweep, thing_at(4.2, 0.0, 0.2)), kSweepLevels);
}

TEST(StopSweep, ANumberThatIsNoneIsNotClear) {
  const StopSettings settings = default_settings<StopTable>();
  Sweep sweep;
  sweep.open(settings);
  sweep.set_motion(arc(settings, 1.0, 0.1), kReaction_s);
  Hazard hazard = thing_at(4.0, 0.0, 0.2);
  hazard.margin_m = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(level_with(sweep, hazard), 0U);
}

}  // namespace
