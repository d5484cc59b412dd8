// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/info/sensor_look.hpp"

#include <algorithm>
#include <cmath>

#include "io/frames/point_position.hpp"
#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kElevationBinsPerDeg = 20.0;
constexpr double kDirectionMin_m = 0.3;  // nearer returns come from the housing
// Bins of ranges grow by this factor: a thousandth, whatever the unit is.
constexpr double kRangeFirst_m = 0.01, kRangeStep = 0.002;
// Fewer are no rings: some sensors number the few lines of a pattern.
constexpr std::size_t kToldRingsMin = 8;

struct SensorClass {
  const char* model;
  const char* title;
  const char* config;
  std::size_t rings;  // 0: a non-repetitive pattern
  double low_deg, high_deg, tolerance_deg;
};

// Views by the makers' data sheets. A tolerance leaves room for rings that nothing answers, and for tilted clouds.
constexpr SensorClass kClasses[] = {
    {"vlp16", "VLP-16", "vlp16", 16, -15.0, 15.0, 2.5},
    {"hdl-32e", "HDL-32E", "", 32, -30.67, 10.67, 2.5},
    {"xt32", "XT32", "", 32, -16.0, 15.0, 2.5},
    {"os1-32", "OS1-32", "", 32, -22.5, 22.5, 3.0},
    {"os0-32", "OS0-32", "", 32, -45.0, 45.0, 4.0},
    {"os1-64", "OS1-64", "os1-64", 64, -22.5, 22.5, 3.0},
    {"os0-64", "OS0-64", "pose_wall", 64, -45.0, 45.0, 4.0},
    {"hdl-64e", "HDL-64E", "", 64, -24.8, 2.0, 2.5},
    {"os1-128", "OS1-128", "pose_wall", 128, -22.5, 22.5, 3.0},
    {"os0-128", "OS0-128", "pose_wall", 128, -45.0, 45.0, 4.0},
    {"mid360", "Mid-360", "mid360", 0, -7.0, 52.0, 4.0},
};
constexpr double kPatternReturnsMin = 8'000.0, kPatternReturnsMax = 40'000.0;

// Of its rings and its view a sensor may lose so much in the dark ahead, or to a vehicle below it.
constexpr double kLostShare = 0.15;

bool is_of(const SensorClass& kind, const SensorFacts& facts) {
  const double lacks_below_deg = facts.elevation_min_deg - kind.low_deg;
  const double lacks_above_deg = kind.high_deg - facts.elevation_max_deg;
  if (std::min(lacks_below_deg, lacks_above_deg) < -kind.tolerance_deg) return false;
  const double lost_deg = kind.rings > 0 ? kLostShare * (kind.high_deg - kind.low_deg) : 0.0;
  if (std::max(lacks_below_deg, lacks_above_deg) > std::max(kind.tolerance_deg, lost_deg)) return false;
  if (kind.rings > 0) {
    const auto rings = static_cast<double>(kind.rings);
    return facts.rings <= kind.rings && static_cast<double>(facts.rings) >= (1.0 - kLostShare) * rings;
  }
  return facts.rings == 0 && facts.returns >= kPatternReturnsMin && facts.returns <= kPatternReturnsMax;
}

void name_class(SensorFacts& facts) {
  for (const SensorClass& kind : kClasses) {
    if (!is_of(kind, facts)) continue;
    facts.model = kind.model;
    facts.title = kind.title;
    facts.config = kind.config;
    return;
  }
}

std::size_t range_bin(double range_m, std::size_t bins) {
  const double bin = std::log(std::max(range_m, kRangeFirst_m) / kRangeFirst_m) / kRangeStep;
  return std::min(static_cast<std::size_t>(bin), bins - 1);
}

// The first bin below which and in which more than `share` of all lie.
std::size_t bin_at(const std::vector<std::size_t>& bins, std::size_t count, double share) {
  const auto wanted = static_cast<std::size_t>(share * static_cast<double>(count));
  std::size_t below = 0;
  for (std::size_t bin = 0; bin + 1 < bins.size(); ++bin) {
    below += bins[bin];
    if (below > wanted) return bin;
  }
  return bins.size() - 1;
}

}  // namespace

