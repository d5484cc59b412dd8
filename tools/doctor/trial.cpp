// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "doctor/trial.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "config_file/load_config.hpp"
#include "doctor/statistics.hpp"
#include "results/result_csv.hpp"

namespace pose_wall::tools::doctor {
namespace {

template <typename Predicate>
double share_of(const std::vector<pose_wall_result>& results, Predicate predicate) {
  return share(static_cast<std::size_t>(std::count_if(results.begin(), results.end(), predicate)), results.size());
}

}  // namespace

bool is_measured(const pose_wall_value& value) {
  return value.state == POSE_WALL_VALID || value.state == POSE_WALL_DEGRADED;
}

Trial::Trial(const api::Config& config, const std::vector<KeptFrame>& frames, std::size_t frames_max) {
  api::Engine engine;
  const std::int32_t status = engine.open(config);
  if (status != POSE_WALL_OK) throw ConfigError(std::string("the engine: ") + pose_wall_status_text(status));
  const std::size_t count = std::min(frames.size(), frames_max);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t frame = count > 1 ? i * (frames.size() - 1) / (count - 1) : 0;
    engine.reset();
    pose_wall_result result = api::make_result();
    if (engine.process(frames[frame].cloud(), result) != POSE_WALL_OK) continue;
    results_.push_back(result);
    frames_.push_back(frame);
  }
}

double Trial::measured(std::uint32_t quantity) const {
  return share_of(results_, [quantity](const auto& r) { return is_measured(r.quantity[quantity]); });
}

double Trial::valid(std::uint32_t quantity) const {
  return share_of(results_, [quantity](const auto& r) { return r.quantity[quantity].state == POSE_WALL_VALID; });
}

double Trial::wall_measured(bool left) const {
  const std::uint32_t front = left ? POSE_WALL_D_LF : POSE_WALL_D_RF;
  return share_of(results_, [front](const auto& r) {
    return is_measured(r.quantity[front]) || is_measured(r.quantity[front + 1]);
  });
}

std::string Trial::reasons(std::size_t count) const {
  std::array<std::pair<std::size_t, std::uint32_t>, POSE_WALL_REASON_COUNT> counts{};
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    counts[bit].second = bit;
    for (const pose_wall_result& r : results_) counts[bit].first += all_reasons(r) >> bit & 1U;
  }
  std::stable_sort(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  // What only says that a value has no past is true of every frame for itself.
  constexpr std::uint32_t kOfNoPast = POSE_WALL_R_NEVER_MEASURED | POSE_WALL_R_LEAF_GROWN;
  std::string names;
  for (const auto& [frames, bit] : counts) {
    if (frames == 0 || count == 0) break;
    if ((1U << bit & kOfNoPast) != 0) continue;
    names += (names.empty() ? "" : ", ") + std::string(pose_wall_reason_name(bit));
    --count;
  }
  return names;
}

}  // namespace pose_wall::tools::doctor
