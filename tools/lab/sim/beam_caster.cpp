// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/beam_caster.hpp"

#include <algorithm>
#include <cmath>

#include "lab/sim/machine_body.hpp"
#include "lab/sim/sector.hpp"

namespace pose_wall::tools::sim {
namespace {

constexpr double kEdgeStep_m = 0.05;  // ranges nearer to each other than this are one surface
constexpr double kTangentMost = 5.0;  // of 79 degrees: beyond, a pulse is too flat to be found. Judgement, 2026-11-28
constexpr double kRockIntensity = 255.0 * 0.45;  // square on plain rock: as much light as noise is stated for

std::vector<Primitive> things_of(const Setup& setup, const World& world, const Moment& moment) {
  std::vector<Primitive> things = world.objects_at(moment.pose.time_s);
  const std::vector<Primitive> body = machine_body(setup, moment.pose, moment.at);
  things.insert(things.end(), body.begin(), body.end());
  return things;
}

bool within(double time_s, double from_s, double to_s) {
  return time_s >= from_s && time_s < to_s;
}

double dust_at(const Faults& f, double time_s) {
  return f.dust_rise_s > 0.0 ? f.dust * std::clamp(time_s / f.dust_rise_s, 0.0, 1.0) : f.dust;
}

bool has_sectors(const Faults& f) {
  return f.blocked_from_deg != f.blocked_to_deg || f.blocked_2_from_deg != f.blocked_2_to_deg ||
         f.shimmer_from_deg != f.shimmer_to_deg;
}

Matrix R_machine_base(const Machine& machine) {
  Matrix m;
  m << forward_axis(machine).transpose(), left_axis(machine).transpose(), Vector::UnitZ().transpose();
  return m;
}

}  // namespace

float intensity(const Return& r) {
  const double albedo = r.label == Label::kDust ? 0.1 : (r.label == Label::kSteel || r.side == 0 ? 0.6 : 0.45);
  return static_cast<float>(std::min(255.0, std::round(255.0 * albedo * r.brightness * (0.2 + 0.8 * r.cosine))));
}

BeamCaster::BeamCaster(const Setup& setup, const World& world, const Moment& moment, std::uint64_t frame_seed)
    : setup_(setup),
      world_(world),
      random_(frame_seed),
      R_machine_lidar_(R_machine_base(setup.machine) * R_base_lidar(setup.mount)),
      water_below_(normal_quantile(setup.floor.puddle_coverage)),
      grazing_cosine_(std::sin(setup.sensor.grazing_limit_deg * kRadPerDeg)) {
  if (const BeamTable* const table = setup.sensor.beams) {
    lens_reach_m_ = table->reach_m();
    range_ahead_m_ = table->ahead_m();
  }
  move_to(moment);
}

void BeamCaster::move_to(const Moment& moment) {
  const auto& [pose, at] = moment;
  R_road_lidar_ = at.R_road_base * R_base_lidar(setup_.mount);
  origin_ = at.R_road_base * lidar_origin_base(setup_.mount) + at.origin_road;
  left_road_ = at.R_road_base * left_axis(setup_.machine);
  things_ = things_of(setup_, world_, moment);
  index_ = SectorIndex(things_, origin_, lens_reach_m_);
  dust_ = dust_at(setup_.faults, pose.time_s);
  wall_lost_ = within(pose.time_s, setup_.faults.lost_from_s, setup_.faults.lost_to_s);
  partial_ = within(pose.time_s, setup_.sequence.partial_from_s, setup_.sequence.partial_to_s);
  needs_azimuth_ = partial_ || has_sectors(setup_.faults);
}

BeamCaster::Returns BeamCaster::cast(const Beam& beam) {
  const Faults& f = setup_.faults;
  double azimuth_deg = 0.0;
  if (needs_azimuth_) {
    const Vector d = R_machine_lidar_ * beam.direction;
    azimuth_deg = std::atan2(d.y(), d.x()) / kRadPerDeg;
    if (in_sector(azimuth_deg, f.blocked_from_deg, f.blocked_to_deg) ||
        in_sector(azimuth_deg, f.blocked_2_from_deg, f.blocked_2_to_deg) ||
        (partial_ && azimuth_deg + 180.0 > 360.0 * setup_.sequence.partial_share)) {
      return {};
    }
  }
  const Ray ray{origin_ + R_road_lidar_ * beam.origin, R_road_lidar_ * beam.direction};
  Returns returns{meet(ray), {}};
  if (setup_.sensor.divergence_deg > 0.0) mix_edge(ray, &returns);
  const Return behind_dust = through_air(&returns.first);
  measure(azimuth_deg, &returns.first);
  Return& second = returns.second;
  if (second.label != Label::kNone) {
    through_air(&second);
  } else if (setup_.sensor.dual_returns != 0.0) {
    second = behind_dust;
  }
  measure(azimuth_deg, &second);
  return returns;
}

Return BeamCaster::meet(const Ray& ray) {
  const Hit hit = world_.trace(ray, setup_.sensor.range_ceiling_m, things_, index_);
  Return r{hit.t_m, hit.cosine, 1.0, hit.label, hit.side};
  if (world_.is_surveyed() && r.label == Label::kFace) {  // all that is neither floor nor roof
    r.side = left_road_.dot(ray.direction) > 0.0 ? 1 : -1;
    r.label = r.side > 0 ? Label::kWallLeft : Label::kWallRight;
  }
  if (r.label == Label::kNone || r.cosine < grazing_cosine_) return {};
  if (r.label != Label::kObject && r.label != Label::kBody) r.brightness = world_.brightness(ray.at(r.range_m));
  if (r.label == Label::kFloor) return meet_floor(ray, r);
  return r;
}

Return BeamCaster::meet_floor(const Ray& ray, const Return& floor) {
  const Floor& f = setup_.floor;
  if (f.puddle_coverage <= 0.0 || world_.wetness(ray.at(floor.range_m)) >= water_below_) {
    return f.floor_return >= 1.0 || random_.chance(f.floor_return) ? floor : Return{};
  }
  const double draw = random_.uniform();
  if (draw < f.puddle_return) return floor;
  return draw < f.puddle_return + f.puddle_ghost ? mirrored(ray, floor.range_m) : Return{};
}

// Water sends the beam on; the sensor takes the whole way for a straight one, so the point lies below the floor.
Return BeamCaster::mirrored(const Ray& ray, double range_m) const {
  const Vector& up = world_.floor().n;
  const Ray onward{ray.at(range_m), ray.direction - 2.0 * up.dot(ray.direction) * up};
  Hit hit = world_.trace_ground(onward, setup_.sensor.range_ceiling_m - range_m);
  for (const Primitive& thing : things_) {
    double cosine = 1.0;
    const double t = thing.hit(onward, &cosine);
    if (t < hit.t_m) hit = {t, cosine, thing.label, 0};
  }
  if (hit.label == Label::kNone || hit.label == Label::kFloor) return {};
  return {range_m + hit.t_m, hit.cosine, 1.0, Label::kGhost, hit.side};
}

// A second ray near the edge of the beam: at edges, the beam's energy falls on both surfaces.
void BeamCaster::mix_edge(const Ray& ray, Returns* returns) {
  const double spread = 0.5 * setup_.sensor.divergence_deg * kRadPerDeg;
  const Vector nudge(random_.gaussian(), random_.gaussian(), random_.gaussian());
  const Return other = meet({ray.origin, (ray.direction + spread * nudge).normalized()});
  Return& first = returns->first;
  if (other.label == Label::kNone || first.label == Label::kNone) return;
  if (std::abs(other.range_m - first.range_m) < kEdgeStep_m) return;
  if (setup_.sensor.dual_returns != 0.0) {
    returns->second = other;
  } else {
    const double share = random_.uniform();
    first.range_m += share * (other.range_m - first.range_m);
  }
}

bool BeamCaster::lost(const Return& r) {
  const Faults& f = setup_.faults;
  if (random_.chance(f.dropout)) return true;
  if (r.side == 0) return false;
  return (has_side(f.wet_side, r.side) && random_.chance(f.wet_dropout)) ||
         (wall_lost_ && has_side(f.lost_side, r.side));
}

// Dust, drops and lost returns. What was behind the dust is returned.
Return BeamCaster::through_air(Return* r) {
  const Faults& f = setup_.faults;
  Return behind;
  if (r->label != Label::kNone && lost(*r)) *r = {};
  for (const auto& [share, reach_m] : {std::pair{dust_, f.dust_range_m}, std::pair{f.drops, f.drops_range_m}}) {
    if (!random_.chance(share)) continue;
    const double range_m = -reach_m * std::log(1.0 - random_.uniform());
    if (range_m >= r->range_m) continue;
    if (r->label != Label::kDust) behind = *r;
    *r = {range_m, 0.1, 1.0, Label::kDust, 0};
  }
  return behind;
}

double BeamCaster::noise_m(const Return& r, bool shimmer) const {
  const Sensor& s = setup_.sensor;
  double noise_m = s.range_noise_m * (shimmer ? setup_.faults.shimmer_factor : 1.0);
  if (s.noise_dark_most > 1.0) {
    const double light = std::max(1.0, static_cast<double>(intensity(r))) / kRockIntensity;
    noise_m *= std::clamp(1.0 / std::sqrt(light), 1.0, s.noise_dark_most);
  }
  if (s.noise_incidence_m > 0.0 && r.label != Label::kDust) {
    const double tangent = std::sqrt(std::max(0.0, 1.0 - r.cosine * r.cosine)) / r.cosine;
    noise_m = std::hypot(noise_m, s.noise_incidence_m * std::min(tangent, kTangentMost));
  }
  return noise_m;
}

// What the sensor makes of a return: its range holds the way to the lens where it counts from the axis.
void BeamCaster::measure(double azimuth_deg, Return* r) {
  if (r->label == Label::kNone) return;
  const Faults& f = setup_.faults;
  const Sensor& s = setup_.sensor;
  const bool shimmer = needs_azimuth_ && in_sector(azimuth_deg, f.shimmer_from_deg, f.shimmer_to_deg);
  r->range_m += s.range_bias_m + noise_m(*r, shimmer) * random_.gaussian();
  const double steps_m = s.range_quantum_m;
  if (steps_m > 0.0) r->range_m = steps_m * std::round((r->range_m + range_ahead_m_) / steps_m) - range_ahead_m_;
  const double told_m = r->range_m + range_ahead_m_;
  if (!(told_m >= s.range_floor_m && told_m <= s.range_ceiling_m)) *r = {};
}

}  // namespace pose_wall::tools::sim
