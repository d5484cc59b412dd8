// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall info: what inputs hold.

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "info/input_facts.hpp"
#include "inputs/frame_sequence.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress_bar.hpp"
#include "verbs/frame_options.hpp"
#include "verbs/verbs.hpp"

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
};

// Each input is looked at by itself; topic, sensor and metadata have to be of one of them, not of each.
void expect_use(const InfoOptions& options) {
  const SensorOptions& packets = options.input.packets;
  const bool has_words = !options.input.topic.empty() || !packets.sensor.empty() || !packets.metadata.empty();
  if (has_words && options.inputs.size() > 1) FrameSequence(options.inputs, options.input);
}

Looked look_at(const std::string& input, const InfoOptions& options) {
  InputOptions of_this = options.input;
  of_this.of_others = options.inputs.size() > 1;
  FrameSequence frames({input}, of_this);
  for (const std::string& error : frames.errors()) fmt::print(stderr, "pose_wall info: {}\n", error);
  if (!frames.errors().empty()) return {};
  InputFacts facts;
  {
    ProgressBar bar(frames.frames(), !options.quiet && is_terminal(2));
    while (const std::optional<SourcedFrame> frame = frames.next()) {
      if (InterruptWatch::is_interrupted()) break;
      facts.add(*frame);
      bar.advance(input);
    }
  }
  for (const std::string& error : facts.errors()) fmt::print(stderr, "pose_wall info: {}\n", error);
  if (!options.json) fmt::print("{}\n{}\n", input, facts_text(frames.about(), facts));
  return {facts_json(input, frames.about(), facts), facts.unreadable() == 0};
}

int info(const InfoOptions& options) {
  expect_use(options);
  const InterruptWatch watch;
  int exit_code = kExitDone;
  std::string pages;
  for (const std::string& input : options.inputs) {
    const Looked looked = look_at(input, options);
    if (!looked.complete) exit_code = kExitUnreadable;
    if (!looked.json.empty()) pages += (pages.empty() ? "" : ",\n") + looked.json;
    if (InterruptWatch::is_interrupted()) return kExitInterrupted;
  }
  if (options.json) fmt::print("[{}]\n", pages);
  return exit_code;
}

}  // namespace

void add_info(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<InfoOptions>();
  options->input.fullest_topic = true;
  CLI::App* verb = app.add_subcommand("info", "Say what frame files, bags and captures hold");
  verb->add_option("INPUT", options->inputs, kInputHelp)->required();
  add_input_options(verb, &options->input);
  verb->add_flag("--json", options->json, "A list with one object per input instead of tables");
  verb->add_flag("-q,--quiet", options->quiet, "Nothing on stderr but errors");
  verb->footer(
      "Example:\n  pose_wall info road.bag frames/\n"
      "Of a bag with several topics of clouds the fullest is looked at; --topic names another.\n"
      "Exit status: 0 done, 1 an input or a frame could not be read, 2 bad usage, 130 interrupted.");
  verb->callback([options, &exit_code] { exit_code = info(*options); });
}

}  // namespace pose_wall::tools
