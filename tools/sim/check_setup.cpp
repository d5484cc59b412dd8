// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "sim/check_setup.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace pose_wall::tools::sim {
namespace {

void demand(bool holds, const char* rule) {
  if (!holds) throw std::invalid_argument(std::string("scene contradicts itself: ") + rule);
}

}  // namespace

const Setup& checked(const Setup& setup) {
  const Road& r = setup.road;
  const Machine& m = setup.machine;
  const bool leans = r.lean_left_deg != 0.0 || r.lean_right_deg != 0.0;
  const bool splays = r.splay_left_deg != 0.0 || r.splay_right_deg != 0.0;
  const bool curved = r.curve_radius_m != 0.0;
  const bool arched = r.arch_springing_m > 0.0;
  demand(!arched || !leans,
         "an arch (arch_springing_m) stands on upright walls: lean_left_deg and lean_right_deg must be 0");
  demand(!arched || !splays, "an arch (arch_springing_m) cannot splay: splay_left_deg and splay_right_deg must be 0");
  demand(!arched || r.arch_springing_m < r.height_m, "arch_springing_m must be below height_m");
  demand(!curved || !(arched || splays), "a curve (curve_radius_m) has a flat roof and no splay");
  demand(!curved || std::abs(r.curve_radius_m) > r.width_m, "curve_radius_m must exceed width_m");
  demand(setup.floor.muck_side == static_cast<double>(kSideNone) || setup.floor.muck_width_m < 0.5 * r.width_m,
         "muck_width_m must be below half of width_m");
  demand(r.roof == 0.0 || m.base_height_m < r.height_m, "base_height_m must be below height_m");
  demand(std::abs(m.lateral_m) < 0.5 * r.width_m, "lateral_m must be within half of width_m");
  demand(setup.sensor.elevation_min_deg < setup.sensor.elevation_max_deg,
         "elevation_min_deg must be below elevation_max_deg");
  return setup;
}

}  // namespace pose_wall::tools::sim
