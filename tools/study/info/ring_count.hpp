// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How many rings a rotating sensor has, by the points alone. De-skew bends rings, and so does an origin that is not the
// sensor's: most where rays are steep or short. A cloud that leans moves them up on one side and down on the other. So
// their spacing is taken from far points near the sensor's horizon, and both spacing and view from one narrow sector at
// a time.

#pragma once

#include <cstddef>
#include <vector>

namespace pose_wall::tools {

class RingCount {
 public:
  // Of the first few frames; later ones tell nothing new.
  void add(const std::vector<float>& xyz_lidar_m);

  // The number of rings that some sensor has, where the count is near to it. 0: there are no rings, the sectors
  // disagree, or no spinning sensor has about so many.
  std::size_t rings() const;

 private:
  double spacing_deg() const;

  std::vector<double> spacings_deg_;  // between neighbouring rings, of sectors that show rings
  std::vector<double> views_deg_;     // from the lowest to the highest point of a sector
  std::size_t sectors_ = 0;           // with points enough near the horizon
  std::size_t frames_ = 0;
};

}  // namespace pose_wall::tools
