// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/section.hpp"

#include <cmath>

#include "lab/sim/random.hpp"

namespace pose_wall::tools::sim {
namespace {

constexpr double kNichesWithin_m = 60.0;  // of the start

RockScales scales_of(const Rock& rock, RockFace face, std::uint64_t identity) {
  return {static_cast<RockKind>(rock.rock), face, rock.rock_scale, rock.rock_repeats != 0.0, mix(identity + 1u)};
}

Relief rock_relief(const Rock& rock, const NoiseTile* tile, std::uint64_t identity, RockFace face = RockFace::kWall) {
  Relief relief;
  if (tile == nullptr) return relief;
  relief.tile = tile;
  relief.scales = scales_of(rock, face, identity);
  relief.rough = NoiseLayer::make(rock.roughness_m, rock.roughness_length_m, rock.rock_repeats != 0.0, identity);
  relief.wave_m = rock.wave_m;
  relief.wave_per_m = 2.0 * M_PI / rock.wave_length_m;
  return relief;
}

// + rises ahead.
Ramp ramp_of(const Road& road) {
  return {std::tan(road.ramp_deg * kRadPerDeg), road.ramp_at_m, road.ramp_length_m};
}

Relief floor_relief(const Setup& setup, const NoiseTile* tile, std::uint64_t identity) {
  const Floor& floor = setup.floor;
  const bool repeats = setup.rock.rock_repeats != 0.0;
  Relief relief;
  if (tile == nullptr) return relief;
  relief.tile = tile;
  relief.scales = scales_of(setup.rock, RockFace::kFloor, identity);
  relief.bow = {-floor.camber_m, 0.0, 0.5 * setup.road.width_m};
  relief.ramp = ramp_of(setup.road);
  relief.rough = NoiseLayer::make(floor.floor_roughness_m, floor.floor_roughness_length_m, repeats, identity);
  relief.hump = NoiseLayer::make(floor.hump_m, floor.hump_length_m, repeats, mix(identity));
  relief.rut_depth_m = floor.rut_depth_m;
  relief.rut_at_m = 0.5 * floor.rut_gauge_m;
  relief.rut_half_width_m = 0.5 * floor.rut_width_m;
  return relief;
}

// Heaps along a wall: high and low in turn, with rubble on them.
Relief muck_relief(const Floor& floor, bool repeats, const NoiseTile* tile, std::uint64_t identity) {
  Relief relief;
  if (tile == nullptr) return relief;
  relief.tile = tile;
  relief.rough = NoiseLayer::make(floor.muck_roughness_m, 0.3, repeats, identity);
  relief.hump = NoiseLayer::make(0.15 * floor.muck_height_m, 2.5, repeats, mix(identity));
  return relief;
}

// Upright by gravity, across the road at s, turned by an angle about a point beside the centre line; facing back to the
// start for facing = -1.
Plane face_plane(const Road& road, double s_m, double turn_rad, double facing, double lateral_m = 0.0) {
  const CentreLine line(road.curve_radius_m);
  const double heading = line.heading_rad(s_m) + turn_rad;
  const double slope = road.slope_deg * kRadPerDeg;
  const Vector across(std::cos(heading), std::sin(heading), 0.0);
  const Vector n = facing * (std::cos(slope) * across - std::sin(slope) * Vector::UnitZ());
  const Vector u = Vector::UnitZ().cross(across);
  return {n, -n.dot(line.point(s_m, lateral_m, 0.0)), u, n.cross(u)};
}

Plane level_plane(double z_m, double facing) {
  return {facing * Vector::UnitZ(), -facing * z_m, Vector::UnitX(), Vector::UnitY()};
}

void add_walls(const Setup& setup, const NoiseTile* tile, std::uint64_t seed, std::vector<RoadSurface>& out) {
  for (const int side : {1, -1}) {
    if (!has_side(setup.road.walls, side)) continue;
    const double half_width = 0.5 * setup.road.width_m;
    const double lean = wall_lean_tangent(setup.road, side);
    Surface wall = wall_mean(setup.road, side, half_width, lean);
    wall.relief = rock_relief(setup.rock, tile, mix(seed + 10u + static_cast<unsigned>(side)));
    const double wall_top_m = setup.road.arch_springing_m > 0.0 ? setup.road.arch_springing_m : setup.road.height_m;
    if (tile != nullptr) wall.relief.bow = {setup.road.bow_m, 0.5 * wall_top_m, 0.5 * wall_top_m};
    out.push_back({wall, side > 0 ? Label::kWallLeft : Label::kWallRight, side, setup.rock.steel_pitch_m > 0.0});

    if (!has_side(setup.floor.muck_side, side)) continue;
    const double repose = setup.floor.muck_width_m / setup.floor.muck_height_m;
    Surface muck = wall_mean(setup.road, side, half_width - setup.floor.muck_width_m, repose + lean);
    muck.relief =
        muck_relief(setup.floor, setup.rock.rock_repeats != 0.0, tile, mix(seed + 20u + static_cast<unsigned>(side)));
    out.push_back({muck, Label::kMuck, 0, false});
  }
}

void add_roof(const Setup& setup, const NoiseTile* tile, std::uint64_t seed, std::vector<RoadSurface>& out) {
  const Road& road = setup.road;
  if (road.roof == 0.0) return;
  Surface roof{level_plane(road.height_m, -1.0), rock_relief(setup.rock, tile, mix(seed + 30u), RockFace::kRoof)};
  Ramp ramp = ramp_of(road);
  ramp.tangent *= -1.0;  // up is out of the road
  if (road.arch_springing_m > 0.0) {
    const Arch arch{0.5 * road.width_m, road.height_m - road.arch_springing_m, road.arch_springing_m};
    ramp.vault_half_m = arch.half_width_m;
    ramp.vault_rise_m = arch.rise_m;
    roof.shape = arch;
  }
  if (tile != nullptr) roof.relief.ramp = ramp;
  out.push_back({roof, Label::kRoof, 0, setup.rock.steel_pitch_m > 0.0});
}

// bounds: the walls of the recess that face each other, its back, its roof.
Recess make_recess(const Setup& setup, const NoiseTile* tile, std::uint64_t identity, int side, double from_m,
                   double to_m, double depth_m, double height_m, double oblique_deg = 0.0) {
  const Road& road = setup.road;
  const double turn = -side * oblique_deg * kRadPerDeg;
  const double mouth = 0.5 * side * road.width_m;
  Recess recess{side, from_m, to_m, height_m, {}};
  recess.bounds.push_back({face_plane(road, from_m, turn, 1.0, mouth), {}});
  if (std::isfinite(to_m)) recess.bounds.push_back({face_plane(road, to_m, turn, -1.0, mouth), {}});
  Surface back = wall_mean(road, side, 0.5 * road.width_m + depth_m, wall_lean_tangent(road, side));
  back.relief = rock_relief(setup.rock, tile, identity);
  recess.bounds.push_back(back);
  if (height_m < road.height_m) recess.bounds.push_back({level_plane(height_m, -1.0), {}});
  return recess;
}

void add_niches(const Setup& setup, const NoiseTile* tile, std::uint64_t identity, int side, std::vector<Recess>& out) {
  const Openings& o = setup.openings;
  Random random(identity, 0x21c4);
  const double first_m = -kNichesWithin_m + random.uniform(0.0, o.niche_pitch_m);
  for (double at_m = first_m; at_m < kNichesWithin_m; at_m += o.niche_pitch_m) {
    const double from_m = at_m + o.niche_pitch_m * random.uniform(-0.25, 0.25);
    out.push_back(
        make_recess(setup, tile, identity, side, from_m, from_m + o.niche_width_m, o.niche_depth_m, o.niche_height_m));
  }
}

}  // namespace

Plane floor_plane(const Road& road) {
  const double fall = road.cross_fall_deg * kRadPerDeg;
  return {{0.0, -std::sin(fall), std::cos(fall)}, 0.0, Vector::UnitX(), {0.0, std::cos(fall), std::sin(fall)}};
}

double floor_height_m(const Road& road, const Vector& p) {
  return p.y() * std::tan(road.cross_fall_deg * kRadPerDeg);
}

double wall_lean_tangent(const Road& road, int side) {
  return std::tan((side > 0 ? road.lean_left_deg : road.lean_right_deg) * kRadPerDeg);
}

Surface wall_mean(const Road& road, int side, double half_width_m, double lean_tangent) {
  const CentreLine line(road.curve_radius_m);
  if (line.curved()) {
    const double outwards = -line.bend() * side;
    return {Cone{line, line.radius_m() + outwards * half_width_m, outwards * lean_tangent, outwards}, {}};
  }
  const double splay = std::tan((side > 0 ? road.splay_left_deg : road.splay_right_deg) * kRadPerDeg);
  const Vector inwards(splay, -side, lean_tangent);
  const Vector n = inwards.normalized();
  const Vector u = Vector(1.0, side * splay, 0.0).normalized();
  return {Plane{n, half_width_m / inwards.norm(), u, n.cross(u)}, {}};
}

std::vector<RoadSurface> road_surfaces(const Setup& setup, const NoiseTile* tile, std::uint64_t seed) {
  const Road& road = setup.road;
  std::vector<RoadSurface> out;
  add_walls(setup, tile, seed, out);
  out.push_back({{floor_plane(road), floor_relief(setup, tile, mix(seed + 1u))}, Label::kFloor, 0, false});
  add_roof(setup, tile, seed, out);
  if (road.face_distance_m > 0.0) {
    const Plane face = face_plane(road, road.face_distance_m, road.face_oblique_deg * kRadPerDeg, -1.0);
    out.push_back({{face, rock_relief(setup.rock, tile, mix(seed + 40u))}, Label::kFace, 0, false});
  }
  if (road.rear_distance_m > 0.0) {
    const Plane rear = face_plane(road, -road.rear_distance_m, 0.0, 1.0);
    out.push_back({{rear, rock_relief(setup.rock, tile, mix(seed + 41u))}, Label::kFace, 0, false});
  }
  return out;
}

std::vector<Recess> road_recesses(const Setup& setup, const NoiseTile* tile, std::uint64_t seed) {
  const Road& road = setup.road;
  const Openings& o = setup.openings;
  std::vector<Recess> out;
  for (const int side : {1, -1}) {
    const std::uint64_t identity = mix(seed + 50u + static_cast<unsigned>(side));
    if (has_side(o.crosscut_side, side)) {
      const double half = 0.5 * o.crosscut_width_m;
      out.push_back(make_recess(setup, tile, identity, side, o.crosscut_at_m - half, o.crosscut_at_m + half,
                                o.crosscut_depth_m, o.crosscut_height_m, o.crosscut_oblique_deg));
    }
    if (has_side(o.niche_side, side)) add_niches(setup, tile, identity, side, out);
    if (has_side(o.widening_side, side)) {
      out.push_back(make_recess(setup, tile, identity, side, o.widening_at_m, kNever, o.widening_m, kNever));
    }
    if (road.face_distance_m > 0.0 && road.face_extra_width_m > 0.0) {
      out.push_back(make_recess(setup, tile, identity, side, road.face_distance_m - road.face_niche_m, kNever,
                                road.face_extra_width_m, kNever));
    }
  }
  return out;
}

}  // namespace pose_wall::tools::sim
