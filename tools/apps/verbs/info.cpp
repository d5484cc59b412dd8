// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall info: what inputs hold, and what to do with them next.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/options/frame_arguments.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/inputs/frame_sequence.hpp"
#include "io/language/language.hpp"
#include "io/terminal/frames_text.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/progress_bar.hpp"
#include "study/info/input_facts.hpp"
#include "study/info/next_steps.hpp"
#include "study/planar/carmen_facts.hpp"
#include "study/planar/carmen_scans.hpp"

namespace pose_wall::tools {
namespace {

struct InfoOptions {
  std::vector<std::string> inputs;
  InputOptions input;
  bool json = false;
  bool quiet = false;
};

struct Looked {
  std::string json;  // empty: nothing could be read
  bool complete = false;
  SensorFacts sensor;
  std::string topic;   // of a bag with several, the one that was looked at
  std::string source;  // of several that send on it, the one that was
  int restart_m = 0;   // of a log of CARMEN: worth trying; 0: it is none
};

// Each input is looked at by itself; topic, source, sensor and metadata have to be of one of them, not of each.
void expect_use(const InfoOptions& options) {
  const SensorOptions& packets = options.input.packets;
  const bool has_words = !options.input.topic.empty() || !options.input.source.empty() || !packets.sensor.empty() ||
                         !packets.metadata.empty();
  if (has_words && options.inputs.size() > 1) FrameSequence(options.inputs, options.input);
}

// One clear error instead of a table that counts one unreadable frame.
Looked not_there(const std::string& input) {
  fmt::print(stderr, "pose_wall info: {}", say("{}: there is no such file or folder\n", input));
  return {};
}

void gather(FrameSequence& frames, const std::string& input, const InfoOptions& options, InputFacts& facts) {
  ProgressBar bar(frames.frames(), !options.quiet && is_terminal(2));
  while (const std::optional<SourcedFrame> frame = frames.next()) {
    if (InterruptWatch::is_interrupted()) break;
    facts.add(*frame);
    bar.advance(input);
  }
}

Looked look_at_log(const std::string& input, const InfoOptions& options) {
  Looked looked;
  try {
    const CarmenLog log = read_carmen_log(input);
    if (!options.json) fmt::print("{}\n{}\n", input, carmen_facts_text(log));
    looked.json = carmen_facts_json(input, log);
    looked.complete = log.skip(CarmenSkip::kBadLine).lines + log.skip(CarmenSkip::kNotFinite).lines == 0;
    looked.restart_m = worthy_restart_m(log);
  } catch (const CarmenError& error) {
    fmt::print(stderr, "pose_wall info: {}\n", error.what());
  }
  return looked;
}

Looked look_at(const std::string& input, const InfoOptions& options) {
  std::error_code ignored;
  if (!std::filesystem::exists(input, ignored)) return not_there(input);
  if (std::filesystem::is_regular_file(input, ignored) && is_carmen_log(input)) return look_at_log(input, options);
  InputOptions of_this = options.input;
  of_this.of_others = options.inputs.size() > 1;
  FrameSequence frames({input}, of_this);
  for (const std::string& error : frames.errors()) fmt::print(stderr, "pose_wall info: {}\n", error);
  // Of a bag the topics are told even where none of them holds a frame.
  if (!frames.errors().empty() && frames.about().topics.empty()) return {};
  if (!options.quiet) {
    for (const std::string& note : frames.notes()) fmt::print(stderr, "{}\n", note);
  }
  InputFacts facts;
  gather(frames, input, options, facts);
  if (InterruptWatch::is_interrupted()) {
    fmt::print(stderr, "pose_wall info: {}: {}\n", input, say("interrupted after {}", frames_text(facts.frames())));
    if (facts.frames() == 0) return {};
  }
  for (const std::string& error : facts.errors()) fmt::print(stderr, "pose_wall info: {}\n", error);
  const SourceAbout about = frames.about();
  // Of a bag the topics are worth a table even where no cloud could be read.
  const bool is_worth_a_table = !facts.points().empty() || !about.topics.empty() || facts.errors().empty();
  if (!options.json && is_worth_a_table) fmt::print("{}\n{}\n", input, facts_text(about, facts));
  const bool has_choice = about.topics.size() > 1;
  Looked looked;
  looked.json = facts_json(input, about, facts);
  looked.complete = facts.unreadable() == 0 && frames.errors().empty();
  looked.sensor = facts.sensor();
  if (has_choice) looked.topic = about.topic;
  for (const SourceSender& sender : about.senders) {
    if (sender.is_read && about.senders.size() > 1) looked.source = sender.name;
  }
  return looked;
}

std::string next_text_of_log(const std::string& log, int restart_m) {
  return next_steps_text(
      {{tr("make a map of it, with the pose of every scan"), {"map", "-o", "map", "--poses", "poses.tum", log}},
       {say("then try restarts in this map, every {} m", restart_m),
        {"localise", "map", log, "--restart", std::to_string(restart_m), "--truth", "poses.tum", "-o", "found"}},
       {tr("and see both in a browser"), {"report", "-o", "map.html", "map", "found"}}});
}

// For one input, or for several of the same sensor.
std::string next_text(const InfoOptions& options, const std::vector<Looked>& looked) {
  if (looked.size() == 1 && looked.front().restart_m > 0) {
    return next_text_of_log(options.inputs.front(), looked.front().restart_m);
  }
  const auto is_like_first = [&looked](const Looked& other) {
    return other.complete && other.sensor.returns > 0.0 && other.sensor.config == looked.front().sensor.config &&
           other.topic == looked.front().topic && other.source == looked.front().source &&
           !is_unit_doubtful(other.sensor.ranges);
  };
  if (looked.empty() || !std::all_of(looked.begin(), looked.end(), is_like_first)) return "";
  InputOptions input = options.input;
  if (input.topic.empty()) input.topic = looked.front().topic;
  if (input.source.empty()) input.source = looked.front().source;
  const std::vector<std::string> words = input_words(options.inputs, input);
  const auto with_inputs = [&words](std::vector<std::string> verb) {
    verb.insert(verb.end(), words.begin(), words.end());
    return verb;
  };
  std::vector<std::string> run = {"run"};
  const std::string& config = looked.front().sensor.config;
  if (!config.empty() && !looked.front().sensor.has_defaults()) run.insert(run.end(), {"--config", config});
  run.insert(run.end(), {"-o", "results.csv"});
  return next_steps_text(
      {{tr("find the settings of this machine: record 30 s while it stands in a straight road"),
        with_inputs({"doctor", "-o", "pose_wall.yaml"})},
       {config.empty() ? tr("measure with the defaults; no file of config/ is made for this sensor")
                       : tr("measure at once; add -s forward_axis=+Y (-X, -Y) if the road does not lie along +X"),
        with_inputs(std::move(run))}});
}

int info(const InfoOptions& options) {
  expect_use(options);
  if (options.json) choose_language(Language::kEnglish);  // programs read it
  int exit_code = kExitDone;
  std::string pages;
  std::vector<Looked> all;
  for (const std::string& input : options.inputs) {
    all.push_back(look_at(input, options));
    const Looked& looked = all.back();
    if (!looked.complete) exit_code = kExitUnreadable;
    if (!looked.json.empty()) pages += (pages.empty() ? "" : ",\n") + looked.json;
    if (InterruptWatch::is_interrupted()) return kExitInterrupted;
  }
  fmt::print("{}", options.json ? fmt::format("[{}]\n", pages) : next_text(options, all));
  return exit_code;
}

}  // namespace

void add_info(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<InfoOptions>();
  options->input.fullest_topic = true;
  CLI::App* verb = app.add_subcommand("info", tr("Show what frame files, bags, captures and logs of CARMEN hold"));
  verb->add_option("INPUT", options->inputs, tr(kScanInputHelp))->required();
  add_input_options(verb, &options->input);
  verb->add_flag("--json", options->json, tr("A list with one object per input instead of tables"));
  verb->add_flag("-q,--quiet", options->quiet, tr("Nothing on stderr but errors"));
  verb->footer(
      tr("Examples:\n  pose_wall info road.bag frames/\n  pose_wall info aces.clf\n"
         "A bag may have several topics of clouds. Then the fullest is taken; --topic names another.\n"
         "Exit status: 0 done, 1 an input or a frame could not be read, 2 bad usage, 130 interrupted."));
  verb->callback([options, &exit_code] { exit_code = info(*options); });
}

}  // namespace pose_wall::tools
