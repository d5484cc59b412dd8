// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall report: measures frames and writes a page about them.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
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
#include "io/config_file/load_config.hpp"
#include "io/csv/csv_file.hpp"
#include "io/csv/truth_csv.hpp"
#include "io/inputs/frame_sequence.hpp"
#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/outputs/output_file.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/progress_bar.hpp"
#include "study/motion/motion_comparison.hpp"
#include "study/motion/motion_table.hpp"
#include "study/motion/pose_truth.hpp"
#include "study/planar/map_report.hpp"
#include "study/report/motion_page.hpp"
#include "study/report/page.hpp"
#include "study/results/frame_runner.hpp"
#include "study/results/result_table.hpp"
#include "study/results/run_summary.hpp"
#include "study/truth/row_pairs.hpp"

namespace pose_wall::tools {
namespace {

constexpr const char* kReportInputHelp = translatable(
    "Frames as for run: files, folders, bags, captures; or a table of run or motion (CSV); or what map -o, localise -o "
    "(folders), plan -o (CSV) and --picture (SVG) wrote");

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
  std::vector<bool> is_unreadable;  // by row
  bool complete = true;
};

Shown process_frames(const ReportOptions& options, FrameSequence& inputs, FrameRunner& runner, report::PageData& data) {
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
    shown.is_unreadable.push_back(!outcome.result);
    data.add(outcome);
    bar.advance(std::filesystem::path(outcome.source).filename().string());
  }
  yield_stamps(shown.is_unreadable, &shown.keys);
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

// Gives each frame that was read its truth. The stamps of all frames decide which rows belong together.
void add_truth(const ReportOptions& options, const std::vector<TruthRow>& truth, const Shown& shown,
               report::PageData* data) {
  std::vector<const TruthRow*> of_frames(data->frames(), nullptr);
  const RowPairs pairs = pair_rows(shown.keys, keys_of(truth));
  for (const auto& [frame, row] : pairs.rows) of_frames[frame] = &truth[row];
  data->add_truth(of_frames);
  if (options.truth.empty()) return;
  if (pairs.rows.empty()) {
    fmt::print(stderr, "{}",
               say("pose_wall report: --truth {}: no row matches these frames, by stamp_ns or frame\n", options.truth));
  }
  if (pairs.other_stamps > 0) {
    fmt::print(stderr, "{}",
               say("pose_wall report: --truth {}: matched by frame number, but the stamps differ in {} of {} pairs. "
                   "Unless the frames are the first ones of the truth, in its order, the errors shown mean nothing.\n",
                   options.truth, pairs.other_stamps, pairs.rows.size()));
  }
}

std::string counted_frames(std::size_t frames) {
  return frames == 1 ? say("1 frame") : say("{} frames", frames);
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
  if (inputs.frames() == 0) throw std::runtime_error(tr("no frame to report on"));
  const std::vector<TruthRow> truth = options.truth.empty() ? std::vector<TruthRow>() : read_truth_csv(options.truth);
  std::vector<std::filesystem::path> read = options.frames.files_read(inputs);
  if (!options.truth.empty()) read.emplace_back(options.truth);
  OutputFile output(options.output, read);
  FrameRunner runner(loaded.config, options.frames.rate_hz, loaded.motion);
  report::PageData data(loaded.config, inputs.frames(), options.points_max);

  const auto started = std::chrono::steady_clock::now();
  const Shown shown = process_frames(options, inputs, runner, data);
  if (shown.summary.frames() == shown.summary.unreadable()) {
    if (!shown.complete)
      throw std::runtime_error(say("interrupted before the first frame; {} is not written", options.output));
    fmt::print(stderr, "{}", say("pose_wall report: no frame could be read; {} is not written\n", options.output));
    return kExitUnreadable;
  }
  add_truth(options, truth, shown, &data);
  const std::string page =
      report::page({title_of(options), language_name(), options.truth, shown.complete, inputs.frames()}, loaded, data);
  output.write(page);
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (!options.frames.quiet) {
    fmt::print(stderr, "{}\n{}", shown.summary.text(wall_s),
               say("{}: {:.1f} MB, {}, points of {} of them, {:.1f} s. Open it in a browser.\n", options.output,
                   1e-6 * static_cast<double>(page.size()), counted_frames(data.frames()), data.clouds(), wall_s));
  }
  if (!shown.complete) {
    fmt::print(stderr, "{}", say("interrupted: the report shows {} of {} frames\n", data.frames(), inputs.frames()));
    return kExitInterrupted;
  }
  return inputs.errors().empty() && shown.summary.unreadable() == 0 ? kExitDone : kExitUnreadable;
}

bool is_table(const std::string& input) {
  return std::filesystem::path(input).extension() == ".csv";
}

// Both are given their files before the work, so that --output is none of them.
std::vector<std::filesystem::path> files_of_table(const ReportOptions& options) {
  std::vector<std::filesystem::path> read = {options.frames.inputs.front()};
  if (!options.truth.empty()) read.emplace_back(options.truth);
  return read;
}

// What is valid in a table is so by the limits of its run, whatever the settings of now say. Throws where its rows are
// of runs with different ones.
void take_limits(const std::vector<FrameOutcome>& outcomes, const std::string& input, api::Config* config) {
  std::optional<AlertLimits> found;
  for (const FrameOutcome& outcome : outcomes) {
    const AlertLimits& limits = outcome.limits;
    if (!(limits.angle_rad > 0.0 && limits.distance_m > 0.0)) continue;
    if (found && (found->angle_rad != limits.angle_rad || found->distance_m != limits.distance_m)) {
      throw std::runtime_error(say("{}: its rows have different alert limits: they are of several runs", input));
    }
    found = limits;
  }
  if (!found) {
    fmt::print(stderr, "{}",
               say("pose_wall report: {}: an older table, which does not tell its alert limits. Those of the settings "
                   "stand in the page; give the settings of its run by --config\n",
                   input));
    return;
  }
  const std::string angle = fmt::format("{}", found->angle_rad * kDegPerRad),
                    distance = fmt::format("{}", found->distance_m);
  if (config->set("alert_limit_angle_deg", angle.c_str()) != POSE_WALL_OK ||
      config->set("alert_limit_distance", distance.c_str()) != POSE_WALL_OK) {
    throw std::runtime_error(
        say("{}: its alert limits, {} deg and {} m, are none of this version", input, angle, distance));
  }
}

// For a table of `pose_wall run` instead of frames: what it tells, without a cloud.
int report_results(const ReportOptions& options, const CsvTable& cells) {
  const std::string& input = options.frames.inputs.front();
  LoadedConfig loaded = options.frames.load();
  const std::vector<FrameOutcome> outcomes = in_csv_file(input, [&] { return read_result_table(cells); });
  if (outcomes.empty()) throw std::runtime_error(say("{}: the table has no row", input));
  take_limits(outcomes, input, &loaded.config);
  const std::vector<TruthRow> truth = options.truth.empty() ? std::vector<TruthRow>() : read_truth_csv(options.truth);
  OutputFile output(options.output, files_of_table(options));
  report::PageData data(loaded.config, outcomes.size(), options.points_max);
  for (const FrameOutcome& outcome : outcomes) data.add(outcome);
  Shown shown;
  shown.keys = row_keys(cells);
  add_truth(options, truth, shown, &data);
  report::PageHead head{title_of(options), language_name(), options.truth, true, outcomes.size()};
  head.from_table = true;
  const std::string page = report::page(head, loaded, data);
  output.write(page);
  if (!options.frames.quiet) {
    fmt::print(stderr, "{}",
               say("{}: {:.1f} MB, {}, from the table alone: no clouds, no pictures of them. Open it in a browser.\n",
                   options.output, 1e-6 * static_cast<double>(page.size()), counted_frames(data.frames())));
  }
  return kExitDone;
}

// For a table of `pose_wall motion` instead of frames.
int report_motion(const ReportOptions& options, const CsvTable& cells) {
  const std::string& input = options.frames.inputs.front();
  const MotionTable table = in_csv_file(input, [&] { return read_motion_table(cells); });
  if (table.rows.empty()) throw std::runtime_error(say("{}: the table has no row", input));
  std::optional<MotionComparison> comparison;
  if (!options.truth.empty()) {
    const CsvTable true_cells = read_csv_file(options.truth);
    const PoseTruth truth = in_csv_file(options.truth, [&] { return read_pose_truth(true_cells); });
    comparison = in_csv_file(say("{} against {}", input, options.truth), [&] { return compare_motion(table, truth); });
  }
  OutputFile output(options.output, files_of_table(options));
  const std::string page = report::motion_page({title_of(options), language_name(), options.truth}, table, comparison);
  output.write(page);
  if (!options.frames.quiet) {
    fmt::print(stderr, "{}",
               say("{}: {:.1f} MB, {}. Open it in a browser.\n", options.output,
                   1e-6 * static_cast<double>(page.size()), counted_frames(table.rows.size())));
  }
  return kExitDone;
}

// The kind is told by the columns that a table of the kind alone has. What lacks some of these is told, too.
int report_table(const ReportOptions& options) {
  const std::string& input = options.frames.inputs.front();
  if (options.frames.inputs.size() > 1) throw std::invalid_argument(say("{}: give a table alone", input));
  const CsvTable cells = read_csv_file(input);
  if (is_motion_table(cells)) return report_motion(options, cells);
  if (cells.find_column("roll_state") || cells.find_column("d_lf_state")) return report_results(options, cells);
  throw std::runtime_error(
      say("{}: this is no table of run (with roll, roll_state, ...), motion (along_m, ...), plan or localise. Its "
          "columns: {}",
          input, cells.head_text()));
}

// For what `map`, `localise` and `plan` wrote.
int report_maps(const ReportOptions& options) {
  const std::vector<std::string>& inputs = options.frames.inputs;
  for (const std::string& input : inputs) {
    if (!is_map_result(input)) {
      throw std::invalid_argument(
          say("{}: this is no result of map, localise or plan; a page shows those without other inputs", input));
    }
  }
  if (!options.truth.empty()) {
    throw std::invalid_argument(tr("--truth is for frames and motion; localise itself compares with a truth"));
  }
  const MapReport report = map_report(inputs, title_of(options));
  OutputFile output(options.output, report.files);
  output.write(report.page);
  if (!options.frames.quiet) {
    fmt::print(stderr, "{}",
               say("{}: {:.1f} MB, {} pictures. Open it in a browser.\n", options.output,
                   1e-6 * static_cast<double>(report.page.size()), report.pictures));
  }
  return kExitDone;
}

// Of frames the others are still shown. Tables and maps belong together.
void require_there(const std::vector<std::string>& inputs) {
  std::error_code ignored;
  std::vector<std::string> missing;
  for (const std::string& input : inputs) {
    if (!std::filesystem::exists(input, ignored)) missing.push_back(input);
  }
  const bool are_frames = std::none_of(
      inputs.begin(), inputs.end(), [](const std::string& input) { return is_map_result(input) || is_table(input); });
  if (missing.empty() || (are_frames && missing.size() < inputs.size())) return;
  throw std::runtime_error(say(
      "INPUT {}: there is no such file or folder. Give frames or a bag; or a table of run or motion; or what `map -o`, "
      "`localise -o` and `plan -o` wrote",
      fmt::format("{}", fmt::join(missing, ", "))));
}

int report_inputs(const ReportOptions& options) {
  const std::vector<std::string>& inputs = options.frames.inputs;
  require_there(inputs);
  if (std::any_of(inputs.begin(), inputs.end(), is_map_result)) return report_maps(options);
  return std::any_of(inputs.begin(), inputs.end(), is_table) ? report_table(options) : report_frames(options);
}

}  // namespace

