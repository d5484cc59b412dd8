// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A config that opens, by the bytes of an input.

#pragma once

#include <cmath>

#include "fuzz/fuzz_target.hpp"

namespace pose_wall::test {

inline void set_key(pose_wall_config* config, const char* key, double value) {
  require_ok(pose_wall_config_set_number(config, key, value), key);
}

// Small and quick, for the small scanners of road_from_input.hpp.
inline pose_wall_config small_config_for_fuzzing() {
  pose_wall_config config;
  require_ok(pose_wall_config_init(&config), "init");
  set_key(&config, "points_max", 10000);
  set_key(&config, "outlier_radius", 0.4);
  set_key(&config, "outlier_min_neighbors", 2);
  set_key(&config, "ground_inlier_min", 100);
  set_key(&config, "wall_inlier_min", 150);
  return config;
}

// What would cost memory or time, and nothing else. Everything else is set over the whole of its range.
inline double bounded(const pose_wall_key_info& key, double value) {
  const auto is = [&key](const char* name) { return std::strcmp(key.name, name) == 0; };
  if (is("points_max")) return std::fmin(value, 20000.0);
  if (is("ground_iterations") || is("wall_iterations")) return std::fmin(value, 400.0);
  return value;
}

inline void set_any_box(Input* input, const pose_wall_key_info& key, pose_wall_config* config) {
  char text[160];
  double at[6];
  for (int i = 0; i < 6; i += 2) {
    at[i] = input->between(key.minimum, key.maximum - 1.0);
    at[i + 1] = std::fmin(at[i] + input->between(0.1, 4.0), key.maximum);
  }
  const int length =
      std::snprintf(text, sizeof text, "%.6f %.6f %.6f %.6f %.6f %.6f", at[0], at[1], at[2], at[3], at[4], at[5]);
#ifdef POSE_WALL_MEMORY_SANITIZER
  __msan_unpoison(text, sizeof text);
#endif
  require(length > 0 && length < static_cast<int>(sizeof text), "a box in words");
  require_ok(pose_wall_config_set(config, key.name, text), "box");
}

inline void set_any_key(Input* input, pose_wall_config* config) {
  pose_wall_key_info key;
  require_ok(pose_wall_config_key(input->byte() % pose_wall_config_key_count(), &key), "key");
  if (key.type == POSE_WALL_KEY_BOX) return set_any_box(input, key, config);
  if (key.type == POSE_WALL_KEY_CHOICE) {
    static const char* const kAxes[] = {"+X", "-X", "+Y", "-Y"};
    (void)pose_wall_config_set(config, key.name, kAxes[input->below(4)]);
    return;
  }
  if (key.type == POSE_WALL_KEY_TEXT) return;
  const std::uint8_t share = input->byte();
  double value = key.minimum + (key.maximum - key.minimum) * share / 255.0;
  if (share == 255) value = key.maximum;
  if (key.type == POSE_WALL_KEY_INTEGER) value = std::floor(value);
  const pose_wall_config before = *config;
  require_ok(pose_wall_config_set_number(config, key.name, bounded(key, value)), key.name);
  // Two keys that contradict each other: the later one is not set.
  if (pose_wall_config_check(config, nullptr) != POSE_WALL_OK) *config = before;
}

inline pose_wall_config config_by(Input* input) {
  pose_wall_config config = small_config_for_fuzzing();
  for (std::uint32_t count = input->below(12); count > 0; --count) set_any_key(input, &config);
  return config;
}

}  // namespace pose_wall::test
