// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/commissioning/steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "apps/live/commissioning/errand.hpp"
#include "io/config_file/all_settings.hpp"
#include "io/config_file/key_table.hpp"
#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"
#include "io/numbers/utc_text.hpp"

namespace pose_wall::tools::live {
namespace {

namespace fs = std::filesystem;

// As `doctor --help` tells them: usable, and not usable. Both come with all that it found.
constexpr int kDone = 0, kNotUsable = 3;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void require_done(const ErrandOutcome& outcome, const char* verb, int also_good = kDone) {
  if (outcome.status == kDone || outcome.status == also_good) return;
  const std::vector<std::string> lines = lines_of(outcome.errors);
  throw std::runtime_error(lines.empty() ? fmt::format("pose_wall {} ended with status {}", verb, outcome.status)
                                         : fmt::format("{}", fmt::join(lines, "; ")));
}

std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

bool is_mounting(const std::string& key) {
  return key == "forward_axis" || key.rfind("extrinsic_", 0) == 0 || key.rfind("body_box_", 0) == 0;
}

// A link costs no room; another disk has to take a copy.
void put(const fs::path& file, const fs::path& place) {
  std::error_code fault;
  fs::create_hard_link(file, place, fault);
  if (fault) fs::copy_file(file, place, fs::copy_options::overwrite_existing);
}

// As YAML has text in which nothing means anything.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char one : text) out += one == '\'' ? std::string("''") : std::string(1, one);
  return out + "'";
}

// All that is set, whoever set it, so that the file alone measures the recording as it was measured.
std::string whole_settings(const LoadedConfig& loaded) {
  std::string text = fmt::format("# {}\n", config_crc_text(*loaded.config.get()));
  for (const SettingText& setting : all_settings(loaded)) {
    // Ports and folders are this machine's, and measure nothing.
    if (setting.reader == SettingText::Reader::kLive || loaded.origins.count(setting.key) == 0) continue;
    text += fmt::format("{}: {}\n", setting.key, setting.is_text ? quoted(setting.value) : setting.written());
  }
  return text;
}

}  // namespace

CommissioningSteps::CommissioningSteps(const LoadedConfig& loaded)
    : loaded_(loaded), folder_(loaded.live.commissioned) {
  fs::create_directories(recording_folder());
  fs::create_directories(folder_ / "trial");
}

Json CommissioningSteps::mounting() const {
  Json keys = Json::array();
  for (const pose_wall_key_info& key : config_keys()) {
    if (!is_mounting(key.name)) continue;
    keys.push_back({{"key", key.name},
                    {"value", config_value_text(*loaded_.config.get(), key)},
                    {"unit", key.unit},
                    {"help", tr(key.help)},
                    {"from", loaded_.origin(key.name)}});
  }
  return keys;
}

void CommissioningSteps::forget_recording() const {
  for (const std::string& file : recordings()) fs::remove(file);
}

