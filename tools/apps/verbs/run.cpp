// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall run: frames in, a table of results out.

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "apps/options/frame_arguments.hpp"
#include "apps/options/one_of.hpp"
#include "apps/verbs/annotated_folder.hpp"
#include "apps/verbs/frame_work.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/config_file/load_config.hpp"
#include "io/config_file/resolved_frames.hpp"
#include "io/inputs/frame_sequence.hpp"
#include "io/language/language.hpp"
#include "io/terminal/frames_text.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/progress_bar.hpp"
#include "study/info/usable_times.hpp"
#include "study/results/frame_runner.hpp"
#include "study/results/next_steps.hpp"
#include "study/results/result_output.hpp"
#include "study/results/run_summary.hpp"

namespace pose_wall::tools {
namespace {

struct RunOptions {
  FrameOptions frames;
  std::string output;
  std::string format = "csv";
  bool parts = false;
  std::string annotate;  // folder; empty: none
  std::string annotate_format = "pcd";
};

std::optional<AnnotatedFolder> annotated_folder(const RunOptions& options) {
  if (options.annotate.empty()) return std::nullopt;
  const CloudFormat format = options.annotate_format == "ply" ? CloudFormat::kPly : CloudFormat::kPcd;
  return AnnotatedFolder(options.annotate, format, options.frames.inputs);
}

void print_start(const RunOptions& options, const LoadedConfig& loaded, const FrameRunner& runner, std::size_t frames) {
  const ResolvedFrames resolved = resolve_frames(loaded.config);
  fmt::print(stderr, "{}{}{}{}",
             say("pose_wall {}: {}, config {}, {:.1f} MB for the engine\n", pose_wall_version(), frames_text(frames),
                 loaded.file.empty() ? tr("defaults") : loaded.file, static_cast<double>(runner.block_bytes()) * 1e-6),
             resolved_frames_text(resolved, "  "), signs_text(resolved, "  "),
             options.format == "csv" ? tr("  angles: radians in the CSV, degrees in the tables below\n")
                                     : tr("  angles: radians in the JSON, degrees in the tables below\n"));
}

struct Outputs {
  ResultOutput& results;
  std::optional<AnnotatedFolder>& annotated;

  // What could not be written; empty when all was.
  std::string write(const FrameOutcome& outcome) const {
    if (!results.write(outcome)) return say("{} could not be written to the end", results.name());
    try {
      if (annotated) annotated->write(outcome);
      return "";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }
};

// What a run came to.
struct Closing {
  RunSummary summary;
  NextSteps next;
  UsableTimes times;

