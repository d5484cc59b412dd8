// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall report: frames in, a page to look at out.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "config_file/load_config.hpp"
#include "csv/csv_file.hpp"
#include "inputs/frame_sequence.hpp"
#include "language/language.hpp"
#include "motion/motion_comparison.hpp"
#include "motion/motion_table.hpp"
#include "motion/pose_truth.hpp"
#include "report/motion_page.hpp"
#include "report/page.hpp"
#include "results/frame_runner.hpp"
#include "results/run_summary.hpp"
#include "terminal/counted.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress_bar.hpp"
#include "truth/row_pairs.hpp"
#include "truth/truth_csv.hpp"
#include "verbs/complaint.hpp"
#include "verbs/frame_options.hpp"
#include "verbs/one_of.hpp"
#include "verbs/output_file.hpp"
#include "verbs/verbs.hpp"

namespace pose_wall::tools {
namespace {

struct ReportOptions {
  FrameOptions frames;
  std::string output = "report.html";
  std::string truth;
  std::string title;
  std::size_t points_max = 1'200'000;
};

struct Shown {
  RunSummary summary;
  RowKeys keys{std::vector<std::string>(), std::vector<std::string>()};
  bool complete = true;
};

Shown process_frames(const ReportOptions& options, FrameSequence& inputs, FrameRunner& runner, report::PageData& data) {
  const InterruptWatch watch;
  ProgressBar bar(inputs.frames(), !options.frames.quiet && is_terminal(2));
  Shown shown;
  while (std::optional<SourcedFrame> frame = inputs.next()) {
    if (InterruptWatch::is_interrupted()) {
      shown.complete = false;
      break;
    }
    const FrameOutcome outcome = runner.run(
        std::move(*frame),
        [&data](const auto& cloud, const auto& points, const auto& result) { data.look(cloud, points, result); });
    if (!outcome.result) bar.print_above(fmt::format("pose_wall report: {}: {}", outcome.source, outcome.error));
    shown.summary.add(outcome);
    shown.keys.frame->push_back(std::to_string(outcome.frame));
    shown.keys.stamp_ns->push_back(std::to_string(outcome.stamp_ns));
    data.add(outcome);
    bar.advance(std::filesystem::path(outcome.source).filename().string());
  }
  return shown;
}

RowKeys keys_of(const std::vector<TruthRow>& truth) {
  std::vector<std::string> frames, stamps_ns;
  for (const TruthRow& row : truth) {
    frames.push_back(std::to_string(row.frame));
    stamps_ns.push_back(std::to_string(row.stamp_ns));
  }
  return {frames, stamps_ns};
}

// The truth of each frame that was read. Which rows are meant hangs on the stamps of all of them.
void add_truth(const ReportOptions& options, const std::vector<TruthRow>& truth, const Shown& shown,
               report::PageData* data) {
  std::vector<const TruthRow*> of_frames(data->frames(), nullptr);
  const RowPairs pairs = pair_rows(shown.keys, keys_of(truth));
  for (const auto& [frame, row] : pairs.rows) of_frames[frame] = &truth[row];
  data->add_truth(of_frames);
  if (options.truth.empty()) return;
  if (pairs.rows.empty()) {
    fmt::print(stderr, "pose_wall report: --truth {}: no row of it is of these frames, by stamp_ns or frame\n",
               options.truth);
  }
  if (pairs.other_stamps > 0) {
    fmt::print(stderr,
               "pose_wall report: --truth {}: matched by frame, but in {} of {} the stamps differ; where the frames "
               "are not the first ones of the truth, in its order, the errors shown mean nothing\n",
               options.truth, pairs.other_stamps, counted(pairs.rows.size(), "pair"));
  }
}

std::string title_of(const ReportOptions& options) {
  if (!options.title.empty()) return options.title;
  std::filesystem::path first = std::filesystem::path(options.frames.inputs.front()).lexically_normal();
  if (!first.has_filename()) first = first.parent_path();
  return first.filename().string() == "frames" && first.has_parent_path() ? first.parent_path().filename().string()
                                                                          : first.filename().string();
}

int report_frames(const ReportOptions& options) {
  const LoadedConfig loaded = options.frames.load();
  FrameSequence inputs = options.frames.open();
  for (const std::string& error : inputs.errors()) fmt::print(stderr, "pose_wall report: {}\n", error);
  if (inputs.frames() == 0) throw std::runtime_error("no frame to report on");
  const std::vector<TruthRow> truth = options.truth.empty() ? std::vector<TruthRow>() : read_truth_csv(options.truth);
  std::vector<std::filesystem::path> read = options.frames.files_read(inputs);
  if (!options.truth.empty()) read.emplace_back(options.truth);
  OutputFile output(options.output, read);
  FrameRunner runner(loaded.config, options.frames.rate_hz, loaded.motion);
  report::PageData data(loaded.config, inputs.frames(), options.points_max);

  const auto started = std::chrono::steady_clock::now();
  const Shown shown = process_frames(options, inputs, runner, data);
  if (shown.summary.frames() == shown.summary.unreadable()) {
    fmt::print(stderr, "pose_wall report: no frame could be read; {} is not written\n", options.output);
    return kExitUnreadable;
  }
  add_truth(options, truth, shown, &data);
  const std::string page =
      report::page({title_of(options), language_name(), options.truth, shown.complete, inputs.frames()}, loaded, data);
  output.write(page);
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (!options.frames.quiet) {
    fmt::print(stderr, "{}\n{}: {:.1f} MB, {}, points of {} of them, {:.1f} s. Open it in a browser.\n",
               shown.summary.text(wall_s), options.output, 1e-6 * static_cast<double>(page.size()),
               counted(data.frames(), "frame"), data.clouds(), wall_s);
  }
  if (!shown.complete) {
    fmt::print(stderr, "interrupted: the report shows {} of {} frames\n", data.frames(), inputs.frames());
    return kExitInterrupted;
  }
  return inputs.errors().empty() && shown.summary.unreadable() == 0 ? kExitDone : kExitUnreadable;
}

bool is_table(const std::string& input) {
  return std::filesystem::path(input).extension() == ".csv";
}

// Of a table of `pose_wall motion` instead of frames.
int report_motion(const ReportOptions& options) {
  const std::string& input = options.frames.inputs.front();
  if (options.frames.inputs.size() > 1) throw std::invalid_argument(input + ": a table is reported on alone");
  const CsvTable cells = read_csv_file(input);
  const MotionTable table = in_csv_file(input, [&] { return read_motion_table(cells); });
  if (table.rows.empty()) throw std::runtime_error(input + ": the table has no row");
  std::optional<MotionComparison> comparison;
  if (!options.truth.empty()) {
    const CsvTable true_cells = read_csv_file(options.truth);
    const PoseTruth truth = in_csv_file(options.truth, [&] { return read_pose_truth(true_cells); });
    comparison = in_csv_file(input + " against " + options.truth, [&] { return compare_motion(table, truth); });
  }
  std::vector<std::filesystem::path> read = {input};
  if (!options.truth.empty()) read.emplace_back(options.truth);
  OutputFile output(options.output, read);
  const std::string page = report::motion_page({title_of(options), language_name(), options.truth}, table, comparison);
  output.write(page);
  if (!options.frames.quiet) {
    fmt::print(stderr, "{}: {:.1f} MB, {}. Open it in a browser.\n", options.output,
               1e-6 * static_cast<double>(page.size()), counted(table.rows.size(), "frame"));
  }
  return kExitDone;
}

int report_inputs(const ReportOptions& options) {
  const std::vector<std::string>& inputs = options.frames.inputs;
  return std::any_of(inputs.begin(), inputs.end(), is_table) ? report_motion(options) : report_frames(options);
}

}  // namespace

void add_report(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* verb = app.add_subcommand("report", "Measure frames and write a page to look at them in a browser");
  add_frame_options(verb, &options->frames);
  verb->add_option("-o,--output", options->output, "The page")->capture_default_str();
  verb->add_option(
          "--truth", options->truth,
          "truth.csv of pose_wall sim: each frame has the row of its stamp, or where stamps do not tell, of its "
          "number among the inputs, from 0")
      ->check(CLI::ExistingFile);
  verb->add_option("--title", options->title, "Heading; default: the name of the first input");
  verb->add_option("--points", options->points_max, "Points in the page, of all frames together: 9 bytes each")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1000}, std::size_t{20'000'000}));
  verb->footer(
      "Example:\n"
      "  pose_wall sim --scene nominal --frames 100 --output road\n"
      "  pose_wall report -c road/pose_wall.yaml --truth road/truth.csv -o road.html road/frames\n"
      "  pose_wall report --truth road/truth.csv -o way.html motion.csv\n"
      "The last is of a table of `pose_wall motion` (.csv): its path from above, states along the road, travel, "
      "steps.\n"
      "The page is one file and needs no network: time series with protection levels and states, every frame from\n"
      "above and in section, summary and verdict, in English and Chinese. Of long recordings it keeps the points of\n"
      "some 400 frames and of those in which a state changes. Ctrl-C ends it early; the page then shows what was "
      "read.\n"
      "Exit status: 0 done, 1 an input could not be read (the others are shown) or the page not written, 2 bad usage "
      "or config, 130 "
      "interrupted.");
  verb->callback(
      [options, &exit_code] { exit_code = done_or_complaint("report", [&] { return report_inputs(*options); }); });
}

}  // namespace pose_wall::tools
