// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The guarantee: where, between the rays of a sector, no thing of a stated size can stand unseen.
//
// At the range r a ray of tangent t has the height h + t r. Two neighbours of one sector, a below b, hide a thing of
// height s where their distance exceeds s: from r = s / (b - a) on. Downward rays stop hiding it where the upper one is
// lower than s, since the thing stands on the floor or above it. Rays that reach the floor do not count there, for
// their returns are the floor's. All of this is per sector, and a thing of the guarantee covers at least one wholly.

#pragma once

#include "planar/scan/evidence.hpp"

namespace pose_wall::planar {

struct ClearRange {
  float from_m, to_m;  // none where from_m >= to_m
};

// What decides about gaps, the same for all sectors.
struct ClearScene {
  double sensor_m = 0.0;     // height of the sensor above the floor
  double tolerance_m = 0.0;  // returns lower than this are the floor
  double high_m = 0.0;       // top of the band
  double thing_m = 0.0;
  double tilt_rad = 0.0;
  double reach_m = 0.0;
};

// Tangents at the edges of the slots.
struct SlotEdges {
  SlotEdges();
  double tangent[kSlots + 1];
};

// Remembers, for each slot, how low the slot below it may be so that nothing hides between them: the rays of all
// sectors have much the same slots, and the lower the ray below, the more hides.
struct CloseSlots {
  CloseSlots();
  std::uint16_t from[kSlots];  // the lowest that was tried
};

// Of one sector, without its returns.
ClearRange clear_range(const SectorRays& rays, const ClearScene& scene, const SlotEdges& edges, CloseSlots* close);

// Of all sectors, up to their returns; a direction is as clear as the least of its sector and the two beside it, since
// a thing may cover it in part.
void find_clear(const Evidence& evidence, const ClearScene& scene, const SlotEdges& edges, Span<ClearRange> alone,
                Span<ClearRange> clear);

}  // namespace pose_wall::planar
