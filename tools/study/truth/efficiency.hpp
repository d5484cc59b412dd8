// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Measured errors beside the least that the frames' points allow.

#pragma once

#include <array>
#include <cstddef>
#include <filesystem>

#include "study/truth/comparison.hpp"
#include "study/truth/cramer_rao.hpp"

namespace pose_wall::tools {

// Of the frames in which a quantity was measured and has a truth and a bound.
class EfficiencySums {
 public:
  void add(double error, double bound);
  std::size_t frames() const { return frames_; }
  double rmse() const;
  double bound() const;  // root mean square
  double ratio() const { return rmse() / bound(); }

 private:
  std::size_t frames_ = 0;
  double error_squares_ = 0.0;
  double bound_squares_ = 0.0;
};

struct Efficiency {
  std::array<EfficiencySums, kTruthQuantities> quantity;
  // Means over the frames that have a floor.
  double floor_points = 0.0;
  std::array<double, 2> wall_points{};
  double noise_ratio = 0.0;
  std::size_t frames = 0;

  void add(const FrameBound& bound);
  // The points scatter about the true planes as the range noise says: else the road is not clean, or the noise another.
  bool is_believable() const;
};

// The points of a result row stand in the folder's file that has the name of its `source`. Throws CsvError for missing
// columns, FrameError that names the file for one that cannot be read.
Efficiency efficiency_of(const CsvTable& results, const CsvTable& truth, const Comparison& comparison,
                         const std::filesystem::path& folder, const CramerRao& bounds);

}  // namespace pose_wall::tools
