// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/compare.hpp"

#include <cmath>

#include "judge/text.hpp"

namespace pose_wall::judge {
namespace {

constexpr std::uint32_t kNoBudget = 2000000000;  // the largest that the key takes

}  // namespace

const std::vector<NamedTreatment>& compared_treatments() {
  static const std::vector<NamedTreatment> treatments = {
      {"motion", {true, 0}}, {"no motion", {false, 0}}, {"no motion, no budget", {false, kNoBudget}}};
  return treatments;
}

void LevelRatios::add(const Verdict& with, const Verdict& without) {
  for (std::size_t k = 0; k < with.findings.size(); ++k) {
    const Finding &a = with.findings[k], &b = without.findings[k];
    const auto q = static_cast<std::size_t>(a.quantity);
    if (a.measured_or_held() && b.measured_or_held()) {
      (a.frame == 0 ? first : later).at(q).push_back(a.level / b.level);
    } else {
      lost.at(q) += b.measured_or_held() ? 1 : 0;
      gained.at(q) += a.measured_or_held() ? 1 : 0;
    }
  }
}

void Comparison::add(const Case& tried) {
  std::vector<Treatment> treatments;
  for (const NamedTreatment& named : compared_treatments()) treatments.push_back(named.treatment);
  const std::vector<Verdict> verdicts = hear(tried, treatments);
  for (std::size_t k = 0; k < verdicts.size(); ++k) {
    judge::add(&tallies_[k], verdicts[k]);
    work_[k].add(verdicts[k]);
    for (const Finding& finding : verdicts[k].findings) {
      const bool bad = finding.beyond() || finding.raw_beyond() || finding.misleading();
      if (bad) std::printf("BEYOND %s: %s\n", compared_treatments()[k].name, verdicts[k].text(finding).c_str());
      wrong_ = wrong_ || (k == 0 && bad && finding.state == POSE_WALL_VALID);
    }
  }
  ratios_.add(verdicts[0], verdicts[1]);
}

std::string Comparison::shares_text() const {
  std::string text = format("%-22s", "");
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) text += format(" %8s", pose_wall_quantity_name(q));
  text += "\n";
  const auto row = [&](const char* name, const char* of, const char* number, const Tallies& tallies, auto value) {
    text += format("%-22s", (std::string(name) + of).c_str());
    for (std::size_t q = 0; q < tallies.size(); ++q) text += format(number, value(tallies[q], static_cast<int>(q)));
    text += "\n";
  };
  const auto rows = [&](const char* name, const char* number, auto value) {
    text += format("%s\n", name);
    for (std::size_t k = 0; k < tallies_.size(); ++k) {
      row("  ", compared_treatments()[k].name, number, tallies_[k], value);
    }
  };
  rows("valid %, frame 0", " %8.1f", [](const Tally& t, int) { return 100.0 * t.share_valid_first(); });
  rows("valid %, later", " %8.1f", [](const Tally& t, int) { return 100.0 * t.share_valid_later(); });
  rows("level, median, later", " %8.3f", [](const Tally& t, int q) { return shown(q, quantile(t.told_levels, 0.5)); });
  rows("error, 95 %", " %8.3f", [](const Tally& t, int q) { return shown(q, quantile(t.errors, 0.95)); });
  rows("misleading", " %8d", [](const Tally& t, int) { return t.misleading; });
  rows("beyond, valid", " %8d", [](const Tally& t, int) { return t.beyond_valid; });
  rows("beyond, others", " %8d", [](const Tally& t, int) { return t.beyond_degraded + t.beyond_held + t.raw_beyond; });
  return text;
}

std::string Comparison::ratios_text() const {
  std::string text = "level with motion over level without\n";
  text += format("%-8s %-7s %6s %8s %8s %8s %8s\n", "", "frames", "values", "50 %", "95 %", "99 %", "largest");
  for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const char* name = pose_wall_quantity_name(static_cast<std::uint32_t>(q));
    for (const bool first : {true, false}) {
      const std::vector<double>& ratios = first ? ratios_.first[q] : ratios_.later[q];
      text += format("%-8s %-7s %6zu %8.3f %8.3f %8.3f %8.3f", name, first ? "0" : "later", ratios.size(),
                     quantile(ratios, 0.5), quantile(ratios, 0.95), quantile(ratios, 0.99), quantile(ratios, 1.0));
      if (!first) text += format("   told without alone %d, with alone %d", ratios_.lost[q], ratios_.gained[q]);
      text += "\n";
    }
  }
  return text;
}

std::string Comparison::text() const {
  std::string text = "Angles in degrees, distances in mm\n" + shares_text() + "\n" + ratios_text() + "\n";
  for (std::size_t k = 0; k < work_.size(); ++k) {
    text += format("%-22s %s", compared_treatments()[k].name, work_[k].text().c_str());
  }
  return text;
}

}  // namespace pose_wall::judge
