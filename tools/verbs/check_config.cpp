// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall check-config: what the settings come to, before a machine runs on them.

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "config_file/key_table.hpp"
#include "config_file/load_config.hpp"
#include "config_file/resolved_frames.hpp"
#include "terminal/text_table.hpp"
#include "verbs/verbs.hpp"

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
  TextTable table({"key", "value", "unit", "allowed", "from"});
  for (const pose_wall_key_info& key : config_keys()) {
    table.add_row(
        {key.name, config_written_text(*loaded.config.get(), key), key.unit, range_text(key), loaded.origin(key.name)});
  }
  for (const OutsideKey& key : motion_keys()) {
    table.add_row(
        {key.name, motion_value_text(loaded.motion, key), key.unit, range_text(key), loaded.origin(key.name)});
  }
  for (const OutsideKey& key : live_keys()) {
    const std::string value = live_value_text(loaded.live, key);
    table.add_row({key.name, value.empty() ? "''" : value, key.unit, range_text(key), loaded.origin(key.name)});
  }
  fmt::print("{}", table.text(5));
}

void print_memory(const LoadedConfig& loaded) {
  uint64_t bytes = 0;
  const int32_t status = pose_wall_memory_needed(loaded.config.get(), &bytes);
  if (status != POSE_WALL_OK) throw ConfigError(std::string("the engine: ") + pose_wall_status_text(status));
  fmt::print("memory: {} bytes ({:.1f} MB), aligned to {}\n", bytes, static_cast<double>(bytes) * 1e-6,
             POSE_WALL_BLOCK_ALIGNMENT);
}

// What a controller compares with the image's config_crc32.
void print_crc(const LoadedConfig& loaded) {
  fmt::print("{} (dwConfigCrc of FB_PoseWall, config_crc32 of the process image)\n",
             config_crc_text(*loaded.config.get()));
}

// The manual of all keys, under the headings of the tables.
void print_keys() {
  std::string group;
  const auto print = [&group](const auto& key, const std::string& usual) {
    if (group != key.group) {
      group = key.group;
      fmt::print("\n{}\n", group);
    }
    fmt::print("  {}\n    default {}; allowed: {}\n{}", key.name, usual, allowed_text(key), wrapped(key.help, 4, 100));
  };
  const api::Config defaults;
  for (const pose_wall_key_info& key : config_keys()) print(key, config_written_text(*defaults.get(), key));
  for (const OutsideKey& key : motion_keys()) print(key, motion_value_text(default_motion_settings(), key));
  const LiveSettings live_defaults;
  for (const OutsideKey& key : live_keys()) {
    const std::string value = live_value_text(live_defaults, key);
    print(key, value.empty() ? "''" : value);
  }
}

int check_config(const CheckConfigOptions& options) {
  if (options.keys) {
    if (!options.file.empty() || !options.settings.empty()) {
      throw std::invalid_argument(
          "--keys prints the manual of all keys, whatever their values: use it without FILE and --set");
    }
    print_keys();
    return kExitDone;
  }
  const LoadedConfig loaded = load_config(options.file, options.settings);
  fmt::print("{}", resolved_frames_text(resolve_frames(loaded.config), ""));
  print_memory(loaded);
  print_crc(loaded);
  fmt::print("\n");
  print_values(loaded);
  return kExitDone;
}

}  // namespace

void add_check_config(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<CheckConfigOptions>();
  CLI::App* verb = app.add_subcommand("check-config", "Check settings; show axes, sampling points and every value");
  verb->add_option("FILE", options->file, "Settings, as config/pose_wall.yaml; default: the defaults");
  verb->add_option("-s,--set", options->settings, "KEY=VALUE over the file; may be repeated")->allow_extra_args(false);
  verb->add_flag("-k,--keys", options->keys, "Print the manual of all keys instead");
  verb->footer(
      "Examples:\n"
      "  pose_wall check-config config/pose_wall.yaml --set forward_axis=-Y\n"
      "  pose_wall check-config --keys\n"
      "Exit status: 0 the settings are good, 2 they have faults (each is named with its line).");
  verb->callback([options, &exit_code] { exit_code = check_config(*options); });
}

}  // namespace pose_wall::tools
