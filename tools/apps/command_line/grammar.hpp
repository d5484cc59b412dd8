// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What can be said to the command, read off its own parser: for completions and the manual page, which so cannot say
// anything else than the command does.

#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace pose_wall::tools {

// What may stand behind an option.
enum class ValueKind {
  kNone,
  kText,
  kNumber,
  kFile,
  kChoice,
  kEngineKey,
  kSimulatorKey,
  kPlannerKey,
  kScanKey,      // of the engine and of planar scans
  kMapKey,       // these, and of the SLAM
  kLocaliseKey,  // those of kScanKey, and of localisation
  kGate,         // of --sweep, with an equals sign
  kGateName,     // each, or names
  kScene,
  kSensor
};

struct OptionGrammar {
  std::vector<std::string> names;  // "-c", "--config"; the one name of a positional
  std::string value;               // "FILE", "csv|json"; empty for a flag
  ValueKind kind = ValueKind::kNone;
  std::vector<std::string> choices;
  std::string help;
  std::string default_text;
  bool is_positional = false;
  bool is_required = false;
  bool is_repeatable = false;
  bool is_list = false;  // of names, separated by commas
};

struct VerbGrammar {
  std::string name;
  std::string help;
  std::string footer;  // examples and exit statuses
  std::vector<OptionGrammar> options;
};

struct CommandGrammar {
  VerbGrammar command;  // without a verb
  std::vector<VerbGrammar> verbs;
};

// Names what stands behind options by what it is ("FILE", "SCENE"), where a verb only said that it is text.
void name_values(CLI::App& app);

// Verbs of the group "" are left out: they are for scripts.
CommandGrammar grammar_of(const CLI::App& app);

// The words that may stand behind the option: choices, names of scenes and sensors, keys and gates with "=" behind.
std::vector<std::string> value_words(const OptionGrammar& option);

}  // namespace pose_wall::tools
