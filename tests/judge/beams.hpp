// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Where each laser of a real spinning sensor points, where its light leaves the sensor, and when it fires.

#pragma once

#include <vector>

namespace pose_wall::judge {

struct Beam {
  double elevation_deg = 0.0;
  double azimuth_deg = 0.0;  // ahead of the head's azimuth, to the left seen from above
  double up_m = 0.0;         // of its light over the sensor's origin
  double after_us = 0.0;     // since its firing began
  int ring = 0;              // counted from the lowest
};

struct Beams {
  std::vector<Beam> lasers;  // in the order in which they fire
  double firing_us = 0.0;    // from one firing of all lasers to the next
  double lens_m = 0.0;       // from the axis to where the light leaves, along the head's azimuth
  bool from_axis = false;    // the sensor counts its range from the axis, and not from there
};

using BeamTable = const Beams& (*)();

const Beams& vlp16_beams();
const Beams& hdl32_beams();
const Beams& vlp32c_beams();
const Beams& xt32_beams();
const Beams& os1_64_beams();
const Beams& os0_128_beams();
const Beams& rs16_beams();

// The same lasers, all of whose light leaves the sensor's origin.
Beams without_offsets(const Beams& beams);

}  // namespace pose_wall::judge
