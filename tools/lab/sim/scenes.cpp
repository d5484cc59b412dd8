// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "io/terminal/did_you_mean.hpp"
#include "lab/sim/check_setup.hpp"
#include "lab/sim/parameters.hpp"
#include "lab/sim/random.hpp"
#include "lab/sim/scene_rows.hpp"
#include "lab/sim/sensors.hpp"

namespace pose_wall::tools::sim {
namespace {

constexpr int kDraws = 200;

const Parameter& parameter(const char* key) {
  const Parameter* const p = find_parameter(key);
  if (p == nullptr) throw std::logic_error(std::string("the table of scenes names the unknown key ") + key);
  return *p;
}

bool is_whole(const Parameter& p) {
  return *p.words != '\0' || std::string_view(p.name).find("_count") != std::string_view::npos;
}

void draw(Setup& setup, const char* key, double low, double high, bool either_sign, Random& random) {
  const Parameter& p = parameter(key);
  const double drawn =
      is_whole(p) ? low + std::floor(random.uniform() * (high - low + 1.0)) : random.uniform(low, high);
  const bool negate = either_sign && random.chance(0.5);
  p.field(setup) = std::clamp(negate ? -drawn : drawn, p.minimum, p.maximum);
}

[[noreturn]] void unknown(const char* what, std::string_view name, const std::vector<std::string>& known) {
  throw std::invalid_argument(std::string("unknown ") + what + " '" + std::string(name) + "'" +
                              did_you_mean(name, known) + "; `pose_wall sim --list` shows them all");
}

}  // namespace

const std::vector<NominalRange>& nominal_ranges() {
  static const std::vector<NominalRange> ranges = {
      {"width_m", 3.8, 6.5},       {"height_m", 2.8, 4.5},           {"base_height_m", 1.0, 1.8},
      {"lateral_m", -0.6, 0.6},    {"turned_left_deg", -12.0, 12.0}, {"roll_deg", -5.0, 5.0},
      {"pitch_deg", -5.0, 5.0},    {"speed_mps", -0.3, 0.3},         {"turn_rate_dps", -1.0, 1.0},
      {"sway_roll_deg", 0.0, 0.5}, {"sway_pitch_deg", 0.0, 0.5},     {"sway_period_s", 2.0, 6.0},
  };
  return ranges;
}

const char* scene_kind_name(SceneKind kind) {
  switch (kind) {
    case SceneKind::kMine:
      return "mine";
    case SceneKind::kNominal:
      return "nominal";
    case SceneKind::kAdversarial:
      return "adversarial";
    case SceneKind::kUnobservable:
      return "unobservable";
  }
  return "";
}

const std::vector<SceneChoice>& scenes() {
  static const std::vector<SceneChoice> table = [] {
    std::vector<SceneChoice> all;
    for (const auto& part : {mines_scenes(), walls_scenes(), along_scenes(), openings_scenes(), floors_scenes(),
                             air_scenes(), machine_scenes(), sensor_scenes()}) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }();
  return table;
}

const SceneChoice* find_scene(std::string_view name) {
  for (const SceneChoice& scene : scenes()) {
    if (scene.name == name) return &scene;
  }
  return nullptr;
}

const SceneChoice& surveyed_scene() {
  static const SceneChoice surveyed{"surveyed", SceneKind::kMine, "a real road", "as the road is", {}};
  return surveyed;
}

void apply_scene(Setup& setup, const SceneChoice& scene) {
  for (const SceneValue& value : scene.values) set_parameter(setup, value.key, value.fixed);
}

void apply_scene_at_random(Setup& setup, const SceneChoice& scene, std::uint64_t seed) {
  Random random(seed, 0x5ce7e);
  for (int i = 0; i < kDraws; ++i) {
    Setup drawn = setup;
    for (const NominalRange& r : nominal_ranges()) draw(drawn, r.key, r.low, r.high, false, random);
    for (const SceneValue& v : scene.values) draw(drawn, v.key, v.low, v.high, v.either_sign, random);
    try {
      setup = checked(drawn);
      return;
    } catch (const std::invalid_argument&) {
      if (i + 1 == kDraws) throw;
    }
  }
}

Setup make_setup(const SceneChoice& scene, std::string_view sensor, bool random, std::uint64_t seed) {
  const SensorModel* const model = find_sensor(sensor);
  if (model == nullptr) unknown("sensor", sensor, sensor_names());
  Setup setup;
  setup.sensor = model->sensor;
  setup.mount.mount_roll_deg = model->mount_roll_deg;
  if (random) {
    apply_scene_at_random(setup, scene, seed);
  } else {
    apply_scene(setup, scene);
  }
  return setup;
}

Setup make_setup(std::string_view scene, std::string_view sensor, bool random, std::uint64_t seed) {
  const SceneChoice* const choice = find_scene(scene);
  if (choice == nullptr) {
    std::vector<std::string> names;
    for (const SceneChoice& s : scenes()) names.emplace_back(s.name);
    unknown("scene", scene, names);
  }
  return make_setup(*choice, sensor, random, seed);
}

}  // namespace pose_wall::tools::sim