std::vector<std::string> CommissioningSteps::recordings() const {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(recording_folder())) {
    if (entry.path().extension() == ".mcap") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// As the daemon was started, but for what was commissioned.
std::vector<std::string> CommissioningSteps::words_with(const std::string& settings_folder) const {
  std::vector<std::string> words;
  if (!loaded_.asked_files.empty()) words = {"--config", loaded_.asked_files};
  for (const std::string& setting : loaded_.asked_settings) {
    if (setting.rfind("commissioned=", 0) != 0) words = joined(std::move(words), {"--set", setting});
  }
  return joined(std::move(words), {"--set", "commissioned=" + settings_folder});
}

Json CommissioningSteps::examine(const std::string& language, const std::atomic<bool>& given_up) const {
  const std::vector<std::string> words =
      joined(joined({"doctor", "--json", "--quiet", "--language", language}, words_with(folder_)), recordings());
  const ErrandOutcome outcome = run_errand(words, given_up);
  require_done(outcome, "doctor", kNotUsable);
  Json told = Json::parse(outcome.output, nullptr, false);
  if (!told.is_object())
    throw std::runtime_error("pose_wall doctor said nothing that can be read: is it of this version?");
  return told;
}

// The changes over what was commissioned before. Only keys of the engine can be changed from the page: no port, no
// folder, no other program's business.
LoadedConfig CommissioningSteps::trial_of(const Changes& changes) const {
  const std::string before = commissioned_file(folder_);
  const LoadedConfig present = load_config(loaded_.asked_files, loaded_.asked_settings);  // others may have saved since
  Changes all;
  api::Config config = present.config;
  for (const pose_wall_key_info& key : config_keys()) {
    if (present.origin(key.name).rfind(before + ":", 0) == 0) all[key.name] = "";
  }
  for (const auto& [key, value] : changes) {
    const std::optional<pose_wall_key_info> known = find_config_key(key);
    // Texts name topics and frames of others, and would bring their own lines into the file.
    if (!known || known->type == POSE_WALL_KEY_TEXT) {
      throw std::runtime_error(fmt::format("'{}' is no setting that the page may change", key));
    }
    if (present.live.extrinsic_from == "tf" && key.rfind("extrinsic_", 0) == 0) {
      throw std::runtime_error(fmt::format("{} comes from ROS (extrinsic_from: tf): change it there", key));
    }
    if (config.set(key.c_str(), value.c_str()) != POSE_WALL_OK) {
      throw std::runtime_error(fmt::format("{}: '{}' is refused; allowed: {}", key, value, allowed_text(*known)));
    }
    all[key] = value;
  }
  std::string text = fmt::format("# Commissioned from the page, {}.\n", utc_text(std::time(nullptr)));
  for (const auto& [key, value] : all) {
    text += fmt::format("{}: {}\n", key, config_written_text(*config.get(), *find_config_key(key)));
  }
  const fs::path trial = folder_ / "trial";
  write_whole_file(commissioned_file(trial), text);
  std::vector<std::string> settings = loaded_.asked_settings;
  settings.push_back("commissioned=" + trial.string());
  LoadedConfig loaded = load_config(loaded_.asked_files, settings);
  for (const auto& [key, value] : all) {
    if (loaded.origin(key) == "--set") {
      throw std::runtime_error(
          fmt::format("{} stands on the daemon's command line (--set), which nothing else changes", key));
    }
  }
  return loaded;
}

Json CommissioningSteps::check(const Changes& changes, const std::string& language,
                               const std::atomic<bool>& given_up) const {
  const LoadedConfig trial = trial_of(changes);
  const fs::path folder = folder_ / "trial";
  const std::vector<std::string> words = joined(words_with(folder), {"--language", language});
  write_whole_file(folder / "whole.yaml", whole_settings(trial));
  const ErrandOutcome run =
      run_errand(joined(joined({"run", "-o", folder / "results.csv"}, words), recordings()), given_up);
  require_done(run, "run");
  const ErrandOutcome report =
      run_errand(joined(joined({"report", "--quiet", "-o", report_file()}, words), recordings()), given_up);
  require_done(report, "report");
  return {{"changes", changes},
          {"config_crc32", config_crc(*trial.config.get())},
          {"forward_axis", config_text(*trial.config.get(), "forward_axis")},
          {"told", lines_of(run.errors)}};
}

Json CommissioningSteps::save(const Json& who, const Json& examined, const Json& checked, const std::string& language,
                              const std::atomic<bool>& given_up) const {
  const fs::path trial = folder_ / "trial", evidence = folder_ / "evidence";
  const std::string settings = read_whole_file(commissioned_file(trial));
  std::vector<std::string> again = loaded_.asked_settings;
  again.push_back("commissioned=" + trial.string());
  const LoadedConfig saved = load_config(loaded_.asked_files, again);
  const bool is_as_checked = whole_settings(saved) == read_whole_file(trial / "whole.yaml");
  if (!is_as_checked || config_crc(*saved.config.get()) != checked.at("config_crc32").get<std::uint32_t>()) {
    throw std::runtime_error("the settings have changed since they were checked: check again");
  }
  fs::remove_all(evidence);
  fs::create_directories(evidence);
  write_whole_file(evidence / "settings.yaml", whole_settings(saved));
  write_whole_file(evidence / "doctor.json", examined.dump(2) + "\n");
  write_whole_file(
      evidence / "commissioning.json",
      Json({{"schema", 1}, {"at", utc_text(std::time(nullptr))}, {"who", who}, {"checked", checked}}).dump(2) + "\n");
  for (const char* file : {"results.csv", "report.html"}) put(trial / file, evidence / file);
  for (const std::string& file : recordings()) put(file, evidence / fs::path(file).filename());
  std::vector<std::string> words = {"evidence", evidence, "--force", "--language", language, "-o", evidence_file()};
  const fs::path key = folder_ / "site.pem";
  if (fs::exists(key)) words = joined(std::move(words), {"--key", key});
  const ErrandOutcome outcome = run_errand(words, given_up);
  fs::remove_all(evidence);
  require_done(outcome, "evidence");
  // Last: what stands over the settings file was proven before.
  write_lasting_file(commissioned_file(folder_), settings);
  return lines_of(outcome.output);
}

}  // namespace pose_wall::tools::live
