// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/card_sections.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "io/terminal/text_table.hpp"
#include "lab/campaign/card_words.hpp"
#include "lab/campaign/markdown_table.hpp"

namespace pose_wall::tools::campaign {
namespace {

using Cells = std::vector<std::string>;

const Cells kValidHead = {"classes", "sensor", "runs", "roll", "pitch", "yaw", "distances"};
const Cells kFramesHead = {"classes", "frames", "runs", "number", "roll", "pitch", "yaw", "distances"};
const Cells kCurveHead = {
    "level ×",    "nominal: valid angles", "distances",          "adversarial: valid angles", "distances",
    "misleading", "beyond, nominal",       "beyond, adversarial"};

double share(std::size_t part, std::size_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

std::string bold(const std::string& text) {
  return fmt::format("**{}**", text);
}

Cells first_cells(const KindCard& row) {
  return {sim::scene_kind_name(row.kind), row.sensor, std::to_string(row.runs)};
}

Cells valid_row(const KindCard& row, bool marks) {
  Cells cells = first_cells(row);
  for (const std::string& cell : valid_cells(row.quantities, row.valid, marks)) cells.push_back(cell);
  return cells;
}

Cells level_cells(const KindCard& row) {
  Cells cells = first_cells(row);
  for (const QuantityGroup& group : grouped(row.quantities)) cells.push_back(level_text(group));
  return cells;
}

Cells frames_cells(const FramesCard& row) {
  Cells cells = {sim::scene_kind_name(row.kind), row.name, std::to_string(row.runs), std::to_string(row.frames)};
  for (const QuantityGroup& group : grouped(row.quantities)) {
    cells.push_back(percent(state_shares(group.statistics).valid));
  }
  return cells;
}

std::string count_text(std::size_t events, std::size_t frames) {
  return frames == 0 ? "-" : count_with_bound(events, frames);
}

Cells curve_cells(const Card& card, std::size_t i) {
  const ScaledCounts& n = card.nominal_curve[i];
  const ScaledCounts& a = card.adversarial_curve[i];
  return {fmt::format("{:g}", kLevelScales[i]),
          percent(share(n.valid_angles, n.angles)),
          percent(share(n.valid_distances, n.distances)),
          percent(share(a.valid_angles, a.angles)),
          percent(share(a.valid_distances, a.distances)),
          count_text(n.misleading + a.misleading, n.frames + a.frames),
          count_text(n.beyond, n.frames),
          count_text(a.beyond, a.frames)};
}

}  // namespace

std::string valid_text(const ErrorStatistics& statistics, const ValidCount& count) {
  std::string valid = percent(state_shares(statistics).valid);
  if (count.values() != statistics.frames()) return valid;  // some of them have no floor
  return fmt::format("{} {} {:.1f}", valid, count.holds() ? "≥" : "<", 100.0 * count.floor());
}

Cells valid_cells(const SevenStatistics& quantities, const ValidCounts& counts, bool marks) {
  const std::vector<QuantityGroup> groups = grouped(quantities);
  Cells cells;
  for (std::size_t group = 0; group < kGroups; ++group) {
    const std::string cell = valid_text(groups[group].statistics, counts[group]);
    cells.push_back(marks && !counts[group].holds() ? bold(cell) : cell);
  }
  return cells;
}

std::string level_text(const QuantityGroup& group) {
  const LevelFigures levels = group.statistics.valid_levels();
  if (!std::isfinite(levels.median)) return "-";
  return fmt::format("{} ({:.1f} ×)", amount(group.is_angle, levels.median), levels.over_error());
}

std::string valid_section(const Card& card) {
  MarkdownTable valid(kValidHead, 2);
  MarkdownTable levels(kValidHead, 2);
  for (const KindCard& row : card.kinds) {
    valid.add_row(valid_row(row, true));
    levels.add_row(level_cells(row));
  }
  return "## Valid values\n\n"
         "Share of the values with a truth that are valid, against the floor; below it in bold.\n\n" +
         valid.text() +
         "\nMedian protection level of valid values. In brackets: over the error that 95 % of these values are "
         "within.\n\n" +
         levels.text() + "\n";
}

std::string frames_section(const Card& card) {
  MarkdownTable table(kFramesHead, 2);
  for (const FramesCard& row : card.frames) table.add_row(frames_cells(row));
  return "## First frames, standing and moving\n\n"
         "Valid share of the values with a truth. An engine knows no motion in the first frame of a run, so nothing "
         "corrects its scan. All other shares, levels and mean z² on this card are of later frames. The way of "
         "`--drive-in` is left out here as well.\n\n" +
         table.text() + "\n";
}

std::string truths_section(const Card& card) {
  MarkdownTable table({"scene", "sensor", "quantity", "valid", "95 % by road", "95 % surveyed", "misleading by road",
                       "misleading surveyed", "misleading"},
                      3);
  bool is_any = false;
  for (const ClassCard& one : card.classes) {
    if (one.scene->kind != sim::SceneKind::kMine) continue;
    is_any = true;
    const std::vector<QuantityGroup> all = grouped(one.quantities), road = grouped(one.by_road),
                                     survey = grouped(one.by_survey);
    for (std::size_t group = 0; group < kGroups; ++group) {
      const auto error = [&](const QuantityGroup& by) {
        const double within = by.statistics.valid_levels().absolute_error_95;
        return std::isfinite(within) ? amount(by.is_angle, within) : "-";
      };
      const auto wrong = [](const QuantityGroup& by) { return std::to_string(by.statistics.valid_beyond_alert()); };
      table.add_row({one.scene->name, one.sensor, all[group].name, std::to_string(all[group].statistics.valid()),
                     error(road[group]), error(survey[group]), wrong(road[group]), wrong(survey[group]),
                     wrong(all[group])});
    }
  }
  if (!is_any) return "";
  return "## Two truths\n\n"
         "Rock that bulges has two: planes of the *road* as a whole, and *surveyed* planes of what is really there "
         "within 2.5 m of the machine. Valid values of mine classes, the error that 95 % of them are within, and how "
         "many are "
         "beyond the alert limit, by each. A value between both, or within the limit of one, is not misleading.\n\n" +
         table.text() + "\n";
}

std::string curve_section(const Card& card) {
  MarkdownTable table(kCurveHead);
  for (std::size_t i = 0; i < kLevelScales.size(); ++i) {
    Cells cells = curve_cells(card, i);
    if (kLevelScales[i] == 1.0) {
      for (std::string& cell : cells) cell = bold(cell);
    }
    table.add_row(cells);
  }
  return "## Margin of the levels\n\n"
         "All levels times a factor. A value is then valid if its level is within the alert limit, and nothing but its "
         "level kept it from being valid. Beyond: frames with an error of value or raw beyond the scaled level.\n\n" +
         table.text() + "\n";
}

std::string valid_summary(const Card& card) {
  TextTable table({"valid", "sensor", "runs", "roll", "pitch", "yaw", "distances"});
  for (const KindCard& row : card.kinds) table.add_row(valid_row(row, false));
  return table.text(2);
}

std::string frames_summary(const Card& card) {
  TextTable table(kFramesHead);
  for (const FramesCard& row : card.frames) table.add_row(frames_cells(row));
  return table.text(2);
}

std::string curve_summary(const Card& card) {
  TextTable table(kCurveHead);
  for (std::size_t i = 0; i < kLevelScales.size(); ++i) table.add_row(curve_cells(card, i));
  return table.text();
}

std::string curve_csv(const Card& card) {
  std::string text = csv_line({"scale", "kind", "frames", "valid_angles", "valid_distances", "misleading", "beyond"});
  for (std::size_t i = 0; i < kLevelScales.size(); ++i) {
    for (const bool is_nominal : {true, false}) {
      const ScaledCounts& c = (is_nominal ? card.nominal_curve : card.adversarial_curve)[i];
      if (c.frames == 0) continue;
      text += csv_line({fmt::format("{:g}", kLevelScales[i]), is_nominal ? "nominal" : "adversarial",
                        std::to_string(c.frames), csv_number(share(c.valid_angles, c.angles)),
                        csv_number(share(c.valid_distances, c.distances)), std::to_string(c.misleading),
                        std::to_string(c.beyond)});
    }
  }
  return text;
}

}  // namespace pose_wall::tools::campaign
