// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/output/temporal_motion.hpp"

#include <cmath>

#include "base/math/finite.hpp"

namespace pose_wall {
namespace {

struct Known {
  bool given = false;
  double rate = 0.0;
  double uncertain = 0.0;  // protection_sigmas standard deviations

  double most() const { return std::fabs(rate) + uncertain; }
};

// False if it is given and not a number within its range.
bool read_known(bool given, double rate, double sigma, double most, const Settings& s, Known* known) {
  if (!given) return true;
  *known = {true, rate, s.protection_sigmas * sigma};
  return rate >= -most && rate <= most && sigma > 0.0 && sigma <= most;
}

bool contradicts_standing(const Known& known) {
  return known.given && !(std::fabs(known.rate) <= known.uncertain);
}

// A machine that turns left by an angle reports a yaw smaller by it.
void turn_yaw(const Known& turn, double elapsed_s, Change* change) {
  const double unknown = turn.uncertain * elapsed_s;
  if (!turn.given || !(unknown < change->growth[POSE_WALL_YAW])) return;
  change->growth[POSE_WALL_YAW] = unknown;
  change->carry[POSE_WALL_YAW] = -turn.rate * elapsed_s;
}

// A distance changes no faster than its sampling point moves.
void slow_distances(const Known& speed, const Known& turn, const Settings& s, double elapsed_s, Change* change) {
  if (!speed.given || !turn.given) return;
  const double reach_m = larger(std::fabs(s.s_front), std::fabs(s.s_back)) +
                         larger(std::fabs(s.lateral_offset_left), std::fabs(s.lateral_offset_right));
  const double most_m = (speed.most() + reach_m * turn.most()) * elapsed_s;
  for (int q = POSE_WALL_D_LF; q <= POSE_WALL_D_RB; ++q) {
    if (most_m < change->growth[q]) change->growth[q] = most_m;
  }
}

}  // namespace

double Unknown::total() const {
  return sum + place_level_then + place_level + std::sqrt(drift2);
}

// Steps by places continue while every frame has one. A step without a place ends them, and the unknown change until
// then adds up with the next ones.
void Unknown::grow(const Change& by, std::uint32_t q, double elapsed_s) {
  if (!by.by_places[q]) {
    blind_s += elapsed_s;
    sum = total() + by.growth[q];
    drift2 = place_level_then = place_level = 0.0;
    steps_by_places = 0;
    return;
  }
  if (steps_by_places++ == 0) place_level_then = by.place_level_before[q];
  place_level = by.place_level[q];
  drift2 += by.drift2[q];
  sum += by.growth[q];
}

Change change_by_config(const Settings& s, double elapsed_s) {
  Change change;
  if (!(elapsed_s > 0.0)) return change;
  for (int q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    change.growth[q] = elapsed_s * (q <= POSE_WALL_YAW ? s.hold_rate_angle : s.hold_rate_distance);
  }
  return change;
}

bool change_by_inputs(const pose_wall_inputs& in, const Settings& s, double elapsed_s, Change* change) {
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
    *change = Change{};
    return true;
  }
  if (!(elapsed_s > 0.0)) return true;
  turn_yaw(turn, elapsed_s, change);
  slow_distances(speed, turn, s, elapsed_s, change);
  return true;
}

}  // namespace pose_wall
