// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/config_file/load_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "io/config_file/config_place.hpp"
#include "io/config_file/key_table.hpp"
#include "io/config_file/yaml_entries.hpp"
#include "io/language/language.hpp"
#include "io/language/system_errors.hpp"
#include "io/numbers/angles.hpp"
#include "io/terminal/did_you_mean.hpp"

namespace pose_wall::tools {
namespace {

// Far above any real config; keeps a wrong path (a recording) from being read whole.
constexpr std::size_t kFileBytesMax = 1024 * 1024;

class ConfigLoader {
 public:
  void apply_file(const ConfigPlace& place) {
    if (!place.error.empty()) return fault(place.error);
    const std::string& file = place.file;
    loaded_.file += (loaded_.file.empty() ? "" : ",") + file;
    note(place.note);
    std::map<std::string, std::size_t> lines;
    for (const YamlEntry& entry : entries_of(file)) {
      const std::string where = fmt::format("{}:{}", file, entry.line);
      const auto [first, is_new] = lines.emplace(entry.key, entry.line);
      if (is_new) {
        apply_entry(where, entry);
      } else {
        fault(say("{}: {}: set a second time; the first is at line {}", where, entry.key, first->second));
      }
    }
  }

  void apply_setting(const std::string& setting) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      fault(say("--set {}: KEY=VALUE is expected", setting));
      return;
    }
    apply("--set", setting.substr(0, equals), setting.substr(equals + 1), false);
  }

  // What was commissioned from the page stands over the files. A word of the command line may name its folder.
  void apply_commissioned(const std::vector<std::string>& settings) {
    const std::string word = "commissioned=";
    std::string folder = loaded_.live.commissioned;
    for (const std::string& setting : settings) {
      if (setting.compare(0, word.size(), word) == 0) folder = setting.substr(word.size());
    }
    if (folder.empty()) return;
    const std::string file = commissioned_file(folder);
    std::error_code error;
    const bool is_there = std::filesystem::exists(file, error);
    only_engine_ = true;
    if (is_there || error) apply_file({file, "", ""});  // what cannot be looked at is a fault, and no machine without
    only_engine_ = false;
    if (is_there || error) return;
    // A disk that is missing must not bring back the mounting of before.
    missing_ = file;
  }

  void check_rules() {
    if (loaded_.live.extrinsic_from == "tf" && loaded_.live.source == "udp") {
      fault(say("extrinsic_from ({}): tf comes by ROS, so source ({}) must be ros1 or ros2",
                loaded_.origin("extrinsic_from"), loaded_.origin("source")));
    }
    if (!missing_.empty() && loaded_.live.commissioning) {
      note(say("commissioned: {} is not there yet: nothing was commissioned", missing_));
    } else if (!missing_.empty()) {
      fault(say("commissioned ({}): there is no {}. Commission the machine (commissioning: 1), or take this key out",
                loaded_.origin("commissioned"), missing_));
    }
    const std::string page_rule = broken_page_rule(loaded_.live);
    if (!page_rule.empty()) fault(page_rule);
    const std::string planar_rule = broken_planar_rule(loaded_.planar);
    if (!planar_rule.empty()) fault(planar_rule);
    const std::string live_rule = broken_live_rule(loaded_.live);
    if (!live_rule.empty()) fault(live_rule);
    const std::string command_rule = broken_command_rule(loaded_.planar, loaded_.live);
    if (!command_rule.empty()) fault(command_rule);
    pose_wall_rule_fault broken{};
    if (!faults_.empty() || loaded_.config.check(&broken) == POSE_WALL_OK) return;
    std::string keys = fmt::format("{} ({})", broken.key, loaded_.origin(broken.key));
    const std::string other = broken.other_key;
    if (!other.empty()) keys += say(" and {} ({})", other, loaded_.origin(other));
    fault(fmt::format("{}: {}", keys, tr(broken.rule)));
  }

