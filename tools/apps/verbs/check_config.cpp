// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall check-config: axes, signs, units and values of the settings, before a machine runs on them.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/verbs/verbs.hpp"
#include "io/config_file/config_place.hpp"
#include "io/config_file/key_table.hpp"
#include "io/config_file/load_config.hpp"
#include "io/config_file/resolved_frames.hpp"
#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/numbers/quantities.hpp"
#include "io/terminal/text_table.hpp"
#include "lab/drive/stop_prospect.hpp"
#include "study/info/wide_text.hpp"

namespace pose_wall::tools {
namespace {

struct CheckConfigOptions {
  std::string file;
  std::vector<std::string> settings;
  bool keys = false;
};

std::string range_text(const pose_wall_key_info& key) {
  switch (key.type) {
    case POSE_WALL_KEY_NUMBER:
    case POSE_WALL_KEY_INTEGER:
    case POSE_WALL_KEY_BOX:
      return fmt::format("{:.9g} .. {:.9g}", key.minimum, key.maximum);
    default:
      return key.choices;
  }
}

std::string range_text(const OutsideKey& key) {
  using Type = OutsideKey::Type;
  if (key.type == Type::kNumber || key.type == Type::kInteger) {
    return fmt::format("{:.9g} .. {:.9g}", key.minimum, key.maximum);
  }
  return key.type == Type::kText ? "" : allowed_text(key);
}

void print_values(const LoadedConfig& loaded) {
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const auto& key, const std::string& value) {
    const std::string origin = loaded.origin(key.name);
    const bool is_default = origin == "default";
    rows.push_back({key.name, value, is_default ? std::string(tr("default")) : origin, key.unit, range_text(key)});
  };
  for (const pose_wall_key_info& key : config_keys()) add(key, config_written_text(*loaded.config.get(), key));
  for (const OutsideKey& key : motion_keys()) add(key, motion_value_text(loaded.motion, key));
  for (const OutsideKey& key : live_keys()) {
    const std::string value = live_value_text(loaded.live, key);
    add(key, value.empty() ? "''" : value);
  }
  for (const OutsideKey& key : planar_keys()) {
    const std::string value = planar_value_text(loaded.planar, key);
    add(key, value.empty() ? "''" : value);
  }
  fmt::print("{}", wrapped_table({tr("key"), tr("value"), tr("from"), tr("unit"), tr("allowed")}, rows));
}

// What a positive angle means to somebody who looks along forward_axis.
const char* meaning(std::uint32_t sense) {
  switch (sense) {
    case POSE_WALL_SENSE_RIGHT_DOWN:
      return tr("the right side is down");
    case POSE_WALL_SENSE_LEFT_DOWN:
      return tr("the left side is down");
    case POSE_WALL_SENSE_NOSE_DOWN:
      return tr("the nose is down");
    case POSE_WALL_SENSE_NOSE_UP:
      return tr("the nose is up");
    case POSE_WALL_SENSE_TURNED_RIGHT:
      return tr("the machine points to the right of the road. Turned left is negative, unlike in ROS (REP 103)");
    default:
      return tr("unknown");
  }
}

// The engine knows its own signs: they stand in every result, even in that of a cloud without points.
std::array<std::uint32_t, 3> senses_of(const api::Config& config) {
  api::Engine engine;
  const std::int32_t status = engine.open(config);
  if (status != POSE_WALL_OK) throw ConfigError(say("the engine: {}", pose_wall_status_text(status)));
  const std::array<float, 3> no_point{};
  pose_wall_cloud cloud{};
  pose_wall_cloud_xyz32(&cloud, no_point.data(), 0, 3 * sizeof(float), 0);
  pose_wall_result result = api::make_result();
  engine.process(cloud, result);
  return {result.positive_means[0], result.positive_means[1], result.positive_means[2]};
}

// Adding zero turns -0 into 0, which a reader would take for a sign.
std::string triple(const Vector3& v, int digits) {
  return fmt::format("({:+.{}f}, {:+.{}f}, {:+.{}f})", v[0] + 0.0, digits, v[1] + 0.0, digits, v[2] + 0.0, digits);
}

void print_axes(const ResolvedFrames& frames) {
  fmt::print("{}", say("forward_axis {}: forward {}, left {}, up {} in base\n", frames.forward_axis,
                       triple(frames.forward_base, 0), triple(frames.left_base, 0), triple(frames.up_base, 0)));
  const Vector3& turn_deg = frames.extrinsic_roll_pitch_yaw_deg;
  fmt::print("{}",
             say("sensor in base: at {} m, roll {:+.3f}, pitch {:+.3f}, yaw {:+.3f} deg\n\n",
                 triple(frames.extrinsic_position_m, 3), turn_deg[0] + 0.0, turn_deg[1] + 0.0, turn_deg[2] + 0.0));
}

// Sign and unit of each of the seven results.
void print_results(const LoadedConfig& loaded, const ResolvedFrames& frames) {
  const std::array<std::uint32_t, 3> senses = senses_of(loaded.config);
  std::vector<std::vector<std::string>> rows;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const char* const name = pose_wall_quantity_name(q);
    if (is_angle(q)) {
      rows.push_back({name, "rad", say("positive: {}", meaning(senses[q]))});
      continue;
    }
    const bool is_left = q < POSE_WALL_D_RF;
    const std::string from = triple(frames.sampling_points_base_m[q - POSE_WALL_D_LF], 3);
    rows.push_back({name, "m",
                    is_left ? say("from {} in base to the left wall, never negative", from)
                            : say("from {} in base to the right wall, never negative", from)});
  }
  fmt::print("{}", wrapped_table({tr("result"), tr("unit"), tr("sign")}, rows));
  fmt::print("{}", wrapped(tr("CSV, JSON and the C interface have rad and m; tables and pages for people have degrees. "
                              "Of the settings, extrinsic_roll, _pitch and _yaw are in rad, keys in _deg in degrees."),
                           0, kLineWidth));
}

