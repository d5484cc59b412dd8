// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "command_line/grammar.hpp"
#include "language/language.hpp"
#include "pose_wall.h"
#include "terminal/did_you_mean.hpp"
#include "verbs/one_of.hpp"
#include "verbs/verbs.hpp"

namespace pose_wall::tools {
namespace {

constexpr const char* kDescription =
    "The attitude and position of a tunnelling machine in its roadway, from one 3D LiDAR: roll, pitch, yaw and four "
    "wall distances per frame.";

std::vector<std::string> verb_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands({})) names.push_back(verb->get_name());
  return names;
}

// CLI11 only says that an argument was not expected; the word that was meant is more help.
bool is_unknown_verb(const CLI::App& app, int argc, const char* const* argv) {
  if (argc < 2 || argv[1][0] == '-') return false;
  const std::string word = argv[1];
  const std::vector<std::string> names = verb_names(app);
  for (const std::string& name : names) {
    if (word == name) return false;
  }
  fmt::print(stderr, "{}",
             say("pose_wall: unknown verb '{}'{}\nVerbs: {}. See pose_wall --help.\n", word, did_you_mean(word, names),
                 fmt::join(names, ", ")));
  return true;
}

std::string unknown_option_hint(const CLI::App& app) {
  std::vector<const CLI::App*> parts = {&app};
  for (const CLI::App* verb : app.get_subcommands()) parts.push_back(verb);
  for (const CLI::App* verb : parts) {
    std::vector<std::string> names;
    for (const CLI::Option* option : verb->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    for (const std::string& word : verb->remaining()) {
      std::string hint = did_you_mean(word.substr(0, word.find('=')), names);
      if (word.rfind("--", 0) == 0 && !hint.empty()) return hint;
    }
  }
  return "";
}

int report_parse_error(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
  const std::vector<CLI::App*> verbs = app.get_subcommands();
  const std::string verb = verbs.empty() ? "" : " " + verbs.front()->get_name();
  fmt::print(stderr, "pose_wall{}: {}{}\n{}\n", verb, error.what(), unknown_option_hint(app),
             say("See pose_wall{} --help.", verb));
  return kExitUsage;
}

// It was chosen before the verbs were added, for their help speaks it too; here it is checked and told.
void add_language(CLI::App& verb) {
  verb.add_option_function<std::string>(
          "--language", [](const std::string&) {},
          tr("Language of what a person reads: en or zh; default: POSE_WALL_LANGUAGE, else the locale's"))
      ->check(one_of({"en", "zh"}));
}

void add_verbs(CLI::App& app, int& exit_code) {
  app.require_subcommand(1);
  app.set_version_flag("--version", fmt::format("pose_wall {} (ABI {})", pose_wall_version(), pose_wall_abi_version()));
  add_run(app, exit_code);
  add_motion(app, exit_code);
  add_doctor(app, exit_code);
  add_sim(app, exit_code);
  add_demo(app, exit_code);
  add_report(app, exit_code);
  add_info(app, exit_code);
  add_eval(app, exit_code);
  add_campaign(app, exit_code);
  add_replay_box(app, exit_code);
  add_explain(app, exit_code);
  add_check_config(app, exit_code);
  add_completion(app, exit_code);
  add_man(app, exit_code);
  for (CLI::App* verb : app.get_subcommands({})) add_language(*verb);
  add_language(app);
  name_values(app);
  app.footer(
      "Examples:\n"
      "  pose_wall demo                                               a simulated roadway, measured, with a picture\n"
      "  pose_wall sim --scene clean --frames 50 --output road        frames with their truth\n"
      "  pose_wall doctor -o pose_wall.yaml frames                    settings for your own frames\n"
      "  pose_wall run -c road/pose_wall.yaml -o out.csv road/frames  measure a folder of frames\n"
      "  pose_wall motion -c road/pose_wall.yaml -o motion.csv road/frames    travel of the machine\n"
      "  pose_wall report -c road/pose_wall.yaml -o report.html road/frames   the same as a page for a browser\n"
      "  pose_wall info road.bag                                      contents of a recording\n"
      "  pose_wall eval out.csv road/truth.csv                        errors against the truth\n"
      "  pose_wall campaign --size small --output card                many random roads, with a card of all errors\n"
      "  pose_wall explain -c road/pose_wall.yaml --frame 12 road/frames      explanation of frame 12\n"
      "  pose_wall check-config road/pose_wall.yaml                   resolved settings\n"
      "Each verb has its own --help.");
}

}  // namespace

CommandGrammar command_grammar() {
  CLI::App app(kDescription, "pose_wall");
  int exit_code = kExitDone;
  add_verbs(app, exit_code);
  return grammar_of(app);
}

int run_command(int argc, const char* const* argv) {
  choose_language(language_of(argc, argv));
  choose_did_you_mean([](const std::string& nearest) { return say("; did you mean '{}'?", nearest); });
  CLI::App app(kDescription, "pose_wall");
  int exit_code = kExitDone;
  add_verbs(app, exit_code);
  if (is_unknown_verb(app, argc, argv)) return kExitUsage;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report_parse_error(app, error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "pose_wall {}: {}\n", app.get_subcommands().front()->get_name(), error.what());
    return kExitUsage;
  }
  return exit_code;
}

}  // namespace pose_wall::tools
