// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/results/run_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/numbers/quantile.hpp"
#include "io/numbers/quantities.hpp"
#include "io/terminal/frames_text.hpp"
#include "io/terminal/share_text.hpp"
#include "io/terminal/text_table.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kReasonsShown = 5;

std::string amount(std::size_t quantity, double value) {
  return tools::level_text(quantity, value, 0.0);
}

// "roll (+ right side down)": an angle without its sign is half a number.
std::string name_of(std::size_t quantity, const std::string& positive_means) {
  const std::string name = pose_wall_quantity_name(static_cast<std::uint32_t>(quantity));
  return positive_means.empty() ? name : say("{} (+ {})", name, tr(positive_means.c_str()));
}

}  // namespace

void RunSummary::add(const FrameOutcome& outcome) {
  ++frames_;
  if (!outcome.result) {
    ++unreadable_;
    return;
  }
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    quantities_[q].positive_means = positive_means(*outcome.result, q);
    add(outcome.result->quantity[q], &quantities_[q]);
  }
  limits_ = outcome.limits;
  steer_.add(steering_of(*outcome.result, limits_));
  const std::uint32_t reasons = all_reasons(*outcome.result);
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) reasons_[bit] += reasons >> bit & 1U;
  elapsed_ms_.push_back(outcome.total_ms);
  processor_ms_.push_back(outcome.processor_ms);
}

void RunSummary::add(const pose_wall_value& value, Quantity* to) {
  ++to->states[std::min<std::uint32_t>(value.state, POSE_WALL_VALID)];
  if (value.state == POSE_WALL_INVALID) return;
  to->values.push_back(value.value);
  to->protection_levels.push_back(value.protection_level);
  if (std::isfinite(value.raw)) {
    to->raws.push_back(value.raw);
    to->raw_levels.push_back(value.raw_protection_level);
  }
  if (value.cause >= POSE_WALL_PARTS) return;
  ++to->largest[value.cause];
  for (std::size_t part = 0; part < to->parts.size(); ++part) to->parts[part].push_back(value.part[part]);
}

ValidShares RunSummary::valid_shares() const {
  ValidShares shares{};
  const auto measured = static_cast<double>(frames_ - unreadable_);
  for (std::size_t q = 0; q < shares.size(); ++q) {
    shares[q] = static_cast<double>(quantities_[q].states[POSE_WALL_VALID]) / measured;
  }
  return shares;
}

std::string RunSummary::level_text(std::size_t quantity, const std::vector<double>& levels) const {
  return tools::level_text(quantity, quantile(levels, 0.5), limit_of(quantity, limits_));
}

std::string RunSummary::text(double wall_s) const {
  const std::string unreadable =
      unreadable_ > 0 ? say("unreadable: {} of {}\n", unreadable_, frames_text(frames_)) : "";
  if (elapsed_ms_.empty()) return say("{}, none processed\n", frames_text(frames_)) + unreadable;
  return steer_line(language(), steer_.steering()) + "\n\n" + quantities_text() + levels_text() + '\n' +
         times_text(wall_s) + reasons_text() + say("verdict: {}\n", usability_text(valid_shares())) + unreadable;
}

std::string RunSummary::quantities_text() const {
  TextTable table({"", tr(pose_wall_state_name(POSE_WALL_VALID)), tr(pose_wall_state_name(POSE_WALL_DEGRADED)),
                   tr(pose_wall_state_name(POSE_WALL_HELD)), tr(pose_wall_state_name(POSE_WALL_INVALID)),
                   tr("median value"), tr("median raw"), tr("median level")});
  const std::size_t measured = frames_ - unreadable_;
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    const Quantity& quantity = quantities_[q];
    table.add_row({name_of(q, quantity.positive_means), share_text(quantity.states[POSE_WALL_VALID], measured),
                   share_text(quantity.states[POSE_WALL_DEGRADED], measured),
                   share_text(quantity.states[POSE_WALL_HELD], measured),
                   share_text(quantity.states[POSE_WALL_INVALID], measured), amount(q, quantile(quantity.values, 0.5)),
                   amount(q, quantile(quantity.raws, 0.5)), level_text(q, quantity.protection_levels)});
  }
  return table.text();
}

// Medians by part: they need not add up to the median of the level. What is no part of any level has no column.
std::string RunSummary::levels_text() const {
  std::vector<std::uint32_t> shown;
  for (std::uint32_t part = 0; part < POSE_WALL_PARTS; ++part) {
    const auto has_it = [part](const Quantity& quantity) {
      return std::any_of(quantity.parts[part].begin(), quantity.parts[part].end(), [](double x) { return x > 0.0; });
    };
    if (std::any_of(quantities_.begin(), quantities_.end(), has_it)) shown.push_back(part);
  }
  if (shown.empty()) return "";
  std::vector<std::string> head = {tr("median level"), tr("of value"), tr("of raw")};
  for (const std::uint32_t part : shown) head.emplace_back(tr(part_words(part).c_str()));
  head.emplace_back(tr("mostly"));
  TextTable table(head);
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    const Quantity& quantity = quantities_[q];
    std::vector<std::string> cells = {name_of(q, ""), level_text(q, quantity.protection_levels),
                                      level_text(q, quantity.raw_levels)};
    for (const std::uint32_t part : shown) cells.push_back(level_text(q, quantity.parts[part]));
    const auto most = std::max_element(quantity.largest.begin(), quantity.largest.end());
    const auto cause = static_cast<std::uint32_t>(most - quantity.largest.begin());
    cells.push_back(*most == 0 ? "-"
                               : fmt::format("{} ({})", tr(part_words(cause).c_str()),
                                             share_text(*most, quantity.parts[0].size())));
    table.add_row(cells);
  }
  return '\n' + table.text();
}

std::string RunSummary::times_text(double wall_s) const {
  TextTable table({tr("engine, per frame"), tr("median"), "95 %", tr("max"), tr("frames/s")});
  const auto add = [&table](const char* what, const std::vector<double>& times_ms) {
    const double sum_s = std::accumulate(times_ms.begin(), times_ms.end(), 0.0) * 1e-3;
    std::vector<std::string> cells = {what};
    for (const double share : {0.5, 0.95, 1.0}) cells.push_back(fmt::format("{:.2f} ms", quantile(times_ms, share)));
    cells.push_back(sum_s > 0.0 ? fmt::format("{:.1f}", static_cast<double>(times_ms.size()) / sum_s) : "-");
    table.add_row(cells);
  };
  add(tr("elapsed"), elapsed_ms_);
  add(tr("processor"), processor_ms_);
  const double rate = wall_s > 0.0 ? static_cast<double>(frames_) / wall_s : 0.0;
  return say("{}\n{} in {:.1f} s with reading and writing: {:.1f} frames/s\n", table.text(), frames_text(frames_),
             wall_s, rate);
}

std::string RunSummary::reasons_text() const {
  std::vector<std::uint32_t> order(reasons_.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [this](std::uint32_t a, std::uint32_t b) { return reasons_[a] > reasons_[b]; });
  order.resize(std::min(order.size(), kReasonsShown));
  std::string text;
  for (const std::uint32_t bit : order) {
    if (reasons_[bit] == 0) break;
    text += fmt::format("{:>6}  {} ({})\n", reasons_[bit], pose_wall_reason_name(bit), tr(pose_wall_reason_text(bit)));
  }
  return text.empty() ? text : tr("most frequent reasons, with the frames that have them:\n") + text;
}

}  // namespace pose_wall::tools
