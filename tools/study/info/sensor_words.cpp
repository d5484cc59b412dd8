// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the sensor looks like, in words that `info` and `doctor` share.

#include <string_view>

#include "io/language/language.hpp"
#include "study/info/sensor_look.hpp"

namespace pose_wall::tools {

namespace {

constexpr double kAllRound_deg = 300.0, kWide_deg = 200.0;
// No LiDAR for roads reaches that far with half of its points.
constexpr double kMillimetresBeyond_m = 200.0;

}  // namespace

std::string view_text(const SensorFacts& facts) {
  if (facts.azimuth_span_deg <= kWide_deg) return tr("a sensor that looks one way, not all round");
  if (facts.azimuth_span_deg <= kAllRound_deg) return tr("a wide sensor, not all round");
  if (facts.rings == 0) return tr("all round; no rings can be told apart (tilted, thinned, filtered, or none there)");
  if (facts.rings == 1) return tr("one ring: a planar scanner, which sees no floor");
  return tr("a spinning sensor of no known class");
}

std::string rings_text(const SensorFacts& facts) {
  if (facts.rings == 0) return tr("not known");
  return facts.rings_are_told ? std::to_string(facts.rings) : say("about {}", facts.rings);
}

std::string rings_source_text(const SensorFacts& facts) {
  if (facts.rings == 0) return tr("neither a field, nor the rows of the cloud, nor the elevations show them");
  if (!facts.rings_are_told) return tr("by the elevations");
  constexpr std::string_view kField = "field ";
  if (facts.rings_by.rfind(kField, 0) == 0) return say("by the field {}", facts.rings_by.substr(kField.size()));
  return tr("by the rows of the cloud");
}

std::string config_text(const SensorFacts& facts) {
  if (facts.has_defaults()) return tr("the defaults are made for it");
  return facts.config.empty() ? std::string(tr("no file of config/ is made for it")) : "--config " + facts.config;
}

std::string class_text(const SensorFacts& facts) {
  return fmt::format("{}; {}", facts.is_known() ? facts.title : view_text(facts), config_text(facts));
}

std::string ranges_text(const RangeFacts& ranges) {
  return say("median {:.2f} m; 1 % below {:.2f} m, 1 % beyond {:.1f} m; from {:.2f} to {:.1f} m", ranges.median_m,
             ranges.near_m, ranges.far_m, ranges.min_m, ranges.max_m);
}

bool is_unit_doubtful(const RangeFacts& ranges) {
  return ranges.median_m > kMillimetresBeyond_m;
}

std::string unit_doubt(const RangeFacts& ranges) {
  if (!is_unit_doubtful(ranges)) return "";
  return say("half of the points lie beyond {:.0f} m: millimetres? --unit mm reads them so", ranges.median_m);
}

}  // namespace pose_wall::tools
