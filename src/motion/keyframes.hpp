// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The relief map and the scans that go into it: where the last one stood, and when another is due.

#pragma once

#include "base/containers/work.hpp"
#include "motion/range_image.hpp"
#include "motion/relief_map.hpp"

namespace pose_wall::motion {

class Keyframes {
 public:
  void lay_out(Arena& arena) { map_.lay_out(arena); }
  void clear() { map_.clear(); }
  // Places near this one count finely (ReliefMap::set_corner).
  void set_corner(const Eigen::Vector3d& near_map) { map_.set_corner(near_map); }

  // An empty map begins with this scan.
  void begin(const RangeImage& image, const Pose& pose, const Eigen::Vector3d& sensor_base_m, Work* work);
  void take_in(const RangeImage& image, const Pose& pose, const Eigen::Vector3d& sensor_base_m, Work* work);
  void forget_relief() { map_.forget_relief(); }
  // The machine went or turned far enough since the last one.
  bool are_due(const Pose& pose, double keyframe_m) const;

  const ReliefMap& map() const { return map_; }
  std::uint32_t count() const { return map_.keyframes(); }

 private:
  ReliefMap map_;
  Pose last_;
};

}  // namespace pose_wall::motion
