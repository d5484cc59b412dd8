// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall motion: frames in, the machine's way along its road out.

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/options/frame_arguments.hpp"
#include "apps/verbs/frame_work.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/config_file/load_config.hpp"
#include "io/config_file/resolved_frames.hpp"
#include "io/csv/csv_table.hpp"
#include "io/inputs/frame_sequence.hpp"
#include "io/language/language.hpp"
#include "io/outputs/output_file.hpp"
#include "io/terminal/frames_text.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/progress_bar.hpp"
#include "study/info/usable_times.hpp"
#include "study/motion/motion_rows.hpp"
#include "study/motion/motion_runner.hpp"
#include "study/motion/motion_summary.hpp"
#include "study/results/row_output.hpp"

namespace pose_wall::tools {
namespace {

struct MotionOptions {
  FrameOptions frames;
  std::string output;
  std::string tum;  // empty: none
  std::string map;  // empty: none
};

// The table, and beside it what was asked for; an output is no input of the others, and no two are one file.
struct MotionOutputs {
  MotionOutputs(const MotionOptions& options, std::vector<std::filesystem::path> read)
      : table(options.output, read, csv_line(motion_head())) {
    if (!options.output.empty()) read.emplace_back(options.output);
    if (!options.tum.empty()) {
      if (options.tum == "-")
        throw std::invalid_argument(tr("--tum -: a file is allowed; --output may be standard output"));
      tum.emplace(options.tum, read, "", "--tum");
      read.emplace_back(options.tum);
    }
    if (!options.map.empty()) map.emplace(options.map, read, "--map");
  }

  // What could not be written; empty when all was.
  std::string write(const MotionOutcome& outcome) {
    if (!table.write(csv_line(motion_cells(outcome)))) return say("{} could not be written to the end", table.name());
    if (tum && !tum->write(tum_row(outcome))) return say("{} could not be written to the end", tum->name());
    return "";
  }

  RowOutput table;
  std::optional<RowOutput> tum;
  std::optional<OutputFile> map;
};

void print_start(const MotionOptions& options, const LoadedConfig& loaded, const MotionRunner& runner,
                 std::size_t frames) {
  fmt::print(stderr, "{}{}",
             say("pose_wall {}: motion in {}, config {}, {:.1f} MB for the map\n", pose_wall_version(),
                 frames_text(frames), options.frames.config_file.empty() ? tr("defaults") : options.frames.config_file,
                 static_cast<double>(runner.block_bytes()) * 1e-6),
             resolved_frames_text(resolve_frames(loaded.config), "  "));
}

// What could not be written, or nothing. Ctrl-C ends it after the frame at work.
std::string process_frames(const MotionOptions& options, FrameSequence& inputs, MotionRunner& runner,
                           MotionOutputs& outputs, MotionSummary& summary, UsableTimes& times) {
  // A bar between rows of the table on the same terminal would spoil both.
  const bool show_bar = !options.frames.quiet && is_terminal(2) && !(outputs.table.is_stdout() && is_terminal(1));
  ProgressBar bar(inputs.frames(), show_bar);
  while (!InterruptWatch::is_interrupted()) {
    std::optional<SourcedFrame> frame = inputs.next();
    if (!frame) break;
    if (!options.frames.quiet && frame->frame) times.add(*frame->frame);
    const MotionOutcome outcome = runner.run(std::move(*frame));
    if (!outcome.result) bar.print_above(fmt::format("pose_wall motion: {}: {}", outcome.source, outcome.error));
    if (!options.frames.quiet && outcome.result) times.add_motion(*outcome.result);
    summary.add(outcome);
    std::string fault = outputs.write(outcome);
    if (!fault.empty()) return fault;
    bar.advance(std::filesystem::path(outcome.source).filename().string());
  }
  return "";
}

// Also after Ctrl-C: what the map holds by then.
std::string write_map(const MotionRunner& runner, MotionOutputs& outputs) {
  if (!outputs.map) return "";
  try {
    outputs.map->write(map_as_ply(runner.map_points()));
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

int motion(const MotionOptions& options) {
  const LoadedConfig loaded = options.frames.load();
  FrameSequence inputs = options.frames.open();
  MotionRunner runner(loaded.config, loaded.motion, options.frames.rate_hz);
  if (has_no_input("motion", inputs, options.output)) return kExitUnreadable;
  MotionOutputs outputs(options, options.frames.files_read(inputs));
  if (!options.frames.quiet) print_start(options, loaded, runner, inputs.frames());
  for (const std::string& error : inputs.errors()) fmt::print(stderr, "pose_wall motion: {}\n", error);

  const auto started = std::chrono::steady_clock::now();
  MotionSummary summary;
  UsableTimes times;
  std::string fault = process_frames(options, inputs, runner, outputs, summary, times);
  if (fault.empty()) fault = write_map(runner, outputs);
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (!fault.empty()) fmt::print(stderr, "pose_wall motion: {}\n", fault);
  if (!options.frames.quiet && summary.frames() > 0) fmt::print(stderr, "\n{}", summary.text(wall_s));
  if (const std::string doubt = times.doubt(); !doubt.empty()) fmt::print(stderr, "{}\n", doubt);
  if (InterruptWatch::is_interrupted()) return tell_interrupted(summary.frames());
  return fault.empty() && inputs.errors().empty() && summary.unreadable() == 0 ? kExitDone : kExitUnreadable;
}

}  // namespace

void add_motion(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<MotionOptions>();
  CLI::App* verb = app.add_subcommand("motion", tr("Measure how the machine moves along its road, frame by frame"));
  add_frame_options(verb, &options->frames);
  verb->add_option("-o,--output", options->output, tr("File for the table (CSV); default, and -: standard output"));
  verb->add_option("--tum", options->tum,
                   tr("File for the path in TUM format: rows `t x y z qx qy qz qw`, s and m; without lost frames"));
  verb->add_option("--map", options->map, tr("File for the map's points at the end: binary PLY, x y z in m"));
  verb->footer(
      tr("Examples:\n"
         "  pose_wall sim --scene rough --frames 60 --set speed_mps=0.3 --set rock_repeats=no --output road\n"
         "  pose_wall motion -c road/pose_wall.yaml -o motion.csv --tum path.tum road/frames\n"
         "  pose_wall eval motion.csv road/truth.csv\n"
         "Poses are those of base, in base as it stood at the first frame. along_m is the travel along the road, and\n"
         "along_state grades it:\n"
         "  measured      the relief of the rock determines the place\n"
         "  ambiguous     two places fit alike, as with periodic steel sets; the level covers both\n"
         "  unobservable  no feature shows the travel; the level grows by motion_speed_max\n"
         "  lost          no pose: x to along_m are empty, and the map restarts\n"
         "Levels (_pl) are in m and rad. The error of the pose since the first frame stays within them. Columns step_\n"
         "describe the step since the last frame. Keys: motion_speed_max, motion_turn_max_deg, motion_range_max,\n"
         "motion_keyframe (pose_wall check-config --keys).\n"
         "Exit status: 0 done, 1 an input could not be read (the others are processed), 2 bad usage or config,\n"
         "130 interrupted by Ctrl-C: written rows and files are whole."));
  verb->callback([options, &exit_code] {
    if (options->output == "-") options->output.clear();
    exit_code = motion(*options);
  });
}

}  // namespace pose_wall::tools
