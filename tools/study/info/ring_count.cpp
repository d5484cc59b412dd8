// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/info/ring_count.hpp"

#include <algorithm>
#include <cmath>

#include "io/numbers/angles.hpp"
#include "io/numbers/quantile.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kFrames = 8;
// A sector is narrow enough that a cloud tilted by 10 degrees moves a ring by less than a degree within it.
constexpr std::size_t kSectors = 72;
constexpr double kSector_deg = 360.0 / kSectors;
constexpr double kHorizon_deg = 12.0;
constexpr double kFar_m = 3.0, kAcrossMin_m = 0.3;  // nearer returns come from the housing
constexpr std::size_t kPointsMin = 24, kRingsMin = 4, kPointsPerRingMin = 3;
// Gaps between rings are at least this many times as wide as those within one.
constexpr double kJump = 2.5;
constexpr double kSectorsShare = 0.3, kAgree = 0.15;
constexpr double kFullViewShare = 0.75, kNear = 0.06;

struct Sector {
  std::vector<double> horizon_deg;  // elevations of the far points near the horizon
  double low_deg = 90.0, high_deg = -90.0;

  void add(double elevation_deg, double across_m) {
    if (across_m >= kAcrossMin_m) {
      low_deg = std::min(low_deg, elevation_deg);
      high_deg = std::max(high_deg, elevation_deg);
    }
    if (across_m >= kFar_m && std::fabs(elevation_deg) <= kHorizon_deg) horizon_deg.push_back(elevation_deg);
  }
};

// Sorted gaps fall into two kinds, those within a ring and those between two. 0: they do not.
double spacing_in(std::vector<double>& elevations_deg) {
  if (elevations_deg.size() < kPointsMin) return 0.0;
  std::sort(elevations_deg.begin(), elevations_deg.end());
  std::vector<double> gaps_deg;
  for (std::size_t i = 1; i < elevations_deg.size(); ++i) {
    gaps_deg.push_back(elevations_deg[i] - elevations_deg[i - 1]);
  }
  std::sort(gaps_deg.rbegin(), gaps_deg.rend());
  const std::size_t rings_max = elevations_deg.size() / kPointsPerRingMin;
  double jump = kJump;
  std::size_t between = 0;
  for (std::size_t k = kRingsMin - 1; k < rings_max && k < gaps_deg.size(); ++k) {
    const double ratio = gaps_deg[k - 1] / std::max(gaps_deg[k], 1e-6);
    if (ratio < jump) continue;
    jump = ratio;
    between = k;
  }
  if (between == 0) return 0.0;
  // From the middle of a ring to that of the next: the median gap and the thickness of a ring.
  const double least_deg = gaps_deg[between - 1];
  std::vector<double> middles_deg;
  double first_deg = elevations_deg.front();
  for (std::size_t i = 1; i <= elevations_deg.size(); ++i) {
    const bool ends = i == elevations_deg.size() || elevations_deg[i] - elevations_deg[i - 1] >= least_deg;
    if (!ends) continue;
    middles_deg.push_back(0.5 * (first_deg + elevations_deg[i - 1]));
    if (i < elevations_deg.size()) first_deg = elevations_deg[i];
  }
  std::vector<double> steps_deg;
  for (std::size_t i = 1; i < middles_deg.size(); ++i) steps_deg.push_back(middles_deg[i] - middles_deg[i - 1]);
  return quantile(steps_deg, 0.5);
}

}  // namespace

void RingCount::add(const std::vector<float>& xyz_lidar_m) {
  if (frames_ >= kFrames) return;
  ++frames_;
  std::vector<Sector> sectors(kSectors);
  for (std::size_t i = 0; i + 2 < xyz_lidar_m.size(); i += 3) {
    const double x = static_cast<double>(xyz_lidar_m[i]), y = static_cast<double>(xyz_lidar_m[i + 1]);
    const double z = static_cast<double>(xyz_lidar_m[i + 2]), across = std::hypot(x, y);
    const double azimuth_deg = std::atan2(y, x) * kDegPerRad + 180.0;
    const auto index = std::min(static_cast<std::size_t>(azimuth_deg / kSector_deg), kSectors - 1);
    sectors[index].add(std::atan2(z, across) * kDegPerRad, across);
  }
  for (Sector& sector : sectors) {
    if (sector.horizon_deg.size() < kPointsMin) continue;
    ++sectors_;
    views_deg_.push_back(sector.high_deg - sector.low_deg);
    const double spacing_deg = spacing_in(sector.horizon_deg);
    if (spacing_deg > 0.0) spacings_deg_.push_back(spacing_deg);
  }
}

double RingCount::spacing_deg() const {
  const double needed = kSectorsShare * static_cast<double>(sectors_);
  if (spacings_deg_.empty() || static_cast<double>(spacings_deg_.size()) < needed) return 0.0;
  const double middle_deg = quantile(spacings_deg_, 0.5);
  const auto agrees = [middle_deg](double deg) { return std::fabs(deg - middle_deg) <= kAgree * middle_deg; };
  const auto agree = std::count_if(spacings_deg_.begin(), spacings_deg_.end(), agrees);
  return 2 * static_cast<std::size_t>(agree) >= spacings_deg_.size() ? middle_deg : 0.0;
}

std::size_t RingCount::rings() const {
  const double spacing = spacing_deg();
  if (!(spacing > 0.0)) return 0;
  // Not every sector answers all rings.
  const double rings = quantile(views_deg_, kFullViewShare) / spacing + 1.0;
  for (const double known : {16.0, 32.0, 40.0, 64.0, 80.0, 128.0}) {
    if (std::fabs(rings - known) <= kNear * known) return static_cast<std::size_t>(known);
  }
  return 0;
}

}  // namespace pose_wall::tools