  // Degrees in a key of radians are in range, too. Quarter turns are how sensors are mounted.
  void doubt_units() {
    constexpr double kTiltMost_rad = 0.8;  // 46 deg: no sensor is mounted askew by more. Judgement, 2026-11-26
    constexpr double kQuarterTurn_rad = 90.0 * kRadPerDeg;
    constexpr double kNearQuarter_rad = 0.05;  // 3 deg, as a mounting is off a quarter turn. Judgement, 2026-11-26
    for (const char* key : {"extrinsic_roll", "extrinsic_pitch", "extrinsic_yaw"}) {
      const double value = loaded_.config.number(key);
      const bool is_quarter = std::fabs(std::remainder(value, kQuarterTurn_rad)) < kNearQuarter_rad;
      if (std::fabs(value) <= kTiltMost_rad || is_quarter) continue;
      note(say("warning: {} is in radians: {:g} rad are {:.1f} deg. For {:g} deg write {:.4f}", key, value,
               value * kDegPerRad, value, value / kDegPerRad));
    }
  }

  LoadedConfig take() {
    if (!faults_.empty()) throw ConfigError(faults_);
    return std::move(loaded_);
  }

 private:
  // A file that stands over others says what it changes: the order of files is easily mistaken.
  void apply_entry(const std::string& where, const YamlEntry& entry) {
    if (only_engine_ && !find_config_key(entry.key)) {
      return fault(say("{}: {}: only settings of the engine are commissioned", where, entry.key));
    }
    const std::string before = loaded_.origin(entry.key);
    apply(where, entry.key, entry.value, entry.is_sequence);
    const auto [set, is_first] = written_.emplace(entry.key, entry.value);
    if (is_first) return;
    if (!is_same_value(set->second, entry.value)) {
      note(say("{}: {}: '{}' instead of '{}' ({})", where, entry.key, entry.value, set->second, before));
    }
    set->second = entry.value;
  }

  // As a config file writes it: "2.0" is "2".
  static bool is_same_value(const std::string& a, const std::string& b) {
    char *end_of_a = nullptr, *end_of_b = nullptr;
    const double number_a = std::strtod(a.c_str(), &end_of_a), number_b = std::strtod(b.c_str(), &end_of_b);
    const bool are_numbers = !a.empty() && !b.empty() && *end_of_a == '\0' && *end_of_b == '\0';
    return are_numbers ? number_a == number_b : a == b;
  }

