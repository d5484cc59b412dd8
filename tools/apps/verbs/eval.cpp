// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall eval: a table of results against the truth.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/verbs/complaint.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/config_file/config_place.hpp"
#include "io/config_file/load_config.hpp"
#include "io/csv/csv_file.hpp"
#include "io/csv/csv_table.hpp"
#include "io/frames/text_cursor.hpp"
#include "io/json/json_words.hpp"
#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/terminal/text_table.hpp"
#include "study/motion/comparison_words.hpp"
#include "study/motion/motion_comparison.hpp"
#include "study/motion/motion_table.hpp"
#include "study/motion/pose_truth.hpp"
#include "study/results/usability.hpp"
#include "study/truth/comparison.hpp"
#include "study/truth/efficiency.hpp"
#include "study/truth/error_figures_json.hpp"

namespace pose_wall::tools {
namespace {

struct EvalOptions {
  std::string results;
  std::string truth;
  std::string config_file;
  std::vector<std::string> settings;
  std::string frames;
  std::optional<double> range_noise_m;
  bool json = false;
};

std::string amount(const QuantityComparison& quantity, double value) {
  if (!std::isfinite(value)) return "-";
  return quantity.is_angle ? fmt::format("{:.4f}°", value * kDegPerRad) : fmt::format("{:.1f} mm", value * 1e3);
}

std::string exact_share(std::size_t part, std::size_t whole) {
  return whole == 0 ? "-" : fmt::format("{:.2f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

void append_figures(std::vector<std::string>& cells, const QuantityComparison& quantity, const ErrorFigures& figures) {
  for (const double figure : {figures.rmse, figures.bias, figures.absolute_95, figures.absolute_max}) {
    cells.push_back(amount(quantity, figure));
  }
}

void append_bound(std::vector<std::string>& cells, const QuantityComparison& quantity, const EfficiencySums& sums) {
  // Far below what a controller cares for: with more digits than the errors.
  const double bound = sums.bound();
  cells.push_back(!std::isfinite(bound) ? "-"
                  : quantity.is_angle   ? fmt::format("{:.5f}°", bound * kDegPerRad)
                                        : fmt::format("{:.3f} mm", bound * 1e3));
  cells.push_back(std::isfinite(sums.ratio()) ? fmt::format("{:.2f}", sums.ratio()) : "-");
}

void print_points(const Efficiency& efficiency) {
  fmt::print("{}",
             say("\nCRB over {} frames; points per frame: floor {:.0f}, left {:.0f}, right {:.0f}. Their scatter is "
                 "{:.2f} times the range noise.\n",
                 efficiency.frames, efficiency.floor_points, efficiency.wall_points[0], efficiency.wall_points[1],
                 efficiency.noise_ratio));
  if (efficiency.is_believable()) return;
  fmt::print("{}", tr("Do not trust the bound: it holds for flat upright walls, a flat floor and the stated range "
                      "noise.\n"));
}

std::vector<std::string> raw_cells(const QuantityComparison& quantity, const std::optional<Efficiency>& efficiency) {
  const ErrorStatistics& s = quantity.statistics;
  std::vector<std::string> cells = {quantity.name, std::to_string(s.frames()), exact_share(s.measured(), s.frames())};
  append_figures(cells, quantity, s.raw());
  cells.push_back(exact_share(s.raw_beyond_protection(), s.measured()));
  cells.push_back(std::isfinite(s.mean_z2()) ? fmt::format("{:.2f}", s.mean_z2()) : "-");
  if (efficiency) append_bound(cells, quantity, efficiency->quantity[quantity.index]);
  return cells;
}

// Each state apart: what may be acted on, and what not.
std::vector<std::string> value_cells(const QuantityComparison& quantity) {
  const ErrorStatistics& s = quantity.statistics;
  std::vector<std::string> cells = {quantity.name, std::to_string(s.frames())};
  for (const std::uint32_t state : {POSE_WALL_VALID, POSE_WALL_DEGRADED, POSE_WALL_HELD, POSE_WALL_INVALID}) {
    cells.push_back(exact_share(s.in_state(state), s.frames()));
  }
  append_figures(cells, quantity, s.value());
  cells.push_back(exact_share(s.value_beyond_protection(), s.value().count));
  cells.push_back(s.valid() == 0 ? tr("none valid") : say("{} of {}", s.valid_beyond_alert(), s.valid()));
  return cells;
}

ValidShares valid_shares(const Comparison& comparison) {
  ValidShares shares{};
  for (const QuantityComparison& quantity : comparison.quantities) {
    const ErrorStatistics& s = quantity.statistics;
    shares[quantity.index] = static_cast<double>(s.valid()) / static_cast<double>(s.frames());
  }
  return shares;
}

void print_tables(const Comparison& comparison, const std::optional<Efficiency>& efficiency) {
  fmt::print("{}",
             say("{} frames matched by {}; without partner: {} results, {} truth rows\n"
                 "Angles in degrees, distances in millimetres; the tables RESULT and TRUTH hold radians and "
                 "metres.\n\n",
                 comparison.matched, comparison.matched_by, comparison.result_rows_alone, comparison.truth_rows_alone));
  std::vector<std::string> head = {tr("raw"),  tr("frames"),    tr("measured"), tr("RMSE"),   tr("bias"),
                                   tr("95 %"), tr("max error"), tr("> level"),  tr("mean z²")};
  if (efficiency) head.insert(head.end(), {tr("CRB"), tr("RMSE/CRB")});
  TextTable raw(head);
  TextTable value({tr("value"), tr("frames"), tr("valid"), tr("degraded"), tr("held"), tr("invalid"), tr("RMSE"),
                   tr("bias"), tr("95 %"), tr("max error"), tr("> level"), tr("valid and > alert limit")});
  for (const QuantityComparison& quantity : comparison.quantities) {
    raw.add_row(raw_cells(quantity, efficiency));
    value.add_row(value_cells(quantity));
  }
  fmt::print("{}\n{}{}", raw.text(), value.text(),
             tr("Errors of value: valid, degraded and held ones together. Act on a value only while it is valid.\n"));
  if (comparison.quantities.size() == POSE_WALL_QUANTITIES) {
    fmt::print("{}", say("verdict: {}\n", usability_text(valid_shares(comparison))));
  }
  if (efficiency) print_points(*efficiency);
}

Json json_bound(const EfficiencySums& sums) {
  return {{"frames", sums.frames()}, {"crb", sums.bound()}, {"rmse", sums.rmse()}, {"rmse_over_crb", sums.ratio()}};
}

Json json_points(const Efficiency& efficiency) {
  return {{"frames", efficiency.frames},
          {"floor_points", efficiency.floor_points},
          {"left_points", efficiency.wall_points[0]},
          {"right_points", efficiency.wall_points[1]},
          {"noise_ratio", efficiency.noise_ratio},
          {"believable", efficiency.is_believable()}};
}

Json comparison_json(const Comparison& comparison, const std::optional<Efficiency>& efficiency) {
  Json page = {{"matched_by", comparison.matched_by},
               {"matched", comparison.matched},
               {"other_stamps", comparison.other_stamps},
               {"result_rows_alone", comparison.result_rows_alone},
               {"truth_rows_alone", comparison.truth_rows_alone}};
  for (const QuantityComparison& quantity : comparison.quantities) {
    const ErrorStatistics& s = quantity.statistics;
    page["quantities"][quantity.name] = {{"unit", quantity.is_angle ? "rad" : "m"},
                                         {"frames", s.frames()},
                                         {"measured", s.measured()},
                                         {"valid", s.valid()},
                                         {"degraded", s.in_state(POSE_WALL_DEGRADED)},
                                         {"held", s.in_state(POSE_WALL_HELD)},
                                         {"invalid", s.in_state(POSE_WALL_INVALID)},
                                         {"raw", error_figures_json(s.raw())},
                                         {"value", error_figures_json(s.value())},
                                         {"raw_beyond_protection", s.raw_beyond_protection()},
                                         {"value_beyond_protection", s.value_beyond_protection()},
                                         {"valid_beyond_alert", s.valid_beyond_alert()},
                                         {"mean_z2", s.mean_z2()}};
    if (efficiency) page["quantities"][quantity.name]["bound"] = json_bound(efficiency->quantity[quantity.index]);
  }
  if (efficiency) page["bound"] = json_points(*efficiency);
  return page;
}

std::optional<Efficiency> efficiency(const EvalOptions& options, const LoadedConfig& loaded, const CsvTable& results,
                                     const CsvTable& truth, const Comparison& comparison) {
  if (options.frames.empty()) return std::nullopt;
  const CramerRao bounds(loaded.config, *options.range_noise_m);
  return in_csv_file(options.results,
                     [&] { return efficiency_of(results, truth, comparison, options.frames, bounds); });
}

// Axes and mounting decide where the points lie: with the settings of another road the bound would mean nothing.
void demand_settings_for_bound(const EvalOptions& options) {
  if (options.frames.empty() || !options.config_file.empty()) return;
  throw std::invalid_argument(tr(
      "--frames needs --config FILE, the settings that RESULT was measured with. pose_wall sim writes them beside its "
      "frames; config/pose_wall.yaml holds the defaults."));
}

// Rows with the same number may belong to two runs. Only their stamps reveal it.
void tell_other_stamps(const EvalOptions& options, std::size_t other_stamps, std::size_t matched) {
  if (other_stamps == 0) return;
  fmt::print(stderr, "{}",
             say("pose_wall eval: {} against {}: matched by frame number, but the stamps differ in {} of {} pairs. "
                 "Unless the frames of RESULT are the first ones of TRUTH, in its order, these errors mean nothing.\n",
                 options.results, options.truth, other_stamps, matched));
}

// For a table of `pose_wall motion`.
int eval_motion(const EvalOptions& options, const CsvTable& results, const CsvTable& truth) {
  if (!options.frames.empty()) {
    throw std::invalid_argument(
        say("--frames: the bound is for a table of run; {} is a table of motion", options.results));
  }
  const MotionTable table = in_csv_file(options.results, [&] { return read_motion_table(results); });
  const PoseTruth poses = in_csv_file(options.truth, [&] { return read_pose_truth(truth); });
  const MotionComparison comparison =
      in_csv_file(say("{} against {}", options.results, options.truth), [&] { return compare_motion(table, poses); });
  tell_other_stamps(options, comparison.other_stamps, comparison.matched);
  if (options.json) {
    fmt::print("{}\n", json_text(motion_comparison_json(comparison), 2));
  } else {
    fmt::print("{}", motion_comparison_text(comparison));
  }
  return kExitDone;
}

// Against one file of truth. JSON where it was asked for; tables are printed.
Json eval_one(const EvalOptions& options, const LoadedConfig& loaded, const CsvTable& results, const CsvTable& truth) {
  const AlertLimits limits = alert_limits_of(loaded.config);
  const Comparison comparison = in_csv_file(say("{} against {}", options.results, options.truth),
                                            [&] { return compare_with_truth(results, truth, limits); });
  tell_other_stamps(options, comparison.other_stamps, comparison.matched);
  const std::optional<Efficiency> bound = efficiency(options, loaded, results, truth, comparison);
  if (options.json) return comparison_json(comparison, bound);
  print_tables(comparison, bound);
  return {};
}

// A folder of `pose_wall sim` has two truths, each under its name.
int eval_both(EvalOptions options, const LoadedConfig& loaded, const CsvTable& results) {
  const std::filesystem::path folder(options.truth);
  const std::pair<const char*, std::string> truths[] = {
      {"truth.csv", tr("the road as a whole")},
      {"surveyed_truth.csv", tr("planes of the rock that is really there, within 2.5 m")}};
  const bool has_both = std::filesystem::exists(folder / truths[1].first);  // a real road has its rock's alone
  Json page;
  for (const auto& [file, about] : truths) {
    options.truth = (folder / file).string();
    if (!options.json && has_both) fmt::print("{}{}: {}\n", page.empty() ? "" : "\n", file, about);
    page[file] = eval_one(options, loaded, results, read_csv_file(options.truth));
    if (!has_both) break;
  }
  if (options.json) fmt::print("{}\n", json_text(page, 2));
  return kExitDone;
}

int eval(const EvalOptions& options) {
  demand_settings_for_bound(options);
  const LoadedConfig loaded = load_config(options.config_file, options.settings);
  tell_notes(loaded, false);
  const CsvTable results = read_csv_file(options.results);
  const bool is_folder = std::filesystem::is_directory(options.truth);
  if (is_folder && !is_motion_table(results)) return eval_both(options, loaded, results);
  const CsvTable truth =
      read_csv_file(is_folder ? (std::filesystem::path(options.truth) / "truth.csv").string() : options.truth);
  if (is_motion_table(results)) return eval_motion(options, results, truth);
  const Json page = eval_one(options, loaded, results, truth);
  if (options.json) fmt::print("{}\n", json_text(page, 2));
  return kExitDone;
}

// Accepts what is inside, so that "nan" is refused.
std::string noise_fault(const std::string& word) {
  const std::optional<double> noise_m = parse_number<double>(word);
  if (noise_m && *noise_m >= 1e-4 && *noise_m <= 1.0) return "";
  return say("'{}' is refused; a number from 0.0001 to 1 is allowed", word);
}

}  // namespace

void add_eval(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<EvalOptions>();
  CLI::App* verb = app.add_subcommand("eval", tr("Compare results with the truth, per quantity"));
  verb->add_option("RESULT", options->results, tr("CSV written by pose_wall run or pose_wall motion"))->required();
  verb->add_option("TRUTH", options->truth,
                   tr("CSV with frame or stamp_ns and any of roll, pitch, yaw (rad), d_lf, d_lb, d_rf, d_rb (m). For "
                      "motion: x, y, z (m) and qx, qy, qz, qw, or r00 to r22 and tx, ty, tz. Or a folder of pose_wall "
                      "sim: each of its two truths by its name"))
      ->required();
  verb->add_option("-c,--config", options->config_file,
                   config_help(tr("Settings that RESULT was measured with; they hold the alert limits")));
  verb->add_option("-s,--set", options->settings, tr("KEY=VALUE over the config; may be repeated"))
      ->allow_extra_args(false);
  CLI::Option* frames =
      verb->add_option("-f,--frames", options->frames,
                       tr("Folder of the frames that RESULT was measured from. Adds CRB, the smallest error that their "
                          "points allow, and RMSE/CRB. Needs --config, the same as for run"));
  CLI::Option* noise =
      verb->add_option("--range-noise", options->range_noise_m, tr("Standard deviation of a range of these frames, m"));
  noise->check(noise_fault, tr("0.0001 to 1"))->needs(frames);
  frames->needs(noise);
  verb->add_flag("--json", options->json, tr("Print JSON instead of tables, in rad and m"));
  verb->footer(
      tr("Examples:\n  pose_wall eval out.csv truth.csv\n"
         "  pose_wall eval out.csv clean/truth.csv -c clean/pose_wall.yaml --frames clean/frames --range-noise 0.012\n"
         "  pose_wall eval motion.csv road/truth.csv\n"
         "The second example needs a road of `pose_wall sim --scene clean`, the third a table of `pose_wall motion`.\n"
         "Poses of motion are laid on the truth at the first frame of both; nothing is fitted.\n"
         "Rows are matched by stamp_ns if it tells the rows of each table apart and both share some, else by frame.\n"
         "Raw is measured by this frame alone. Value is smoothed or held; act on it only while it is valid.\n"
         "95 % of the errors are smaller than the figure in column 95 %. Column > level has the share of errors above\n"
         "the stated protection level. The last column counts valid values with an error above the alert limit, the\n"
         "worst failure. Column mean z² has the mean of (error / sigma)², which is 1 if the stated sigma is true.\n"
         "CRB: Cramer-Rao bound, root mean square over frames. It holds on a clean road: flat floor, flat upright\n"
         "walls, noise along the ray.\n"
         "Exit status: 0 done, 1 a table or frame cannot be read or does not fit, 2 bad usage or config."));
  verb->callback([options, &exit_code] { exit_code = done_or_complaint("eval", [&] { return eval(*options); }); });
}

}  // namespace pose_wall::tools
