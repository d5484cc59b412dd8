// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "doctor/sensor_seen.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "doctor/statistics.hpp"

namespace pose_wall::tools::doctor {
namespace {

constexpr double kBin_deg = 0.05;
constexpr std::size_t kBins = 3600;
// Nearer, the offsets of the lasers in their housing spread a ring.
constexpr double kRangeMin_m = 1.5;

struct Directions {
  std::array<std::size_t, kBins> by_elevation{};
  std::array<std::size_t, 360> by_azimuth{};
  std::size_t count = 0;
  std::vector<double> ranges_m;
};

Directions directions_of(const std::vector<KeptFrame>& frames) {
  Directions seen;
  for (const KeptFrame& frame : frames) {
    for (std::size_t i = 0; i < frame.count(); ++i) {
      const Eigen::Vector3d p = frame.point(i);
      const double range = p.norm();
      if (i % 16 == 0) seen.ranges_m.push_back(range);
      if (!(range >= kRangeMin_m)) continue;
      const double elevation_deg = std::asin(std::clamp(p.z() / range, -1.0, 1.0)) * kDegPerRad;
      const double azimuth_deg = std::atan2(p.y(), p.x()) * kDegPerRad + 180.0;
      ++seen.by_elevation[std::min(static_cast<std::size_t>((elevation_deg + 90.0) / kBin_deg), kBins - 1)];
      ++seen.by_azimuth[std::min(static_cast<std::size_t>(azimuth_deg), std::size_t{359})];
      ++seen.count;
    }
  }
  return seen;
}

double elevation_deg_at(const Directions& seen, double fraction) {
  const auto wanted = static_cast<std::size_t>(fraction * static_cast<double>(seen.count));
  std::size_t sum = 0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    sum += seen.by_elevation[bin];
    if (sum > wanted) return (static_cast<double>(bin) + 0.5) * kBin_deg - 90.0;
  }
  return 90.0;
}

// Rings are peaks that stand apart: between them next to nothing. Each counts by its own height, since far walls answer
// the middle rings less often than floor and roof the outer ones.
int rings_of(const Directions& seen) {
  constexpr std::size_t kReach = 3;  // bins to both sides of a peak
  int rings = 0;
  std::size_t in_peaks = 0, last = 0;
  const std::size_t least = std::max<std::size_t>(seen.count / 5000, 8);
  for (std::size_t bin = kReach; bin + kReach < kBins; ++bin) {
    const std::size_t here = seen.by_elevation[bin];
    const auto* around = &seen.by_elevation[bin - kReach];
    const bool highest = here >= *std::max_element(around, around + 2 * kReach + 1);
    if (here < least || !highest || (last != 0 && bin - last <= kReach)) continue;
    ++rings;
    last = bin;
    in_peaks += here + seen.by_elevation[bin - 1] + seen.by_elevation[bin + 1];
  }
  // An even cover has peaks by chance, three bins wide in every seven.
  return share(in_peaks, seen.count) > 0.75 ? rings : 0;
}

bool is_near(double value, double wanted, double tolerance) {
  return std::fabs(value - wanted) <= tolerance;
}

// A roadway answers every ring of a sensor; a few may be lost in the dark ahead.
void name_class(SensorSeen& seen) {
  const double low = seen.elevation_min_deg, high = seen.elevation_max_deg;
  const auto is = [&seen](const char* model, const char* title) {
    seen.model = model;
    seen.title = title;
  };
  if (seen.rings >= 14 && seen.rings <= 16 && is_near(low, -15, 2.5) && is_near(high, 15, 2.5)) {
    is("vlp16", "VLP-16 class");
  } else if (seen.rings >= 58 && seen.rings <= 66 && is_near(low, -22.5, 3) && is_near(high, 22.5, 3)) {
    is("os1-64", "OS1-64 class");
  } else if (seen.rings >= 116 && seen.rings <= 130 && is_near(low, -45, 4) && is_near(high, 45, 4)) {
    is("os0-128", "OS0-128 class");
  } else if (seen.rings == 0 && seen.returns >= 8000 && seen.returns <= 30000 && is_near(low, -7, 3) &&
             is_near(high, 52, 5)) {
    is("mid360", "Mid-360 class");
  }
}

}  // namespace

SensorSeen look_at_sensor(const Recording& recording) {
  SensorSeen seen;
  std::vector<double> returns;
  for (const FrameNote& note : recording.notes) {
    if (note.error.empty()) returns.push_back(note.returns);
  }
  if (recording.kept.empty()) return seen;
  seen.returns = median(returns);
  const Directions directions = directions_of(recording.kept);
  seen.range_near_m = quantile(directions.ranges_m, 0.01);
  seen.range_median_m = median(directions.ranges_m);
  seen.range_far_m = quantile(directions.ranges_m, 0.99);
  if (directions.count == 0) return seen;
  seen.rings = rings_of(directions);
  seen.elevation_min_deg = elevation_deg_at(directions, 0.001);
  seen.elevation_max_deg = elevation_deg_at(directions, 0.999);
  const auto empty = std::count(directions.by_azimuth.begin(), directions.by_azimuth.end(), std::size_t{0});
  seen.azimuth_share = 1.0 - static_cast<double>(empty) / 360.0;
  name_class(seen);
  return seen;
}

}  // namespace pose_wall::tools::doctor
