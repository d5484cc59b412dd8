// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/summary_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/language/engine_words.hpp"
#include "io/terminal/text_table.hpp"
#include "study/explain/amounts.hpp"
#include "study/explain/gate_list.hpp"
#include "study/explain/prose.hpp"

namespace pose_wall::tools::explain {
namespace {

constexpr std::size_t kDigestWidth = 110;
constexpr std::size_t kStretchesShown = 24;
constexpr std::size_t kGatesShown = 4;

std::string share(std::size_t part, std::size_t whole) {
  if (whole == 0) return "-";
  return fmt::format("{:.1f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string cause_text(const QuantitySummary& quantity) {
  const std::uint32_t cause = quantity.cause();
  if (cause >= POSE_WALL_PARTS) return "-";
  return say("{} (in {})", spoken_part(cause), share(quantity.largest[cause], quantity.with_cause()));
}

std::string values_text(const RecordingSummary& summary) {
  const std::size_t measured = summary.frames() - summary.unreadable();
  TextTable table(
      {tr("quantity"), tr("valid"), tr("degraded"), tr("held"), tr("invalid"), tr("median level"), tr("largest part")});
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const QuantitySummary& quantity = summary.quantities()[q];
    const auto of = [&](std::uint32_t state) { return share(quantity.states[state], measured); };
    const double level = quantity.levels.median();
    table.add_row({pose_wall_quantity_name(q), of(POSE_WALL_VALID), of(POSE_WALL_DEGRADED), of(POSE_WALL_HELD),
                   of(POSE_WALL_INVALID), std::isfinite(level) ? quantity_amount(q, level) : "-",
                   cause_text(quantity)});
  }
  return table.text();
}

std::string gates_text(const std::vector<std::uint32_t>& gates) {
  std::vector<std::string> names;
  for (const std::uint32_t gate : gates) {
    if (names.size() == kGatesShown) {
      names.emplace_back("...");
      break;
    }
    names.emplace_back(gate_list()[gate].name);
  }
  return names.empty() ? "-" : listed(names);
}

std::vector<std::uint32_t> reasons_by_count(const RecordingSummary& summary) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    if (summary.reasons()[bit].frames > 0) order.push_back(bit);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return summary.reasons()[a].frames > summary.reasons()[b].frames;
  });
  return order;
}

std::string reasons_text(const RecordingSummary& summary) {
  const std::size_t measured = summary.frames() - summary.unreadable();
  TextTable table({tr("reason"), tr("gates behind it"), tr("frames"), tr("share")});
  std::string meanings;
  for (const std::uint32_t bit : reasons_by_count(summary)) {
    const ReasonSummary& reason = summary.reasons()[bit];
    table.add_row({pose_wall_reason_name(bit), gates_text(reason.gates), std::to_string(reason.frames),
                   share(reason.frames, measured)});
    meanings += wrapped(say("{}: {}.", pose_wall_reason_name(bit), reason_words(bit)), 2, kDigestWidth);
  }
  return meanings.empty() ? std::string(tr("none")) + "\n" : table.text(2) + "\n" + meanings;
}

std::string stretches_text(const RecordingSummary& summary) {
  std::string list;
  for (const Stretch& s : summary.longest_stretches(kStretchesShown)) {
    const std::string story = story_words(s.story);
    list += wrapped(s.frames() == 1 ? say("{}: {}", s.first, story)
                                    : say("{}–{} ({}): {}", s.first, s.last, frames_text(s.frames()), story),
                    2, kDigestWidth);
  }
  std::string heading = tr("Stretches of frames alike");
  if (summary.stretch_count() > kStretchesShown) {
    heading += say(" (the {} longest of {})", kStretchesShown, summary.stretch_count());
  }
  return heading + "\n" + list;
}

std::string to_see_text(const RecordingSummary& summary, const std::string& command) {
  std::string text;
  for (const FrameToSee& f : frames_to_see(summary)) {
    text += wrapped(say("Frame {}: {}.", f.frame, clauses(f.why)), 2, kDigestWidth);
    text += "    " + command_for(command, f.frame) + "\n";
  }
  return text;
}

}  // namespace

std::string command_for(const std::string& command, std::uint64_t frame) {
  return fmt::format("{} --frame {}", command, frame);
}

std::string summary_text(const RecordingSummary& summary, const std::string& command) {
  std::string text = frames_text(summary.frames());
  if (summary.unreadable() > 0) text += say("; {} of them could not be read", summary.unreadable());
  text += fmt::format("\n\n{}\n{}\n", tr("Values"), values_text(summary));
  text += fmt::format("{}\n{}\n", tr("Reasons"), reasons_text(summary));
  text += fmt::format("{}\n", stretches_text(summary));
  return text + fmt::format("{}\n{}", tr("Frames worth a look"), to_see_text(summary, command));
}

}  // namespace pose_wall::tools::explain
