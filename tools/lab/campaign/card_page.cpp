// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "io/numbers/angles.hpp"
#include "io/numbers/quantities.hpp"
#include "io/terminal/counted.hpp"
#include "io/terminal/text_table.hpp"
#include "lab/campaign/card_files.hpp"
#include "lab/campaign/card_sections.hpp"
#include "lab/campaign/card_words.hpp"
#include "lab/campaign/gate.hpp"
#include "lab/campaign/markdown_table.hpp"
#include "lab/campaign/recipe.hpp"
#include "study/results/result_csv.hpp"

namespace pose_wall::tools::campaign {
namespace {

std::string head_of(const Card& card) {
  std::string text = "# Integrity card\n\n";
  text += fmt::format(
      "{} in {} of {}, {} (scene and sensor). Alert limits: {}, {}.\n\n",
      counted(card.mine.frames.frames + card.judged.frames.frames + card.unobservable.frames.frames, "frame"),
      card.runs, counted(card.manifest.runs, "run"), counted(card.classes.size(), "class", "classes"),
      amount(true, card.manifest.limits.angle_rad), amount(false, card.manifest.limits.distance_m));
  text += card.manifest.plan.surfaces.empty()
              ? "No real road is among them: `--surface FILE` takes its scan.\n\n"
              : fmt::format("Real roads, class `surveyed`, each frame by itself: {}.\n\n",
                            fmt::join(card.manifest.plan.surfaces, ", "));
  const std::string movement = movement_text(card.manifest);
  text += card.manifest.motion_is_on ? movement + "\n\n" : fmt::format("**{}**\n\n", movement);
  if (card.manifest.plan.drive_in_m > 0.0) {
    text += fmt::format(
        "The machine drove {} m before each scene began. States, valid shares, levels, reasons, mean z², the table of "
        "quantities, *noticed* and *recovered* count the frames of the scenes alone: none from before the drive-in "
        "ended. Numbers of frames, *to alert*, diagrams and worst events count all frames, since a value that is wrong "
        "on the way is wrong, too.\n\n",
        card.manifest.plan.drive_in_m);
  }
  return text + origin_text(card.manifest);
}

std::string totals_of(const Card& card) {
  MarkdownTable table({"over", "classes", "runs", "frames", "valid", "degraded", "held", "invalid", "misleading",
                       "value > protection", "raw > protection", "work limit"});
  for (const Totals* totals : {&card.mine, &card.nominal, &card.adversarial, &card.judged, &card.unobservable}) {
    const Totals& t = *totals;
    if (t.classes == 0) continue;
    const FrameCounts& f = t.frames;
    const StateShares s = state_shares(t.quantities);
    table.add_row({t.name, std::to_string(t.classes), std::to_string(t.runs), std::to_string(f.frames),
                   percent(s.valid), percent(s.degraded), percent(s.held), percent(s.invalid),
                   count_with_bound(f.misleading, f.frames), count_with_bound(f.value_beyond_protection, f.frames),
                   count_with_bound(f.raw_beyond_protection, f.frames),
                   fmt::format("{} ({})", f.work_limited, percent(rate(f.work_limited, f.frames)))});
  }
  return "## Totals\n\n"
         "Counts are frames with at least one such value among the seven. In brackets: the 95 % upper bound of the "
         "rate (Clopper-Pearson). Runs are independent; frames of one run are not. *Misleading*: valid, and the error "
         "exceeds the alert limit or there is nothing to measure. *Work limit*: the engine ran out of its budget "
         "(`work_max`). States are of later frames than a run's first. *Mine*: rock as it was measured; what lies "
         "between its two truths is not wrong (*Two truths*). The other classes are short-waved rock on ideal planes. "
         "In "
         "*unobservable* classes the data of one "
         "sensor "
         "cannot show the fault. They are listed, and left out of everything else.\n\n" +
         table.text() + "\n";
}

std::string sigma_of(const Card& card) {
  MarkdownTable table({"over", "runs", "roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb"});
  const auto add_row = [&table](const std::string& name, std::size_t runs, const SevenStatistics& quantities) {
    std::vector<std::string> cells = {name, std::to_string(runs)};
    for (const ErrorStatistics& q : quantities) cells.push_back(figure(q.mean_z2()));
    table.add_row(cells);
  };
  for (const Totals* totals : {&card.nominal, &card.adversarial}) {
    if (totals->classes == 0) continue;
    add_row(fmt::format("{}, no motion in a scan", totals->name), totals->straight_runs, totals->straight);
    add_row(fmt::format("{}, all", totals->name), totals->runs, totals->quantities);
  }
  return fmt::format(
      "## Mean z² = (raw error / sigma)²\n\n"
      "1 for a true standard deviation. No motion is in a scan of one instant, and of a machine that stands and does "
      "not sway. From {2} such runs of nominal classes on their mean must be from {0:g} to {1:g}. What a moving "
      "machine does to a scan is in the level and not in sigma.\n\n"
      "{3}\n",
      kMeanZ2Min, kMeanZ2Max, kRunsForMeanZ2, table.text());
}

std::string classes_of(const Card& card) {
  MarkdownTable table(
      {"scene", "sensor", "kind", "draws", "frames", "roll", "pitch", "yaw", "distances", "degraded", "held", "invalid",
       "misleading", "value > pl", "raw > pl", "to alert", "noticed", "recovered", "why not valid"},
      3);
  for (const ClassCard& c : card.classes) {
    const StateShares s = state_shares(c.quantities);
    std::vector<std::string> cells = {c.scene->name, c.sensor, sim::scene_kind_name(c.scene->kind),
                                      std::to_string(c.draws), std::to_string(c.frames.frames)};
    for (const std::string& cell : valid_cells(c.quantities, valid_counts(c), true)) cells.push_back(cell);
    cells.insert(cells.end(),
                 {percent(s.degraded), percent(s.held), percent(s.invalid), std::to_string(c.frames.misleading),
                  std::to_string(c.frames.value_beyond_protection), std::to_string(c.frames.raw_beyond_protection),
                  std::to_string(c.times.alert_max), times_text(c.times.noticed, c.times.never_noticed),
                  times_text(c.times.recovered, c.times.never_recovered), reasons_text(c)});
    table.add_row(cells);
  }
  return "## Classes\n\n"
         "Shares refer to values that have a truth. Roll to distances: valid share against its floor, below it in "
         "bold. "
         "Unobservable classes have no floor, nor have runs that are shorter than their scene asks for. To alert: the "
         "longest time in frames "
         "from an error beyond the alert limit until the state leaves valid (0: it never was). Scenes with an event "
         "have two more times, median / longest in frames. Noticed: from its begin until a value leaves valid. "
         "Recovered: from its end until all values are valid again that were so before it. Why not valid: the most "
         "frequent reasons and their share of the values that are not valid.\n\n" +
         table.text() + "\n";
}

std::string quantities_of(const Card& card) {
  MarkdownTable table({"scene", "sensor", "quantity", "values", "valid", "valid level", "raw RMSE", "95 %", "max",
                       "value RMSE", "95 %", "max", "misleading", "value > pl", "raw > pl", "mean z²"},
                      3);
  for (const ClassCard& c : card.classes) {
    const std::vector<QuantityGroup> groups = grouped(c.quantities);
    const std::vector<std::string> valid = valid_cells(c.quantities, valid_counts(c), true);
    for (std::size_t group = 0; group < kGroups; ++group) {
      const QuantityGroup& g = groups[group];
      const ErrorStatistics& s = g.statistics;
      std::vector<std::string> cells = {c.scene->name, c.sensor,     g.name, std::to_string(s.frames()),
                                        valid[group],  level_text(g)};
      for (const ErrorFigures& f : {s.raw(), s.value()}) {
        for (const double number : {f.rmse, f.absolute_95, f.absolute_max}) cells.push_back(amount(g.is_angle, number));
      }
      cells.insert(cells.end(), {std::to_string(s.valid_beyond_alert() + s.valid_without_truth()),
                                 std::to_string(s.value_beyond_protection()), std::to_string(s.raw_beyond_protection()),
                                 figure(s.mean_z2())});
      table.add_row(cells);
    }
  }
  return "## Quantities\n\n"
         "Valid level: the median protection level of valid values; in brackets over their 95 % error. "
         "Raw: the frame's own measurement. Value: smoothed or held, for the controller. Counts are values.\n\n" +
         table.text() + "\n";
}

std::string frame_text(const WorstEvent& event) {
  return fmt::format("{}{}", event.frame, event.frame < event.run.drive_in_frames ? " (driving in)" : "");
}

std::string events_section(const char* title, const char* help, const MarkdownTable& table, std::size_t events) {
  return fmt::format("## {}\n\n", title) + (events == 0 ? "None.\n" : fmt::format("{}\n\n{}", help, table.text()));
}

std::string events_of(const Card& card) {
  MarkdownTable table({"breach", "scene", "sensor", "draw", "frame", "quantity", "error", "protection level", "sigma",
                       "state", "reasons", "to repeat it"},
                      3);
  for (const WorstEvent& e : card.events) {
    const bool angle = is_angle(e.quantity);
    std::string reasons = reason_names(e.reasons);
    for (std::size_t at = reasons.find('|'); at != std::string::npos; at = reasons.find('|')) reasons[at] = ' ';
    table.add_row({breach_name(e.breach), e.run.scene, e.run.sensor, std::to_string(e.run.draw), frame_text(e),
                   pose_wall_quantity_name(e.quantity), amount(angle, e.error),
                   amount(angle, e.measured.protection_level), amount(angle, e.measured.sigma),
                   pose_wall_state_name(e.measured.state), reasons, fmt::format("`{}`", recipe(e, card.manifest))});
  }
  return events_section(
      "Worst events",
      "One row per run and quantity: the worst frame of its gravest breach. The command at the end of a row "
      "measures it again. It is the last row of `DIR/out.csv`. Where frame files cannot repeat it (a second file of "
      "settings, stamps out of step, a machine that drove in), it is the last row of `DIR/frames.csv`. While the "
      "machine drives in, it is the row of that frame.",
      table, card.events.size());
}

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
                std::to_string(one.poses.misleading), std::to_string(class_faults(one).size())});
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

