// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Which files `--config WORDS` means. A word is a path, or the name of a config that comes with pose_wall (vlp16).

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pose_wall::tools {

struct ConfigPlace {
  std::string file;   // what is to be read
  std::string note;   // of a file that wins over a config of the same name; each sentence for a person
  std::string error;  // no such file or config, with what may be meant; then `file` is the word
};

// A file of that path wins, then WORD.yaml in this folder, then the configs of the folders below, in their order.
ConfigPlace find_config(const std::string& word);

// One word, or several with commas between them, as vlp16,hand_held: a later file stands over the ones before it.
// Blanks beside commas do not count. A file whose name has a comma is found, too. Empty for no word.
std::vector<ConfigPlace> find_configs(const std::string& words);

// Where configs lie that are found by name: POSE_WALL_CONFIG_DIR, share/pose_wall/config of the prefix that this
// program is installed in, and config/ of the source tree that it was built in. Only those that are there.
std::vector<std::filesystem::path> config_folders();

// Help of an option that takes such words: `settings`, and where names are looked for.
std::string config_help(const std::string& settings);

// The name of a config that was found in one of those folders; empty for a file of one's own.
std::string shipped_config_name(const ConfigPlace& place);

// "vlp16", ...; sorted, each once.
std::vector<std::string> config_names();

}  // namespace pose_wall::tools