void add_report(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* verb = app.add_subcommand("report", tr("Measure frames and write a page about them, to open in a browser"));
  add_frame_options(verb, &options->frames, kReportInputHelp);
  verb->add_option("-o,--output", options->output, tr("The page"))->capture_default_str();
  verb->add_option("--truth", options->truth,
                   tr("truth.csv of pose_wall sim. Each frame gets the row of its stamp. If the stamps do not tell the "
                      "rows apart, it gets the row of its number among the inputs, from 0"))
      ->check(existing_file());
  verb->add_option("--title", options->title, tr("Heading; default: the name of the first input"));
  verb->add_option("--points", options->points_max, tr("Points in the page, over all frames: 9 bytes each"))
      ->capture_default_str()
      ->check(whole_number_within(1000, 20'000'000));
  verb->footer(tr(
      "Examples:\n"
      "  pose_wall sim --scene nominal --frames 100 --output road\n"
      "  pose_wall report -c road/pose_wall.yaml --truth road/truth.csv -o road.html road/frames\n"
      "  pose_wall report -o values.html out.csv\n"
      "  pose_wall report --truth road/truth.csv -o way.html motion.csv\n"
      "  pose_wall report -o map.html map found route.csv route.svg\n"
      "The third example reads a table of `run`: the same page without clouds and pictures of them. The fourth reads\n"
      "a table of `motion`. Its page shows the path from above, the states\n"
      "along the road, travel and steps. The last one reads the folders of `map -o` and `localise -o` and table and\n"
      "picture of `plan`. Its page shows their pictures (SVG) and figures.\n"
      "The page is one file in English and Chinese and needs no network. It shows a verdict, every frame from above\n"
      "and in section, and time series with protection levels and states. Values that are not valid are grey.\n"
      "Of a long recording it keeps the points of some 400 frames, and of frames in which a state changes.\n"
      "Ctrl-C ends it early; the page then shows the frames read so far.\n"
      "Exit status: 0 done, 1 an input could not be read (the others are shown) or the page not written,\n"
      "2 bad usage or config, 130 interrupted."));
  verb->callback(
      [options, &exit_code] { exit_code = done_or_complaint("report", [&] { return report_inputs(*options); }); });
}

}  // namespace pose_wall::tools
