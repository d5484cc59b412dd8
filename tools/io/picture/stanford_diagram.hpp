// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Error against protection level, counted in cells: the usual picture of integrity. An instrument keeps its
// promise where no count lies right of the diagonal.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pose_wall::tools::picture {

// Both axes are logarithmic and the same.
struct StanfordScale {
  std::string_view quantity;  // "angles"
  double low;                 // smaller numbers count in the first cell, larger ones than `high` in the last
  double high;
  double alert_limit;
  std::string (*label)(double);  // of a number on an axis
};
StanfordScale angle_scale(double alert_limit_deg);   // numbers in degrees
StanfordScale distance_scale(double alert_limit_m);  // numbers in metres

class StanfordCounts {
 public:
  explicit StanfordCounts(const StanfordScale& scale);

  // An error is never negative here; a missing protection level counts as none at all (0).
  void add(double error, double protection_level);

  struct Regions {
    std::size_t within = 0;               // error <= protection level <= alert limit
    std::size_t too_wide = 0;             // error <= protection level, which is beyond the alert limit
    std::size_t beyond_protection = 0;    // error > protection level, but both on the same side of the alert limit
    std::size_t misleading_if_valid = 0;  // protection level <= alert limit < error
  };

  const StanfordScale& scale() const { return scale_; }
  const Regions& regions() const { return regions_; }
  std::size_t cell(std::size_t error_cell, std::size_t level_cell) const {
    return cells_[level_cell * kCells + error_cell];
  }
  std::size_t largest_cell() const;

  static constexpr std::size_t kCells = 96;

 private:
  std::size_t cell_of(double number) const;

  StanfordScale scale_;
  Regions regions_;
  std::vector<std::size_t> cells_;
};

// The whole SVG document.
std::string stanford_diagram(const StanfordCounts& counts, std::string_view title);

}  // namespace pose_wall::tools::picture
