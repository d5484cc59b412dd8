// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/temporal_motion.hpp"

#include <cmath>

#include "math/larger.hpp"

namespace pose_wall {
namespace {

// As pose_wall_inputs documents them: what no roadheader does is a wrong unit or a broken sensor.
constexpr double kSpeedMost_m_s = 50.0;
constexpr double kTurnRateMost_rad_s = 10.0;

struct Known {
  bool given = false;
  double rate = 0.0;
  double uncertain = 0.0;  // protection_factor standard deviations

  double most() const { return std::fabs(rate) + uncertain; }
};

// False where it is given and is no number within its range.
bool read_known(bool given, double rate, double sigma, double most, const Settings& s, Known* known) {
  if (!given) return true;
  *known = {true, rate, s.protection_factor * sigma};
  return rate >= -most && rate <= most && sigma > 0.0 && sigma <= most;
}

bool contradicts_standing(const Known& known) {
  return known.given && !(std::fabs(known.rate) <= known.uncertain);
}

// A machine that turns left by an angle reports a yaw that is smaller by it.
void turn_yaw(const Known& turn, MotionRates* rates) {
  if (!turn.given || !(turn.uncertain < rates->growth[POSE_WALL_YAW])) return;
  rates->growth[POSE_WALL_YAW] = turn.uncertain;
  rates->carry[POSE_WALL_YAW] = -turn.rate;
}

// A distance changes no faster than its sampling point moves.
void slow_distances(const Known& speed, const Known& turn, const Settings& s, MotionRates* rates) {
  if (!speed.given || !turn.given) return;
  const double reach_m = larger(std::fabs(s.s_front), std::fabs(s.s_back)) +
                         larger(std::fabs(s.lateral_offset_left), std::fabs(s.lateral_offset_right));
  const double fastest_m_s = speed.most() + reach_m * turn.most();
  for (int q = POSE_WALL_D_LF; q <= POSE_WALL_D_RB; ++q) {
    if (fastest_m_s < rates->growth[q]) rates->growth[q] = fastest_m_s;
  }
}

}  // namespace

MotionRates rates_by_config(const Settings& s) {
  MotionRates rates;
  for (int q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    rates.growth[q] = q <= POSE_WALL_YAW ? s.hold_rate_angle : s.hold_rate_distance;
  }
  return rates;
}

bool rates_by_inputs(const pose_wall_inputs& in, const Settings& s, MotionRates* rates) {
  const bool stands = (in.given & POSE_WALL_INPUT_STANDING) != 0;
  Known speed, turn;
  if (!read_known((in.given & POSE_WALL_INPUT_SPEED) != 0, in.speed_m_s, in.speed_sigma_m_s, kSpeedMost_m_s, s,
                  &speed)) {
    return false;
  }
  if (!read_known((in.given & POSE_WALL_INPUT_TURN_RATE) != 0, in.turn_rate_rad_s, in.turn_rate_sigma_rad_s,
                  kTurnRateMost_rad_s, s, &turn)) {
    return false;
  }
  if (stands && (contradicts_standing(speed) || contradicts_standing(turn))) return false;
  if (stands) {
    *rates = MotionRates{};
    return true;
  }
  turn_yaw(turn, rates);
  slow_distances(speed, turn, s, rates);
  return true;
}

}  // namespace pose_wall
