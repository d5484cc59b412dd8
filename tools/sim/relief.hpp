// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How far a real surface stands out of its mean surface, as a function of two coordinates on it. Fixed to the road,
// so it stays while the machine moves.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/noise_tile.hpp"
#include "sim/random.hpp"

namespace pose_wall::tools::sim {

struct NoiseLayer {
  double sigma_m = 0.0;
  double cells_per_m = 1.0;
  double u_cells = 0.0;  // where on the tile the surface's origin lies: surfaces share a tile without looking alike
  double v_cells = 0.0;
  double slant = 0.0;  // rows of the tile that one column along the surface leads up

  // After a turn of the tile the surface is 92 of its 256 rows higher, and at the same height after 64 turns.
  static constexpr double kSlantUnrepeated = 92.0 / NoiseTile::kColumns;

  static NoiseLayer make(double sigma_m, double length_m, bool repeats, std::uint64_t identity) {
    Random random(identity, 0x1a7e);
    const double u = random.uniform(0.0, NoiseTile::kColumns);
    const double v = random.uniform(0.0, NoiseTile::kRows);
    return {sigma_m, NoiseTile::kCellsPerLength / length_m, u, v, repeats ? 0.0 : kSlantUnrepeated};
  }
  double length_m() const { return NoiseTile::kCellsPerLength / cells_per_m; }
  double at(const NoiseTile& tile, double u_m, double v_m) const {
    double v = v_m * cells_per_m + v_cells;
    if (slant != 0.0) v += slant * u_m * cells_per_m;
    return sigma_m * static_cast<double>(tile.at(u_m * cells_per_m + u_cells, v));
  }
};

struct Relief {
  const NoiseTile* tile = nullptr;
  NoiseLayer rough;
  NoiseLayer hump;
  double wave_m = 0.0;
  double wave_per_m = 0.0;  // 2 pi / length
  double rut_depth_m = 0.0;
  double rut_at_m = 0.0;
  double rut_half_width_m = 0.0;

  bool flat() const { return rough.sigma_m + hump.sigma_m + wave_m + rut_depth_m <= 0.0; }

  // The surface stays within this distance of its mean; noise is cut there.
  double reach_m() const { return 3.5 * (rough.sigma_m + hump.sigma_m) + wave_m + rut_depth_m; }

  // About twice the root mean square slope: what a marching ray must expect.
  double slope() const {
    return 2.8 * (rough.sigma_m / rough.length_m() + hump.sigma_m / hump.length_m()) + wave_m * wave_per_m +
           (rut_depth_m > 0.0 ? 2.0 * rut_depth_m / rut_half_width_m : 0.0);
  }

  // Steps shorter than this resolve every feature.
  double step_m() const {
    double step = 1.0;
    if (rough.sigma_m > 0.0) step = std::min(step, 0.15 * rough.length_m());
    if (hump.sigma_m > 0.0) step = std::min(step, 0.15 * hump.length_m());
    if (wave_m > 0.0) step = std::min(step, 0.5 / wave_per_m);
    if (rut_depth_m > 0.0) step = std::min(step, 0.3 * rut_half_width_m);
    return step;
  }

  double height(double u_m, double v_m) const {
    double h = 0.0;
    if (rough.sigma_m > 0.0) h += rough.at(*tile, u_m, v_m);
    if (hump.sigma_m > 0.0) h += hump.at(*tile, u_m, v_m);
    if (wave_m > 0.0) h += wave_m * std::sin(u_m * wave_per_m) * std::cos(0.7 * v_m * wave_per_m);
    if (rut_depth_m > 0.0) {
      const double off = (std::abs(v_m) - rut_at_m) / rut_half_width_m;
      if (std::abs(off) < 1.0) h -= rut_depth_m * (1.0 - off * off);
    }
    return std::clamp(h, -reach_m(), reach_m());
  }
};

}  // namespace pose_wall::tools::sim
