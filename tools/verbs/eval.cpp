// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall eval: a table of results against the truth.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config_file/load_config.hpp"
#include "csv/csv_table.hpp"
#include "terminal/text_table.hpp"
#include "truth/comparison.hpp"
#include "verbs/verbs.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kDegPerRad = 57.29577951308232;

struct EvalOptions {
  std::string results;
  std::string truth;
  std::string config_file;
  std::vector<std::string> settings;
  bool json = false;
};

// Names the file in front of what is wrong with it.
template <typename Step>
auto in_file(const std::string& file, Step step) {
  try {
    return step();
  } catch (const CsvError& error) {
    throw CsvError(fmt::format("{}: {}", file, error.what()));
  }
}

CsvTable read_table(const std::string& file) {
  return in_file(file, [&file] {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw CsvError("cannot be opened for reading");
    return CsvTable::parse(stream);
  });
}

std::string amount(const QuantityComparison& quantity, double value) {
  if (!std::isfinite(value)) return "-";
  return quantity.is_angle ? fmt::format("{:.4f}°", value * kDegPerRad) : fmt::format("{:.1f} mm", value * 1e3);
}

std::string percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? "-" : fmt::format("{:.2f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

void append_figures(std::vector<std::string>& cells, const QuantityComparison& quantity, const ErrorFigures& figures) {
  for (const double figure : {figures.rmse, figures.bias, figures.absolute_95, figures.absolute_max}) {
    cells.push_back(amount(quantity, figure));
  }
}

void print_tables(const Comparison& comparison) {
  fmt::print("{} frames matched by {}; without partner: {} results, {} truths\n\n", comparison.matched,
             comparison.matched_by, comparison.result_rows_alone, comparison.truth_rows_alone);
  TextTable raw({"raw", "frames", "measured", "valid", "RMSE", "bias", "95 %", "max", "> protection", "mean z²"});
  TextTable value({"value", "frames", "usable", "RMSE", "bias", "95 %", "max", "> protection", "> alert while valid"});
  for (const QuantityComparison& quantity : comparison.quantities) {
    const ErrorStatistics& s = quantity.statistics;
    std::vector<std::string> cells = {quantity.name, std::to_string(s.frames()), percent(s.measured(), s.frames()),
                                      percent(s.valid(), s.frames())};
    append_figures(cells, quantity, s.raw());
    cells.push_back(percent(s.raw_beyond_protection(), s.measured()));
    cells.push_back(std::isfinite(s.mean_z2()) ? fmt::format("{:.2f}", s.mean_z2()) : "-");
    raw.add_row(cells);
    cells = {quantity.name, std::to_string(s.frames()), percent(s.value().count, s.frames())};
    append_figures(cells, quantity, s.value());
    cells.push_back(percent(s.value_beyond_protection(), s.value().count));
    cells.push_back(fmt::format("{} of {}", s.valid_beyond_alert(), s.valid()));
    value.add_row(cells);
  }
  fmt::print("{}\n{}", raw.text(), value.text());
}

// NaN, which JSON does not know, becomes null.
nlohmann::ordered_json json_figures(const ErrorFigures& figures) {
  return {{"count", figures.count},
          {"rmse", figures.rmse},
          {"bias", figures.bias},
          {"absolute_95", figures.absolute_95},
          {"absolute_max", figures.absolute_max}};
}

void print_json(const Comparison& comparison) {
  nlohmann::ordered_json page = {{"matched_by", comparison.matched_by},
                                 {"matched", comparison.matched},
                                 {"result_rows_alone", comparison.result_rows_alone},
                                 {"truth_rows_alone", comparison.truth_rows_alone}};
  for (const QuantityComparison& quantity : comparison.quantities) {
    const ErrorStatistics& s = quantity.statistics;
    page["quantities"][quantity.name] = {{"unit", quantity.is_angle ? "rad" : "m"},
                                         {"frames", s.frames()},
                                         {"measured", s.measured()},
                                         {"valid", s.valid()},
                                         {"raw", json_figures(s.raw())},
                                         {"value", json_figures(s.value())},
                                         {"raw_beyond_protection", s.raw_beyond_protection()},
                                         {"value_beyond_protection", s.value_beyond_protection()},
                                         {"valid_beyond_alert", s.valid_beyond_alert()},
                                         {"mean_z2", s.mean_z2()}};
  }
  fmt::print("{}\n", page.dump(2));
}

int eval(const EvalOptions& options) {
  const std::optional<std::string> config_file =
      options.config_file.empty() ? std::nullopt : std::optional<std::string>(options.config_file);
  const LoadedConfig loaded = load_config(config_file, options.settings);
  const AlertLimits limits{loaded.config.number("alert_limit_angle_deg") / kDegPerRad,
                           loaded.config.number("alert_limit_distance")};
  try {
    const CsvTable results = read_table(options.results);
    const CsvTable truth = read_table(options.truth);
    const Comparison comparison = in_file(fmt::format("{} against {}", options.results, options.truth),
                                          [&] { return compare_with_truth(results, truth, limits); });
    options.json ? print_json(comparison) : print_tables(comparison);
  } catch (const CsvError& error) {
    fmt::print(stderr, "pose_wall eval: {}\n", error.what());
    return kExitUnreadable;
  }
  return kExitDone;
}

}  // namespace

void add_eval(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<EvalOptions>();
  CLI::App* verb = app.add_subcommand("eval", "Compare results with the truth, per quantity");
  verb->add_option("RESULT", options->results, "CSV written by pose_wall run")->required();
  verb->add_option("TRUTH", options->truth,
                   "CSV with frame or stamp_ns and any of roll, pitch, yaw (rad), d_lf, d_lb, "
                   "d_rf, d_rb (m)")
      ->required();
  verb->add_option("-c,--config", options->config_file, "Settings the results were made with: gives the alert limits");
  verb->add_option("-s,--set", options->settings, "KEY=VALUE over the config; may be repeated")
      ->allow_extra_args(false);
  verb->add_flag("--json", options->json, "Print JSON instead of tables, in rad and m");
  verb->footer(
      "Example:\n  pose_wall eval out.csv truth.csv\n"
      "raw: this frame's own measurement. value: what a controller acts on, held values included.\n"
      "> protection: errors beyond the stated protection level. mean z²: 1 when the stated sigma is true.\n"
      "Exit status: 0 done, 1 a table cannot be read or does not fit, 2 bad usage or config.");
  verb->callback([options, &exit_code] { exit_code = eval(*options); });
}

}  // namespace pose_wall::tools
