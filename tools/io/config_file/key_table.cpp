// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/config_file/key_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

std::vector<pose_wall_key_info> read_table() {
  std::vector<pose_wall_key_info> keys(pose_wall_config_key_count());
  for (std::uint32_t i = 0; i < keys.size(); ++i) pose_wall_config_key(i, &keys[i]);
  return keys;
}

std::string with_unit(const pose_wall_key_info& key) {
  const bool bare = std::strcmp(key.unit, "") == 0 || std::strcmp(key.unit, "1") == 0;
  return bare ? "" : fmt::format(" {}", key.unit);
}

std::string box_text(const pose_wall_config& config, const pose_wall_key_info& key) {
  double box[6] = {};
  pose_wall_config_get_box(&config, key.name, box);
  const bool empty = std::all_of(std::begin(box), std::end(box), [](double side) { return side == 0.0; });
  return empty ? "" : fmt::format("{:g}", fmt::join(box, " "));
}

}  // namespace

const std::vector<pose_wall_key_info>& config_keys() {
  static const std::vector<pose_wall_key_info> keys = read_table();
  return keys;
}

std::optional<pose_wall_key_info> find_config_key(const std::string& name) {
  for (const pose_wall_key_info& key : config_keys()) {
    if (name == key.name) return key;
  }
  return std::nullopt;
}

std::vector<std::string> config_key_names() {
  std::vector<std::string> names;
  for (const pose_wall_key_info& key : config_keys()) names.emplace_back(key.name);
  return names;
}

std::string allowed_text(const pose_wall_key_info& key) {
  switch (key.type) {
    case POSE_WALL_KEY_NUMBER:
      return say("a number from {:g} to {:g}{}", key.minimum, key.maximum, with_unit(key));
    case POSE_WALL_KEY_INTEGER:
      return say("a whole number from {:.0f} to {:.0f}{}", key.minimum, key.maximum, with_unit(key));
    case POSE_WALL_KEY_BOX:
      return say("x_min x_max y_min y_max z_min z_max, each from {:g} to {:g}{} and min < max, or []", key.minimum,
                 key.maximum, with_unit(key));
    case POSE_WALL_KEY_CHOICE: {
      std::string choices = key.choices;
      for (std::size_t at = choices.find('|'); at != std::string::npos; at = choices.find('|', at)) {
        choices.replace(at, 1, ", ");
      }
      return choices.find(',') != std::string::npos ? say("one of {}", choices) : say("only {}", choices);
    }
    default:
      return say("text of at most {} bytes", POSE_WALL_TEXT_MAX - 1);
  }
}

std::string config_value_text(const pose_wall_config& config, const pose_wall_key_info& key) {
  if (key.type == POSE_WALL_KEY_BOX) return box_text(config, key);
  if (key.type == POSE_WALL_KEY_TEXT || key.type == POSE_WALL_KEY_CHOICE) {
    return config_text(config, key.name);
  }
  double value = 0.0;
  pose_wall_config_get_number(&config, key.name, &value);
  return fmt::format("{:.9g}", value);
}

std::string config_text(const pose_wall_config& config, const char* key) {
  char text[POSE_WALL_TEXT_MAX] = {};
  pose_wall_config_get_text(&config, key, text, sizeof text);
  return text;
}

std::uint32_t config_crc(const pose_wall_config& config) {
  std::uint32_t crc = 0;
  static_cast<void>(pose_wall_config_crc(&config, &crc));  // it refuses NULL alone
  return crc;
}

std::string config_crc_text(const pose_wall_config& config) {
  return say("settings' CRC: 16#{:08X}", config_crc(config));
}

std::string config_written_text(const pose_wall_config& config, const pose_wall_key_info& key) {
  const std::string value = config_value_text(config, key);
  if (!value.empty()) return value;
  return key.type == POSE_WALL_KEY_BOX ? "[]" : "''";
}

}  // namespace pose_wall::tools
