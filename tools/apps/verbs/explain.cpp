// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall explain: the reasons for the results of one frame, or of a whole recording in short.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "apps/options/frame_arguments.hpp"
#include "apps/verbs/complaint.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/language/language.hpp"
#include "io/outputs/output_file.hpp"
#include "io/terminal/colours.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/program_word.hpp"
#include "io/terminal/progress_bar.hpp"
#include "io/terminal/shell_word.hpp"
#include "lab/campaign/command_words.hpp"
#include "study/explain/explained_recording.hpp"
#include "study/explain/explanation_json.hpp"
#include "study/explain/explanation_text.hpp"
#include "study/explain/frame_choice.hpp"
#include "study/explain/gate_list.hpp"
#include "study/explain/prose.hpp"
#include "study/explain/summary_json.hpp"
#include "study/explain/summary_text.hpp"

namespace pose_wall::tools {
namespace {

using explain::ChoiceKind;
using explain::Explained;

struct ExplainOptions {
  FrameOptions frames;
  explain::FrameChoice choice;
  std::string picture;
  bool json = false;

  bool shows_progress() const { return !frames.quiet && is_terminal(2); }
};

// The command as it was given, but without a frame.
std::string command_of(const FrameOptions& frames) {
  const std::pair<const char*, std::string> texts[] = {{"topic", frames.input.topic},
                                                       {"source", frames.input.source},
                                                       {"sensor", frames.input.packets.sensor},
                                                       {"metadata", frames.input.packets.metadata}};
  std::string command = program_word() + " explain" + campaign::engine_words({frames.config_file, frames.settings});
  if (frames.rate_hz != FrameOptions{}.rate_hz) command += fmt::format(" --rate {}", frames.rate_hz);
  for (const auto& [name, text] : texts) {
    if (!text.empty()) command += fmt::format(" --{} {}", name, shell_word(text));
  }
  for (const std::string& input : frames.inputs) command += " " + shell_word(input);
  return command;
}

// Nothing after Ctrl-C.
std::optional<explain::FoundFrame> found_frame(const ExplainOptions& options, FrameSequence& inputs) {
  ProgressBar bar(inputs.frames(), options.shows_progress());
  return explain::find_frame(options.choice, inputs, options.frames.rate_hz, [&](const std::string& name) {
    bar.advance(name);
    return !InterruptWatch::is_interrupted();
  });
}

std::string explanation_text(const LoadedConfig& loaded, const Explained& explained) {
  const explain::Notes notes(*explained.traced->trace);
  const std::uint64_t frame = explained.outcome.frame;
  std::string text = frame == 0 ? say("{}: frame {}", explained.outcome.source, frame)
                                : say("{}: frame {}, measured after {} before it", explained.outcome.source, frame,
                                      explain::frames_text(frame));
  text += "\n\n" + explain::sentences_text(explained.explanation);
  text += fmt::format("\n{}\n{}", tr("Planes that were considered"),
                      explain::planes_text(*loaded.config.get(), explained.traced->result, notes));
  text += fmt::format("\n{}\n{}", tr("Gates"), explain::gates_text(notes, wants_colours(1)));
  if (notes.dropped() > 0) text += say("Notes left out for lack of room: {}.", notes.dropped()) + "\n";
  return text;
}

// It is SVG whatever the name of the file.
void expect_svg(const std::string& picture) {
  if (picture.empty() || std::filesystem::path(picture).extension() == ".svg") return;
  throw std::invalid_argument(
      say("--picture {}: the picture is written as SVG; a file ending in .svg is allowed", picture));
}

int explain_one(const ExplainOptions& options, const LoadedConfig& loaded, FrameSequence& inputs, OutputFile* picture) {
  const std::optional<explain::FoundFrame> found = found_frame(options, inputs);
  if (!found) return kExitInterrupted;
  const explain::RecordingRun run{loaded, options.frames.rate_hz, options.shows_progress(), picture != nullptr};
  std::optional<FrameSequence> again;
  if (found->read_frames) again.emplace(options.frames.open());
  const std::optional<Explained> explained = explain::explain_one(run, again ? *again : inputs, found->frame);
  if (!explained) return kExitInterrupted;
  if (!explained->outcome.result) {
    fmt::print(stderr, "pose_wall explain: {}: {}\n", explained->outcome.source, explained->outcome.error);
    return kExitUnreadable;
  }
  if (!found->told.empty()) fmt::print(options.json ? stderr : stdout, "{}\n", found->told);
  fmt::print("{}", options.json ? explain::explanation_json(*loaded.config.get(), explained->outcome,
                                                            *explained->traced, explained->explanation)
                                : explanation_text(loaded, *explained));
  if (picture != nullptr) picture->write(explained->picture);
  return kExitDone;
}

void print_recording(const ExplainOptions& options, const LoadedConfig& loaded,
                     const explain::ExplainedRecording& all) {
  const Explained& worst = *all.worst;
  const bool whole = explain::kind_of(options.choice) == ChoiceKind::kRecording;
  const std::string command = command_of(options.frames);
  if (options.json) {
    Json page = explain::explanation_page(*loaded.config.get(), worst.outcome, *worst.traced, worst.explanation);
    fmt::print("{}\n", json_text(whole ? Json{{"digest", explain::summary_json(all.summary, command)},
                                              {"interrupted", all.interrupted},
                                              {"worst_frame", page}}
                                       : page,
                                 2));
    return;
  }
  if (whole) fmt::print("{}\n", explain::summary_text(all.summary, command));
  fmt::print("{}\n\n{}",
             say("The worst of {} is frame {}", explain::frames_text(all.summary.frames()), all.summary.worst()->frame),
             explanation_text(loaded, worst));
}

int explain_all(const ExplainOptions& options, const LoadedConfig& loaded, FrameSequence& inputs, OutputFile* picture) {
  if (inputs.frames() == 0) throw std::runtime_error(tr("no frame to explain"));
  const explain::RecordingRun run{loaded, options.frames.rate_hz, options.shows_progress(), picture != nullptr};
  const explain::ExplainedRecording all = explain::explain_all(run, inputs);
  if (all.interrupted) {
    fmt::print(stderr, "pose_wall explain: {}\n",
               say("interrupted: the digest is of the first {}", explain::frames_text(all.summary.frames())));
  }
  if (!all.worst) {
    if (!all.interrupted) fmt::print(stderr, "pose_wall explain: {}\n", tr("no frame could be read"));
    return all.interrupted ? kExitInterrupted : kExitUnreadable;
  }
  print_recording(options, loaded, all);
  if (picture != nullptr) picture->write(all.worst->picture);
  if (all.interrupted) return kExitInterrupted;
  return all.summary.unreadable() > 0 || !inputs.errors().empty() ? kExitUnreadable : kExitDone;
}

int explain_inputs(const ExplainOptions& options) {
  const LoadedConfig loaded = options.frames.load();
  FrameSequence inputs = options.frames.open();
  for (const std::string& error : inputs.errors()) fmt::print(stderr, "pose_wall explain: {}\n", error);
  std::optional<OutputFile> picture;
  if (!options.picture.empty()) picture.emplace(options.picture, options.frames.files_read(inputs), "--picture");
  expect_svg(options.picture);
  const ChoiceKind kind = explain::kind_of(options.choice);
  const bool all = kind == ChoiceKind::kRecording || kind == ChoiceKind::kWorst;
  return (all ? explain_all : explain_one)(options, loaded, inputs, picture ? &*picture : nullptr);
}

void add_choice(CLI::App* verb, ExplainOptions* options) {
  CLI::Option* frame =
      verb->add_option("-n,--frame", options->choice.frame,
                       tr("One frame: its number, counted from 0 as in the CSV of run; its name (000123.pcd, "
                          "road.bag#12); or worst. Default: a digest of the whole recording and its worst frame"));
  frame->type_name("FRAME");
  verb->add_option("--stamp", options->choice.stamp,
                   tr("The frame of the nearest stamp: seconds, nanoseconds as in the CSV, or +SECONDS "
                      "since the first frame"))
      ->type_name("SECONDS")
      ->check(explain::stamp_fault, "")
      ->excludes(frame);
}

// The list is that of the table, whatever the frames and settings.
void demand_gates_alone(const CLI::App& verb) {
  std::vector<std::string> others;
  for (const CLI::Option* option : verb.get_options()) {
    const std::string name = option->get_name();
    if (option->count() > 0 && name != "--gates" && name != "--language") others.push_back(name);
  }
  if (others.empty() && verb.remaining().empty()) return;
  throw CLI::ValidationError("--gates", say("the list has the limits of the table and the keys that move them, and "
                                            "needs nothing else; leave out {}",
                                            fmt::format("{}", fmt::join(others, ", "))));
}

std::string footer() {
  constexpr const char* kExamples[] = {
      "  pose_wall explain -c road/pose_wall.yaml road/frames",
      "  pose_wall explain --config road/pose_wall.yaml --frame 12 road/frames",
      "  pose_wall explain -c road/pose_wall.yaml --frame 000012.pcd --picture why.svg road/frames",
      "  pose_wall explain -c road/pose_wall.yaml --stamp +1.2 --set wall_length_min=1.5 road/frames",
      "  pose_wall explain -c road/pose_wall.yaml -n 12 --json road/frames | jq '.gates[] | select(.passed | not)'",
      "  pose_wall explain --gates | less"};
  return fmt::format(
      "{}\n{}\n\n{}", tr("Examples:"), fmt::join(kExamples, "\n"),
      tr("Frames before the chosen one are measured too: held and smoothed values depend on them.\n"
         "The frame is then computed twice, by the delivered engine and by one that takes notes.\n"
         "Both give the same bits, or there is no explanation.\n"
         "\n"
         "Exit status: 0 done, 1 a frame could not be read or the picture not written, 2 bad usage or config,\n"
         "130 interrupted by Ctrl-C."));
}

}  // namespace

void add_explain(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<ExplainOptions>();
  CLI::App* verb = app.add_subcommand(
      "explain",
      tr("Say why frames came out as they did: a digest of a recording, or one frame with gates and planes"));
  add_frame_options(verb, &options->frames);
  add_choice(verb, options.get());
  verb->add_option("-p,--picture", options->picture, tr("SVG file for a picture of the frame, or of the worst one"))
      ->type_name("FILE");
  verb->add_flag("-j,--json", options->json, tr("Everything as one JSON object instead"));
  // As --help it needs no frame: callbacks of options come before the look for those that are missing.
  const auto print_gates = [verb] {
    demand_gates_alone(*verb);
    fmt::print("{}", explain::gate_list_text());
    throw CLI::Success();
  };
  verb->add_flag_callback("--gates", print_gates, tr("Print the list of all gates with their limits, and no frame"));
  verb->footer(footer());
  verb->callback(
      [options, &exit_code] { exit_code = done_or_complaint("explain", [&] { return explain_inputs(*options); }); });
}

}  // namespace pose_wall::tools
