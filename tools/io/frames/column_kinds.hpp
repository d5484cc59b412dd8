// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a column of numbers without a name is, by its values over all points of a frame.
//
// A ring is a small whole number, and goes with the elevation of its points. Times spread over what a scan takes; they
// go with the azimuth, or change little from one point to the next. Intensities do none of this.

#pragma once

#include <cstddef>
#include <vector>

namespace pose_wall::tools {

enum class ColumnKind { kConstant, kRing, kTime, kOther };

// The values of a column in the order of the points, with the place of each. Points without a return are passed over.
class ColumnLook {
 public:
  void add(double value, double x, double y, double z);
  ColumnKind kind() const;

 private:
  bool is_whole_byte() const;
  bool goes_with_elevation() const;
  bool goes_with_azimuth() const;
  bool is_smooth() const;

  struct Way {
    double x = 0.0, y = 0.0;
  };

  std::vector<double> values_, elevations_rad_;
  std::vector<Way> ways_;  // of length 1, in the plane
  double least_ = 0.0, most_ = 0.0;
  bool are_finite_ = true, are_whole_ = true, is_rising_ = true;
};

}  // namespace pose_wall::tools
