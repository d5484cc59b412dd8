// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/config_file/config_place.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <system_error>

#include "io/language/language.hpp"
#include "io/terminal/did_you_mean.hpp"

namespace pose_wall::tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kConfigEnding = ".yaml";
constexpr const char* kDefaults = "pose_wall.yaml";  // tells the folder from others called config
constexpr int kParentsMax = 5;                       // from build/release/tools/ to the source tree

fs::path folder_of_program() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path() : program.parent_path();
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_directory(path, ignored);
}

void add_if_there(const fs::path& folder, std::vector<fs::path>* folders) {
  std::error_code ignored;
  if (!folder.empty() && fs::is_directory(folder, ignored)) folders->push_back(folder.lexically_normal());
}

bool is_name(const std::string& word) {
  return !word.empty() && word.find('/') == std::string::npos && word != "-" && word.front() != '.';
}

std::string without_blanks_around(const std::string& word) {
  constexpr const char* kBlanks = " \t";
  const std::size_t from = word.find_first_not_of(kBlanks);
  return from == std::string::npos ? "" : word.substr(from, word.find_last_not_of(kBlanks) - from + 1);
}

std::string with_ending(const std::string& word) {
  return fs::path(word).extension() == kConfigEnding ? word : word + kConfigEnding;
}

// The first config of this name; empty where there is none.
std::string config_of_name(const std::string& word) {
  for (const fs::path& folder : config_folders()) {
    if (is_file(folder / with_ending(word))) return (folder / with_ending(word)).string();
  }
  return "";
}

ConfigPlace in_this_folder(const std::string& file, const std::string& other) {
  std::error_code ignored;
  if (other.empty() || fs::equivalent(file, other, ignored)) return {file, "", ""};
  return {file, say("--config: {} of this folder is taken, not {}", file, other), ""};
}

std::string what_is_there(const std::string& word) {
  const std::vector<std::string> names = config_names();
  if (names.empty()) return "";
  const std::string stem = fs::path(word).stem().string();
  std::string meant = did_you_mean(stem, names);
  for (const std::string& name : names) {
    if (name == stem) meant = say("; did you mean '{}'?", name);
  }
  if (meant.empty()) meant = tr(".");
  return say("{} Configs that are found by name: {}", meant, fmt::format("{}", fmt::join(names, ", ")));
}

}  // namespace

std::vector<fs::path> config_folders() {
  std::vector<fs::path> folders;
  if (const char* told = std::getenv("POSE_WALL_CONFIG_DIR")) add_if_there(told, &folders);
  fs::path parent = folder_of_program();
  if (parent.empty()) return folders;
  add_if_there(parent / "../share/pose_wall/config", &folders);
  for (int i = 0; i < kParentsMax && parent.has_relative_path(); ++i, parent = parent.parent_path()) {
    if (is_file(parent / "config" / kDefaults)) add_if_there(parent / "config", &folders);
  }
  return folders;
}

std::vector<std::string> config_names() {
  std::set<std::string> names;
  for (const fs::path& folder : config_folders()) {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() == kConfigEnding) names.insert(entry.path().stem().string());
    }
  }
  return {names.begin(), names.end()};
}

ConfigPlace find_config(const std::string& word) {
  std::error_code ignored;
  if (word.empty()) return {};
  if (!is_name(word)) {
    const bool is_there = fs::exists(word, ignored) || word == "-";
    return {word, "", is_there ? "" : say("{}: no such file{}", word, what_is_there(word))};
  }
  const std::string other = config_of_name(word);
  if (fs::exists(word, ignored) && !(fs::is_directory(word, ignored) && !other.empty())) {
    return in_this_folder(word, other);
  }
  if (is_file(with_ending(word))) return in_this_folder(with_ending(word), other);
  if (!other.empty()) return {other, "", ""};
  return {word, "", say("{}: no such file{}", word, what_is_there(word))};
}

std::vector<ConfigPlace> find_configs(const std::string& words) {
  std::error_code ignored;
  if (words.empty()) return {};
  if (fs::exists(words, ignored)) return {find_config(words)};
  std::vector<ConfigPlace> places;
  for (std::size_t from = 0; from <= words.size();) {
    const std::size_t comma = std::min(words.find(',', from), words.size());
    const std::string word = without_blanks_around(words.substr(from, comma - from));
    places.push_back(word.empty() ? ConfigPlace{words, "",
                                                say("'{}': a config is missing beside a comma; allowed: names and "
                                                    "files with one comma between, as vlp16,hand_held",
                                                    words)}
                                  : find_config(word));
    from = comma + 1;
  }
  return places;
}

std::string config_help(const std::string& settings) {
  return say("{}. Names are looked for in this folder, in that of POSE_WALL_CONFIG_DIR, and among those installed",
             settings);
}

std::string shipped_config_name(const ConfigPlace& place) {
  const fs::path file = place.file;
  const std::vector<fs::path> folders = config_folders();
  std::error_code ignored;
  const fs::path parent = fs::absolute(file, ignored).parent_path();
  const bool is_shipped = std::any_of(folders.begin(), folders.end(),
                                      [&](const fs::path& folder) { return fs::equivalent(folder, parent, ignored); });
  return is_shipped ? file.stem().string() : "";
}

}  // namespace pose_wall::tools
