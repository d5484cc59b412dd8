// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A planar scanner: from cloud and floor to a scan, frame by frame. Only the last floor is kept between frames.

#pragma once

#include "planar/scan/beam_ranges.hpp"
#include "planar/scan/clear.hpp"
#include "planar/scan/evidence.hpp"
#include "pose_wall_planar_scan.h"

namespace pose_wall::planar {

// POSE_WALL_OK or POSE_WALL_PLANAR_E_POSE.
std::int32_t check_floor(const pose_wall_planar_floor& floor);

class Scanner {
 public:
  void lay_out(Arena& arena, const pose_wall_planar_scanner_settings& given);
  void open(const pose_wall_planar_scanner_settings& given, const pose_wall_config& config);
  void reset() { has_floor_ = false; }

  // A checked cloud, and a checked floor of this frame or none. Complete structs are written.
  void process(const pose_wall_cloud& cloud, const pose_wall_planar_floor* floor, pose_wall_planar_scan* scan,
               pose_wall_planar_scan_view* view);

 private:
  std::uint32_t take_floor(const pose_wall_planar_floor* floor, std::int64_t stamp_ns);
  ClearScene clear_scene(double sensor_m) const;
  void end_beams();
  void show_clear();
  void show_nothing();
  void describe(std::int64_t stamp_ns, pose_wall_planar_scan* scan) const;
  void describe(std::uint32_t floor_state, std::int64_t stamp_ns, pose_wall_planar_scan_view* view) const;

  ScanSettings settings_{};
  OrderStatistics statistics_;
  SlotEdges edges_;
  bool has_floor_ = false;
  FloorPose floor_;  // as measured; in use: with the tilt of its age
  double tilt_measured_rad_ = 0.0;
  std::int64_t floor_stamp_ns_ = 0;
  Evidence evidence_;
  BeamRanges ranges_;
  Span<ClearRange> clear_alone_, clear_;
  Span<float> clear_from_m_, clear_m_;
};

}  // namespace pose_wall::planar
