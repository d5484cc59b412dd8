// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Records made by hand: every value is valid, its error zero, unless a test says otherwise.

#pragma once

#include <string>
#include <vector>

#include "lab/campaign/card.hpp"
#include "lab/campaign/record.hpp"

namespace pose_wall::tools::test {

constexpr double kAngleLimit_rad = 0.0175;
constexpr double kDistanceLimit_m = 0.1;

inline campaign::QuantityRecord value_with_error(double error, double sigma = 0.01, double protection_level = 0.015,
                                                 std::uint32_t state = POSE_WALL_VALID) {
  return {1.0, {1.0 + error, 1.0 + error, sigma, protection_level, state}, 0};
}

// Errors are of `sigma` size in turn, so that mean z² is 1.
inline campaign::RunRecord good_run(const std::string& scene, std::uint32_t draw, std::uint32_t frames) {
  campaign::RunRecord record{{scene, "os1-64", draw, 100U + draw, frames}, {}};
  for (std::uint32_t i = 0; i < frames; ++i) {
    campaign::FrameRecord frame;
    frame.frame = i;
    frame.stamp_ns = 1000000000LL + 100000000LL * i;
    for (auto& q : frame.quantity) q = value_with_error(i % 2 == 0 ? 0.01 : -0.01);
    record.frames.push_back(frame);
  }
  return record;
}

inline campaign::Manifest manifest_of(const std::vector<campaign::RunRecord>& records) {
  campaign::Manifest manifest;
  manifest.identity = {{"version", "0"}, {"program", "p"}, {"settings", "defaults"}, {"plan", "by hand"}};
  manifest.limits = {kAngleLimit_rad, kDistanceLimit_m};
  manifest.runs = records.size();
  return manifest;
}

inline campaign::Card card_of(const std::vector<campaign::RunRecord>& records) {
  return campaign::make_card(manifest_of(records), records, 10);
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace pose_wall::tools::test