std::vector<float> returns_of(const pose_wall_cloud& cloud) {
  std::vector<float> xyz_m;
  xyz_m.reserve(std::size_t{3} * cloud.width * cloud.height);
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    for (std::uint32_t column = 0; column < cloud.width; ++column) {
      const Eigen::Vector3f p = point_position(cloud, row, column).cast<float>();
      if (p.allFinite() && !p.isZero(0.0F)) xyz_m.insert(xyz_m.end(), {p.x(), p.y(), p.z()});
    }
  }
  return xyz_m;
}

void SensorLook::add(const std::vector<float>& xyz_lidar_m, const ToldRings& told) {
  returns_.push_back(xyz_lidar_m.size() / 3);
  if (told.count > told_.count) told_ = told;
  if (xyz_lidar_m.empty()) return;
  ring_count_.add(xyz_lidar_m);
  for (std::size_t i = 0; i + 2 < xyz_lidar_m.size(); i += 3) {
    const double x = static_cast<double>(xyz_lidar_m[i]), y = static_cast<double>(xyz_lidar_m[i + 1]);
    const double z = static_cast<double>(xyz_lidar_m[i + 2]), range_m = std::hypot(x, y, z);
    range_min_m_ = count_ == 0 ? range_m : std::min(range_min_m_, range_m);
    range_max_m_ = std::max(range_max_m_, range_m);
    ++by_range_[range_bin(range_m, by_range_.size())];
    ++count_;
    if (range_m >= kDirectionMin_m) add_direction(x, y, z, range_m);
  }
}

void SensorLook::add_direction(double x_m, double y_m, double z_m, double range_m) {
  const double elevation_deg = std::asin(std::clamp(z_m / range_m, -1.0, 1.0)) * kDegPerRad;
  const double azimuth_deg = std::atan2(y_m, x_m) * kDegPerRad + 180.0;
  const auto bin = static_cast<std::size_t>((elevation_deg + 90.0) * kElevationBinsPerDeg);
  ++by_elevation_[std::min(bin, by_elevation_.size() - 1)];
  azimuths_[std::min(static_cast<std::size_t>(azimuth_deg), azimuths_.size() - 1)] = true;
  ++directions_;
}

double SensorLook::elevation_deg_at(double share) const {
  return (static_cast<double>(bin_at(by_elevation_, directions_, share)) + 0.5) / kElevationBinsPerDeg - 90.0;
}

double SensorLook::range_m_at(double share) const {
  const double bin = static_cast<double>(bin_at(by_range_, count_, share)) + 0.5;
  return std::clamp(kRangeFirst_m * std::exp(bin * kRangeStep), range_min_m_, range_max_m_);
}

SensorFacts SensorLook::facts() const {
  SensorFacts facts;
  if (count_ == 0) return facts;
  std::vector<std::size_t> returns = returns_;
  std::nth_element(returns.begin(), returns.begin() + static_cast<std::ptrdiff_t>(returns.size() / 2), returns.end());
  facts.returns = static_cast<double>(returns[returns.size() / 2]);
  facts.ranges = {range_min_m_, range_m_at(0.01), range_m_at(0.5), range_m_at(0.99), range_max_m_};
  if (directions_ == 0) return facts;
  facts.elevation_min_deg = elevation_deg_at(0.001);
  facts.elevation_max_deg = elevation_deg_at(0.999);
  facts.azimuth_span_deg = static_cast<double>(std::count(azimuths_.begin(), azimuths_.end(), true));
  facts.rings_are_told = told_.count >= kToldRingsMin || told_.count == 1;
  facts.rings = facts.rings_are_told ? told_.count : ring_count_.rings();
  if (facts.rings > 0) facts.rings_by = facts.rings_are_told ? told_.by : "elevations";
  name_class(facts);
  return facts;
}

}  // namespace pose_wall::tools
