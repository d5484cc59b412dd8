// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/card_files.hpp"

#include <fmt/format.h>

#include "io/frames/whole_file.hpp"
#include "io/terminal/counted.hpp"
#include "io/terminal/text_table.hpp"
#include "lab/campaign/card_sections.hpp"
#include "lab/campaign/card_words.hpp"

namespace pose_wall::tools::campaign {
namespace {

std::string title(const Card& card, const char* quantities) {
  return fmt::format("{}: error against protection level, {}", quantities, counted(card.judged.frames.frames, "frame"));
}

std::vector<std::string> row_of(const Totals& t, const char* kind, bool with_bounds) {
  const StateShares s = state_shares(t.quantities);
  const FrameCounts& f = t.frames;
  std::vector<std::string> cells = {t.name,
                                    kind,
                                    std::to_string(f.frames),
                                    percent(s.valid),
                                    percent(s.degraded),
                                    percent(s.held),
                                    percent(s.invalid)};
  for (const std::size_t events : {f.misleading, f.value_beyond_protection, f.raw_beyond_protection}) {
    cells.push_back(with_bounds ? count_with_bound(events, f.frames) : std::to_string(events));
  }
  // As the gate looks at them: of scans without motion.
  ErrorStatistics angles = t.straight[POSE_WALL_ROLL];
  angles.merge(t.straight[POSE_WALL_PITCH]);
  angles.merge(t.straight[POSE_WALL_YAW]);
  cells.insert(cells.end(), {figure(angles.mean_z2()), figure(grouped(t.straight).back().statistics.mean_z2())});
  return cells;
}

// All sensors together.
std::vector<std::pair<const sim::SceneChoice*, Totals>> by_scene(const Card& card) {
  std::vector<std::pair<const sim::SceneChoice*, Totals>> scenes;
  for (const ClassCard& one : card.classes) {
    if (scenes.empty() || scenes.back().first != one.scene) {
      scenes.emplace_back(one.scene, Totals{one.scene->name, 1, one.draws, one.frames, one.quantities,
                                            one.straight_runs, one.straight});
    } else {
      add_class(scenes.back().second, one);
    }
  }
  return scenes;
}

template <typename AnyCard>
void write_texts(const std::filesystem::path& folder, const AnyCard& card) {
  write_whole_file(folder / "card.md", card_page(card));
  write_whole_file(folder / "card.json", card_json(card));
}

}  // namespace

std::string card_summary(const Card& card) {
  TextTable table({"scene", "kind", "frames", "valid", "degraded", "held", "invalid", "misleading", "value > pl",
                   "raw > pl", "z² angles", "z² distances"});
  for (const auto& [scene, totals] : by_scene(card)) {
    table.add_row(row_of(totals, sim::scene_kind_name(scene->kind), false));
  }
  table.add_row({"in all"});
  for (const Totals* totals : {&card.mine, &card.nominal, &card.adversarial, &card.judged}) {
    if (totals->classes > 0) table.add_row(row_of(*totals, "", true));
  }
  return movement_text(card.manifest) + "\n\n" + table.text(2) + "\n" + valid_summary(card) + "\n" +
         frames_summary(card) + "\n" + curve_summary(card);
}

void write_card(const std::filesystem::path& folder, const Card& card) {
  write_texts(folder, card);
  write_whole_file(folder / "level_curve.csv", curve_csv(card));
  write_whole_file(folder / "stanford_angles.svg",
                   picture::stanford_diagram(card.angles, title(card, "Roll, pitch, yaw")));
  write_whole_file(folder / "stanford_distances.svg",
                   picture::stanford_diagram(card.distances, title(card, "Distances")));
}

void write_card(const std::filesystem::path& folder, const MotionCard& card) {
  write_texts(folder, card);
}

}  // namespace pose_wall::tools::campaign
