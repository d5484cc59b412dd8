// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/card_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/numbers/angles.hpp"
#include "io/terminal/counted.hpp"
#include "lab/campaign/rate_bound.hpp"

namespace pose_wall::tools::campaign {
namespace {

constexpr std::size_t kReasonsShown = 3;
constexpr double kRoundingOfSums = 1e-9;

}  // namespace

std::string amount(bool is_angle, double value) {
  if (!std::isfinite(value)) return "-";
  return is_angle ? fmt::format("{:.3f}°", value * kDegPerRad) : fmt::format("{:.1f} mm", value * 1e3);
}

std::string percent(double share) {
  if (!std::isfinite(share)) return "-";
  if (share > 1.0 - kRoundingOfSums) return "100 %";
  if (share >= 0.9995) return "> 99.9 %";
  if (share > 0.0 && share < 0.0005) return "< 0.1 %";
  return share > 0.0 ? fmt::format("{:.1f} %", 100.0 * share) : "0 %";
}

std::string figure(double value) {
  if (!std::isfinite(value)) return "-";
  return value < 1000.0 ? fmt::format("{:.2f}", value) : fmt::format("{:.1e}", value);
}

std::string count_with_bound(std::size_t events, std::size_t frames) {
  return fmt::format("{} (≤ {:.1e})", events, rate_bound_95(events, frames));
}

std::string times_text(std::vector<std::size_t> times, std::size_t never) {
  if (times.empty() && never == 0) return "-";
  std::string text = "never";
  if (!times.empty()) {
    std::sort(times.begin(), times.end());
    text = fmt::format("{} / {}", times[times.size() / 2], times.back());
  }
  if (never > 0) text += fmt::format(" ({} never)", never);
  return text;
}

std::string reasons_text(const ClassCard& card) {
  std::size_t values = 0;
  for (const ErrorStatistics& q : card.quantities) values += q.frames() - q.valid();
  std::vector<std::pair<std::size_t, std::uint32_t>> counts;
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    if (card.reasons[bit] > 0) counts.emplace_back(card.reasons[bit], bit);
  }
  std::sort(counts.rbegin(), counts.rend());
  std::string text;
  for (std::size_t i = 0; i < std::min(kReasonsShown, counts.size()); ++i) {
    const double share = static_cast<double>(counts[i].first) / static_cast<double>(values);
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", pose_wall_reason_name(counts[i].second), percent(share));
  }
  return text.empty() ? "-" : text;
}

std::string gate_text(const std::vector<std::string>& faults) {
  if (faults.empty()) return "**Gate passed.**\n\n";
  std::string text =
      fmt::format("**Gate not passed: {}.**\n\n", counted(faults.size(), "requirement fails", "requirements fail"));
  for (const std::string& fault : faults) text += "- " + fault + "\n";
  return text + "\n";
}

std::string movement_text(const Manifest& manifest) {
  const bool turning = manifest.plan.scans == Scans::kTurning;
  const char* const scans = turning ? "Scans take time and their points have times; half of the runs drive."
                                    : "Scans are of one instant, and points have no times.";
  if (manifest.motion_is_on) return fmt::format("{} Motion is on.", scans);
  return fmt::format("{} Motion is off: the engine is alone{}.", scans,
                     turning ? ", and nothing takes the motion out of a scan" : "");
}

std::string origin_text(const Manifest& manifest) {
  std::string text = fmt::format("To make it again: `{} --output DIR`.\n\n", manifest.command());
  for (const auto& [name, value] : manifest.identity) text += fmt::format("- {}: `{}`\n", name, value);
  return text + "\n";
}

}  // namespace pose_wall::tools::campaign