  std::vector<YamlEntry> entries_of(const std::string& file) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) {
      fault(say("{}: this is a folder; a file is allowed", file));
      return {};
    }
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
      fault(say("{}: cannot be opened for reading: {}{}", file, system_error_text(errno),
                file == "-" ? tr("; standard input is /dev/stdin") : ""));
      return {};
    }
    // A pipe has no size: one byte more than is allowed tells.
    std::string text(kFileBytesMax + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kFileBytesMax) {
      fault(say("{}: a config file has at most {} bytes; this has more", file, kFileBytesMax));
      return {};
    }
    try {
      return parse_yaml_entries(text);
    } catch (const YamlError& problem) {
      fault(fmt::format("{}:{}: {}", file, problem.line(), problem.what()));
      return {};
    }
  }

  void apply(const std::string& where, const std::string& key, const std::string& value, bool is_sequence) {
    if (const OutsideKey* live_key = find_live_key(key)) {
      return take_outside(where, *live_key, value, !is_sequence && set_live_value(&loaded_.live, *live_key, value));
    }
    if (const OutsideKey* planar_key = find_planar_key(key)) {
      return take_outside(where, *planar_key, value,
                          !is_sequence && set_planar_value(&loaded_.planar, *planar_key, value));
    }
    if (const OutsideKey* motion_key = find_motion_key(key)) {
      return take_outside(where, *motion_key, value,
                          !is_sequence && set_motion_value(&loaded_.motion, *motion_key, value));
    }
    const std::optional<pose_wall_key_info> known = find_config_key(key);
    if (!known) {
      fault(say("{}: unknown key '{}'{}", where, key, suggestion(key, value)));
      return;
    }
    if (is_sequence && known->type != POSE_WALL_KEY_BOX) {
      fault(say("{}: {}: a list is not allowed here; allowed: {}", where, key, allowed_text(*known)));
      return;
    }
    const std::int32_t status = loaded_.config.set(key.c_str(), value.c_str());
    if (status == POSE_WALL_OK) {
      loaded_.origins[key] = where;
    } else {
      fault(say("{}: {}: '{}' is refused ({}); allowed: {}", where, key, value, tr(pose_wall_status_text(status)),
                allowed_text(*known)));
      // A choice needs more than its words: z_axis is fixed, and its help says what to turn instead.
      if (known->type == POSE_WALL_KEY_CHOICE) faults_ += fmt::format(" ({})", tr(known->help));
    }
  }

  // Of keys that the engine does not read.
  void take_outside(const std::string& where, const OutsideKey& key, const std::string& value, bool is_taken) {
    if (is_taken) {
      loaded_.origins[key.name] = where;
    } else {
      fault(say("{}: {}: '{}' is refused; allowed: {}{}", where, key.name, value, allowed_text(key),
                did_you_mean(value, choices_of(key))));
    }
  }

  // The unit is part of the question where the name leaves it out or has another one.
  static std::string suggestion(const std::string& key, const std::string& value) {
    if (key == "protection_factor") {  // until 0.2: the levels' factor itself, 5.0 unless set
      const double sigmas = std::strtod(value.c_str(), nullptr), risk = std::erfc(sigmas / std::sqrt(2.0));
      const pose_wall_key_info allowed = find_config_key("integrity_risk").value();
      return say("; integrity_risk replaced it: leave it out, or write integrity_risk: {:.3g}",
                 std::clamp(risk, allowed.minimum, allowed.maximum));
    }
    if (find_config_key(key + "_deg")) return did_you_mean(key + "_deg_", {key + "_deg"});
    std::string question = did_you_mean(key, all_key_names());
    const std::string ending = "_deg";
    if (key.size() <= ending.size() || key.compare(key.size() - ending.size(), ending.size(), ending) != 0) {
      return question;
    }
    const std::optional<pose_wall_key_info> bare = find_config_key(key.substr(0, key.size() - ending.size()));
    if (!bare || std::string(bare->unit) != "rad") return question;
    const double angle_deg = std::strtod(value.c_str(), nullptr);
    return question + say(" (in radians: write {:.4f} for {:g} deg)", angle_deg / kDegPerRad, angle_deg);
  }

  static std::vector<std::string> all_key_names() {
    std::vector<std::string> names = config_key_names();
    for (const OutsideKey& key : motion_keys()) names.emplace_back(key.name);
    for (const OutsideKey& key : live_keys()) names.emplace_back(key.name);
    for (const OutsideKey& key : planar_keys()) names.emplace_back(key.name);
    return names;
  }

  void fault(const std::string& text) { add_line(text, &faults_); }
  void note(const std::string& text) { add_line(text, &loaded_.notes); }

  static void add_line(const std::string& text, std::string* lines) {
    if (!lines->empty() && !text.empty()) *lines += '\n';
    *lines += text;
  }

  LoadedConfig loaded_;
  std::map<std::string, std::string> written_;  // values of the files, by key
  std::string faults_;
  bool only_engine_ = false;  // of a file
  std::string missing_;       // what was to be commissioned, and was not
};

}  // namespace

std::string LoadedConfig::origin(const std::string& key) const {
  const auto set = origins.find(key);
  return set != origins.end() ? set->second : "default";
}

std::string commissioned_file(const std::string& folder) {
  return (std::filesystem::path(folder) / "settings.yaml").string();
}

LoadedConfig load_config(const std::string& files, const std::vector<std::string>& settings) {
  ConfigLoader loader;
  for (const ConfigPlace& place : find_configs(files)) loader.apply_file(place);
  loader.apply_commissioned(settings);
  for (const std::string& setting : settings) loader.apply_setting(setting);
  loader.check_rules();
  loader.doubt_units();
  LoadedConfig loaded = loader.take();
  loaded.asked_files = files;
  loaded.asked_settings = settings;
  return loaded;
}

void tell_notes(const LoadedConfig& loaded, bool quiet) {
  if (!quiet && !loaded.notes.empty()) fmt::print(stderr, "{}\n", loaded.notes);
}

}  // namespace pose_wall::tools
