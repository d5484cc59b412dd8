// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The error of a beam on rough walls, against the same rays without noise.

#pragma once

#include "planar/scan_campaign.hpp"

namespace pose_wall::test {

struct Errors {
  std::uint64_t count = 0;
  double sum = 0.0, sum2 = 0.0;
  void add(double e) { ++count, sum += e, sum2 += e * e; }
  double mean() const { return sum / static_cast<double>(count); }
  double sd() const { return std::sqrt(std::max(0.0, sum2 / static_cast<double>(count) - mean() * mean())); }
};

struct WallErrors {
  static constexpr int kBins = 4;
  static int bin_of(double range_m) { return range_m < 3.0 ? 0 : range_m < 6.0 ? 1 : range_m < 10.0 ? 2 : 3; }
  static const char* name(int bin) {
    static const char* const names[kBins] = {"2-3", "3-6", "6-10", "10-15"};
    return names[bin];
  }
  struct Cell {
    Errors ours, from_mean, minimum;
  };
  Cell cells[kBins];
};

// The rule of pointcloud_to_laserscan and of the document: the nearest return of a beam with the heights of the
// sensor's own axes. Here the band is told apart by the true floor, so that only the rule of the range is compared.
inline void measure_walls(const RingSensor& sensor, double rough_m, std::uint64_t seed, WallErrors* errors) {
  SceneDraw draw(seed);
  RoadScene road;
  road.height_m = draw.between(1.2, 1.8);
  road.left_m = draw.between(2.2, 2.8), road.right_m = draw.between(2.2, 2.8);
  road.ahead_m = road.behind_m = 40.0;
  road.roll_rad = draw.between(-0.05, 0.05), road.pitch_rad = draw.between(-0.05, 0.05);
  road.yaw_rad = draw.between(-0.2, 0.2);
  road.noise_m = sensor.noise_m;
  road.rough_m = rough_m;
  const WallRelief relief(seed);
  const SeenScene seen = see(road, sensor, rays_of(sensor, seed), seed, &relief);
  pose_wall_config config = config_with();
  set(&config, "extrinsic_roll", sensor.mount_roll_rad);
  set(&config, "range_noise", sensor.noise_m);
  const pose_wall_planar_scanner_settings settings = scan_settings();
  ScannerUnderTest scanner(config, settings);
  pose_wall_planar_floor floor = floor_of(road, 1e-5, &draw);
  floor.reach_m = 100.0;  // the whole band at all ranges
  scanner.process(cloud_of(seen.points, 0), &floor);
  const Eigen::Matrix3d R_base_lidar = rotation_zyx(sensor.mount_roll_rad, 0.0, 0.0);
  const Eigen::Matrix3d R = rotation_zyx(road.roll_rad, road.pitch_rad, 0.0) * R_base_lidar;
  struct Beam {
    std::vector<double> clean;
    double least_noisy = 1e9;
  };
  std::vector<Beam> beams(scanner.scan().beams);
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    const auto& q = seen.points[i];
    const Eigen::Vector3d p =
        R * Eigen::Vector3d(static_cast<double>(q[0]), static_cast<double>(q[1]), static_cast<double>(q[2]));
    const double z = p.z() + road.height_m;
    if (z < settings.ground_clearance_m - settings.margin_m + 0.02) continue;
    if (z > settings.machine_height_m + settings.margin_m - 0.02) continue;
    const std::uint32_t beam = scanner.beam_at(std::atan2(p.y(), p.x()));
    if (beam >= beams.size()) continue;
    beams[beam].clean.push_back(static_cast<double>(seen.range_free_m[i]));
    beams[beam].least_noisy = std::min(beams[beam].least_noisy, std::hypot(p.x(), p.y()));
  }
  for (std::uint32_t b = 0; b < beams.size(); ++b) {
    std::vector<double>& clean = beams[b].clean;
    const auto ours = static_cast<double>(scanner.scan().range_m[b]);
    if (clean.empty() || !std::isfinite(ours) || scanner.view().returns[b] == 0) continue;
    std::sort(clean.begin(), clean.end());
    if (clean.back() > 15.0 || clean.back() - clean.front() > 0.5) continue;
    const std::size_t n = scanner.view().returns[b], rank = n < 4 ? 0 : n < 8 ? 1 : n < 16 ? 2 : 3;
    const std::size_t k = std::min(rank, clean.size() - 1);
    double mean = 0.0;
    for (const double c : clean) mean += c / static_cast<double>(clean.size());
    WallErrors::Cell& cell = errors->cells[WallErrors::bin_of(clean.front())];
    cell.ours.add(ours - clean[k]);
    cell.from_mean.add(ours - mean);
    cell.minimum.add(beams[b].least_noisy - clean.front());
  }
}

struct FalseThings {
  std::uint64_t beams = 0, ours = 0, beams_by_axes = 0, by_axes = 0;
};

// Beams that end at the floor or the roof of a plain road, within the range of the scan, on a machine that is tilted by
// so much; ours, and with the document's heights counted from the sensor along its own axes.
inline void count_false_things(const RingSensor& sensor, double tilt_rad, std::uint64_t seed, FalseThings* counts) {
  SceneDraw draw(seed);
  RoadScene road;
  const double way_rad = draw.between(-M_PI, M_PI);
  road.roll_rad = tilt_rad * std::cos(way_rad), road.pitch_rad = tilt_rad * std::sin(way_rad);
  road.noise_m = sensor.noise_m;
  const SeenScene seen = see(road, sensor, rays_of(sensor, seed), seed);
  const pose_wall_planar_scanner_settings settings = scan_settings();
  pose_wall_config config = config_with();
  set(&config, "extrinsic_roll", sensor.mount_roll_rad);
  ScannerUnderTest scanner(config, settings);
  const pose_wall_planar_floor floor = floor_of(road, kCampaignTilt_rad, &draw);
  scanner.process(cloud_of(seen.points, 0), &floor);
  std::vector<double> by_axes(scanner.scan().beams, 1e9);
  const Eigen::Matrix3d R = rotation_zyx(sensor.mount_roll_rad, 0.0, 0.0);
  for (const auto& q : seen.points) {
    const Eigen::Vector3d p =
        R * Eigen::Vector3d(static_cast<double>(q[0]), static_cast<double>(q[1]), static_cast<double>(q[2]));
    const double low = -(road.height_m - settings.ground_clearance_m + settings.margin_m);
    if (p.z() < low || p.z() > settings.machine_height_m - road.height_m + settings.margin_m) continue;
    double& least = by_axes[scanner.beam_at(std::atan2(p.y(), p.x()))];
    least = std::min(least, std::hypot(p.x(), p.y()));
  }
  for (std::uint32_t b = 0; b < scanner.scan().beams; ++b) {
    const double a = scanner.angle_of(b), s = std::fabs(std::sin(a)), c = std::fabs(std::cos(a));
    const double wall_m = std::min(road.left_m / std::max(s, 1e-9), road.ahead_m / std::max(c, 1e-9));
    const double short_m = wall_m - 0.3 - 0.05 * wall_m;
    if (std::isfinite(scanner.scan().range_m[b])) ++counts->beams;
    if (by_axes[b] < 1e9) ++counts->beams_by_axes;
    if (static_cast<double>(scanner.scan().range_m[b]) < short_m) ++counts->ours;
    if (by_axes[b] < short_m) ++counts->by_axes;
  }
}

}  // namespace pose_wall::test
