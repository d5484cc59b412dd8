// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What may steer by a whole recording: a value that is valid often enough (usability.hpp), else its most frequent
// cause.

#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "study/steer/steering.hpp"

namespace pose_wall::tools {

class SteerTally {
 public:
  void add(const Steering& steering);  // of a frame that was read

  // Of the recording. A level is the median of the frames with the most frequent cause.
  Steering steering() const;

 private:
  struct Quantity {
    std::array<std::size_t, kSteerCauses> causes{};        // frames
    std::array<std::vector<double>, kSteerCauses> levels;  // of those in which it was measured
    std::size_t may = 0;
    double limit = 0.0;
  };

  std::size_t frames_ = 0;
  std::array<Quantity, POSE_WALL_QUANTITIES> quantities_{};
};

}  // namespace pose_wall::tools
