// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/doctor/proposal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "io/beams/sensor_settings.hpp"
#include "io/config_file/key_table.hpp"
#include "io/language/language.hpp"
#include "io/terminal/text_table.hpp"

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

void Proposal::take_class(const std::string& model, const std::string& title, const std::string& config) {
  if (config.empty() && !is_told("range_bias_max")) {
    state("range_bias_max",
          tr("No file of config/ is made for this sensor. Set this to the accuracy of its data sheet."));
  }
  for (const EngineSetting& setting : engine_settings_of(model)) {
    if (is_told(setting.key)) continue;
    const std::string reason = say("{} class: as in config/{}.yaml", title, config);
    set(setting.key, setting.value, reason);
    state(setting.key, reason);
  }
}

LoadedConfig Proposal::settings() const {
  LoadedConfig all = told_;
  all.config = config_;
  return all;
}

std::string Proposal::comment_of(const std::string& key) const {
  const auto change =
      std::find_if(changes_.rbegin(), changes_.rend(), [&key](const Change& c) { return c.key == key; });
  if (change != changes_.rend()) {
    return say("{} (was {})", change->reason, change->before.empty() ? std::string(tr("none")) : change->before);
  }
  if (const auto stated = stated_.find(key); stated != stated_.end()) return stated->second;
  return is_told(key) ? say("as given: {}", told_.origin(key)) : "";
}

std::string Proposal::yaml(const std::vector<std::string>& head) const {
  std::string text;
  for (const std::string& line : head) text += comment(line);
  text += comment(tr("Keys that are not here keep their defaults. `pose_wall check-config FILE` prints them all."));
  const auto add = [this, &text](const char* key, const std::string& value) {
    const std::string why = comment_of(key);
    if (!why.empty() && !value.empty()) text += fmt::format("\n{}{}: {}\n", comment(why), key, value);
  };
  for (const pose_wall_key_info& key : config_keys()) {
    const std::string value = config_value_text(*config_.get(), key);
    add(key.name, value.empty() ? value : yaml_value(value, key.type == POSE_WALL_KEY_BOX));
  }
  for (const OutsideKey& key : motion_keys()) add(key.name, motion_value_text(told_.motion, key));
  for (const OutsideKey& key : live_keys()) add(key.name, live_value_text(told_.live, key));
  for (const OutsideKey& key : planar_keys()) add(key.name, planar_value_text(told_.planar, key));
  return text;
}

}  // namespace pose_wall::tools::doctor
