// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <cstring>
#include <sstream>

#include "apps/command_line/completion.hpp"
#include "io/config_file/key_table.hpp"
#include "lab/sim/parameters.hpp"

namespace pose_wall::tools {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream all(text);
  for (std::string word; std::getline(all, word, '|');) words.push_back(word);
  return words;
}

}  // namespace

std::vector<KeyChoices> keys_with_choices() {
  std::vector<KeyChoices> keys;
  for (const pose_wall_key_info& key : config_keys()) {
    if (key.type == POSE_WALL_KEY_CHOICE) keys.push_back({key.name, split(key.choices)});
  }
  for (const sim::Parameter& p : sim::parameters()) {
    if (*p.words != '\0') keys.push_back({p.name, split(p.words)});
  }
  return keys;
}

}  // namespace pose_wall::tools
