// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "doctor/proposal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "config_file/key_table.hpp"
#include "sim/sensors.hpp"
#include "terminal/text_table.hpp"

namespace pose_wall::tools::doctor {
namespace {

constexpr std::size_t kCommentWidth = 116;

std::string value_text(const api::Config& config, const std::string& key) {
  const auto info = find_config_key(key);
  return info ? config_value_text(*config.get(), *info) : std::string();
}

// Six numbers are a list in YAML.
std::string yaml_value(const std::string& value, bool is_box) {
  if (!is_box) return value;
  std::string list;
  std::istringstream words(value);
  for (std::string word; words >> word;) list += (list.empty() ? "[" : ", ") + word;
  return list + "]";
}

std::string comment(const std::string& text) {
  std::string all;
  std::istringstream lines(wrapped(text, 0, kCommentWidth));
  for (std::string line; std::getline(lines, line);) all += "# " + line + "\n";
  return all;
}

}  // namespace

void Proposal::set(const std::string& key, const std::string& value, const std::string& reason) {
  const std::string before = value_text(config_, key);
  if (config_.set(key.c_str(), value.c_str()) != POSE_WALL_OK) {
    throw std::logic_error(fmt::format("{}: the engine refuses {}", key, value));
  }
  const std::string after = value_text(config_, key);
  if (after != before) changes_.push_back({key, before, after, reason});
}

void Proposal::raise(const std::string& key, double value, const std::string& reason) {
  if (!is_told(key) && value > config_.number(key.c_str())) set(key, fmt::format("{:.2f}", value), reason);
}

void Proposal::lower(const std::string& key, double value, const std::string& reason) {
  if (!is_told(key) && value < config_.number(key.c_str())) set(key, fmt::format("{:.2f}", value), reason);
}

void Proposal::take_class(const std::string& model, const std::string& title) {
  const sim::SensorModel* const known = sim::find_sensor(model);
  if (known == nullptr) return;
  for (const sim::EngineSetting& setting : known->engine) {
    if (is_told(setting.key)) continue;
    set(setting.key, setting.value, fmt::format("{}: as config/{}.yaml has it", title, model));
  }
}

std::string Proposal::yaml(const std::vector<std::string>& head) const {
  std::string text;
  for (const std::string& line : head) text += comment(line);
  text += comment("What is not named here keeps its default; `pose_wall check-config FILE` shows what it comes to.");
  for (const pose_wall_key_info& key : config_keys()) {
    const auto change =
        std::find_if(changes_.rbegin(), changes_.rend(), [&key](const Change& c) { return c.key == key.name; });
    const std::string value = config_value_text(*config_.get(), key);
    const bool is_box = key.type == POSE_WALL_KEY_BOX;
    if (change != changes_.rend()) {
      const std::string before = change->before.empty() ? "none" : change->before;
      text += "\n" + comment(fmt::format("{} (was {})", change->reason, before));
    } else if (const auto stated = stated_.find(key.name); stated != stated_.end()) {
      text += "\n" + comment(stated->second);
    } else if (is_told(key.name) && !value.empty()) {
      text += "\n" + comment("as told: " + told_.origin(key.name));
    } else {
      continue;
    }
    text += fmt::format("{}: {}\n", key.name, yaml_value(value, is_box));
  }
  return text;
}

}  // namespace pose_wall::tools::doctor
