// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// One pass over a cloud: the returns of each beam, told apart by their height above the floor, and how far rays were
// seen to pass.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "planar/scan/scan_settings.hpp"
#include "pose_wall.h"

namespace pose_wall::planar {

constexpr float kNothing_m = 1e9F;  // the range of what was not seen: beyond any that is read

// The slots of elevation. They are finer near the horizon, since heights at a range go with its inverse: the slot of a
// tangent t is (t / (|t| + kSlotBend) + 1) kSlots / 2.
constexpr std::uint32_t kSlots = 512;
constexpr double kSlotBend = 0.25;                 // a slot is 0.001 at the horizon, 0.007 at 22 degrees
constexpr std::uint32_t kSlotWords = kSlots / 32;  // one bit for each slot

// Which elevations had a return, in one sector.
struct SectorRays {
  std::uint32_t word[kSlotWords];
};

// A return in the band. Eight bytes: there are many.
struct BandReturn {
  float range_m;  // horizontal
  std::uint16_t beam;
  std::int16_t aside;  // from the beam's middle, in kAsides of a step
};
constexpr float kAsides = 1.0F / 65536.0F;  // of a step: half a step to each side fits 16 bits

// kHigh: in the top of the band, where the roof may be instead.
enum HeightClass : std::int32_t { kFloor, kLow, kBand, kHigh, kOverhead, kRoof, kHeightClasses };

struct PassCounts {
  std::uint32_t points_in = 0, dropped = 0, of_body = 0, out_of_scan = 0, uncounted = 0;
  std::uint32_t of[kHeightClasses] = {};
};

struct Evidence {
  void lay_out(Arena& arena, std::uint32_t beams, std::uint32_t sectors);
  void clear();

  Span<float> nearest_m, low_m, overhead_m;  // kNothing_m: none
  Span<float> free_m;
  Span<SectorRays> rays;
  Span<float> sector_end_m;  // the nearest return of a sector that is no floor and no roof
  Span<BandReturn> returns;
  std::uint32_t return_count = 0;
  PassCounts counts;
};

// The floor under the sensor.
struct FloorPose {
  Eigen::Matrix3d R_level_base = Eigen::Matrix3d::Identity();
  double base_height_m = 0.0;
  double tilt_rad = 0.0;  // the heights of far returns are uncertain by this times their range
  double reach_m = 0.0;   // beyond this range the ground may bend
};

void gather_evidence(const pose_wall_cloud& cloud, const ScanSettings& settings, const FloorPose& floor,
                     Evidence* evidence);

// The place of the sensor in the levelled frame, its height above the floor in z.
Eigen::Vector3d sensor_level_m(const ScanSettings& settings, const FloorPose& floor);

}  // namespace pose_wall::planar
