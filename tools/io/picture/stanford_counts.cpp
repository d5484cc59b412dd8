// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/picture/stanford_diagram.hpp"

namespace pose_wall::tools::picture {
namespace {

std::string degrees_label(double degrees) {
  return fmt::format("{:g}°", degrees);
}

std::string metres_label(double metres) {
  return metres < 0.9999 ? fmt::format("{:g} mm", metres * 1e3) : fmt::format("{:g} m", metres);
}

}  // namespace

StanfordScale angle_scale(double alert_limit_deg) {
  return {"angles", 0.001, 100.0, alert_limit_deg, degrees_label};
}

StanfordScale distance_scale(double alert_limit_m) {
  return {"distances", 1e-4, 10.0, alert_limit_m, metres_label};
}

StanfordCounts::StanfordCounts(const StanfordScale& scale) : scale_(scale), cells_(kCells * kCells, 0) {}

std::size_t StanfordCounts::cell_of(double number) const {
  const double place = std::log(number / scale_.low) / std::log(scale_.high / scale_.low);
  if (!(place > 0.0)) return 0;
  return std::min(kCells - 1, static_cast<std::size_t>(place * static_cast<double>(kCells)));
}

void StanfordCounts::add(double error, double protection_level) {
  const double level = std::isfinite(protection_level) ? protection_level : 0.0;
  ++cells_[cell_of(level) * kCells + cell_of(error)];
  const bool is_bounded = error <= level;
  const bool claims = level <= scale_.alert_limit;
  if (is_bounded) {
    ++(claims ? regions_.within : regions_.too_wide);
  } else {
    ++(claims && error > scale_.alert_limit ? regions_.misleading_if_valid : regions_.beyond_protection);
  }
}

std::size_t StanfordCounts::largest_cell() const {
  return *std::max_element(cells_.begin(), cells_.end());
}

}  // namespace pose_wall::tools::picture
