// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/tally.hpp"

#include <algorithm>
#include <cmath>

#include "judge/text.hpp"

namespace pose_wall::judge {

void Tally::add(const Finding& finding) {
  ++frames;
  valid += finding.state == POSE_WALL_VALID ? 1 : 0;
  degraded += finding.state == POSE_WALL_DEGRADED ? 1 : 0;
  held += finding.state == POSE_WALL_HELD ? 1 : 0;
  first += finding.frame == 0 ? 1 : 0;
  first_valid += finding.frame == 0 && finding.state == POSE_WALL_VALID ? 1 : 0;
  if (finding.frame > 0 && finding.measured_or_held()) told_levels.push_back(finding.level);
  int* beyond[] = {nullptr, &beyond_held, &beyond_degraded, &beyond_valid};
  if (finding.beyond()) ++*beyond[finding.state];
  raw_beyond += finding.raw_beyond() ? 1 : 0;
  misleading += finding.misleading() ? 1 : 0;
  misleading_road += finding.misleading_by(finding.road_error) ? 1 : 0;
  misleading_surveyed += finding.misleading_by(finding.surveyed_error) ? 1 : 0;
  if (finding.state == POSE_WALL_VALID && std::isfinite(finding.surveyed_error)) {
    valid_road_errors.push_back(std::abs(finding.road_error));
    valid_surveyed_errors.push_back(std::abs(finding.surveyed_error));
  }
  if (finding.raw_state != POSE_WALL_INVALID) {
    closest = std::max(closest, finding.raw_error_abs() / finding.raw_level);
    z2_sum += std::pow(finding.raw_error_abs() / finding.sigma, 2.0);
    errors.push_back(finding.raw_error_abs());
    levels.push_back(finding.raw_level);
    levels_in_sigma.push_back(finding.raw_level / finding.sigma);
  }
  if (finding.state == POSE_WALL_VALID) return;
  for (std::uint32_t bit = 0; bit < 32; ++bit) reasons[bit] += static_cast<int>(finding.reasons >> bit & 1U);
}

void add(Tallies* tallies, const Verdict& verdict) {
  tallies->resize(POSE_WALL_QUANTITIES);
  for (const Finding& finding : verdict.findings) (*tallies)[static_cast<std::size_t>(finding.quantity)].add(finding);
}

std::string table(const Tallies& tallies) {
  std::string text = format("%-6s %6s %7s %7s %7s %6s %8s %8s %8s %8s %7s %6s %6s %6s %6s %6s %6s\n", "", "frames",
                            "first%", "later%", "degr%", "held%", "err50", "err95", "level50", "lvl/sig", "closest",
                            "z2", "bey.v", "bey.d", "bey.h", "bey.r", "misl");
  for (std::size_t k = 0; k < tallies.size(); ++k) {
    const Tally& tally = tallies[k];
    const int q = static_cast<int>(k);
    const double percent = 100.0 / std::max(1, tally.frames);
    text += format("%-6s %6d %7.1f %7.1f %7.1f %6.1f %8.3f %8.3f %8.3f %8.1f %7.2f %6.2f %6d %6d %6d %6d %6d\n",
                   pose_wall_quantity_name(static_cast<std::uint32_t>(k)), tally.frames,
                   100.0 * tally.share_valid_first(), 100.0 * tally.share_valid_later(), percent * tally.degraded,
                   percent * tally.held, shown(q, quantile(tally.errors, 0.5)), shown(q, quantile(tally.errors, 0.95)),
                   shown(q, quantile(tally.levels, 0.5)), quantile(tally.levels_in_sigma, 0.5), tally.closest,
                   tally.z2_sum / std::max<double>(1.0, static_cast<double>(tally.errors.size())), tally.beyond_valid,
                   tally.beyond_degraded, tally.beyond_held, tally.raw_beyond, tally.misleading);
  }
  return text;
}

std::string truths_table(const Tallies& tallies) {
  std::string text = format("%-6s %6s %10s %10s %10s %10s %6s %6s %6s\n", "", "valid", "road 50%", "road 95%",
                            "survey 50%", "survey 95%", "mis.r", "mis.s", "both");
  for (std::size_t k = 0; k < tallies.size(); ++k) {
    const Tally& tally = tallies[k];
    const int q = static_cast<int>(k);
    text += format("%-6s %6d %10.3f %10.3f %10.3f %10.3f %6d %6d %6d\n",
                   pose_wall_quantity_name(static_cast<std::uint32_t>(k)), tally.valid,
                   shown(q, quantile(tally.valid_road_errors, 0.5)), shown(q, quantile(tally.valid_road_errors, 0.95)),
                   shown(q, quantile(tally.valid_surveyed_errors, 0.5)),
                   shown(q, quantile(tally.valid_surveyed_errors, 0.95)), tally.misleading_road,
                   tally.misleading_surveyed, tally.misleading);
  }
  return text;
}

std::string reasons_table(const Tallies& tallies) {
  std::string text;
  for (std::size_t q = 0; q < tallies.size(); ++q) {
    std::vector<std::uint32_t> bits;
    for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
      if (tallies[q].reasons[bit] > 0) bits.push_back(bit);
    }
    std::stable_sort(bits.begin(), bits.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return tallies[q].reasons[a] > tallies[q].reasons[b]; });
    text += format("%-6s", pose_wall_quantity_name(static_cast<std::uint32_t>(q)));
    for (const std::uint32_t bit : bits) text += format(" %s %d", pose_wall_reason_name(bit), tallies[q].reasons[bit]);
    text += "\n";
  }
  return text;
}

void WorkTally::add(const Verdict& verdict) {
  const int before = limited;
  for (const Work& work : verdict.work) {
    steps.push_back(static_cast<double>(work.steps));
    limited += work.limited ? 1 : 0;
  }
  roads_limited += limited > before ? 1 : 0;
}

std::string WorkTally::text() const {
  return format(
      "%zu frames, ended by the budget %d (%.2f %%, on %d roads); million steps: 50 %% %.2f, 95 %% %.2f, "
      "99.5 %% %.2f, largest %.2f\n",
      steps.size(), limited, 100.0 * share_limited(), roads_limited, 1e-6 * quantile(steps, 0.5),
      1e-6 * quantile(steps, 0.95), 1e-6 * quantile(steps, 0.995), 1e-6 * quantile(steps, 1.0));
}

}  // namespace pose_wall::judge
