// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/doctor/range_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <unordered_map>

#include "io/numbers/angles.hpp"
#include "study/doctor/statistics.hpp"

namespace pose_wall::tools::doctor {
namespace {

constexpr double kNotMeasured_m = std::numeric_limits<double>::quiet_NaN();
constexpr double kDirection_deg = 0.1;
constexpr double kSameSurface_m = 0.25;
constexpr std::size_t kPairs = 6;
constexpr double kRepeatedShareMin = 0.25;
// Patches of a plane, small enough that rock is nearly flat within one.
constexpr double kPatch_m = 0.3;
constexpr std::size_t kPatchPointsMin = 8;

using Ranges = std::unordered_map<std::uint32_t, float>;

// Farther than the first of a direction none is taken: two returns of one beam are two surfaces.
Ranges ranges_of(const KeptFrame& frame) {
  Ranges ranges;
  ranges.reserve(frame.count());
  for (std::size_t i = 0; i < frame.count(); ++i) {
    const Eigen::Vector3d p = frame.point(i);
    const double range = p.norm();
    if (!(range > 0.5 && range < 30.0)) continue;
    const auto azimuth = static_cast<std::uint32_t>((std::atan2(p.y(), p.x()) * kDegPerRad + 180.0) / kDirection_deg);
    const auto elevation = static_cast<std::uint32_t>(
        (std::asin(std::clamp(p.z() / range, -1.0, 1.0)) * kDegPerRad + 90.0) / kDirection_deg);
    ranges.emplace(azimuth * 2048U + elevation, static_cast<float>(range));
  }
  return ranges;
}

void by_repetition(const std::vector<KeptFrame>& frames, RangeNoise& noise) {
  noise.repeated_m = kNotMeasured_m;
  std::vector<double> differences_m;
  std::size_t looked = 0, again = 0;
  for (std::size_t k = 0; k < kPairs; ++k) {
    const std::size_t f = k * frames.size() / kPairs;
    if (f + 1 >= frames.size()) break;
    const Ranges before = ranges_of(frames[f]), after = ranges_of(frames[f + 1]);
    looked += before.size();
    for (const auto& [direction, range] : before) {
      const auto found = after.find(direction);
      if (found == after.end()) continue;
      ++again;
      const double difference_m = static_cast<double>(found->second) - static_cast<double>(range);
      if (std::fabs(difference_m) < kSameSurface_m) differences_m.push_back(difference_m);
    }
  }
  noise.repeated_share = share(again, looked);
  if (noise.repeated_share >= kRepeatedShareMin && differences_m.size() >= 500) {
    noise.repeated_m = robust_sigma(differences_m) / std::sqrt(2.0);
  }
}

struct PatchPoint {
  double off_m;   // from the plane
  double cosine;  // between ray and plane's normal: an error along the ray shows by so much
};

// One frame's points near the two walls and the floor, by patch. Road coordinates.
using Patches = std::map<std::array<int, 3>, std::vector<PatchPoint>>;

void add_to_patches(Patches& patches, const Eigen::Vector3d& p, const Eigen::Vector3d& sensor, const RoadAxis& road) {
  const Eigen::Vector3d ray = (p - sensor).normalized();
  const auto patch = [](double m) { return static_cast<int>(std::floor(m / kPatch_m)); };
  const auto add = [&](int surface, double off_m, double cosine, double a, double b) {
    // Flatter rays tell more of the rock than of the range.
    if (std::fabs(off_m) < 0.15 && std::fabs(cosine) > 0.5) {
      patches[{surface, patch(a), patch(b)}].push_back({off_m, std::fabs(cosine)});
    }
  };
  if (p.z() > 0.3 && p.z() < 2.5) {
    if (std::isfinite(road.left_m)) add(0, p.y() - road.left_m, ray.y(), p.x(), p.z());
    if (std::isfinite(road.right_m)) add(1, p.y() + road.right_m, ray.y(), p.x(), p.z());
  }
  add(2, p.z(), ray.z(), p.x(), p.y());
}

void by_planes(const std::vector<KeptFrame>& frames, const RoadFrame& frame, const RoadAxis& road, RangeNoise& noise) {
  const Eigen::Vector3d sensor = frame.of_base(frame.mount().position_base_m());
  std::vector<double> scaled_m;
  for (std::size_t k = 0; k < kPairs && k < frames.size(); ++k) {
    const KeptFrame& kept = frames[k * frames.size() / std::min(kPairs, frames.size())];
    Patches patches;
    for (std::size_t i = 0; i < kept.count(); ++i) {
      add_to_patches(patches, frame.of_lidar(kept.point(i)), sensor, road);
    }
    for (const auto& [where, points] : patches) {
      if (points.size() < kPatchPointsMin) continue;
      std::vector<double> off_m;
      off_m.reserve(points.size());
      for (const PatchPoint& point : points) off_m.push_back(point.off_m);
      const double middle_m = median(off_m);
      for (const PatchPoint& point : points) scaled_m.push_back((point.off_m - middle_m) / point.cosine);
    }
  }
  noise.plane_m = scaled_m.size() >= 300 ? robust_sigma(scaled_m) : kNotMeasured_m;
}

}  // namespace

RangeNoise look_at_noise(const std::vector<KeptFrame>& frames, const RoadFrame& frame, const RoadAxis& road) {
  RangeNoise noise;
  by_repetition(frames, noise);
  by_planes(frames, frame, road, noise);
  return noise;
}

}  // namespace pose_wall::tools::doctor
