// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall scan: frames or a log in, planar scans out.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/options/frame_arguments.hpp"
#include "apps/options/one_of.hpp"
#include "apps/options/pose_word.hpp"
#include "apps/verbs/complaint.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/csv/csv_table.hpp"
#include "io/language/language.hpp"
#include "io/outputs/output_file.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/progress_bar.hpp"
#include "io/terminal/text_table.hpp"
#include "study/planar/cloud_scans.hpp"
#include "study/planar/scan_inputs.hpp"
#include "study/planar/scan_picture.hpp"
#include "study/results/row_output.hpp"

namespace pose_wall::tools {
namespace {

struct ScanOptions {
  FrameOptions frames;
  std::string output;
  std::string format = "csv";
  std::string picture;  // file; empty: none
  std::size_t drawn = 0;
};

// Beside the range, where the scan is of a cloud.
struct BeamColumn {
  const char* name;
  const float* pose_wall_planar_scan_view::*values;
};
constexpr BeamColumn kBeamColumns[] = {
    {"free_m", &pose_wall_planar_scan_view::free_m},
    {"bias_m", &pose_wall_planar_scan_view::bias_m},
    {"sigma_m", &pose_wall_planar_scan_view::sigma_m},
    {"low_m", &pose_wall_planar_scan_view::low_m},
    {"overhead_m", &pose_wall_planar_scan_view::overhead_m},
    {"alone_m", &pose_wall_planar_scan_view::alone_m},
    {"clear_from_m", &pose_wall_planar_scan_view::clear_from_m},
    {"clear_m", &pose_wall_planar_scan_view::clear_m},
};

struct ScanCounts {
  std::size_t scans = 0, unreadable = 0, beams = 0, ranges = 0, held = 0;
  bool is_drawn = false;
};

std::string csv_head() {
  std::vector<std::string> head = {"scan", "source", "time_s", "beam", "angle_rad", "range_m"};
  for (const BeamColumn& column : kBeamColumns) head.emplace_back(column.name);
  return csv_line(head);
}

double angle_of(const SourcedScan& scan, std::size_t beam) {
  return scan.scan.angle_min_rad + static_cast<double>(beam) * scan.scan.angle_step_rad;
}

std::string number_or_inf(double value) {
  return value == INFINITY ? "inf" : csv_number(value);
}

std::string csv_rows(std::size_t number, const SourcedScan& scan, const pose_wall_planar_scan_view* view) {
  std::string rows;
  for (std::size_t beam = 0; beam < scan.range_m.size(); ++beam) {
    std::vector<std::string> cells = {std::to_string(number),
                                      scan.name,
                                      scan.time,
                                      std::to_string(beam),
                                      csv_number(angle_of(scan, beam)),
                                      number_or_inf(static_cast<double>(scan.range_m[beam]))};
    for (const BeamColumn& column : kBeamColumns) {
      cells.push_back(view != nullptr ? csv_number(static_cast<double>((view->*column.values)[beam])) : "");
    }
    rows += csv_line(cells);
  }
  return rows;
}

// Nine digits hold a float; null where there is no number, "inf" where all was seen free.
nlohmann::ordered_json json_ranges(const float* values, std::size_t count) {
  nlohmann::ordered_json array = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < count; ++k) {
    if (std::isfinite(values[k])) {
      array.push_back(std::round(static_cast<double>(values[k]) * 1e5) * 1e-5);
    } else if (values[k] > 0.0F) {
      array.push_back("inf");
    } else {
      array.push_back(nullptr);
    }
  }
  return array;
}

std::string json_row(std::size_t number, const SourcedScan& scan, const pose_wall_planar_scan_view* view) {
  const pose_wall_planar_scan& head = scan.scan;
  nlohmann::ordered_json row;
  row["scan"] = number;
  row["source"] = scan.name;
  row["time_s"] = scan.time;
  row["sensor"] = {head.sensor.x_m, head.sensor.y_m, head.sensor.yaw_rad};
  row["angle_min_rad"] = head.angle_min_rad;
  row["angle_step_rad"] = head.angle_step_rad;
  row["range_min_m"] = head.range_min_m;
  row["range_max_m"] = head.range_max_m;
  row["sigma_m"] = head.sigma_m;
  if (scan.odometry) row["odometry"] = {scan.odometry->x_m, scan.odometry->y_m, scan.odometry->yaw_rad};
  if (view != nullptr) {
    row["floor_age_s"] = view->floor_age_s;
    row["sensor_height_m"] = view->sensor_height_m;
    row["min_height_m"] = view->min_height_m;
    row["max_height_m"] = view->max_height_m;
  }
  row["ranges_m"] = json_ranges(scan.range_m.data(), scan.range_m.size());
  for (const BeamColumn& column : kBeamColumns) {
    if (view != nullptr) row["beams"][column.name] = json_ranges(view->*column.values, scan.range_m.size());
  }
  return row.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

std::string counts_text(const ScanCounts& counts) {
  TextTable table({tr("planar scans"), ""});
  table.add_row({tr("scans"), std::to_string(counts.scans)});
  table.add_row({tr("beams a scan"), std::to_string(counts.beams / counts.scans)});
  table.add_row({tr("beams with a range"), fmt::format("{:.1f} %", 100.0 * static_cast<double>(counts.ranges) /
                                                                       static_cast<double>(counts.beams))});
  table.add_row({tr("scans on a held floor"), std::to_string(counts.held)});
  table.add_row({tr("not readable, or without a floor"), std::to_string(counts.unreadable)});
  return table.text();
}

void count(const SourcedScan& scan, const pose_wall_planar_scan_view* view, ScanCounts* counts) {
  ++counts->scans;
  counts->beams += scan.range_m.size();
  for (const float range_m : scan.range_m) counts->ranges += std::isfinite(range_m) ? 1U : 0U;
  if (view != nullptr && view->floor_state == POSE_WALL_PLANAR_FLOOR_HELD) ++counts->held;
}

// What could not be written, or nothing. Ctrl-C ends it after the scan at work.
std::string write_scans(const ScanOptions& options, ScanSource& source, RowOutput* rows, OutputFile* picture,
                        ScanCounts* counts) {
  const auto* clouds = dynamic_cast<const CloudScans*>(&source);
  const bool bar_shown = !options.frames.quiet && is_terminal(2) && !(rows->is_stdout() && is_terminal(1));
  ProgressBar bar(source.scans(), bar_shown, translatable("scans"));
  for (std::size_t number = 0; !InterruptWatch::is_interrupted(); ++number) {
    const std::optional<SourcedScan> scan = source.next();
    if (!scan) break;
    if (!scan->error.empty()) {
      ++counts->unreadable;
      bar.print_above(fmt::format("pose_wall scan: {}: {}", scan->name, scan->error));
      continue;
    }
    const pose_wall_planar_scan_view* view = clouds != nullptr ? &clouds->view() : nullptr;
    count(*scan, view, counts);
    const bool is_written =
        rows->write(options.format == "json" ? json_row(number, *scan, view) : csv_rows(number, *scan, view));
    if (!is_written) return say("{} could not be written to the end", rows->name());
    if (picture != nullptr && number >= options.drawn && !counts->is_drawn) {
      picture->write(scan_picture(*scan, view));
      counts->is_drawn = true;
    }
    bar.advance(std::filesystem::path(scan->name).filename().string());
  }
  return "";
}

int scan_inputs(const ScanOptions& options) {
  const std::unique_ptr<ScanSource> source = open_scans(options.frames, {});
  std::vector<std::filesystem::path> read = source->files();
  RowOutput rows(options.output, read, options.format == "json" ? "" : csv_head());
  if (!options.output.empty()) read.emplace_back(options.output);
  std::optional<OutputFile> picture;
  if (!options.picture.empty()) picture.emplace(options.picture, read, "--picture");
  for (const std::string& error : source->errors()) fmt::print(stderr, "pose_wall scan: {}\n", error);
  if (!options.frames.quiet) {
    for (const std::string& note : source->notes()) fmt::print(stderr, "{}\n", note);
  }
  ScanCounts counts;
  const std::string fault = write_scans(options, *source, &rows, picture ? &*picture : nullptr, &counts);
  if (!fault.empty()) fmt::print(stderr, "pose_wall scan: {}\n", fault);
  if (!options.frames.quiet && counts.scans > 0) fmt::print(stderr, "\n{}", counts_text(counts));
  if (InterruptWatch::is_interrupted()) {
    fmt::print(stderr, "{}", say("interrupted after {} scans, each whole\n", counts.scans));
    return kExitInterrupted;
  }
  if (counts.scans == 0) fmt::print(stderr, "{}", say("pose_wall scan: there is no scan\n"));
  const bool lacks_picture = picture && !counts.is_drawn;
  if (lacks_picture && counts.scans > 0) {
    fmt::print(stderr, "{}",
               say("pose_wall scan: --drawn {}: there is no scan from this number on, so {} is not written\n",
                   options.drawn, options.picture));
  }
  const bool is_done =
      fault.empty() && source->errors().empty() && counts.unreadable == 0 && counts.scans > 0 && !lacks_picture;
  return is_done ? kExitDone : kExitUnreadable;
}

}  // namespace

void add_scan(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<ScanOptions>();
  CLI::App* verb = app.add_subcommand("scan", tr("Compress frames to planar scans by the machine's height"));
  add_frame_options(verb, &options->frames, kScanInputHelp);
  verb->add_option("-o,--output", options->output, tr("File for the scans; default, and -: standard output"));
  verb->add_option("--format", options->format,
                   tr("CSV: a row for each beam; JSON: one object per line and scan, with the beams as arrays"))
      ->capture_default_str()
      ->check(one_of({"csv", "json"}));
  verb->add_option("--picture", options->picture, tr("File for a picture of one scan from above (SVG)"))
      ->check(svg_file());
  verb->add_option("--drawn", options->drawn,
                   tr("Number of that scan among the inputs, from 0; where it cannot be read, the next one"))
      ->capture_default_str()
      ->check(whole_number());
  const std::string text = tr(
      "Examples:\n"
      "  pose_wall scan -c road/pose_wall.yaml -o scans.csv --picture scan.svg road/frames\n"
      "  pose_wall scan -c vlp16 -s machine_height_m=1.6 --format json -o scans.jsonl road.bag\n"
      "  pose_wall scan --format json -o scans.jsonl aces.clf.gz\n"
      "Scans of a log stay as they are. Of frames, a beam is the first thing of the machine's height in its\n"
      "direction. Heights count from the measured floor: from ground_clearance_m to machine_height_m, with margin_m\n"
      "at both ends.\n"
      "An empty range_m is unknown, which is not free. free_m: so far a ray passed. low_m, overhead_m: nearest\n"
      "return below and above the band. clear_from_m to clear_m: nothing of thing_m stands there unseen.\n"
      "Exit status: 0 done, 1 an input could not be read or has no floor (the others are written), 2 bad usage or\n"
      "config, 130 interrupted by Ctrl-C: whole scans are written.");
  verb->footer(text + settings_help(scanner_setting_rows()));
  verb->callback([options, &exit_code] {
    if (options->output == "-") options->output.clear();
    exit_code = done_or_complaint("scan", [&] { return scan_inputs(*options); });
  });
}

}  // namespace pose_wall::tools
