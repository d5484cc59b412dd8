// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// In place of this edge where the build did not find its library.

#include "apps/live/edges.hpp"

namespace pose_wall::tools::live {

RosEdge make_ros1_edge(const LoadedConfig&, const HealthBoard&, bool, bool, CommandBoard*) {
  throw EdgeMissing(
      "this build has no ROS 1: install libroscpp-dev libsensor-msgs-dev libdiagnostic-msgs-dev libtf2-msgs-dev, "
      "configure and build again");
}

}  // namespace pose_wall::tools::live
