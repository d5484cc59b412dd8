// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/map/cell_model.hpp"

#include <cmath>

#include "base/math/elementary.hpp"

namespace pose_wall::planar {
namespace {

int steps_of(double probability) {
  return static_cast<int>(std::floor(kStepsOfLogOdds * natural_log(probability / (1.0 - probability)) + 0.5));
}

std::uint8_t moved(int value, int steps, int least, int most) {
  const int from = value == kNeverSeen ? int{kEvenOdds} : value;
  const int to = from + steps;
  const int inside = to < least ? least : to > most ? most : to;
  return static_cast<std::uint8_t>(inside | kTouched);
}

}  // namespace

std::uint8_t sum_of(const CellModel& model, std::uint8_t a, std::uint8_t b) {
  if (a == kNeverSeen || b == kNeverSeen) return static_cast<std::uint8_t>(a + b);
  return static_cast<std::uint8_t>(moved(a, b - kEvenOdds, model.least, model.most) & kValueMost);
}

double probability_of(std::uint8_t value) {
  const double log_odds = (static_cast<double>(value) - kEvenOdds) / kStepsOfLogOdds;
  return 1.0 / (1.0 + exponential(-log_odds));
}

CellModel::CellModel(const pose_wall_planar_map_settings& settings) {
  least = static_cast<std::uint8_t>(kEvenOdds + steps_of(settings.least_probability));
  most = static_cast<std::uint8_t>(kEvenOdds + steps_of(settings.most_probability));
  const int up = steps_of(settings.hit_probability), down = steps_of(settings.miss_probability);
  thing_from = static_cast<std::uint8_t>(kEvenOdds + steps_of(settings.occupied_probability));
  free_up_to = static_cast<std::uint8_t>(kEvenOdds + steps_of(settings.free_probability));
  for (int value = 0; value < 128; ++value) {
    hit[value] = moved(value, up, least, most);
    miss[0][value] = moved(value, down, least, most);
    miss[1][value] = value < thing_from ? miss[0][value] : static_cast<std::uint8_t>(value);
    const int touched = value | kTouched;
    hit[touched] = miss[0][touched] = miss[1][touched] = static_cast<std::uint8_t>(touched);
    const double probability = probability_of(static_cast<std::uint8_t>(value));
    per_cent[value] = static_cast<std::int8_t>(std::floor(100.0 * probability + 0.5));
  }
  per_cent[kNeverSeen] = POSE_WALL_PLANAR_UNKNOWN;
}

}  // namespace pose_wall::planar