std::string events_of(const MotionCard& card) {
  MarkdownTable table({"what", "class", "sensor", "draw", "frame", "times the allowed", "to repeat it"}, 3);
  for (const MotionEvent& e : card.events) {
    table.add_row({e.what, e.run.scene, e.run.sensor, std::to_string(e.run.draw), std::to_string(e.frame),
                   figure(e.excess), fmt::format("`{}`", recipe(e, card.manifest))});
  }
  return events_section(
      "Worst",
      "The worst frame of its kind in each run. The command measures the run again up to that frame, the last row "
      "of `DIR/records/CLASS/SENSOR/DRAW.csv`.",
      table, card.events.size());
}

}  // namespace

std::string card_page(const Card& card) {
  return head_of(card) + gate_text(gate_faults(card)) + valid_section(card) + frames_section(card) + totals_of(card) +
         truths_section(card) + curve_section(card) + sigma_of(card) +
         "## Stanford diagrams\n\n![angles](stanford_angles.svg)\n\n![distances](stanford_distances.svg)\n\n" +
         classes_of(card) + quantities_of(card) + events_of(card);
}

std::string card_page(const MotionCard& card) {
  std::size_t frames = 0;
  for (const MotionClassCard& one : card.classes) frames += one.frames;
  return fmt::format("# Card of motion\n\n{} in {} of {}.\n\n", counted(frames, "frame"), card.runs,
                     counted(card.manifest.runs, "run")) +
         origin_text(card.manifest) + gate_text(gate_faults(card)) + results_part(card) + levels_part(card) +
         limits_part() + events_of(card);
}

std::string card_summary(const MotionCard& card) {
  TextTable table(kResultHead);
  for (const MotionClassCard& one : card.classes) table.add_row(result_cells(one));
  return table.text(2);
}

std::string motion_class_list() {
  TextTable table(kLimitHead);
  for (const MotionClass& one : motion_classes()) table.add_row(limit_cells(one));
  return table.text(3);
}

}  // namespace pose_wall::tools::campaign
