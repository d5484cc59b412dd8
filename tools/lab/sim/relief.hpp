// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How far a real surface stands out of its mean surface, as a function of two coordinates on it. Fixed to the road,
// so it stays while the machine moves.
#pragma once

#include <algorithm>
#include <cmath>

#include "lab/sim/rock_scales.hpp"

namespace pose_wall::tools::sim {

// A parabola across the surface: the middle stands back by depth_m against the edges, or out if that is negative. The
// mean stays: the middle goes back by a third of it, the edges come in by two.
struct Bow {
  double depth_m = 0.0;
  double middle_m = 0.0;  // of |v|
  double half_m = 1.0;
  double at(double v_m) const {
    const double off = std::min(1.0, std::abs(std::abs(v_m) - middle_m) / half_m);
    return depth_m * (off * off - 1.0 / 3.0);
  }
};

// Floor and roof lead up or down over a stretch along the road, and go on level behind it. A vault goes with them as it
// is: upright, not square to itself.
struct Ramp {
  double tangent = 0.0;
  double at_m = 0.0;
  double length_m = 0.0;
  double vault_half_m = 0.0, vault_rise_m = 0.0;  // of an elliptic roof; 0: flat

  double at(double u_m, double v_m) const { return tangent * std::clamp(u_m - at_m, 0.0, length_m) * upright(v_m); }
  // How much of a way up leads out of the surface. Of a vault v is the angle times its mean radius.
  double upright(double v_m) const {
    if (vault_half_m <= 0.0) return 1.0;
    const double angle = v_m / (0.5 * (vault_half_m + vault_rise_m));
    const double across = std::cos(angle) / vault_half_m, up = std::sin(angle) / vault_rise_m;
    return up / std::hypot(across, up);
  }
  double rise_m() const { return std::abs(tangent) * length_m; }
};

struct Relief {
  const NoiseTile* tile = nullptr;
  NoiseLayer rough;
  NoiseLayer hump;
  RockScales scales;
  Bow bow;
  Ramp ramp;
  double wave_m = 0.0;
  double wave_per_m = 0.0;  // 2 pi / length
  double rut_depth_m = 0.0;
  double rut_at_m = 0.0;
  double rut_half_width_m = 0.0;

  bool flat() const {
    return rough.sigma_m + hump.sigma_m + wave_m + rut_depth_m + std::abs(bow.depth_m) + ramp.rise_m() <= 0.0 &&
           scales.flat();
  }

  // The surface stays within this distance of its mean; noise is cut there.
  double reach_m() const {
    return 3.5 * (rough.sigma_m + hump.sigma_m) + wave_m + rut_depth_m + scales.reach_m() + std::abs(bow.depth_m) +
           ramp.rise_m();
  }

  // About twice the root mean square slope: what a marching ray must expect.
  double slope() const {
    return 2.8 * (rough.sigma_m / rough.length_m() + hump.sigma_m / hump.length_m()) + wave_m * wave_per_m +
           (rut_depth_m > 0.0 ? 2.0 * rut_depth_m / rut_half_width_m : 0.0) + scales.slope() +
           std::abs(bow.depth_m) / bow.half_m + std::abs(ramp.tangent);
  }

  // Steps shorter than this resolve every feature.
  double step_m() const {
    double step = scales.step_m();
    if (rough.sigma_m > 0.0) step = std::min(step, 0.15 * rough.length_m());
    if (hump.sigma_m > 0.0) step = std::min(step, 0.15 * hump.length_m());
    if (wave_m > 0.0) step = std::min(step, 0.5 / wave_per_m);
    if (rut_depth_m > 0.0) step = std::min(step, 0.3 * rut_half_width_m);
    return step;
  }

  // `reach_m` is reach_m(), which a march works out once.
  double height(double u_m, double v_m, double reach_m) const {
    double h = 0.0;
    if (rough.sigma_m > 0.0) h += rough.at(*tile, u_m, v_m);
    if (hump.sigma_m > 0.0) h += hump.at(*tile, u_m, v_m);
    if (!scales.flat()) h += scales.at(*tile, u_m, v_m);
    if (wave_m > 0.0) h += wave_m * std::sin(u_m * wave_per_m) * std::cos(0.7 * v_m * wave_per_m);
    if (rut_depth_m > 0.0) {
      const double off = (std::abs(v_m) - rut_at_m) / rut_half_width_m;
      if (std::abs(off) < 1.0) h -= rut_depth_m * (1.0 - off * off);
    }
    if (bow.depth_m != 0.0) h += bow.at(v_m);
    if (ramp.tangent != 0.0) h += ramp.at(u_m, v_m);
    return std::clamp(h, -reach_m, reach_m);
  }
  double height(double u_m, double v_m) const { return height(u_m, v_m, reach_m()); }
};

}  // namespace pose_wall::tools::sim
