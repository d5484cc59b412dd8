// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/truth/cramer_rao.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

#include "io/config_file/resolved_frames.hpp"
#include "io/frames/point_position.hpp"

namespace pose_wall::tools {
namespace {

enum Parameter { kRoll, kPitch, kFloor, kYaw, kLean, kWall = kLean + 2 };
enum Surface { kFloorPlane, kLeftPlane, kRightPlane, kSurfaces };

// Of the numerical derivatives, rad or m: rounding and curvature both stay below 1e-9 of them.
constexpr double kStep = 1e-5;
// Below this the information is singular but for rounding.
constexpr double kPivotMin = 1e-12;

Eigen::Vector3d vector_of(const Vector3& v) {
  return {v[0], v[1], v[2]};
}

Eigen::Matrix3d level_of(double roll_rad, double pitch_rad) {
  return (Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

// Next to a wall. False for a wall that is not there: its distance is NaN.
bool at_foot(const Eigen::Matrix<double, 4, 3>& planes, const Eigen::Vector4d& point) {
  return planes.col(kLeftPlane).dot(point) < CramerRao::kFoot_m ||
         planes.col(kRightPlane).dot(point) < CramerRao::kFoot_m;
}

// Levelled frame.
Eigen::Vector3d along_road(const Eigen::Vector3d& forward_level, double yaw_rad) {
  const Eigen::Vector3d ahead = Eigen::Vector3d(forward_level.x(), forward_level.y(), 0.0).normalized();
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * ahead;
}

// Towards the machine, in the levelled frame; side 0 is left.
Eigen::Vector3d wall_normal(const Eigen::Vector3d& forward_level, double yaw_rad, double lean_rad, int side) {
  const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(along_road(forward_level, yaw_rad));
  return std::cos(lean_rad) * (side == 0 ? -left : left) + std::sin(lean_rad) * Eigen::Vector3d::UnitZ();
}

}  // namespace

// Derivatives by the parameters: of each plane's normal and distance, and of the quantities.
struct CramerRao::Slopes {
  std::array<Eigen::Matrix<double, 4, kParameters>, kSurfaces> planes;
  Eigen::Matrix<double, kTruthQuantities, kParameters> quantities;
};

struct CramerRao::Gathered {
  Information information = Information::Zero();
  std::array<std::size_t, kSurfaces> points{};
  double squares = 0.0;  // of residuals in units of their standard deviation

  void add(std::size_t surface, const Parameters& slope, double residual_m, double sigma_m) {
    information += slope * slope.transpose() / (sigma_m * sigma_m);
    squares += residual_m * residual_m / (sigma_m * sigma_m);
    ++points[surface];
  }
};

CramerRao::CramerRao(const api::Config& config, double range_noise_m)
    : range_noise_m_(range_noise_m),
      mount_(config),
      wall_z_min_m_(config.number("wall_z_min")),
      wall_z_max_m_(config.number("wall_z_max")) {
  const ResolvedFrames frames = resolve_frames(config);
  forward_base_ = vector_of(frames.forward_base);
  for (std::size_t i = 0; i < samples_base_m_.size(); ++i) {
    samples_base_m_[i] = vector_of(frames.sampling_points_base_m[i]);
  }
}

CramerRao::Parameters CramerRao::parameters_of(const std::array<double, kTruthQuantities>& truth,
                                               double floor_distance_m) const {
  Parameters p = Parameters::Zero();
  p[kRoll] = truth[POSE_WALL_ROLL];
  p[kPitch] = truth[POSE_WALL_PITCH];
  p[kFloor] = floor_distance_m;
  p[kYaw] = truth[POSE_WALL_YAW];
  const Eigen::Matrix3d level = level_of(p[kRoll], p[kPitch]);
  for (int side = 0; side < 2; ++side) {
    const Eigen::Vector3d n = wall_normal(level * forward_base_, p[kYaw], 0.0, side);
    const auto front = 2 * static_cast<std::size_t>(side);
    p[kWall + side] = truth[POSE_WALL_D_LF + front] - n.dot(level * samples_base_m_[front]);
  }
  return p;
}

CramerRao::Planes CramerRao::planes_of(const Parameters& p) const {
  const Eigen::Matrix3d level = level_of(p[kRoll], p[kPitch]);
  Planes planes;
  planes.col(kFloorPlane) << level.transpose() * Eigen::Vector3d::UnitZ(), p[kFloor];
  for (int side = 0; side < 2; ++side) {
    const Eigen::Vector3d n_level = wall_normal(level * forward_base_, p[kYaw], p[kLean + side], side);
    planes.col(kLeftPlane + side) << level.transpose() * n_level, p[kWall + side];
  }
  return planes;
}

CramerRao::Quantities CramerRao::quantities_of(const Parameters& p) const {
  const Planes planes = planes_of(p);
  Quantities q;
  q.head<3>() << p[kRoll], p[kPitch], p[kYaw];
  for (int i = 0; i < 4; ++i) {
    const auto plane = planes.col(kLeftPlane + i / 2);
    q[POSE_WALL_D_LF + i] = plane.head<3>().dot(samples_base_m_[static_cast<std::size_t>(i)]) + plane[3];
  }
  return q;
}

CramerRao::Slopes CramerRao::slopes_at(const Parameters& p) const {
  Slopes slopes;
  for (int k = 0; k < kParameters; ++k) {
    const Parameters step = kStep * Parameters::Unit(k);
    const Planes planes = (planes_of(p + step) - planes_of(p - step)) / (2.0 * kStep);
    for (int s = 0; s < kSurfaces; ++s) slopes.planes[static_cast<std::size_t>(s)].col(k) = planes.col(s);
    slopes.quantities.col(k) = (quantities_of(p + step) - quantities_of(p - step)) / (2.0 * kStep);
  }
  return slopes;
}

CramerRao::Gathered CramerRao::gather(const pose_wall_cloud& cloud, const Parameters& parameters, const Slopes& slopes,
                                      const View& view) const {
  const Planes planes = planes_of(parameters);
  const Eigen::Matrix3d level = level_of(parameters[kRoll], parameters[kPitch]);
  const Eigen::Vector3d along_base = level.transpose() * along_road(level * forward_base_, parameters[kYaw]);
  const auto in_view = [&](int surface, const Eigen::Vector3d& p, double height_m) {
    if (surface == kFloorPlane) return p.head<2>().norm() <= view.floor_radius_m;
    const auto& span_m = view.wall_span_m[static_cast<std::size_t>(surface - kLeftPlane)];
    const double along_m = along_base.dot(p);
    return height_m >= wall_z_min_m_ && height_m <= wall_z_max_m_ && along_m >= span_m[0] && along_m <= span_m[1];
  };
  Gathered gathered;
  for (std::uint32_t i = 0; i < cloud.width * cloud.height; ++i) {
    const Eigen::Vector3d ray_m = mount_.R_base_lidar() * point_position(cloud, i / cloud.width, i % cloud.width);
    const Eigen::Vector3d p = ray_m + mount_.position_base_m();
    if (!mount_.is_used(ray_m.norm(), p)) continue;
    const Eigen::Vector4d point(p.x(), p.y(), p.z(), 1.0);
    const double height_m = planes.col(kFloorPlane).dot(point);
    for (int s = 0; s < kSurfaces; ++s) {
      const double residual_m = planes.col(s).dot(point);
      const double sigma_m = range_noise_m_ * std::abs(planes.col(s).head<3>().dot(ray_m.normalized()));
      if (!(sigma_m > 0.0) || !(std::abs(residual_m) <= kGateInSigmas * sigma_m) || !in_view(s, p, height_m)) continue;
      if (s == kFloorPlane && at_foot(planes, point)) continue;
      gathered.add(static_cast<std::size_t>(s), slopes.planes[static_cast<std::size_t>(s)].transpose() * point,
                   residual_m, sigma_m);
    }
  }
  return gathered;
}

FrameBound CramerRao::bound(const pose_wall_cloud& cloud, const std::array<double, kTruthQuantities>& truth,
                            const View& view) const {
  const Parameters parameters = parameters_of(truth, view.floor_distance_m);
  const Slopes slopes = slopes_at(parameters);
  Gathered gathered = gather(cloud, parameters, slopes, view);

  FrameBound out;
  out.floor_points = gathered.points[kFloorPlane];
  out.wall_points = {gathered.points[kLeftPlane], gathered.points[kRightPlane]};
  const auto all = static_cast<double>(out.floor_points + out.wall_points[0] + out.wall_points[1]);
  out.noise_ratio = std::sqrt(gathered.squares / all);
  // What no point tells of stands by itself and is given no bound below.
  const std::size_t walls = out.wall_points[0] + out.wall_points[1];
  Information& information = gathered.information;
  if (walls == 0) information(kYaw, kYaw) = 1.0;
  for (int side = 0; side < 2; ++side) {
    if (out.wall_points[static_cast<std::size_t>(side)] > 0) continue;
    information(kLean + side, kLean + side) = 1.0;
    information(kWall + side, kWall + side) = 1.0;
  }
  const Parameters scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Information> solver(scale.asDiagonal() * information * scale.asDiagonal());
  if (!(solver.vectorD().minCoeff() > kPivotMin)) return out;
  const Information covariance = scale.asDiagonal() * solver.solve(Information::Identity()) * scale.asDiagonal();
  for (int q = 0; q < static_cast<int>(kTruthQuantities); ++q) {
    const bool of_wall = q >= POSE_WALL_D_LF;
    const bool seen = of_wall ? out.wall_points[static_cast<std::size_t>(q - POSE_WALL_D_LF) / 2] > 0 : true;
    if (!seen || (q == POSE_WALL_YAW && walls == 0)) continue;
    const auto slope = slopes.quantities.row(q);
    out.sigma[static_cast<std::size_t>(q)] = std::sqrt((slope * covariance * slope.transpose()).value());
  }
  return out;
}

}  // namespace pose_wall::tools
