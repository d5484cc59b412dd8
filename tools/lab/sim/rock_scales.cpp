// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/rock_scales.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::tools::sim {
namespace {

// Of the layers: where their correlation has fallen to 1/e.
constexpr std::array<double, 5> kLengths_m = {0.2, 0.5, 1.2, 3.0, 7.0};
// A block's edge runs out over so much of the field that places it, whose standard deviation is 1. Judgement, 2026-11:
// about a tenth of the block.
constexpr double kBlockEdge = 0.3;

struct FaceTable {
  std::array<double, 5> sigma_m;
  double block_depth_m, block_length_m, block_above;
};

// blasted: fitted to the spectra (pose_wall_rock) of a level gallery of the Jinchuan nickel mine, 90 m, 4.9 m wide, a
// published map, 2026-11; its scan holds nothing shorter than 0.3 m. Blocks stand for what broke out and for what
// stands at the walls.
constexpr FaceTable kBlastedWall = {{0.0109, 0.0041, 0.0355, 0.0098, 0.0064}, 0.53, 1.12, 0.85};
constexpr FaceTable kBlastedRoof = {{0.0084, 0.0160, 0.0340, 0.0500, 0.1400}, 0.24, 0.43, 1.33};
constexpr FaceTable kHaulFloor = {{0.0020, 0.0027, 0.0125, 0.0066, 0.0527}, 0.046, 1.20, 1.09};

FaceTable scaled(FaceTable table, double layers, double blocks) {
  for (double& sigma_m : table.sigma_m) sigma_m *= layers;
  table.block_depth_m *= blocks;
  return table;
}

// Judgement, 2026-11, beside the measured one. Shotcrete fills what broke out and follows the rest; a roadheader's
// drum leaves the profile that its driver steered, without blocks; a lining is as true as its formwork. All have the
// gallery's floor: wheels make it.
FaceTable table_of(RockKind kind, RockFace face) {
  const FaceTable blasted =
      face == RockFace::kWall ? kBlastedWall : (face == RockFace::kRoof ? kBlastedRoof : kHaulFloor);
  if (kind == RockKind::kPlain) return {};
  if (face == RockFace::kFloor || kind == RockKind::kBlasted) return blasted;
  if (kind == RockKind::kShotcrete) return scaled(blasted, 0.7, 0.4);
  if (kind == RockKind::kCut) return scaled(blasted, 0.6, 0.0);
  return scaled(blasted, 0.2, 0.0);
}

double share_above(double quantile) {
  return 0.5 * std::erfc(quantile / std::sqrt(2.0));
}

}  // namespace

RockScales::RockScales(RockKind kind, RockFace face, double scale, bool repeats, std::uint64_t identity) {
  const FaceTable table = table_of(kind, face);
  double squares = 0.0;
  for (std::size_t k = 0; k < kLayers; ++k) {
    identity = mix(identity);
    layers_[k] = NoiseLayer::make(scale * table.sigma_m[k], kLengths_m[k], repeats, identity);
    squares += layers_[k].sigma_m * layers_[k].sigma_m;
  }
  sigma_m_ = std::sqrt(squares);
  block_depth_m_ = scale * table.block_depth_m;
  if (block_depth_m_ <= 0.0) return;
  blocks_ = NoiseLayer::make(1.0, table.block_length_m, repeats, mix(identity));
  block_above_ = table.block_above;
  block_mean_m_ = block_depth_m_ * share_above(block_above_);
}

double RockScales::at(const NoiseTile& tile, double u_m, double v_m) const {
  double h = block_mean_m_;
  for (const NoiseLayer& layer : layers_) h += layer.at(tile, u_m, v_m);
  if (block_depth_m_ > 0.0) {
    const double over = (blocks_.at(tile, u_m, v_m) - block_above_) / kBlockEdge + 0.5;
    const double t = std::clamp(over, 0.0, 1.0);
    h -= block_depth_m_ * t * t * (3.0 - 2.0 * t);
  }
  return h;
}

double RockScales::slope() const {
  double squares = 0.0;
  for (const NoiseLayer& layer : layers_) squares += std::pow(layer.sigma_m / layer.length_m(), 2.0);
  return 2.8 * std::sqrt(squares) + (block_depth_m_ > 0.0 ? block_depth_m_ / blocks_.length_m() : 0.0);
}

double RockScales::step_m() const {
  double step = 1.0;
  for (const NoiseLayer& layer : layers_) {
    if (layer.sigma_m > 0.0) step = std::min(step, 0.15 * layer.length_m());
  }
  return block_depth_m_ > 0.0 ? std::min(step, kBlockEdge * 0.15 * blocks_.length_m()) : step;
}

}  // namespace pose_wall::tools::sim
