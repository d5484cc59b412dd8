// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall doctor: from frames of a machine that stands, how its sensor is mounted and which settings fit.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/options/frame_arguments.hpp"
#include "apps/options/one_of.hpp"
#include "apps/verbs/complaint.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/language/language.hpp"
#include "io/outputs/output_file.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/progress_bar.hpp"
#include "study/doctor/diagnosis.hpp"
#include "study/doctor/diagnosis_output.hpp"
#include "study/info/next_steps.hpp"

namespace pose_wall::tools {
namespace {

struct DoctorOptions {
  FrameOptions frames;
  std::string output;
  std::optional<double> height_m;
  bool force = false;
  bool write_anyway = false;
  bool json = false;
};

// Before any work is done: what stands at --output was made by somebody.
std::unique_ptr<OutputFile> open_output(const DoctorOptions& options, const FrameSequence& inputs) {
  if (options.output.empty()) return nullptr;
  std::error_code ignored;
  if (!options.force && std::filesystem::exists(options.output, ignored)) {
    throw std::invalid_argument(say("--output {}: this file exists already; --force overwrites it", options.output));
  }
  return std::make_unique<OutputFile>(options.output, inputs.files());
}

doctor::Recording read_all(const DoctorOptions& options, FrameSequence& inputs) {
  ProgressBar bar(inputs.frames(), !options.frames.quiet && is_terminal(2));
  return doctor::read_recording(inputs, options.frames.rate_hz, [&bar](const std::string& name) {
    bar.advance(std::filesystem::path(name).filename().string());
  });
}

// Reads the inputs once more: the engine keeps state from frame to frame, and memory does not hold all frames.
doctor::Preview preview_of(const DoctorOptions& options, const LoadedConfig& settings) {
  FrameSequence inputs = options.frames.open();
  ProgressBar bar(inputs.frames(), !options.frames.quiet && is_terminal(2));
  return doctor::preview(settings, options.frames.rate_hz, [&]() -> std::optional<SourcedFrame> {
    if (InterruptWatch::is_interrupted()) return std::nullopt;
    std::optional<SourcedFrame> frame = inputs.next();
    if (frame) bar.advance(std::filesystem::path(frame->name).filename().string());
    return frame;
  });
}

// The comments at the head of the file: whoever opens it later has no terminal to read.
std::vector<std::string> head_of(const DoctorOptions& options, const doctor::Diagnosis& diagnosis) {
  const doctor::RecordingVerdict& verdict = diagnosis.verdict;
  std::vector<std::string> head = {
      say("Proposed by pose_wall doctor from {} frames of {}.", diagnosis.stamps.frames, options.frames.inputs.front()),
      say("Verdict: {}", verdict.headline())};
  for (const std::string& line : verdict.buts) head.push_back(say("Doubt: {}", line));
  for (const std::string& line : verdict.confirm) head.push_back(say("To confirm: {}", line));
  return head;
}

std::vector<std::string> with_inputs(std::vector<std::string> words, const DoctorOptions& options) {
  constexpr double kUsualRate_hz = 10.0;
  if (options.frames.rate_hz != kUsualRate_hz) {
    words.insert(words.end(), {"--rate", fmt::format("{:g}", options.frames.rate_hz)});
  }
  const std::vector<std::string> inputs = input_words(options.frames.inputs, options.frames.input);
  words.insert(words.end(), inputs.begin(), inputs.end());
  return words;
}

// The same look once more, with the file written.
std::vector<std::string> again(const DoctorOptions& options, const std::string& file, bool is_usable) {
  std::vector<std::string> words = {"doctor"};
  if (!options.frames.config_file.empty()) words.insert(words.end(), {"-c", options.frames.config_file});
  for (const std::string& setting : options.frames.settings) words.insert(words.end(), {"-s", setting});
  if (options.height_m) words.insert(words.end(), {"--height", fmt::format("{:g}", *options.height_m)});
  words.insert(words.end(), {"-o", file});
  if (!is_usable) words.emplace_back("--write-anyway");
  return with_inputs(std::move(words), options);
}

std::string next_text(const DoctorOptions& options, const doctor::Diagnosis& diagnosis, bool is_written) {
  const bool is_usable = diagnosis.verdict.is_usable();
  const std::string file = options.output.empty() ? "pose_wall.yaml" : options.output;
  std::vector<NextStep> steps;
  if (!is_usable) {
    steps.push_back({tr("record 30 s again while the machine stands in a straight road, and repeat this"),
                     again(options, file, true)});
  }
  if (!is_usable && !is_written) {
    steps.push_back({tr("only to look for the fault, never to control a machine: write these settings all the same"),
                     again(options, file, false)});
    return "\n" + next_steps_text(steps);  // there is no file to go on with
  }
  if (!is_written) steps.push_back({tr("write these settings to a file"), again(options, file, true)});
  std::string check = tr("axes, signs of the angles and every value of these settings");
  if (!diagnosis.ahead.axis.empty() && !diagnosis.ahead.is_known) check = doctor::guess_text(diagnosis.ahead.axis);
  steps.push_back({check, {"check-config", file}});
  steps.push_back({tr("measure the frames with them"), with_inputs({"run", "-c", file, "-o", "results.csv"}, options)});
  steps.push_back(
      {tr("the same as a page to look at"), with_inputs({"report", "-c", file, "-o", "report.html"}, options)});
  return "\n" + next_steps_text(steps);
}

// Whether the file was written; what became of it is said on stderr.
bool write_proposal(const DoctorOptions& options, const doctor::Diagnosis& diagnosis, OutputFile* output) {
  const bool usable = diagnosis.verdict.is_usable();
  if (output == nullptr) return false;
  if (!usable && !options.write_anyway) {
    fmt::print(stderr, "{}",
               say("{} is not written, for the recording is not usable. --write-anyway writes it with the verdict and "
                   "the doubts at its head.\n",
                   options.output));
    return false;
  }
  output->write(diagnosis.proposal.yaml(head_of(options, diagnosis)));
  if (!options.frames.quiet) {
    fmt::print(stderr, "{}",
               usable ? say("{} is written\n", options.output)
                      : say("{} is written, although the recording is not usable\n", options.output));
  }
  return true;
}

int tell_interrupt(std::size_t frames) {
  fmt::print(stderr, "{}", say("interrupted after {} frames: nothing is concluded\n", frames));
  return kExitInterrupted;
}

int examine(const DoctorOptions& options) {
  const LoadedConfig told = options.frames.load();
  FrameSequence inputs = options.frames.open();
  const std::unique_ptr<OutputFile> output = open_output(options, inputs);
  const doctor::Recording recording = read_all(options, inputs);
  for (const std::string& error : recording.errors) fmt::print(stderr, "pose_wall doctor: {}\n", error);
  if (recording.interrupted) return tell_interrupt(recording.notes.size());
  const bool is_any_readable = std::any_of(recording.notes.begin(), recording.notes.end(),
                                           [](const doctor::FrameNote& note) { return note.error.empty(); });
  if (!is_any_readable && !options.json) return kExitUnreadable;  // the errors say it all

  const doctor::Diagnosis diagnosis = doctor::diagnose(
      recording, told, options.height_m, [&](const LoadedConfig& settings) { return preview_of(options, settings); });
  if (InterruptWatch::is_interrupted()) return tell_interrupt(recording.notes.size());
  fmt::print("{}", options.json ? doctor::diagnosis_json(diagnosis) : doctor::diagnosis_text(diagnosis));
  if (diagnosis.stamps.frames == 0) return kExitUnreadable;
  std::fflush(stdout);  // before stderr goes on
  const bool is_written = write_proposal(options, diagnosis, output.get());
  if (!options.json) fmt::print("{}", next_text(options, diagnosis, is_written));
  if (!diagnosis.verdict.is_usable()) return kExitNotUsable;
  return recording.errors.empty() ? kExitDone : kExitUnreadable;
}

}  // namespace

void add_doctor(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<DoctorOptions>();
  CLI::App* verb =
      app.add_subcommand("doctor", tr("Find sensor, mounting and settings from frames of a machine that stands"));
  add_frame_options(verb, &options->frames);
  CLI::Option* output = verb->add_option("-o,--output", options->output,
                                         tr("File for the proposed settings, written if the recording is usable"));
  verb->add_flag("--force", options->force, tr("Overwrite --output"));
  verb->add_flag("--write-anyway", options->write_anyway,
                 tr("Write --output even if the recording is not usable, with verdict and doubts at its head"))
      ->needs(output);
  verb->add_option("--height", options->height_m,
                   tr("Height of the sensor above the floor in m, measured by hand: tells floor from roof"))
      ->check(number_within(0.02, 20.0));
  verb->add_flag("--json", options->json, tr("One JSON object instead of tables"));
  verb->footer(
      tr("Examples:\n"
         "  pose_wall doctor -o pose_wall.yaml frames/            30 s of a machine that stands in a straight road\n"
         "  pose_wall doctor --height 1.35 --json frames/         for a script\n"
         "  pose_wall doctor -c pose_wall.yaml frames/            is the mounting still as the settings say?\n"
         "It finds the class of the sensor, its mounting, floor, walls, the machine's own body, the frame rate and\n"
         "the axis of the road. It proposes settings, each with a reason, and measures all frames with them as `run`\n"
         "does. The verdict follows from the share of valid values.\n"
         "It asks you to confirm what frames cannot show: which end of the road is ahead, or floor against roof.\n"
         "Gates are only narrowed, or set as in config/ for the class of the sensor.\n"
         "Exit status: 0 usable (also in part), 3 not usable (no file without --write-anyway), 1 an input could not\n"
         "be read or the output not written, 2 bad usage or config, or --output exists already, 130 interrupted."));
  verb->callback([options, &exit_code] { exit_code = done_or_complaint("doctor", [&] { return examine(*options); }); });
}

}  // namespace pose_wall::tools
