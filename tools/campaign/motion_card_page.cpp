// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "angles.hpp"
#include "campaign/card_words.hpp"
#include "campaign/markdown_table.hpp"
#include "campaign/motion_card_files.hpp"
#include "campaign/motion_gate.hpp"
#include "campaign/recipe.hpp"
#include "frames/whole_file.hpp"
#include "terminal/counted.hpp"
#include "terminal/text_table.hpp"

namespace pose_wall::tools::campaign {
namespace {

std::string fixed(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

std::string spread_text(const std::vector<double>& numbers, int digits) {
  const Spread s = spread_of(numbers);
  return fmt::format("{} / {} / {}", fixed(s.low, digits), fixed(s.middle, digits), fixed(s.high, digits));
}

double largest_of(const std::vector<double>& numbers) {
  double largest = std::nan("");
  for (const double number : numbers) largest = std::fmax(largest, number);
  return largest;
}

// "0.12 / 0.45", median and worst in percent.
std::string along_percent(const MotionClassCard& one) {
  return fmt::format("{} / {}", fixed(100.0 * spread_of(one.along_share).middle, 2),
                     fixed(100.0 * largest_of(one.along_share), 2));
}

std::string beyond_text(const DirectionTotals& directions) {
  std::vector<std::size_t> beyond;
  for (const DirectionErrors& one : directions) beyond.push_back(one.beyond());
  return fmt::format("{}", fmt::join(beyond, " "));
}

const std::vector<std::string> kResultHead = {
    "class",   "sensor",   "runs",      "frames", "measured", "ambiguous",        "unobservable", "lost",
    "along %", "along mm", "across mm", "up mm",  "turn °",   "misleading steps", "poses",        "broken"};

std::vector<std::string> result_cells(const MotionClassCard& one) {
  std::vector<std::string> cells = {one.kind->name, one.sensor, std::to_string(one.runs), std::to_string(one.frames)};
  for (std::uint32_t state = POSE_WALL_ALONG_MEASURED + 1; state-- > 0;) cells.push_back(percent(one.share(state)));
  // By the enum backwards: measured, ambiguous, unobservable, lost.
  cells.insert(cells.end(),
               {along_percent(one), fixed(1e3 * largest_of(one.along_m), 1), fixed(1e3 * one.across_m, 1),
                fixed(1e3 * one.up_m, 1), fixed(one.turn_rad * kDegPerRad, 3), std::to_string(one.steps.misleading),
                std::to_string(one.poses.misleading), std::to_string(motion_class_faults(one).size())});
  return cells;
}

std::string results_part(const MotionCard& card) {
  MarkdownTable table(kResultHead, 2);
  for (const MotionClassCard& one : card.classes) table.add_row(result_cells(one));
  return "## Classes\n\n"
         "States: shares of all frames but the first of each run. Along %: error at the end over the distance driven, "
         "median / worst of the runs. Along mm: the worst. Across, up, turn: the largest of all frames, in the base "
         "frame of the first one. Misleading: measured, and the error along exceeds its level. Broken: number of "
         "failed requirements.\n\n" +
         table.text() + "\n";
}

std::string levels_part(const MotionCard& card) {
  MarkdownTable table({"class", "sensor", "steps beyond", "poses beyond", "z² step", "z² pose", "contrast", "patches",
                       "ms mean", "ms worst"},
                      2);
  for (const MotionClassCard& one : card.classes) {
    table.add_row({one.kind->name, one.sensor, beyond_text(one.step), beyond_text(one.pose),
                   figure(one.step[POSE_WALL_MOTION_ALONG].mean_z2()),
                   figure(one.pose[POSE_WALL_MOTION_ALONG].mean_z2()), spread_text(one.contrast, 2),
                   spread_text(one.patches, 1), fixed(one.ms_sum / static_cast<double>(one.frames), 2),
                   fixed(one.ms_worst, 1)});
  }
  const RoughTotals rough = rough_totals(card);
  return fmt::format(
      "## Levels, sigma, evidence and time\n\n"
      "Beyond: frames with an error beyond its level, along, across, up, roll, pitch, yaw. z²: mean of (error along / "
      "sigma)², 1 for a true sigma. Over rough rock it is {} of the step and {} of the pose, in {}. Contrast and "
      "patches: 5 % / median / 95 % of the frames that have them. ms: time elapsed in the library, including other "
      "work of the machine.\n\n"
      "{}\n",
      figure(rough.along_step.mean_z2()), figure(rough.along_pose.mean_z2()), counted(rough.runs, "run"), table.text());
}

std::string limit_text(double number, const char* unit) {
  return std::isnan(number) ? "-" : fmt::format("{:g}{}", number, unit);
}

std::vector<std::string> limit_cells(const MotionClass& one) {
  const MotionLimits& l = one.limits;
  return {one.name,
          one.help,
          one.expected,
          std::isnan(l.told_min) ? limit_text(100.0 * l.measured_min, " %")
                                 : limit_text(100.0 * l.told_min, " %, or ambiguous"),
          limit_text(100.0 * l.unobservable_min, " %"),
          limit_text(100.0 * l.along_share, " %") + ", " + limit_text(100.0 * l.along_share_few, " %"),
          limit_text(1e3 * l.along_m, " mm"),
          limit_text(1e3 * l.across_m, " mm"),
          limit_text(l.turn_deg, "°")};
}

const std::vector<std::string> kLimitHead = {"class",       "the machine",     "right",
                                             "measured in", "unobservable in", "along (few points)",
                                             "or",          "across, up",      "turn"};

std::string limits_part() {
  MarkdownTable table(kLimitHead, 3);
  for (const MotionClass& one : motion_classes()) table.add_row(limit_cells(one));
  return "## Right behaviour\n\n"
         "Least shares of the frames, and largest errors. Along: share of the way, or a length in millimetres for any "
         "way. In every class no measured frame may mislead, and no error may exceed its level.\n\n" +
         table.text() + "\n";
}

std::string motion_events_part(const MotionCard& card) {
  if (card.events.empty()) return "## Worst\n\nNone.\n";
  MarkdownTable table({"what", "class", "sensor", "draw", "frame", "times the allowed", "to repeat it"}, 3);
  for (const MotionEvent& event : card.events) {
    const auto frames = static_cast<std::uint32_t>(event.frame + 1);
    table.add_row({event.what, event.run.scene, event.run.sensor, std::to_string(event.run.draw),
                   std::to_string(event.frame), figure(event.excess),
                   fmt::format("`{}`", run_recipe(event.run, frames, card.manifest))});
  }
  return "## Worst\n\n"
         "The worst frame of its kind in each run. The command measures the run again up to that frame, the last row "
         "of `DIR/records/CLASS/SENSOR/DRAW.csv`.\n\n" +
         table.text();
}

}  // namespace

std::string motion_card_page(const MotionCard& card) {
  std::size_t frames = 0;
  for (const MotionClassCard& one : card.classes) frames += one.frames;
  return fmt::format("# Card of motion\n\n{} in {} of {}.\n\n", counted(frames, "frame"), card.runs,
                     counted(card.manifest.runs, "run")) +
         origin_text(card.manifest) + gate_text(motion_gate_faults(card)) + results_part(card) + levels_part(card) +
         limits_part() + motion_events_part(card);
}

std::string motion_card_summary(const MotionCard& card) {
  TextTable table(kResultHead);
  for (const MotionClassCard& one : card.classes) table.add_row(result_cells(one));
  return table.text(2);
}

std::string motion_class_list() {
  TextTable table(kLimitHead);
  for (const MotionClass& one : motion_classes()) table.add_row(limit_cells(one));
  return table.text(3);
}

void write_motion_card(const std::filesystem::path& folder, const MotionCard& card) {
  write_whole_file(folder / "card.md", motion_card_page(card));
  write_whole_file(folder / "card.json", motion_card_json(card));
}

}  // namespace pose_wall::tools::campaign
