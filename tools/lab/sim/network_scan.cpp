// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/network_scan.hpp"

#include <cmath>
#include <limits>

#include "lab/sim/pose.hpp"
#include "lab/sim/sensors.hpp"

namespace pose_wall::tools::sim {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr float kNothing = std::numeric_limits<float>::infinity();

template <typename Visit>
void each_beam(const PlanarSensor& sensor, const PlanePose& at, Visit visit) {
  for (int i = 0; i < sensor.beams; ++i) {
    const double angle = at.yaw_rad + sensor.angle_min_rad() + i * sensor.angle_step_rad();
    visit(i, Place(std::cos(angle), std::sin(angle)));
  }
}

class CloudCaster {
 public:
  CloudCaster(const Network& network, const Sensor& sensor, const StandingPose& pose, const CloudScene& scene)
      : network_(network),
        sensor_(sensor),
        scene_(scene),
        origin_(pose.at.x_m, pose.at.y_m, pose.height_m),
        R_world_lidar_(rotation_z(pose.at.yaw_rad) * rotation_y(pose.pitch_rad) * rotation_x(pose.roll_rad)) {}

  struct Met {
    double range_m = kNever;
    double cosine = 1.0;
    Label label = Label::kNone;
  };

  Met meet(const Beam& beam) const {
    const Ray ray{origin_ + R_world_lidar_ * beam.origin, R_world_lidar_ * beam.direction};
    const Met met = meet_road(ray, beam.direction.y());
    const double pillar_m = scene_.pillars.empty() ? kNever : meet_pillars(ray, met.range_m);
    return pillar_m < met.range_m ? Met{pillar_m, 1.0, Label::kObject} : met;
  }

 private:
  Met meet_road(const Ray& ray, double to_left) const {
    const bool looks_down = ray.direction.z() < 0.0;
    const Surface& level = looks_down ? network_.floor() : network_.roof();
    const double reach_m = level.relief.reach_m();
    const double level_from_m = level.enter(ray, reach_m);
    // Below its relief there is nothing more to see of the walls.
    const double end_m = std::min(level.enter(ray, -reach_m - 1e-6), sensor_.range_ceiling_m);
    const Place across(ray.direction.x(), ray.direction.y());
    const double share = across.norm();
    Met met;
    if (share > 1e-9) met = meet_wall(ray, across / share, share, end_m, to_left);
    if (!(level_from_m < std::min(met.range_m, sensor_.range_ceiling_m))) return met;
    const double level_m = reach_m > 0.0 ? level.hit(ray, level_from_m) : level_from_m;
    if (!(level_m < std::min(met.range_m, sensor_.range_ceiling_m))) return met;
    return {level_m, std::abs(ray.direction.z()), looks_down ? Label::kFloor : Label::kRoof};
  }

  Met meet_wall(const Ray& ray, const Place& across, double share, double end_m, double to_left) const {
    const PlaneHit hit = network_.cast({ray.origin.x(), ray.origin.y()}, across, end_m * share);
    if (!std::isfinite(hit.range_m)) return {};
    const WallKind kind = network_.walls()[hit.segment].kind;
    const Label rock = to_left > 0.0 ? Label::kWallLeft : Label::kWallRight;
    const Label label = kind == WallKind::kRock ? rock : (kind == WallKind::kSteel ? Label::kSteel : Label::kObject);
    const Place at(ray.origin.x() + across.x() * hit.range_m, ray.origin.y() + across.y() * hit.range_m);
    const bool is_dark = (at - scene_.dark_at).squaredNorm() < scene_.dark_radius_m * scene_.dark_radius_m;
    return {hit.range_m / share, hit.cosine * share, is_dark ? Label::kNone : label};
  }

