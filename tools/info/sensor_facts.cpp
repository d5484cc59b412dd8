// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What kind of sensor a frame looks like: how many rings, how high and how far round it sees.

#include <algorithm>
#include <cmath>
#include <vector>

#include "angles.hpp"
#include "frames/field_value.hpp"
#include "frames/told_rings.hpp"
#include "info/input_facts.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kElevationBinsPerDeg = 20.0;
constexpr double kRangeMin_m = 1.0;  // nearer, offsets between lasers and origin bend the rings
constexpr std::size_t kRingsByElevationMax = 128;
constexpr std::size_t kMid360PointsMax = 40000;  // two frames of a tenth of a second

struct Directions {
  std::vector<std::size_t> elevations =
      std::vector<std::size_t>(static_cast<std::size_t>(180 * kElevationBinsPerDeg) + 1);
  std::vector<bool> azimuths = std::vector<bool>(360);
  std::size_t count = 0;
};

Directions directions_of(const pose_wall_cloud& cloud) {
  Directions directions;
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    for (std::uint32_t column = 0; column < cloud.width; ++column) {
      const double x_m = field_value(cloud, row, column, cloud.x);
      const double y_m = field_value(cloud, row, column, cloud.y);
      const double z_m = field_value(cloud, row, column, cloud.z);
      const double range_m = std::hypot(x_m, y_m, z_m);
      if (!(range_m >= kRangeMin_m && range_m < 1e6)) continue;
      const double elevation_deg = std::atan2(z_m, std::hypot(x_m, y_m)) * kDegPerRad;
      const double azimuth_deg = std::atan2(y_m, x_m) * kDegPerRad;
      ++directions.elevations[static_cast<std::size_t>((elevation_deg + 90.0) * kElevationBinsPerDeg)];
      directions.azimuths[static_cast<std::size_t>(azimuth_deg + 360.0) % 360] = true;
      ++directions.count;
    }
  }
  return directions;
}

double elevation_at_share(const Directions& directions, double share) {
  const auto wanted = static_cast<std::size_t>(share * static_cast<double>(directions.count - 1));
  std::size_t below = 0;
  std::size_t bin = 0;
  while (below + directions.elevations[bin] <= wanted) below += directions.elevations[bin++];
  return (static_cast<double>(bin) + 0.5) / kElevationBinsPerDeg - 90.0;
}

// Rings of a sensor whose frame was not tilted: elevations in narrow groups with nothing between them.
std::size_t rings_by_elevation(const Directions& directions) {
  const std::size_t noise = directions.count / 20'000;
  std::size_t groups = 0;
  std::size_t filled = 0;
  bool inside = false;
  for (const std::size_t count : directions.elevations) {
    const bool occupied = count > noise;
    if (occupied) ++filled;
    if (occupied && !inside) ++groups;
    inside = occupied;
  }
  return groups >= 4 && groups <= kRingsByElevationMax && filled <= 4 * groups ? groups : 0;
}

void find_rings(const Frame& frame, const Directions& directions, SensorFacts& facts) {
  const ToldRings told = told_rings(frame);
  facts.rings = told.count > 0 ? told.count : rings_by_elevation(directions);
  facts.rings_by = told.count == 0 && facts.rings > 0 ? "elevations" : told.by;
}

std::string guess_of(const SensorFacts& facts, const Directions& directions) {
  const double view_deg = facts.elevation_max_deg - facts.elevation_min_deg;
  const bool all_round = facts.azimuth_span_deg > 300.0;
  if (!all_round) return facts.azimuth_span_deg > 200.0 ? "wide, not all round" : "looks one way, not all round";
  if (facts.rings == 0) {
    const bool as_mid360 = view_deg > 40.0 && view_deg < 66.0 && directions.count < kMid360PointsMax;
    return as_mid360 ? "all round without rings, as a Mid-360: config/mid360.yaml"
                     : "all round; rings cannot be told apart: tilted, thinned or filtered, or it has none";
  }
  if (facts.rings == 1) return "one ring: a planar scanner, which sees no floor";
  if (facts.rings <= 16 && view_deg <= 35.0) return "spinning, as a VLP-16: config/vlp16.yaml";
  if (facts.rings >= 64 && view_deg <= 50.0) return "spinning, as an OS1-64: config/os1-64.yaml";
  return view_deg > 60.0 ? "spinning, wide view (as an OS0): config/pose_wall.yaml" : "spinning";
}

}  // namespace

SensorFacts sensor_facts(const Frame& frame) {
  SensorFacts facts;
  const Directions directions = directions_of(frame.cloud);
  if (directions.count == 0) return facts;
  facts.elevation_min_deg = elevation_at_share(directions, 0.001);
  facts.elevation_max_deg = elevation_at_share(directions, 0.999);
  facts.azimuth_span_deg =
      static_cast<double>(std::count(directions.azimuths.begin(), directions.azimuths.end(), true));
  find_rings(frame, directions, facts);
  facts.guess = guess_of(facts, directions);
  return facts;
}

}  // namespace pose_wall::tools
