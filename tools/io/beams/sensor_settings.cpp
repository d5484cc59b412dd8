// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/beams/sensor_settings.hpp"

#include <cstddef>

#include "io/beams/beam_table.hpp"

namespace pose_wall::tools {
namespace {

// Largest range bias by the makers' documents, which config/README.md lists. No scene draws a larger one.
constexpr const char* kBiasMost_m = "0.03";

// As in config/; a test compares them.
std::vector<EngineSetting> few_points(const char* ground_roi_radius_max, const char* range_noise) {
  return {
      {"outlier_radius", "0.40"},   {"outlier_min_neighbors", "2"}, {"ground_roi_radius_max", ground_roi_radius_max},
      {"ground_inlier_min", "150"}, {"wall_inlier_min", "250"},     {"range_bias_max", kBiasMost_m},
      {"range_noise", range_noise}};
}

std::vector<EngineSetting> more_points() {
  return {{"ground_inlier_min", "400"}, {"range_bias_max", kBiasMost_m}, {"range_noise", "0.015"}};
}

std::vector<EngineSetting> many_points() {
  return {{"range_bias_max", kBiasMost_m}};
}

// As of the class that has as many rings. The lowest laser of a Puck Hi-Res meets the floor only at 5.7 times the
// sensor's height: of a sensor 2 m high, three of its rings lie within 20 m, and two within 15 m.
std::vector<EngineSetting> settings_of_table(const BeamTable& table) {
  constexpr double kLooksFar_deg = -12.0;  // between the lowest lasers of a Puck and of a Hi-Res
  const std::size_t rings = table.lasers.size();
  if (rings <= 16) return few_points(table.lowest_deg() > kLooksFar_deg ? "20.0" : "15.0", "0.015");
  return rings <= 64 ? more_points() : many_points();
}

}  // namespace

std::vector<EngineSetting> engine_settings_of(std::string_view sensor) {
  if (sensor == "vlp16") return few_points("15.0", "0.015");
  if (sensor == "os1-64") return more_points();
  if (sensor == "os0-128") return many_points();
  if (sensor == "mid360") return few_points("20.0", "0.02");
  for (const BeamTable* const table : beam_tables()) {
    if (table->word == sensor) return settings_of_table(*table);
  }
  return {};
}

}  // namespace pose_wall::tools
