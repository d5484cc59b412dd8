// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Scripts that complete the words of the command in a shell: verbs, options, choices, keys after --set and the values
// of those that have choices, scenes, sensors.

#pragma once

#include <string>
#include <vector>

#include "apps/command_line/grammar.hpp"

namespace pose_wall::tools {

std::string bash_completion(const CommandGrammar& grammar);
std::string zsh_completion(const CommandGrammar& grammar);
std::string fish_completion(const CommandGrammar& grammar);

// Keys of the engine that are one of some words, with those words.
struct KeyChoices {
  std::string key;
  std::vector<std::string> words;
};
std::vector<KeyChoices> keys_with_choices();

}  // namespace pose_wall::tools
