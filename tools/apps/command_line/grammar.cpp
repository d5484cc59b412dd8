// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/command_line/grammar.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <sstream>
#include <string_view>

#include "io/config_file/key_table.hpp"
#include "io/config_file/motion_settings.hpp"
#include "lab/sim/parameters.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/sensors.hpp"
#include "study/explain/gate_list.hpp"
#include "study/planar/cloud_scans.hpp"
#include "study/planar/map_localiser.hpp"
#include "study/planar/planned_route.hpp"
#include "study/planar/slam_settings.hpp"

namespace pose_wall::tools {
namespace {

// By the option's long name: verbs that ask for the same call it the same.
struct Meaning {
  std::string_view long_name;
  const char* value;
  ValueKind kind;
};

constexpr std::array<Meaning, 13> kMeanings = {{
    {"config", "FILE", ValueKind::kFile},
    {"set", "KEY=VALUE", ValueKind::kEngineKey},
    {"simulate", "KEY=VALUE", ValueKind::kSimulatorKey},
    {"scene", "SCENE", ValueKind::kScene},
    {"scenes", "SCENE,...", ValueKind::kScene},
    {"sensor", "SENSOR", ValueKind::kSensor},
    {"sensors", "SENSOR,...", ValueKind::kSensor},
    {"truth", "FILE", ValueKind::kFile},
    {"annotate", "FOLDER", ValueKind::kFile},
    {"sweep", "GATE=A,B", ValueKind::kGate},
    {"ablate", "GATE,...", ValueKind::kGateName},
    {"title", "TEXT", ValueKind::kText},
    {"stamp", "SECONDS", ValueKind::kText},
}};

std::string long_name(const CLI::Option& option) {
  return option.get_lnames().empty() ? "" : option.get_lnames().front();
}

const Meaning* meaning_of(const CLI::Option& option) {
  for (const Meaning& meaning : kMeanings) {
    if (meaning.long_name == long_name(option)) return &meaning;
  }
  return nullptr;
}

bool is_flag(const CLI::Option& option) {
  return option.get_items_expected_max() == 0;
}

// "TEXT:{csv,json}" gives csv and json.
std::vector<std::string> choices_of(const std::string& type) {
  const std::size_t from = type.find('{'), to = type.find('}');
  std::vector<std::string> choices;
  if (from == std::string::npos || to == std::string::npos) return choices;
  std::istringstream words(type.substr(from + 1, to - from - 1));
  for (std::string word; std::getline(words, word, ',');) choices.push_back(word);
  return choices;
}

bool is_number(const std::string& type) {
  return type.rfind("INT", 0) == 0 || type.rfind("UINT", 0) == 0 || type.rfind("FLOAT", 0) == 0;
}

// Of the verb's --set.
ValueKind key_kind(const std::string& verb) {
  if (verb == "sim") return ValueKind::kSimulatorKey;
  if (verb == "plan") return ValueKind::kPlannerKey;
  if (verb == "localise") return ValueKind::kLocaliseKey;
  if (verb == "scan") return ValueKind::kScanKey;
  return verb == "map" ? ValueKind::kMapKey : ValueKind::kEngineKey;
}

ValueKind kind_of(const CLI::App& verb, const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (is_flag(option)) return ValueKind::kNone;
  if (!choices_of(type).empty()) return ValueKind::kChoice;
  if (is_number(type)) return ValueKind::kNumber;
  if (long_name(option) == "set") return key_kind(verb.get_name());
  const Meaning* meaning = meaning_of(option);
  return meaning != nullptr ? meaning->kind : ValueKind::kFile;
}

// What a manual puts behind the option.
std::string value_name(const CLI::Option& option) {
  const std::string type = option.get_type_name(), name = type.substr(0, type.find(':'));
  const std::vector<std::string> choices = choices_of(type);
  const Meaning* meaning = meaning_of(option);
  if (is_flag(option)) return "";
  if (!choices.empty()) return fmt::format("{}", fmt::join(choices, "|"));
  if (is_number(type)) return name == "FLOAT" ? "NUMBER" : "N";
  return name == "TEXT" && meaning != nullptr ? meaning->value : name;
}

OptionGrammar option_grammar(const CLI::App& verb, const CLI::Option& option) {
  OptionGrammar out;
  out.is_positional = option.get_positional();
  for (const std::string& name : option.get_snames()) out.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) out.names.push_back("--" + name);
  if (out.is_positional) out.names = {option.get_name(true)};
  out.kind = kind_of(verb, option);
  const std::string type = option.get_type_name();
  out.choices = choices_of(type);
  out.value = value_name(option);
  out.help = option.get_description();
  out.default_text = option.get_default_str();
  out.is_required = option.get_required();
  out.is_repeatable = option.get_expected_max() > 1;
  out.is_list = out.value.find(",...") != std::string::npos;
  return out;
}

VerbGrammar verb_grammar(const CLI::App& verb) {
  VerbGrammar out{verb.get_name(), verb.get_description(), verb.get_footer(), {}};
  for (const CLI::Option* option : verb.get_options()) out.options.push_back(option_grammar(verb, *option));
  return out;
}

template <typename Rows>
std::vector<std::string> names_of(const Rows& rows, const char* ending = "") {
  std::vector<std::string> names;
  for (const auto& row : rows) names.push_back(std::string(row.name) + ending);
  return names;
}

// Those of pose_walld have no command here that would heed them.
std::vector<std::string> config_words() {
  std::vector<std::string> names = names_of(config_keys(), "=");
  for (const std::string& name : names_of(motion_keys(), "=")) names.push_back(name);
  return names;
}

std::vector<std::string> joined(std::vector<std::string> first, const std::vector<std::string>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

void name_values(CLI::App& app) {
  for (CLI::App* verb : app.get_subcommands({})) {
    for (CLI::Option* option : verb->get_options()) {
      const std::string type = option->get_type_name();
      if (is_flag(*option) || type != "TEXT") continue;
      if (option->get_positional()) {
        option->type_name("");
      } else if (const Meaning* meaning = meaning_of(*option)) {
        option->type_name(meaning->value);
      } else {
        const std::string help = option->get_description();  // some verbs speak English alone
        const bool is_folder = help.rfind("Folder", 0) == 0 || help.find(tr("Folder")) != std::string::npos;
        option->type_name(is_folder ? "FOLDER" : "FILE");
      }
    }
  }
}

CommandGrammar grammar_of(const CLI::App& app) {
  CommandGrammar grammar{verb_grammar(app), {}};
  grammar.command.name.clear();
  for (const CLI::App* verb : app.get_subcommands({})) {
    if (!verb->get_group().empty()) grammar.verbs.push_back(verb_grammar(*verb));
  }
  return grammar;
}

std::vector<std::string> value_words(const OptionGrammar& option) {
  switch (option.kind) {
    case ValueKind::kChoice:
      return option.choices;
    case ValueKind::kEngineKey:
      return config_words();
    case ValueKind::kSimulatorKey:
      return names_of(sim::parameters(), "=");
    case ValueKind::kPlannerKey:
      return names_of(plan_setting_rows(), "=");
    case ValueKind::kScanKey:
      return joined(config_words(), names_of(scanner_setting_rows(), "="));
    case ValueKind::kMapKey:
      return joined(joined(config_words(), names_of(scanner_setting_rows(), "=")), names_of(slam_setting_rows(), "="));
    case ValueKind::kLocaliseKey:
      return joined(joined(config_words(), names_of(scanner_setting_rows(), "=")),
                    names_of(localise_setting_rows(), "="));
    case ValueKind::kGate:
      return names_of(explain::gate_list(), "=");
    case ValueKind::kGateName:
      return joined({"each"}, names_of(explain::gate_list()));
    case ValueKind::kScene:
      return names_of(sim::scenes());
    case ValueKind::kSensor:
      return sim::sensor_names();
    default:
      return {};
  }
}

}  // namespace pose_wall::tools
