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

#include "apps/command_line/grammar.hpp"
#include "apps/command_line/help_format.hpp"
#include "apps/command_line/language_option.hpp"
#include "apps/command_line/parse_fault.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/language/language.hpp"
#include "io/terminal/did_you_mean.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/program_word.hpp"
#include "pose_wall.h"

namespace pose_wall::tools {
namespace {

constexpr const char* kDescription = translatable(
    "The attitude and position of a tunnelling machine in its roadway, from one 3D LiDAR: roll, pitch, yaw and four "
    "wall distances per frame.");

std::vector<std::string> verb_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands({})) names.push_back(verb->get_name());
  return names;
}

// CLI11 would only find a word left over; the verb that was meant is more help.
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

int report_parse_error(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
  const std::vector<CLI::App*> verbs = app.get_subcommands();
  const std::string verb = verbs.empty() ? "" : " " + verbs.front()->get_name();
  fmt::print(stderr, "pose_wall{}: {}\n{}\n", verb, parse_fault_text(app, error), say("See pose_wall{} --help.", verb));
  return kExitUsage;
}

// What is typed, and what for.
struct Example {
  const char *words, *purpose;
};

constexpr Example kExamples[] = {
    {"pose_wall demo", translatable("a simulated roadway, measured, with a picture")},
    {"pose_wall sim --scene clean --frames 50 --output road", translatable("frames with their truth")},
    {"pose_wall doctor -o pose_wall.yaml frames", translatable("settings for your own frames")},
    {"pose_wall run -c road/pose_wall.yaml -o out.csv road/frames", translatable("measure a folder of frames")},
    {"pose_wall motion -c road/pose_wall.yaml -o motion.csv road/frames", translatable("travel of the machine")},
    {"pose_wall map -o map --poses poses.tum aces.clf.gz", translatable("a map of planar scans")},
    {"pose_wall localise map --restart 60 aces.clf.gz", translatable("the place in a map, after restarts")},
    {"pose_wall plan map --from 0,0,0 --to 12,3,90", translatable("a route through a map")},
    {"pose_wall drive --seed 2 -o story", translatable("a machine that follows its own map, in the simulator")},
    {"pose_wall report -c road/pose_wall.yaml -o report.html road/frames",
     translatable("the same as a page for a browser")},
    {"pose_wall info road.bag", translatable("contents of a recording")},
    {"pose_wall eval out.csv road/truth.csv", translatable("errors against the truth")},
    {"pose_wall campaign --size small --output card", translatable("many random roads, with a card of all errors")},
    {"pose_wall explain -c road/pose_wall.yaml --frame 12 road/frames", translatable("explanation of frame 12")},
    {"pose_wall check-config road/pose_wall.yaml", translatable("resolved settings")},
    {"pose_wall evidence commissioning -o evidence.zip --key site.pem", translatable("a signed zip of a folder")},
};

std::string command_footer() {
  std::string text = fmt::format("{}\n", tr("Examples:"));
  for (const Example& example : kExamples) text += fmt::format("  {:<68} {}\n", example.words, tr(example.purpose));
  return text + tr("Each verb has its own --help.");
}

void add_verbs(CLI::App& app, int& exit_code) {
  use_help_format(app);
  app.require_subcommand(1);
  app.set_version_flag("--version", fmt::format("pose_wall {} (ABI {})", pose_wall_version(), pose_wall_abi_version()),
                       tr("Display program version information and exit"));
  add_run(app, exit_code);
  add_motion(app, exit_code);
  add_scan(app, exit_code);
  add_map(app, exit_code);
  add_localise(app, exit_code);
  add_plan(app, exit_code);
  add_drive(app, exit_code);
  add_doctor(app, exit_code);
  add_sim(app, exit_code);
  add_demo(app, exit_code);
  add_report(app, exit_code);
  add_info(app, exit_code);
  add_evidence(app, exit_code);
  add_eval(app, exit_code);
  add_campaign(app, exit_code);
  add_replay_box(app, exit_code);
  add_explain(app, exit_code);
  add_check_config(app, exit_code);
  add_completion(app, exit_code);
  add_man(app, exit_code);
  for (CLI::App* verb : app.get_subcommands({})) add_language_option(*verb);
  add_language_option(app);
  name_values(app);
  name_verb_group(app);
  app.footer(command_footer());
}

}  // namespace

CommandGrammar command_grammar() {
  CLI::App app(tr(kDescription), "pose_wall");
  int exit_code = kExitDone;
  add_verbs(app, exit_code);
  return grammar_of(app);
}

// The exit status of the verb that the words name. Whichever it is, and however it came to its end: after Ctrl-C it is
// that of an interrupt, also before a first result. Bad usage stays bad usage.
int run_command(int argc, const char* const* argv) {
  const InterruptWatch watch;
  set_program_word(argc > 0 ? argv[0] : "");
  choose_language_by(argc, argv, "pose_wall");
  CLI::App app(tr(kDescription), "pose_wall");
  int exit_code = kExitDone;
  add_verbs(app, exit_code);
  if (is_unknown_verb(app, argc, argv)) return kExitUsage;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report_parse_error(app, error);
  } catch (const Interrupted&) {
    fmt::print(stderr, "pose_wall {}: {}\n", app.get_subcommands().front()->get_name(), tr("interrupted"));
  } catch (const std::exception& error) {
    fmt::print(stderr, "pose_wall {}: {}\n", app.get_subcommands().front()->get_name(), error.what());
    return kExitUsage;
  }
  return InterruptWatch::is_interrupted() ? kExitInterrupted : exit_code;
}

}  // namespace pose_wall::tools
