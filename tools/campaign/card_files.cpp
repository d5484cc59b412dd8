// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "campaign/card_files.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

#include "campaign/card_words.hpp"
#include "campaign/classes.hpp"
#include "terminal/text_table.hpp"

namespace pose_wall::tools::campaign {
namespace {

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(fmt::format("{}: cannot write", file.string()));
}

std::string title(const Card& card, const char* quantities) {
  return fmt::format("{}: error against protection level, {} frames", quantities, card.all.frames.frames);
}

std::vector<std::string> counts_cells(const FrameCounts& f) {
  return {count_with_bound(f.misleading, f.frames), count_with_bound(f.value_beyond_protection, f.frames),
          count_with_bound(f.raw_beyond_protection, f.frames)};
}

}  // namespace

std::string card_summary(const Card& card) {
  TextTable table({"over", "sensor", "frames", "valid", "degraded", "held", "invalid", "misleading", "value > pl",
                   "raw > pl", "z² angles", "z² distances"});
  const auto add = [&table](const std::string& name, const std::string& sensor, const FrameCounts& frames,
                            const SevenStatistics& quantities, bool with_bounds) {
    const StateShares s = state_shares(quantities);
    std::vector<std::string> cells = {name,
                                      sensor,
                                      std::to_string(frames.frames),
                                      percent(s.valid),
                                      percent(s.degraded),
                                      percent(s.held),
                                      percent(s.invalid)};
    const std::vector<std::string> counts =
        with_bounds ? counts_cells(frames)
                    : std::vector<std::string>{std::to_string(frames.misleading),
                                               std::to_string(frames.value_beyond_protection),
                                               std::to_string(frames.raw_beyond_protection)};
    cells.insert(cells.end(), counts.begin(), counts.end());
    ErrorStatistics angles = quantities[POSE_WALL_ROLL];
    angles.merge(quantities[POSE_WALL_PITCH]);
    angles.merge(quantities[POSE_WALL_YAW]);
    cells.insert(cells.end(), {figure(angles.mean_z2()), figure(grouped(quantities).back().statistics.mean_z2())});
    table.add_row(cells);
  };
  for (const ClassCard& c : card.classes) add(c.scene, c.sensor, c.frames, c.quantities, false);
  if (card.nominal.classes > 0) add("all nominal", "", card.nominal.frames, card.nominal.quantities, true);
  if (card.adversarial.classes > 0) {
    add("all adversarial", "", card.adversarial.frames, card.adversarial.quantities, true);
  }
  return table.text(2);
}

void write_card(const std::filesystem::path& folder, const Card& card) {
  write(folder / "card.md", card_page(card));
  write(folder / "card.json", card_json(card));
  write(folder / "stanford_angles.svg", picture::stanford_diagram(card.angles, title(card, "Roll, pitch, yaw")));
  write(folder / "stanford_distances.svg", picture::stanford_diagram(card.distances, title(card, "Distances")));
}

}  // namespace pose_wall::tools::campaign
