// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Units in which files give coordinates. The engine reads metres.

#pragma once

#include <string>
#include <vector>

#include "io/frames/frame.hpp"

namespace pose_wall::tools {

// m mm cm ft
std::vector<std::string> length_unit_names();

// Metres of one unit; the name is one of length_unit_names().
double metres_of(const std::string& unit);

// Multiplies x, y and z of every point.
void scale_points(Frame* frame, double factor);

// Whether ranges are likely given in a smaller unit: nearly all of them lie beyond range_max, and in millimetres or
// centimetres they would lie within it. The units by name, the likeliest first; empty where metres are plausible.
// `beyond_share`: of the returns, those farther than range_max.
std::vector<std::string> likely_units(double median_range, double beyond_share, double range_max_m);

// The same of a cloud.
struct UnitQuestion {
  double median_range = 0.0;
  std::vector<std::string> units;
};
UnitQuestion unit_question(const pose_wall_cloud& cloud, double range_max_m);

// "nearly all points lie beyond range_max (30 m), half of them beyond 4982: are they in mm? --unit mm reads them so";
// empty where there is no question.
std::string unit_question_text(const UnitQuestion& question, double range_max_m);

}  // namespace pose_wall::tools