void print_memory(const LoadedConfig& loaded) {
  uint64_t bytes = 0;
  const int32_t status = pose_wall_memory_needed(loaded.config.get(), &bytes);
  if (status != POSE_WALL_OK) throw ConfigError(say("the engine: {}", pose_wall_status_text(status)));
  fmt::print("{}", say("\nmemory: {} bytes ({:.1f} MB), aligned to {}\n", bytes, static_cast<double>(bytes) * 1e-6,
                       POSE_WALL_BLOCK_ALIGNMENT));
}

// Before anybody drives: a mount may be such that the stop can never let the machine go.
void print_stop_prospect(const LoadedConfig& loaded) {
  const std::string text = stop_prospect_text(loaded);
  if (!text.empty()) fmt::print("{}", wrapped(text, 0, kLineWidth));
}

// What a controller compares with the image's config_crc32.
void print_crc(const LoadedConfig& loaded) {
  fmt::print("{}",
             say("CRC of the settings: 16#{:08X} (dwConfigCrc of FB_PoseWall, config_crc32 of the process image)\n\n",
                 config_crc(*loaded.config.get())));
}

// Headings of the manual, as config/README.md has them; other groups name themselves.
const char* heading(const std::string& group) {
  constexpr std::pair<std::string_view, const char*> kHeadings[] = {
      {"input", translatable("Input")},
      {"frames", translatable("Frames of reference")},
      {"filter", translatable("Filter and voxels")},
      {"ground", translatable("Floor")},
      {"walls", translatable("Walls")},
      {"quality", translatable("Quality")},
      {"temporal", translatable("Over time")},
  };
  for (const auto& [name, title] : kHeadings) {
    if (group == name) return tr(title);
  }
  return tr(group.c_str());
}

// The manual of all keys, under the headings of the tables.
void print_keys() {
  std::string group;
  const auto print = [&group](const auto& key, const std::string& usual) {
    if (group != key.group) {
      group = key.group;
      fmt::print("\n{}\n", heading(group));
    }
    const std::string values = wrapped(say("default {}; allowed: {}", usual, allowed_text(key)), 6, 100);
    fmt::print("  {}\n{}{}", key.name, values.substr(2), wrapped(tr(key.help), 4, 100));
  };
  const api::Config defaults;
  for (const pose_wall_key_info& key : config_keys()) print(key, config_written_text(*defaults.get(), key));
  for (const OutsideKey& key : motion_keys()) print(key, motion_value_text(default_motion_settings(), key));
  const LiveSettings live_defaults;
  for (const OutsideKey& key : live_keys()) {
    const std::string value = live_value_text(live_defaults, key);
    print(key, value.empty() ? "''" : value);
  }
  const PlanarSettings planar_defaults;
  for (const OutsideKey& key : planar_keys()) {
    const std::string value = planar_value_text(planar_defaults, key);
    print(key, value.empty() ? "''" : value);
  }
}

int check_config(const CheckConfigOptions& options) {
  if (options.keys) {
    if (!options.file.empty() || !options.settings.empty()) {
      throw std::invalid_argument(
          tr("--keys prints the manual of all keys, whatever their values: use it without FILE and --set"));
    }
    print_keys();
    return kExitDone;
  }
  const LoadedConfig loaded = load_config(options.file, options.settings);
  tell_notes(loaded, false);
  const ResolvedFrames frames = resolve_frames(loaded.config);
  print_axes(frames);
  print_results(loaded, frames);
  print_stop_prospect(loaded);
  print_memory(loaded);
  print_crc(loaded);
  print_values(loaded);
  return kExitDone;
}

}  // namespace

void add_check_config(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<CheckConfigOptions>();
  CLI::App* verb =
      app.add_subcommand("check-config", tr("Check settings; show axes, signs, sampling points and every value"));
  verb->add_option("FILE", options->file,
                   config_help(tr("Settings, as config/pose_wall.yaml; without it the defaults")));
  verb->add_option("-s,--set", options->settings, tr("KEY=VALUE over the file; may be repeated"))
      ->allow_extra_args(false);
  verb->add_flag("-k,--keys", options->keys, tr("Print the manual of all keys instead"));
  verb->footer(
      tr("Examples:\n  pose_wall check-config config/pose_wall.yaml --set forward_axis=-Y\n"
         "  pose_wall check-config --keys\n"
         "Exit status: 0 the settings are good, 2 they have faults (each is named with its line)."));
  verb->callback([options, &exit_code] { exit_code = check_config(*options); });
}

}  // namespace pose_wall::tools
