// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Renders frames, puts them through the engine and keeps what the closing table and the picture need.

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/csv/truth_csv.hpp"
#include "lab/sim/simulator.hpp"
#include "pose_wall.hpp"
#include "study/results/result_csv.hpp"
#include "study/truth/error_statistics.hpp"

namespace pose_wall::tools {

struct DemoFrame {
  FrameOutcome outcome;
  TruthRow truth;
  double time_s = 0.0;
};

class DemoRun {
 public:
  // Throws ConfigError or std::invalid_argument.
  DemoRun(const sim::Setup& setup, const api::Config& config, std::uint64_t seed);

  DemoFrame next();

  // Errors of all frames so far, as a table.
  std::string error_table() const;
  // The last frame as SVG.
  std::string picture(const DemoFrame& frame, const std::string& subtitle) const;

  double median_engine_ms() const;
  double median_render_ms() const;

 private:
  sim::Simulator simulator_;
  api::Config config_;
  api::Engine engine_;
  std::uint32_t next_frame_ = 0;
  std::vector<ErrorStatistics> errors_;
  std::vector<double> engine_ms_;
  std::vector<double> render_ms_;
};

}  // namespace pose_wall::tools
