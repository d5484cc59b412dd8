// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/network.hpp"

#include <algorithm>

#include "lab/sim/network_walls.hpp"

namespace pose_wall::tools::sim {
namespace {

Surface level(double n_z, double d_m, const Relief& relief) {
  return {Plane{n_z * Vector::UnitZ(), d_m, Vector::UnitX(), Vector::UnitY()}, relief};
}

Relief floor_relief(const NetworkPlan& plan, const NoiseTile* tile, std::uint64_t seed) {
  Relief relief;
  relief.tile = tile;
  relief.rough = NoiseLayer::make(plan.floor_roughness_m, 0.3, false, mix(seed ^ 0xf1u));
  relief.hump = NoiseLayer::make(plan.hump_m, plan.hump_length_m, false, mix(seed ^ 0xf2u));
  return relief;
}

Relief roof_relief(const NetworkPlan& plan, const NoiseTile* tile, std::uint64_t seed) {
  Relief relief;
  relief.tile = tile;
  relief.rough = NoiseLayer::make(plan.lining == Lining::kRock ? plan.roughness_m : 0.0, 0.6, false, mix(seed ^ 0xf3u));
  return relief;
}

}  // namespace

Network::Network(const NetworkPlan& plan, std::uint64_t seed)
    : plan_(plan),
      graph_(draw_network(plan, seed)),
      walls_(network_walls(plan, graph_, seed)),
      tile_(std::make_unique<NoiseTile>(mix(seed ^ 0x711eu))),
      floor_(level(1.0, 0.0, floor_relief(plan, tile_.get(), seed))),
      roof_(level(-1.0, plan.height_m, roof_relief(plan, tile_.get(), seed))) {}

bool Network::is_open(const Place& p) const {
  // Any direction does; this one meets few corners of the grid.
  const Place direction = Place(0.8191725, 0.5735533).normalized();
  const double far_m = 1e6;
  const PlaneHit rock = walls_.cast(p, direction, far_m, kRockOnly);
  if (!(rock.range_m < far_m && rock.cosine > 0.0)) return false;
  const PlaneHit thing = walls_.cast(p, direction, far_m, kThingsOnly);
  return !(thing.range_m < far_m && thing.cosine < 0.0);
}

double Network::floor_height_m(const Place& p) const {
  Relief humps = floor_.relief;
  humps.rough.sigma_m = 0.0;
  return humps.height(p.x(), p.y());
}

}  // namespace pose_wall::tools::sim
