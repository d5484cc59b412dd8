// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall doctor: frames of a machine that stands in, how its sensor is mounted and what its settings should be out.

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "doctor/diagnosis.hpp"
#include "doctor/diagnosis_output.hpp"
#include "terminal/counted.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress_bar.hpp"
#include "verbs/complaint.hpp"
#include "verbs/frame_options.hpp"
#include "verbs/output_file.hpp"
#include "verbs/verbs.hpp"

namespace pose_wall::tools {
namespace {

struct DoctorOptions {
  FrameOptions frames;
  std::string output;
  std::optional<double> height_m;
  bool force = false;
  bool json = false;
};

// Before any work is done: what stands at --output was made by somebody.
std::unique_ptr<OutputFile> open_output(const DoctorOptions& options, const FrameSequence& inputs) {
  if (options.output.empty()) return nullptr;
  std::error_code ignored;
  if (!options.force && std::filesystem::exists(options.output, ignored)) {
    throw std::invalid_argument(fmt::format("--output {}: is there already; --force overwrites it", options.output));
  }
  return std::make_unique<OutputFile>(options.output, inputs.files());
}

doctor::Recording read_all(const DoctorOptions& options, FrameSequence& inputs) {
  const InterruptWatch watch;
  ProgressBar bar(inputs.frames(), !options.frames.quiet && is_terminal(2));
  return doctor::read_recording(inputs, options.frames.rate_hz, [&bar](const std::string& name) {
    bar.advance(std::filesystem::path(name).filename().string());
  });
}

std::vector<std::string> head_of(const DoctorOptions& options, const doctor::Diagnosis& diagnosis) {
  std::vector<std::string> head = {fmt::format("Proposed by pose_wall doctor from {} of {}: {}",
                                               counted(diagnosis.stamps.frames, "frame"), options.frames.inputs.front(),
                                               diagnosis.verdict.line())};
  for (const std::string& line : diagnosis.verdict.confirm) head.push_back("To confirm: " + line);
  return head;
}

int examine(const DoctorOptions& options) {
  const LoadedConfig told = options.frames.load();
  FrameSequence inputs = options.frames.open();
  const std::unique_ptr<OutputFile> output = open_output(options, inputs);
  const doctor::Recording recording = read_all(options, inputs);
  for (const std::string& error : recording.errors) fmt::print(stderr, "pose_wall doctor: {}\n", error);
  if (recording.interrupted) {
    fmt::print(stderr, "interrupted: {} were read, nothing is concluded\n", counted(recording.notes.size(), "frame"));
    return kExitInterrupted;
  }

  const doctor::Diagnosis diagnosis = doctor::diagnose(recording, told, options.height_m);
  fmt::print("{}", options.json ? doctor::diagnosis_json(diagnosis) : doctor::diagnosis_text(diagnosis));
  const bool usable = diagnosis.verdict.is_usable();
  if (output && usable) output->write(diagnosis.proposal.yaml(head_of(options, diagnosis)));
  if (output && !options.frames.quiet) {
    fmt::print(stderr, "{} {}\n", options.output, usable ? "is written" : "is not written");
  }
  if (diagnosis.stamps.frames == 0) return kExitUnreadable;
  if (!usable) return kExitNotUsable;
  return recording.errors.empty() ? kExitDone : kExitUnreadable;
}

}  // namespace

void add_doctor(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<DoctorOptions>();
  CLI::App* verb = app.add_subcommand("doctor", "Look at frames of a standing machine and propose its settings");
  add_frame_options(verb, &options->frames);
  verb->add_option("-o,--output", options->output, "Write the proposed settings here, if the recording is usable");
  verb->add_flag("--force", options->force, "Overwrite --output");
  verb->add_option("--height", options->height_m,
                   "Height of the sensor above the floor in m, as measured by hand: "
                   "tells floor from roof")
      ->check(CLI::Range(0.02, 20.0));
  verb->add_flag("--json", options->json, "One JSON object instead of tables");
  verb->footer(
      "Examples:\n"
      "  pose_wall doctor -o pose_wall.yaml frames/            30 s of a machine that stands in a straight road\n"
      "  pose_wall doctor --height 1.35 --json frames/         for a script\n"
      "  pose_wall doctor -c pose_wall.yaml frames/            is the mounting still as the settings say?\n"
      "It tells the class of the sensor, how it is mounted, what it sees of floor, walls and the machine's own body,\n"
      "how its frames come, and along which axis the road lies; then the settings that follow, each with a reason, "
      "and\n"
      "a verdict in one line. What it cannot know it asks to be confirmed: which end of a road is ahead, floor or "
      "roof.\n"
      "Gates are only narrowed, or set as config/ has them for the class of the sensor.\n"
      "Exit status: 0 usable, 3 not usable (then nothing is written), 1 an input could not be read or the output not\n"
      "written, 2 bad usage or config, or --output is there already, 130 interrupted.");
  verb->callback([options, &exit_code] { exit_code = done_or_complaint("doctor", [&] { return examine(*options); }); });
}

}  // namespace pose_wall::tools
