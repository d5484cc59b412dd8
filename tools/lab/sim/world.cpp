// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pose_wall::tools::sim {
namespace {

constexpr std::size_t kMostSurfaces = 10;

bool needs_tile(const Setup& setup) {
  const Floor& f = setup.floor;
  const bool has_form = setup.road.bow_m != 0.0 || setup.road.ramp_deg != 0.0 || f.camber_m != 0.0;
  return has_form || setup.rock.rock != 0.0 || setup.rock.roughness_m > 0.0 || setup.rock.wave_m > 0.0 ||
         f.floor_roughness_m > 0.0 || f.hump_m > 0.0 || f.rut_depth_m > 0.0 || setup.rock.texture > 0.0 ||
         f.muck_side != static_cast<double>(kSideNone) || f.puddle_coverage > 0.0;
}

void hit_things(const Ray& ray, const std::vector<Primitive>& things, const SectorIndex& index, Hit* best) {
  for (const std::uint16_t i : index.candidates(ray.direction)) {
    double cosine = 1.0;
    const double t = things[i].hit(ray, &cosine);
    if (t < best->t_m) *best = {t, cosine, things[i].label, 0};
  }
}

// From the mouth on, as an oblique recess has sides that the ray's origin may lie behind.
double from_mouth(const Surface& side, const Ray& ray, double t_mouth) {
  const Ray inside{ray.at(t_mouth), ray.direction};
  return side.clearance(inside.origin) <= 0.0 ? t_mouth : t_mouth + side.enter(inside, 0.0);
}

double smallest_bound(const Recess& recess, const Ray& ray, double t_mouth, double t_max, const Surface** bound) {
  double best = t_max;
  for (const Surface& surface : recess.bounds) {
    double t = kNever;
    if (surface.relief.flat()) {
      t = from_mouth(surface, ray, t_mouth);
    } else {
      const double start = surface.enter(ray, surface.relief.reach_m());
      if (start >= best) continue;
      t = surface.hit(ray, start);
    }
    if (t < best) {
      best = t;
      *bound = &surface;
    }
  }
  return best;
}

}  // namespace

World::World(const Setup& setup, std::uint64_t seed)
    : line_(setup.road.curve_radius_m), rock_(setup.rock), floor_(floor_plane(setup.road)) {
  if (needs_tile(setup)) tile_ = std::make_unique<NoiseTile>(seed);
  puddles_ = NoiseLayer::make(1.0, setup.floor.puddle_size_m, true, mix(seed + 60u));
  texture_ = NoiseLayer::make(setup.rock.texture, setup.rock.texture_length_m, false, mix(seed + 61u));
  surfaces_ = road_surfaces(setup, tile_.get(), seed);
  recesses_ = road_recesses(setup, tile_.get(), seed);
  objects_ = road_objects(setup, seed);
  for (const std::vector<Primitive>& places : {narrow_place(setup), benches(setup)}) {
    ground_.insert(ground_.end(), places.begin(), places.end());
  }
  objects_.insert(objects_.end(), ground_.begin(), ground_.end());
}

World World::mean(const Setup& setup) {
  Setup bare = setup;
  bare.rock.steel_pitch_m = 0.0;
  bare.floor = Floor{};
  bare.openings.crosscut_side = kSideNone;
  bare.openings.niche_side = kSideNone;
  World world;
  world.line_ = CentreLine(bare.road.curve_radius_m);
  world.rock_ = bare.rock;
  world.floor_ = floor_plane(bare.road);
  world.recesses_ = road_recesses(bare, nullptr, 0);
  world.objects_ = narrow_place(bare);
  // The walls prolonged past both ends of the road, a niche before the face included.
  bare.road.face_distance_m = 0.0;
  bare.road.rear_distance_m = 0.0;
  world.surfaces_ = road_surfaces(bare, nullptr, 0);
  return world;
}

double World::wetness(const Vector& p) const {
  return tile_ ? puddles_.at(*tile_, p.x(), p.y()) : 0.0;
}

double World::brightness(const Vector& p) const {
  if (texture_.sigma_m <= 0.0) return 1.0;
  return std::max(0.0, 1.0 + texture_.at(*tile_, line_.s_of(p), p.y() + p.z()));
}

