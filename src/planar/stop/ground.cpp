// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/ground.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace pose_wall::planar {
namespace {

constexpr std::uint32_t kLeast = 60;                      // with fewer on it the floor was not seen
constexpr std::uint32_t kEnough = FloorLooks::kMost / 2;  // looks about the floor, of which most may be no floor
constexpr double kAround_m = 6.0;                         // from the sensor: what the sweep needs
// Gates of the rounds, above the plane (below it twice as wide: things stand on floors):
constexpr double kGates_m[] = {0.20, 0.12, 0.08, 0.06};
// How well the machine's own plane is known, as so many points of the last gate:
constexpr double kPriorHeight = 40.0, kPriorSlope = 160.0;

// Sums of the normal equations about the machine's plane.
struct Sums {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  std::uint32_t count = 0;
};

double within(double value, double most) {
  return value > most ? most : value < -most ? -most : value;
}

void look(const Rays& rays, const Mount& mount, const StopSettings& settings, FloorLooks* looks) {
  constexpr std::uint32_t kLooks = FloorLooks::kMost;  // room for as many
  looks->count = 0;
  // Odd: no ring of an even number is passed over. A level sensor has few rays on the floor nearby: then it looks again
  // between its looks.
  constexpr std::uint64_t kPasses = 4;
  const std::uint64_t stride = (rays.points() / kLooks + 1) | 1U;
  const auto sx = static_cast<float>(mount.sensor_base_m.x()), sy = static_cast<float>(mount.sensor_base_m.y());
  const auto sz = static_cast<float>(mount.sensor_base_m.z() - settings.floor_z_m);
  const float slope = static_cast<float>(settings.slope_max_rad), first = static_cast<float>(kGates_m[0]);
  const auto look_at = [&](std::uint64_t i) {
    float x, y, z;
    if (!rays.one(i, &x, &y, &z)) return;
    const float r2 = x * x + y * y, z_above = z + sz;
    if (!(r2 < static_cast<float>(kAround_m * kAround_m))) return;
    const float room = first + slope * std::sqrt(r2) + slope * 2.0F;
    if (!(z_above > -room && z_above < room)) return;
    looks->x[looks->count] = x + sx, looks->y[looks->count] = y + sy, looks->z[looks->count] = z_above;
    ++looks->count;
  };
  for (std::uint64_t pass = 0; pass < kPasses && looks->count < kEnough; ++pass) {
    for (std::uint64_t i = pass * stride / kPasses; i < rays.points() && looks->count < kLooks; i += stride) look_at(i);
  }
}

Sums sums_within(const FloorLooks& looks, const Eigen::Vector3d& plane, double gate_m) {
  Sums sums;
  sums.A.diagonal() << kPriorHeight, kPriorSlope, kPriorSlope;
  for (std::uint32_t i = 0; i < looks.count; ++i) {
    const double x = static_cast<double>(looks.x[i]), y = static_cast<double>(looks.y[i]);
    const double z = static_cast<double>(looks.z[i]), off = z - (plane[0] + plane[1] * x + plane[2] * y);
    if (!(off < gate_m && off > -2.0 * gate_m)) continue;
    const Eigen::Vector3d row(1.0, x, y);
    sums.A += row * row.transpose();
    sums.b += row * z;
    ++sums.count;
  }
  return sums;
}

}  // namespace

Ground find_ground(const Rays& rays, const Mount& mount, const StopSettings& settings, FloorLooks* looks) {
  look(rays, mount, settings, looks);
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  std::uint32_t count = 0;
  for (const double gate_m : kGates_m) {
    const Sums sums = sums_within(*looks, plane, gate_m + (gate_m == kGates_m[0] ? settings.slope_max_rad : 0.0));
    count = sums.count;
    plane = sums.A.ldlt().solve(sums.b);
    plane[0] = within(plane[0], settings.floor_band_m);
    plane[1] = within(plane[1], settings.slope_max_rad);
    plane[2] = within(plane[2], settings.slope_max_rad);
  }
  Ground ground;
  ground.seen = count >= kLeast && plane.allFinite();
  ground.height_m = settings.floor_z_m;
  if (!ground.seen) return ground;
  ground.height_m += plane[0];
  ground.slope_x = plane[1];
  ground.slope_y = plane[2];
  return ground;
}

}  // namespace pose_wall::planar
