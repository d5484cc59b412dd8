// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/doctor/trial.hpp"

#include <algorithm>
#include <string>

#include "io/config_file/load_config.hpp"
#include "study/doctor/statistics.hpp"

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

}  // namespace pose_wall::tools::doctor