std::vector<Primitive> World::objects_at(double time_s) const {
  std::vector<Primitive> moved = objects_;
  for (Primitive& thing : moved) thing.centre += time_s * thing.velocity_mps;
  return moved;
}

Hit World::trace(const Ray& ray, double t_max_m, const std::vector<Primitive>& things, const SectorIndex& index) const {
  Hit best = trace_ground(ray, t_max_m);
  if (!index.empty()) hit_things(ray, things, index, &best);
  return best;
}

// Of ground: heaps and benches lie there, and what stands out from a wall for a while is rock.
Hit World::trace(const Ray& ray, double t_max_m) const {
  Hit best = trace_ground(ray, t_max_m);
  for (const Primitive& place : ground_) {
    double cosine = 1.0;
    const double t = place.hit(ray, &cosine);
    if (t < best.t_m && t < t_max_m) best = {t, cosine, place.label, 0};
  }
  return best;
}

// Surfaces in the order in which the ray comes into their reach; those it reaches after the best hit are not searched.
Hit World::trace_ground(const Ray& ray, double t_max_m) const {
  if (surveyed_) return surveyed_->trace(ray, t_max_m);
  std::array<double, kMostSurfaces> start{};
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const RoadSurface& s = surfaces_[i];
    start[i] = s.surface.enter(ray, std::max(s.surface.relief.reach_m(), s.steel ? rock_.steel_depth_m : 0.0));
  }
  Hit best;
  best.t_m = t_max_m;
  for (;;) {
    const auto* const first = std::min_element(start.begin(), start.begin() + surfaces_.size());
    if (*first >= best.t_m) break;
    const RoadSurface& s = surfaces_[static_cast<std::size_t>(first - start.begin())];
    hit_wall_or_recess(s, ray, s.steel ? s.surface.enter(ray, s.surface.relief.reach_m()) : *first, &best);
    start[static_cast<std::size_t>(first - start.begin())] = kNever;
  }
  if (best.label == Label::kNone) best.t_m = kNever;
  return best;
}

void World::hit_wall_or_recess(const RoadSurface& wall, const Ray& ray, double t_start, Hit* best) const {
  double t = wall.surface.hit(ray, t_start);
  if (t == kNever) return;
  if (wall.side != 0 && !recesses_.empty()) {
    const Vector p = ray.at(t);
    const double s = line_.s_of(p);
    for (const Recess& r : recesses_) {
      if (r.side != wall.side || s <= r.s_from_m || s >= r.s_to_m || p.z() >= r.height_m) continue;
      const Surface* bound = nullptr;
      t = smallest_bound(r, ray, t, best->t_m, &bound);
      if (bound == nullptr) return;
      *best = {t, std::abs(bound->normal(ray.at(t)).dot(ray.direction)), Label::kOpening, wall.side};
      return;
    }
  }
  const double steel = wall.steel ? hit_steel(wall, ray, t) : kNever;
  if (std::min(t, steel) >= best->t_m) return;
  if (steel < t) {
    *best = {steel, 0.7, Label::kSteel, wall.side};
  } else {
    *best = {t, std::abs(wall.surface.normal(ray.at(t)).dot(ray.direction)), wall.label, wall.side};
  }
}

// Ribs of one depth: the ray meets the inner face of one, or the flank of the next one along the road, or none.
double World::hit_steel(const RoadSurface& behind, const Ray& ray, double t_behind) const {
  const double t_face = behind.surface.enter(ray, rock_.steel_depth_m);
  if (t_face >= t_behind) return kNever;
  const Vector p = ray.at(t_face);
  const double s = line_.s_of(p);
  const double from_rib = s - std::round(s / rock_.steel_pitch_m) * rock_.steel_pitch_m;
  const double half = 0.5 * rock_.steel_width_m;
  if (std::abs(from_rib) <= half) return t_face > 0.0 ? t_face : kNever;
  const double advance = line_.tangent(s).dot(ray.direction);
  if (advance == 0.0) return kNever;
  const double next_rib = advance > 0.0 ? (from_rib > 0.0 ? rock_.steel_pitch_m : 0.0) - half - from_rib
                                        : from_rib - half + (from_rib < 0.0 ? rock_.steel_pitch_m : 0.0);
  const double t_flank = t_face + next_rib / std::abs(advance);
  return t_flank < t_behind ? t_flank : kNever;
}

}  // namespace pose_wall::tools::sim
