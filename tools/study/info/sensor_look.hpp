// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Which kind of sensor made a recording: rings, view, ranges and class. `info` and `doctor` both ask here, so that they
// agree.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/frames/told_rings.hpp"
#include "pose_wall.h"
#include "study/info/ring_count.hpp"

namespace pose_wall::tools {

struct RangeFacts {
  double min_m = 0.0, near_m = 0.0, median_m = 0.0, far_m = 0.0, max_m = 0.0;  // near, far: 1 % and 99 %
};

struct SensorFacts {
  std::string model = "unknown";  // "vlp16", "os1-128", ...; where lab/sim/sensors.hpp has one of this name, that one
  std::string title = "unknown";  // "VLP-16"
  std::string config;             // of config/, "vlp16" for config/vlp16.yaml; empty: none is made for it
  double returns = 0.0;           // median per frame
  std::size_t rings = 0;          // 0: none, or not known
  bool rings_are_told = false;    // by the frames; else counted in a part of the cloud: "about"
  std::string rings_by;           // "field ring", "rows of the cloud", "elevations"
  double elevation_min_deg = 0.0, elevation_max_deg = 0.0;
  double azimuth_span_deg = 0.0;  // degrees of the circle from which anything came
  RangeFacts ranges;

  bool is_known() const { return model != "unknown"; }
  // config/pose_wall.yaml holds the defaults: to give it changes nothing.
  bool has_defaults() const { return config == "pose_wall"; }
};

// Finite points that are not at zero, in the order of the cloud: x, y, z.
std::vector<float> returns_of(const pose_wall_cloud& cloud);

class SensorLook {
 public:
  // The returns of one frame, in the lidar frame.
  void add(const std::vector<float>& xyz_lidar_m, const ToldRings& told);
  bool is_empty() const { return count_ == 0; }
  SensorFacts facts() const;

 private:
  void add_direction(double x_m, double y_m, double z_m, double range_m);
  double elevation_deg_at(double share) const;
  double range_m_at(double share) const;

  std::vector<std::size_t> by_elevation_ = std::vector<std::size_t>(3600);
  std::array<bool, 360> azimuths_{};
  std::vector<std::size_t> by_range_ = std::vector<std::size_t>(9300);
  std::size_t count_ = 0, directions_ = 0;
  double range_min_m_ = 0.0, range_max_m_ = 0.0;
  std::vector<std::size_t> returns_;  // of each frame
  ToldRings told_;
  RingCount ring_count_;
};

// "64", "about 64", "not known"; and by what: "by the field ring".
std::string rings_text(const SensorFacts& facts);
std::string rings_source_text(const SensorFacts& facts);

// What the view shows where the class is not known.
std::string view_text(const SensorFacts& facts);

// "--config vlp16", or that no config is made for this sensor.
std::string config_text(const SensorFacts& facts);

// Class, or view, and config.
std::string class_text(const SensorFacts& facts);

// "0.50 m min, 1.20 m at 1 %, 6.40 m median, ..."
std::string ranges_text(const RangeFacts& ranges);

// The ranges look like millimetres; and the words for it, empty where they do not.
bool is_unit_doubtful(const RangeFacts& ranges);
std::string unit_doubt(const RangeFacts& ranges);

}  // namespace pose_wall::tools
