// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Rock as it was measured: relief of several lengths at once, and blocks that broke out. One length alone is rough
// either near by or far off, and real rock is both.
#pragma once

#include <array>
#include <cstdint>

#include "lab/sim/noise_tile.hpp"
#include "lab/sim/random.hpp"

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

// In the order of the words of the key `rock`.
enum class RockKind { kPlain, kSmooth, kShotcrete, kBlasted, kCut };
inline constexpr const char* kRockWords = "plain|smooth|shotcrete|blasted|cut";

enum class RockFace { kWall, kRoof, kFloor };

class RockScales {
 public:
  RockScales() = default;
  // scale: times what was measured. Plain rock has none.
  RockScales(RockKind kind, RockFace face, double scale, bool repeats, std::uint64_t identity);

  bool flat() const { return sigma_m_ + block_depth_m_ <= 0.0; }
  double at(const NoiseTile& tile, double u_m, double v_m) const;
  // Nearly all rock is within this distance of its mean.
  double reach_m() const { return 3.5 * sigma_m_ + block_depth_m_; }
  double slope() const;   // about twice the root mean square of the layers' slopes
  double step_m() const;  // shorter steps resolve every layer
  // A ray in a hole must not step over the edge of the next block.
  double stride_m() const { return block_depth_m_ > 0.0 ? 0.2 * blocks_.length_m() : 1e3; }

 private:
  static constexpr std::size_t kLayers = 5;
  std::array<NoiseLayer, kLayers> layers_{};
  double sigma_m_ = 0.0;  // of all layers together
  NoiseLayer blocks_;     // where it is above block_above_, blocks broke out
  double block_above_ = 0.0, block_depth_m_ = 0.0, block_mean_m_ = 0.0;
};

}  // namespace pose_wall::tools::sim
