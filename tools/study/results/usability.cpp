// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/results/usability.hpp"

#include <algorithm>
#include <cmath>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

long whole_percent(double share) {
  return std::lround(100.0 * share);
}

template <typename Predicate>
std::string names_where(const ValidShares& valid, Predicate is_meant) {
  std::string names;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    if (is_meant(valid[q])) names += (names.empty() ? "" : ", ") + std::string(pose_wall_quantity_name(q));
  }
  return names;
}

std::string verdict_text(Usability usability) {
  if (usability == Usability::kUsable) return say("usable");
  return usability == Usability::kInPart ? say("usable in part") : say("not usable");
}

}  // namespace

// Accepts inside: NaN, of no frame at all, is not usable.
Usability usability_of(double valid_share) {
  if (valid_share >= kUsableShare) return Usability::kUsable;
  return valid_share >= kInPartShare ? Usability::kInPart : Usability::kNotUsable;
}

Usability usability_of(const ValidShares& valid) {
  const auto is_at_least = [](Usability least) {
    return [least](double share) { return usability_of(share) >= least; };
  };
  if (std::all_of(valid.begin(), valid.end(), is_at_least(Usability::kUsable))) return Usability::kUsable;
  const bool is_in_part = std::any_of(valid.begin(), valid.end(), is_at_least(Usability::kInPart));
  return is_in_part ? Usability::kInPart : Usability::kNotUsable;
}

std::string usability_text(const ValidShares& valid) {
  const std::string usable = names_where(valid, [](double x) { return usability_of(x) == Usability::kUsable; });
  const std::string in_part = names_where(valid, [](double x) { return usability_of(x) == Usability::kInPart; });
  const std::string rarely = names_where(valid, [](double x) { return x > 0.0 && x < kInPartShare; });
  const std::string never = names_where(valid, [](double x) { return !(x > 0.0); });
  std::string reasons;
  const auto add = [&reasons](const std::string& reason) { reasons += (reasons.empty() ? "" : tr("; ")) + reason; };
  if (!usable.empty()) add(say("{} valid in at least {} % of the frames", usable, whole_percent(kUsableShare)));
  if (!in_part.empty()) {
    add(say("{} valid in {} % to {} %", in_part, whole_percent(kInPartShare), whole_percent(kUsableShare)));
  }
  if (!rarely.empty()) add(say("{} valid in less than {} %", rarely, whole_percent(kInPartShare)));
  if (!never.empty()) add(say("never valid: {}", never));
  return say("{}: {}", verdict_text(usability_of(valid)), reasons);
}

}  // namespace pose_wall::tools
