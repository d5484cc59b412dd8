// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Named scenes: what the road holds, and from which ranges its sizes may be drawn.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lab/sim/setup.hpp"

namespace pose_wall::tools::sim {

struct SceneValue {
  const char* key;
  const char* fixed;  // without --random
  double low;         // with it: uniform between these; words by their index, counts are rounded
  double high;
  bool either_sign = false;  // the drawn number may also be negated
};

struct NominalRange {
  const char* key;
  double low;
  double high;
};

// A mine's scene is an ordinary road with rock as it was measured. It has two truths: that of the road as a whole, and
// that of what is really there (survey_truth.hpp). In a nominal scene, short-waved rock on ideal planes, the
// estimator's statistics must be exactly true. An adversarial one is made to mislead. In an unobservable one the data
// of a single sensor cannot tell that anything is wrong: nothing is to be concluded from its errors.
enum class SceneKind { kMine, kNominal, kAdversarial, kUnobservable };
const char* scene_kind_name(SceneKind kind);

struct SceneChoice {
  const char* name;
  SceneKind kind;
  const char* help;
  const char* expected;  // what a good instrument does in it
  std::vector<SceneValue> values;
};

const std::vector<SceneChoice>& scenes();
// What stands for a real road, which is no scene of the table.
const SceneChoice& surveyed_scene();
// nullptr if there is none of this name.
const SceneChoice* find_scene(std::string_view name);

// Ranges that --random draws the road's and the machine's nominal numbers from, before those of the scene.
const std::vector<NominalRange>& nominal_ranges();

void apply_scene(Setup& setup, const SceneChoice& scene);
// Deterministic in the seed. Sizes that cannot go together are drawn again.
void apply_scene_at_random(Setup& setup, const SceneChoice& scene, std::uint64_t seed);

// Both by name; throw std::invalid_argument for unknown names, with the nearest one. The random draw is made when
// random is true.
Setup make_setup(std::string_view scene, std::string_view sensor, bool random, std::uint64_t seed);
// Of a scene that is not in the table.
Setup make_setup(const SceneChoice& scene, std::string_view sensor, bool random, std::uint64_t seed);

}  // namespace pose_wall::tools::sim
