// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The frames put through the engine with settings that are being tried.

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pose_wall.hpp"
#include "study/doctor/recording.hpp"

namespace pose_wall::tools::doctor {

constexpr std::size_t kAllKept = static_cast<std::size_t>(-1);

bool is_measured(const pose_wall_value& value);

class Trial {
 public:
  // Up to `frames_max` of the frames, spread evenly, each for itself: nothing is held or smoothed. Throws ConfigError
  // when the engine refuses the config.
  Trial(const api::Config& config, const std::vector<KeptFrame>& frames, std::size_t frames_max);

  const std::vector<pose_wall_result>& results() const { return results_; }
  const std::vector<std::size_t>& frames() const { return frames_; }  // indices, one per result

  // Share of the frames in which the quantity was measured, and in which it was valid.
  double measured(std::uint32_t quantity) const;
  double valid(std::uint32_t quantity) const;
  // In which the wall was measured at either of its two points.
  double wall_measured(bool left) const;

 private:
  std::vector<pose_wall_result> results_;
  std::vector<std::size_t> frames_;
};

}  // namespace pose_wall::tools::doctor
