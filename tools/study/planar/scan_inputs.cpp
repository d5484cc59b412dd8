// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/scan_inputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "io/config_file/key_table.hpp"
#include "io/language/language.hpp"
#include "io/terminal/did_you_mean.hpp"
#include "study/planar/carmen_scans.hpp"
#include "study/planar/cloud_scans.hpp"
#include "study/planar/setting_words.hpp"

namespace pose_wall::tools {
namespace {

void require_log_alone(const FrameOptions& options, const std::vector<std::string>& verb_settings) {
  if (options.inputs.size() > 1) {
    throw std::invalid_argument(say("{}: give a log of CARMEN alone", options.inputs.front()));
  }
  if (!options.config_file.empty()) {
    throw std::invalid_argument(tr("--config is for frames; a log of CARMEN holds scans"));
  }
  std::vector<std::string> faults;
  for (const std::string& setting : options.settings) {
    const std::string name = named_value(setting).name;
    faults.push_back(say("--set {}: no setting for scans of a log{}", name, did_you_mean(name, verb_settings)));
    if (!verb_settings.empty()) {
      faults.back() += say("; settings: {}", fmt::format("{}", fmt::join(verb_settings, ", ")));
    }
  }
  refuse_settings(faults);
}

// Of one input the frames' own fault would do; it does not say what else is taken here.
void require_any_there(const std::vector<std::string>& inputs) {
  std::error_code ignored;
  const auto is_there = [&ignored](const std::string& input) { return std::filesystem::exists(input, ignored); };
  if (std::any_of(inputs.begin(), inputs.end(), is_there)) return;
  throw std::runtime_error(
      say("INPUT {}: there is no such file or folder. Give frames, a bag, a capture of packets, or a log of CARMEN",
          fmt::format("{}", fmt::join(inputs, ", "))));
}

// A name that no table has may be meant for one of the planar library: the config's own answer knows only its keys.
void compare_settings(const std::vector<std::string>& words, const std::vector<std::string>& verb_settings) {
  std::vector<std::string> planar = names_of(scanner_setting_rows());
  planar.insert(planar.end(), verb_settings.begin(), verb_settings.end());
  const std::vector<std::string> keys = config_key_names();
  for (const std::string& word : words) {
    const std::string name = named_value(word).name;
    const std::string meant = nearest_word(name, planar);
    if (meant.empty() || std::find(keys.begin(), keys.end(), name) != keys.end()) continue;
    const std::string key = nearest_word(name, keys);
    if (!key.empty() && edit_distance(name, key) <= edit_distance(name, meant)) continue;
    throw std::invalid_argument(say("--set {}: there is no such setting{}", name, did_you_mean(name, planar)));
  }
}

}  // namespace

std::unique_ptr<ScanSource> open_scans(const FrameOptions& options, const std::vector<std::string>& verb_settings) {
  require_any_there(options.inputs);
  const auto& inputs = options.inputs;
  const auto log = std::find_if(inputs.begin(), inputs.end(), [](const std::string& input) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(input, ignored) && is_carmen_log(input);
  });
  if (log == inputs.end()) {
    FrameOptions for_engine = options;
    const pose_wall_planar_scanner_settings settings = take_scanner_settings(&for_engine.settings);
    compare_settings(for_engine.settings, verb_settings);
    return std::make_unique<CloudScans>(for_engine, settings);
  }
  require_log_alone(options, verb_settings);
  return std::make_unique<CarmenScans>(*log);
}

}  // namespace pose_wall::tools
