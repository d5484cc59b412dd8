// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/info/stamp_steps.hpp"

#include <algorithm>
#include <cmath>

#include "io/frames/frame_stamps.hpp"
#include "io/language/language.hpp"
#include "io/numbers/quantile.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kGapSteps = 1.5;
constexpr double kStillBelow_s = 1e-3;  // the engine takes it for the same frame again

}  // namespace

StampSteps look_at_steps(const std::vector<std::int64_t>& stamps_ns) {
  StampSteps found;
  std::vector<double> ahead_s;
  for (std::size_t i = 1; i < stamps_ns.size(); ++i) {
    const double step_s = seconds_between(stamps_ns[i - 1], stamps_ns[i]);
    if (step_s < 0.0) {
      ++found.back;
    } else if (step_s < kStillBelow_s) {
      ++found.still;
    } else {
      ahead_s.push_back(step_s);
    }
  }
  if (ahead_s.empty()) return found;
  const double usual_s = quantile(ahead_s, 0.5);
  found.rate_hz = 1.0 / usual_s;
  std::vector<double> off_s;
  off_s.reserve(ahead_s.size());
  for (const double step_s : ahead_s) off_s.push_back(std::fabs(step_s - usual_s));
  found.jitter_s = quantile(off_s, 0.9);
  for (const double step_s : ahead_s) {
    // A gap is no time that was recorded.
    found.duration_s += std::min(step_s, kGapSteps * usual_s);
    found.gaps += step_s > kGapSteps * usual_s ? std::size_t{1} : 0;
    found.longest_s = std::max(found.longest_s, step_s);
  }
  found.duration_s += usual_s;
  return found;
}

std::string steps_text(const StampSteps& steps) {
  const std::string faults = say("repeated stamps: {}, backward steps: {}", steps.still, steps.back);
  if (steps.rate_hz == 0.0) return say("unknown; {}", faults);
  return say("{:.2f} Hz over {:.1f} s; 90 % of the steps within {:.1f} ms; gaps: {}, longest step {:.3f} s; {}",
             steps.rate_hz, steps.duration_s, 1e3 * steps.jitter_s, steps.gaps, steps.longest_s, faults);
}

}  // namespace pose_wall::tools
