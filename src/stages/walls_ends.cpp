// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/walls_ends.hpp"

#include <cmath>

namespace pose_wall {
namespace {

// Half-metre places along the plane, from the one beside the sensor outwards.
constexpr std::uint32_t kPlaces = 30;
constexpr double kPlace_m = 0.5;
// An end beyond this place (6 m) is not near.
constexpr std::uint32_t kNearPlaces = 12;
constexpr double kOnMin = 2.0;
constexpr double kPastMin = 4.0;
// So many points up to this far behind the plane, within so many places of its end, are its own bend.
constexpr double kBend_m = 0.5;
constexpr std::uint32_t kBendPlaces = 4;
constexpr double kBendMin = 4.0;

// Measured points by place.
struct End {
  double on[kPlaces] = {}, past[kPlaces] = {}, just_behind[kPlaces] = {};

  bool is_looked_past() const {
    std::uint32_t beyond = 0;  // the first place behind the last that has anything on the plane
    for (std::uint32_t k = 0; k < kPlaces; ++k) beyond = on[k] > kOnMin && on[k] > past[k] ? k + 1 : beyond;
    double passing = 0.0, bending = 0.0;
    for (std::uint32_t k = beyond; k < kPlaces; ++k) {
      passing += past[k];
      bending += k < beyond + kBendPlaces ? just_behind[k] : 0.0;
    }
    return beyond > 0 && beyond <= kNearPlaces && passing >= kPastMin && bending < kBendMin;
  }
};

class Ends {
 public:
  double* on(double along_m) { return place(along_m, &End::on); }
  double* past(double along_m) { return place(along_m, &End::past); }
  double* just_behind(double along_m) { return place(along_m, &End::just_behind); }
  bool both_are_looked_past() const { return end_[0].is_looked_past() && end_[1].is_looked_past(); }

 private:
  // What lies too far away is counted where nobody looks.
  double* place(double along_m, double (End::*places)[kPlaces]) {
    const double place = std::fabs(along_m) / kPlace_m;
    if (!(place < kPlaces)) return &elsewhere_;
    return &(end_[along_m < 0.0 ? 0 : 1].*places)[static_cast<std::uint32_t>(place)];
  }

  End end_[2];
  double elsewhere_ = 0.0;
};

}  // namespace

bool is_island(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, double margin_m) {
  const Eigen::Vector3d& sensor = scene.sensor_level_m;
  const double inside_m = wall.signed_distance(sensor);
  if (!(inside_m > 0.0)) return false;
  Ends ends;
  for (std::uint32_t i = 0; i < scene.cloud_base.count; ++i) {
    const Eigen::Vector3d ray = scene.R_level_base * scene.cloud_base.at(i) - sensor;
    const double r = inside_m + wall.n.dot(ray), weight = static_cast<double>(scene.cloud_base.weight[i]);
    if (r > margin_m) continue;
    const bool point_in_band = scene.in_band(sensor.z() + ray.z());
    if (r >= -margin_m && point_in_band) {
      *ends.on(along_level.dot(ray)) += weight;
      continue;
    }
    if (r > -kBend_m && point_in_band) *ends.just_behind(along_level.dot(ray)) += weight;
    // Rays to the floor right behind the plane pass it too.
    const double to_plane = r < 0.0 ? way_to_plane(inside_m, r) : 0.0;
    if (r < 0.0 && scene.in_band(sensor.z() + to_plane * ray.z()))
      *ends.past(to_plane * along_level.dot(ray)) += weight;
  }
  return ends.both_are_looked_past();
}

}  // namespace pose_wall
