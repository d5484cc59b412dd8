// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall run: frames in, a table of results out.

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "config_file/load_config.hpp"
#include "config_file/resolved_frames.hpp"
#include "inputs/frame_sequence.hpp"
#include "results/frame_runner.hpp"
#include "results/result_output.hpp"
#include "results/run_summary.hpp"
#include "terminal/counted.hpp"
#include "terminal/progress_bar.hpp"
#include "verbs/frame_options.hpp"
#include "verbs/verbs.hpp"

namespace pose_wall::tools {
namespace {

struct RunOptions {
  FrameOptions frames;
  std::string output;
};

void print_start(const RunOptions& options, const LoadedConfig& loaded, const FrameRunner& runner, std::size_t frames) {
  fmt::print(stderr, "pose_wall {}: {}, config {}, {:.1f} MB for the engine\n{}", pose_wall_version(),
             counted(frames, "frame"), options.frames.config_file.empty() ? "defaults" : options.frames.config_file,
             static_cast<double>(runner.block_bytes()) * 1e-6,
             resolved_frames_text(resolve_frames(loaded.config), "  "));
}

// False when the output could not be written.
bool process_frames(const RunOptions& options, FrameSequence& inputs, FrameRunner& runner, ResultOutput& output,
                    RunSummary& summary) {
  // A bar between rows of the table on the same terminal would spoil both.
  const bool show_bar = !options.frames.quiet && is_terminal(2) && !(output.is_stdout() && is_terminal(1));
  ProgressBar bar(inputs.frames(), show_bar);
  while (std::optional<SourcedFrame> frame = inputs.next()) {
    const FrameOutcome outcome = runner.run(std::move(*frame));
    if (!outcome.result) bar.print_above(fmt::format("pose_wall run: {}: {}", outcome.source, outcome.error));
    summary.add(outcome);
    if (!output.write(outcome)) return false;
    bar.advance(std::filesystem::path(outcome.source).filename().string());
  }
  return true;
}

int run(const RunOptions& options) {
  const LoadedConfig loaded = options.frames.load();
  FrameSequence inputs = options.frames.open();
  FrameRunner runner(loaded.config, options.frames.rate_hz);
  ResultOutput output(options.output, inputs.files());
  if (!options.frames.quiet) print_start(options, loaded, runner, inputs.frames());
  for (const std::string& error : inputs.errors()) fmt::print(stderr, "pose_wall run: {}\n", error);

  const auto started = std::chrono::steady_clock::now();
  RunSummary summary;
  const bool written = process_frames(options, inputs, runner, output, summary);
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (!written) fmt::print(stderr, "pose_wall run: {} could not be written to the end\n", output.name());
  if (!options.frames.quiet && summary.frames() > 0) fmt::print(stderr, "\n{}", summary.text(wall_s));
  return written && inputs.errors().empty() && summary.unreadable() == 0 ? kExitDone : kExitUnreadable;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* verb = app.add_subcommand("run", "Measure attitude and wall distances in frames of a LiDAR");
  add_frame_options(verb, &options->frames);
  verb->add_option("-o,--output", options->output, "CSV file for the results; default: standard output");
  verb->footer(
      "Example:\n  pose_wall run --config config/pose_wall.yaml --set forward_axis=+Y --output out.csv frames/\n"
      "A file name of 16 to 19 digits is the frame's stamp in nanoseconds; other frames are 1/rate apart.\n"
      "Exit status: 0 done, 1 an input could not be read (the others are processed), 2 bad usage or config.");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pose_wall::tools