  // The nearest pillar up to end_m, or kNever. Their tops are not seen.
  double meet_pillars(const Ray& ray, double end_m) const {
    double best_m = kNever;
    const Place across(ray.direction.x(), ray.direction.y());
    const double share2 = across.squaredNorm();
    if (share2 < 1e-18) return best_m;
    for (const Pillar& pillar : scene_.pillars) {
      const Place to(pillar.at.x() - ray.origin.x(), pillar.at.y() - ray.origin.y());
      const double middle = to.dot(across) / share2;
      const double under = pillar.radius_m * pillar.radius_m - (to - middle * across).squaredNorm();
      if (!(under > 0.0)) continue;
      const double range_m = middle - std::sqrt(under / share2);
      const double z_m = ray.origin.z() + range_m * ray.direction.z();
      if (range_m > 0.0 && range_m < std::min(best_m, end_m) && z_m < pillar.height_m) best_m = range_m;
    }
    return best_m;
  }

  const Network& network_;
  const Sensor& sensor_;
  const CloudScene& scene_;
  Vector origin_;
  Matrix R_world_lidar_;
};

float light_of(const CloudCaster::Met& met) {
  constexpr double kAlbedo = 0.5;
  return static_cast<float>(std::round(255.0 * kAlbedo * (0.2 + 0.8 * std::abs(met.cosine))));
}

}  // namespace

void planar_scan(const Network& network, const PlanarSensor& sensor, const PlanePose& at, std::uint64_t seed,
                 float* ranges) {
  Random random(seed, 0x5ca9);
  const double grazing = std::sin(sensor.grazing_deg * kRadPerDeg);
  each_beam(sensor, at, [&](int i, const Place& direction) {
    const PlaneHit hit = network.cast(at.place(), direction, sensor.range_max_m);
    const double noise_m = sensor.noise_m > 0.0 ? sensor.noise_m * random.gaussian() : 0.0;
    if (random.chance(sensor.dropout)) {
      ranges[i] = kUnknown;
      return;
    }
    if (!std::isfinite(hit.range_m)) {
      ranges[i] = kNothing;
      return;
    }
    double range_m = hit.range_m + noise_m;
    if (sensor.quantum_m > 0.0) range_m = sensor.quantum_m * std::round(range_m / sensor.quantum_m);
    const bool is_seen = hit.cosine >= grazing && range_m >= sensor.range_min_m && range_m <= sensor.range_max_m;
    ranges[i] = is_seen ? static_cast<float>(range_m) : kUnknown;
  });
}

void true_scan(const Network& network, const PlanarSensor& sensor, const PlanePose& at, float* ranges) {
  each_beam(sensor, at, [&](int i, const Place& direction) {
    ranges[i] = static_cast<float>(network.cast(at.place(), direction, sensor.range_max_m).range_m);
  });
}

Frame network_cloud(const Network& network, const Sensor& sensor, const StandingPose& pose, std::uint32_t frame_index,
                    std::uint64_t seed, const CloudScene& scene) {
  const CloudCaster caster(network, sensor, pose, scene);
  Random random(mix(seed) ^ mix(frame_index + 1u)), lost(mix(seed ^ 0x1057u), frame_index);
  const double grazing = std::sin(sensor.grazing_limit_deg * kRadPerDeg);
  Frame frame;
  for (const Beam& beam : beams_of(sensor, frame_index)) {
    const CloudCaster::Met met = caster.meet(beam);
    const double range_m = met.range_m + sensor.range_bias_m + sensor.range_noise_m * random.gaussian();
    if (met.label == Label::kNone || met.cosine < grazing) continue;
    if (scene.dropout > 0.0 && lost.chance(scene.dropout)) continue;
    if (!(range_m >= sensor.range_floor_m && range_m <= sensor.range_ceiling_m)) continue;
    const Vector p = point_of(beam, range_m);
    for (int axis = 0; axis < 3; ++axis) frame.xyz_intensity.push_back(static_cast<float>(p[axis]));
    frame.xyz_intensity.push_back(light_of(met));
    frame.labels.push_back(met.label);
    frame.time_ns.push_back(0);
    frame.ring.push_back(beam.ring);
    frame.column.push_back(beam.step);
  }
  return frame;
}

}  // namespace pose_wall::tools::sim
