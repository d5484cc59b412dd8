// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/doctor/preview.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "study/doctor/statistics.hpp"
#include "study/results/frame_runner.hpp"

namespace pose_wall::tools::doctor {
namespace {

// How far apart the places along the road are that the motion measured. What stays in place in five parts of six is the
// body (body_seen.cpp), so five parts of six have to move: a machine that stood until shortly before the end did not
// drive. Of a drive at one speed it is the whole way.
class Travel {
 public:
  void add(const pose_wall_motion_result& moved) {
    if (moved.along_state != POSE_WALL_ALONG_MEASURED || !std::isfinite(moved.along_m)) return;
    along_m_.push_back(moved.along_m);
  }
  double most_m() const {
    constexpr std::size_t kParts = 6;  // as BodySeen looks at
    if (along_m_.size() < kParts) return 0.0;
    double least_m = INFINITY;
    for (std::size_t part = 0; part < kParts; ++part) {
      double low_m = INFINITY, high_m = -INFINITY;
      for (std::size_t i = 0; i < along_m_.size(); ++i) {
        if (i * kParts / along_m_.size() == part) continue;
        low_m = std::fmin(low_m, along_m_[i]), high_m = std::fmax(high_m, along_m_[i]);
      }
      least_m = std::fmin(least_m, high_m - low_m);
    }
    return least_m * kParts / (kParts - 1);
  }

 private:
  std::vector<double> along_m_;
};

}  // namespace

std::string Preview::reasons_text(std::size_t count) const {
  std::vector<std::pair<std::size_t, std::uint32_t>> order;
  // These two say nothing of the settings: every recording begins with no value, and a leaf may grow.
  constexpr std::uint32_t kLeftOut = POSE_WALL_R_NEVER_MEASURED | POSE_WALL_R_LEAF_GROWN;
  for (std::uint32_t bit = 0; bit < reasons.size(); ++bit) {
    if (reasons[bit] > 0 && (1U << bit & kLeftOut) == 0) order.emplace_back(reasons[bit], bit);
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  order.resize(std::min(order.size(), count));
  std::string names;
  for (const auto& reason : order) {
    names += (names.empty() ? "" : ", ") + std::string(pose_wall_reason_name(reason.second));
  }
  return names;
}

Preview preview(const LoadedConfig& settings, double rate_hz, const NextFrame& next) {
  FrameRunner runner(settings.config, rate_hz, settings.motion);
  std::array<std::array<std::size_t, POSE_WALL_QUANTITIES>, POSE_WALL_VALID + 1> counts{};
  std::array<std::vector<double>, POSE_WALL_QUANTITIES> levels;
  Preview seen;
  Travel travel;
  while (std::optional<SourcedFrame> frame = next()) {
    const FrameOutcome outcome = runner.run(std::move(*frame));
    if (!outcome.result) continue;
    ++seen.frames;
    if (runner.moved()) travel.add(*runner.moved());
    for (std::size_t q = 0; q < levels.size(); ++q) {
      const pose_wall_value& value = outcome.result->quantity[q];
      ++counts[std::min<std::uint32_t>(value.state, POSE_WALL_VALID)][q];
      if (value.state != POSE_WALL_INVALID) levels[q].push_back(value.protection_level);
    }
    const std::uint32_t reasons = all_reasons(*outcome.result);
    for (std::uint32_t bit = 0; bit < seen.reasons.size(); ++bit) seen.reasons[bit] += reasons >> bit & 1U;
  }
  seen.travel_m = travel.most_m();
  for (std::size_t q = 0; q < levels.size(); ++q) {
    seen.valid[q] = share(counts[POSE_WALL_VALID][q], seen.frames);
    seen.degraded[q] = share(counts[POSE_WALL_DEGRADED][q], seen.frames);
    seen.held[q] = share(counts[POSE_WALL_HELD][q], seen.frames);
    seen.level[q] = median(levels[q]);
  }
  return seen;
}

}  // namespace pose_wall::tools::doctor
