// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Transforms as /tf and /tf_static of either ROS tell them, and where the sensor stands in base by them. Only the
// newest of each counts: the sensor is fixed to the machine.

#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/live/live_frame.hpp"
#include "io/bags/bag_reader.hpp"
#include "io/bags/byte_cursor.hpp"

namespace pose_wall::tools::live {

class TransformTree {
 public:
  // Takes a tf2_msgs/TFMessage; of /tf_static, or of /tf. now_ns: of a clock that runs on. Throws FrameError for bytes
  // that are none, and takes nothing of them then. A transform that is no number or no rotation is passed over.
  void take(MessageEncoding encoding, ByteView message, bool is_static, std::int64_t now_ns);

  // Nothing where no chain leads from the sensor to base, or where a link of it that comes by /tf is older than
  // kOld_ns; links above the first frame that both hang on do not count. Never the identity by default: unless both are
  // one frame, which they then are.
  std::optional<Extrinsic> extrinsic(const std::string& base_frame, const std::string& lidar_frame,
                                     std::int64_t now_ns) const;

  void clear() { links_.clear(); }

  // As long as a buffer of tf2 keeps transforms by default.
  static constexpr std::int64_t kOld_ns = 10'000'000'000;
  // Who sends other names all the time must not fill the memory.
  static constexpr std::size_t kLinksMost = 10'000;
  // Machines have chains of ten links; a ring has no end.
  static constexpr std::size_t kStepsMost = 100;

 private:
  struct Link {
    std::string parent;
    Eigen::Isometry3d parent_from_child = Eigen::Isometry3d::Identity();
    bool is_static = false;
    std::int64_t taken_ns = 0;
  };
  // A frame on the way up from a first one.
  struct Step {
    std::string frame;
    Eigen::Isometry3d here_from_first;
    const Link* link;  // by which it was reached; none for the first
  };
  std::vector<Step> chain_of(const std::string& frame) const;
  // Of the links up to the step `end`.
  static bool is_fresh(const std::vector<Step>& chain, std::size_t end, std::int64_t now_ns);

  std::map<std::string, Link> links_;  // by child
};

// base = Rz(yaw) Ry(pitch) Rx(roll) lidar + position.
Extrinsic extrinsic_of(const Eigen::Isometry3d& base_from_lidar);

}  // namespace pose_wall::tools::live
