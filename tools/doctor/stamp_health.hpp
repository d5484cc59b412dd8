// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How steadily the frames come, and whether their stamps can be believed.

#pragma once

#include <cstddef>

#include "doctor/recording.hpp"

namespace pose_wall::tools::doctor {

struct StampHealth {
  std::size_t frames = 0;  // that could be read
  std::size_t unreadable = 0;
  std::size_t empty = 0;       // without any return
  std::size_t cut = 0;         // less than 60 % of the median's returns, but some
  std::size_t repeated = 0;    // the very points of the frame before
  std::size_t own_stamps = 0;  // 0: the format carries none, and what follows is --rate
  double duration_s = 0.0;
  double rate_hz = 0.0;   // of the median step
  double jitter_s = 0.0;  // nine in ten steps lie within this of the median
  std::size_t gaps = 0;   // steps of more than 2.5 times the median
  double gap_max_s = 0.0;
  std::size_t still = 0;
  std::size_t back = 0;

  bool has_stamps() const { return own_stamps > 1; }
};

StampHealth look_at_stamps(const Recording& recording);

}  // namespace pose_wall::tools::doctor
