// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "doctor/sensor_seen.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "angles.hpp"
#include "doctor/statistics.hpp"

namespace pose_wall::tools::doctor {
namespace {

constexpr double kBin_deg = 0.05;
constexpr std::size_t kBins = 3600;
// Nearer, the offsets of the lasers in their housing blur a ring.
constexpr double kFar_m = 3.0;
// Fewer are no rings: an even cover has a hollow by chance.
constexpr std::size_t kRingsMin = 8;
constexpr double kRingShareMax = 0.4;

using Histogram = std::array<std::size_t, kBins>;

struct Directions {
  Histogram by_elevation{}, far_by_elevation{};
  std::array<std::size_t, 360> by_azimuth{};
  std::size_t count = 0, far = 0;
  std::vector<double> ranges_m;
};

Directions directions_of(const std::vector<KeptFrame>& frames) {
  Directions seen;
  for (const KeptFrame& frame : frames) {
    for (std::size_t i = 0; i < frame.count(); ++i) {
      const Eigen::Vector3d p = frame.point(i);
      const double range = p.norm();
      if (i % 16 == 0) seen.ranges_m.push_back(range);
      if (!(range >= 0.3)) continue;
      const double elevation_deg = std::asin(std::clamp(p.z() / range, -1.0, 1.0)) * kDegPerRad;
      const double azimuth_deg = std::atan2(p.y(), p.x()) * kDegPerRad + 180.0;
      const std::size_t bin = std::min(static_cast<std::size_t>((elevation_deg + 90.0) / kBin_deg), kBins - 1);
      ++seen.by_elevation[bin];
      ++seen.by_azimuth[std::min(static_cast<std::size_t>(azimuth_deg), std::size_t{359})];
      ++seen.count;
      if (range < kFar_m) continue;
      ++seen.far_by_elevation[bin];
      ++seen.far;
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

// Rings are peaks with a hollow between them that falls below half of either: each is measured by its own height, since
// far walls answer the middle rings less often than floor and roof the outer ones.
std::size_t rings_in(const Histogram& histogram, std::size_t count) {
  const std::size_t least = std::max<std::size_t>(count / 4000, 8);
  std::size_t rings = 0;
  std::size_t top = 0, hollow = 0, sum = 0, most = 0;
  for (std::size_t bin = 1; bin + 1 < kBins; ++bin) {
    const std::size_t here = histogram[bin - 1] + histogram[bin] + histogram[bin + 1];
    sum += histogram[bin];
    if (top == 0) {  // in a hollow: a ring begins where it is twice as high
      hollow = std::min(hollow, here);
      if (here >= least && here > 2 * hollow) top = here;
    } else {
      top = std::max(top, here);
      if (2 * here < top) {
        ++rings;
        most = std::max(most, std::exchange(sum, 0));
        top = 0;
        hollow = here;
      }
    }
  }
  // An even cover is one broad peak, with chance hollows where it thins out.
  return rings >= kRingsMin && share(most, count) < kRingShareMax ? rings : 0;
}

// What the frames tell is right, where it is of rings: some sensors number the few lines of a pattern. Else far returns
// show rings best, and a deck right under the sensor hides the lower ones from them.
std::size_t rings_of(const Directions& seen, std::size_t told) {
  if (told >= kRingsMin) return told;
  return std::max(rings_in(seen.far_by_elevation, seen.far), rings_in(seen.by_elevation, seen.count));
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
  seen.rings = rings_of(directions, recording.rings_told);
  seen.elevation_min_deg = elevation_deg_at(directions, 0.001);
  seen.elevation_max_deg = elevation_deg_at(directions, 0.999);
  const auto empty = std::count(directions.by_azimuth.begin(), directions.by_azimuth.end(), std::size_t{0});
  seen.azimuth_share = 1.0 - static_cast<double>(empty) / 360.0;
  name_class(seen);
  return seen;
}

}  // namespace pose_wall::tools::doctor