  void add(const FrameOutcome& outcome) {
    summary.add(outcome);
    next.add(outcome);
  }
};

// What could not be written, or nothing. Ctrl-C ends it after the frame at work.
std::string process_frames(const RunOptions& options, FrameSequence& inputs, FrameRunner& runner,
                           const Outputs& outputs, Closing& closing) {
  // A bar between rows of the table on the same terminal would spoil both.
  const bool show_bar = !options.frames.quiet && is_terminal(2) && !(outputs.results.is_stdout() && is_terminal(1));
  ProgressBar bar(inputs.frames(), show_bar);
  const FrameRunner::Notice notice = [&](const auto& cloud, const auto& points, const auto& result) {
    if (outputs.annotated) outputs.annotated->look(points, result);
    if (!options.frames.quiet) closing.next.look(cloud, result);
  };
  while (!InterruptWatch::is_interrupted()) {
    std::optional<SourcedFrame> frame = inputs.next();
    if (!frame) break;
    if (!options.frames.quiet && frame->frame) closing.times.add(*frame->frame);
    const FrameOutcome outcome = runner.run(std::move(*frame), notice);
    if (!outcome.result) bar.print_above(fmt::format("pose_wall run: {}: {}", outcome.source, outcome.error));
    if (!options.frames.quiet && outcome.result && runner.moved()) closing.times.add_motion(*runner.moved());
    closing.add(outcome);
    std::string fault = outputs.write(outcome);
    if (!fault.empty()) return fault;
    bar.advance(std::filesystem::path(outcome.source).filename().string());
  }
  return "";
}

void print_end(const Closing& closing, double wall_s, bool has_motion) {
  const std::string next = closing.next.text(), times = closing.times.doubt();
  fmt::print(stderr, "\n{}{}{}{}{}", closing.summary.text(wall_s), times, times.empty() ? "" : "\n",
             next.empty() ? "" : "\n", next);
  if (closing.summary.frames() == 1 && has_motion) {
    fmt::print(
        stderr, "{}",
        tr("One frame alone: nothing tells how the machine moved during its scan, so no value is valid. Give two "
           "frames or more, or -s motion=off where the machine stood.\n"));
  }
}

int run(const RunOptions& options) {
  const LoadedConfig loaded = options.frames.load();
  FrameSequence inputs = options.frames.open();
  FrameRunner runner(loaded.config, options.frames.rate_hz, loaded.motion);
  std::optional<AnnotatedFolder> annotated = annotated_folder(options);
  if (has_no_input("run", inputs, options.output)) return kExitUnreadable;
  ResultOutput output(options.output, options.frames.files_read(inputs),
                      options.format == "json" ? ResultFormat::kJson : ResultFormat::kCsv,
                      options.parts ? PartColumns::kAll : PartColumns::kNone);
  if (!options.frames.quiet) print_start(options, loaded, runner, inputs.frames());
  for (const std::string& error : inputs.errors()) fmt::print(stderr, "pose_wall run: {}\n", error);

  const auto started = std::chrono::steady_clock::now();
  Closing closing{RunSummary(), NextSteps(loaded.config, options.frames.config_file, options.frames.shell_words()), {}};
  const std::string fault = process_frames(options, inputs, runner, {output, annotated}, closing);
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (!fault.empty()) fmt::print(stderr, "pose_wall run: {}\n", fault);
  const RunSummary& summary = closing.summary;
  if (!options.frames.quiet && summary.frames() > 0) print_end(closing, wall_s, runner.moved().has_value());
  if (InterruptWatch::is_interrupted()) return tell_interrupted(summary.frames());
  return fault.empty() && inputs.errors().empty() && summary.unreadable() == 0 ? kExitDone : kExitUnreadable;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* verb = app.add_subcommand(
      "run", tr("Measure attitude and wall distances in frames of a LiDAR, with motion where the key `motion` is on"));
  add_frame_options(verb, &options->frames);
  verb->add_option("-o,--output", options->output, tr("File for the results; default, and -: standard output"));
  verb->add_option("--format", options->format, tr("Results as CSV, or as JSON: one object per line and frame"))
      ->capture_default_str()
      ->check(one_of({"csv", "json"}));
  verb->add_flag(
      "--parts", options->parts,
      tr("In the CSV also a column for each part of each protection level, behind the others; JSON always has "
         "them"));
  CLI::Option* annotate = verb->add_option(
      "--annotate", options->annotate,
      tr("Folder for the points of each frame: base frame, label (0 other, 1 floor, 2 left, 3 right wall), distance to "
         "its plane, colour; for pcl_viewer, and with --annotate-format ply for CloudCompare, Open3D, MeshLab"));
  verb->add_option("--annotate-format", options->annotate_format, tr("Format of these clouds, binary"))
      ->capture_default_str()
      ->check(one_of({"pcd", "ply"}))
      ->needs(annotate);
  verb->footer(tr(
      "Examples:\n"
      "  pose_wall run --config vlp16 --set forward_axis=+Y --output out.csv frames/\n"
      "  pose_wall run -c vlp16 --format json -o out.jsonl --annotate labelled frames/\n"
      "  pose_wall run --layout xyz --unit mm -o out.csv exported/\n"
      "A file name of digits is the frame's stamp: 13 in ms, 16 in us, 17 to 19 in ns; other frames are 1/rate apart.\n"
      "Exit status: 0 done, 1 an input could not be read (the others are processed), 2 bad usage or config,\n130 "
      "interrupted by Ctrl-C: whole rows and whole files are written."));
  verb->callback([options, &exit_code] {
    if (options->output == "-") options->output.clear();
    exit_code = run(*options);
  });
}

}  // namespace pose_wall::tools
