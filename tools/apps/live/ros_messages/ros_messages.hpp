// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What pose_walld publishes by ROS, as the bytes of each message: one description for ROS 1, ROS 2 and recordings.
//
// Angles in rad, lengths in m, in base_frame; NaN where a value is invalid. A result of silence tells aged and held
// values under the stamp of the last cloud's header.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/live/health.hpp"
#include "apps/live/ros_messages/ros_writer.hpp"
#include "apps/live/sink.hpp"
#include "io/bags/bag_reader.hpp"

namespace pose_wall::tools::live {

// A type under the names that either ROS has for it.
struct RosType {
  const char* name;             // "geometry_msgs/Vector3Stamped"
  const char* md5;              // of ROS 1
  const char* hash;             // of ROS 2 from Iron on (REP-2016); "": not known, and not needed
  const char* definition;       // whole text, with the types it uses, of ROS 1
  const char* ros2_definition;  // of ROS 2, for recordings

  // "geometry_msgs/msg/Vector3Stamped", "geometry_msgs::msg::dds_::Vector3Stamped_"
  std::string ros2_name() const;
  std::string dds_name() const;
};

extern const RosType kPointCloud2Type, kVector3StampedType, kFloat32MultiArrayType, kStateType, kDiagnosticArrayType,
    kTfMessageType, kLaserScanType, kOccupancyGridType, kCovariantPoseType, kBoolType, kStopType;
// By name and hash alone: of ROS 2, and commands of the drive, which are read only.
extern const RosType kParticipantEntitiesType, kLivoxCustomType, kTwistType, kTwistStampedType;

class RosMessages {
 public:
  RosMessages(MessageEncoding encoding, std::string base_frame);

  // x roll, y pitch, z yaw.
  std::string attitude(const LiveResult& result) const;
  // d_lf, d_lb, d_rf, d_rb, labelled in its layout.
  std::string distances(const LiveResult& result) const;
  std::string state(const LiveResult& result) const;
  std::string diagnostics(const std::vector<PartHealth>& parts, std::int64_t now_ns) const;
  // From base_frame to its levelled twin, base_frame + "_level": z up, its x as ahead as base's.
  std::string level_transform(const LiveResult& result) const;
  // Whether this frame measured it; of held angles there is no transform.
  static bool has_level(const LiveResult& result);
  // x y z float32 and label uint8, in base_frame. There must be points.
  std::string points(const LiveResult& result) const;
  // The cloud as it came.
  std::string cloud(const LiveFrame& frame) const;

 private:
  RosWriter begin(std::int64_t stamp_ns, const std::string& frame_id) const;

  MessageEncoding encoding_;
  std::string base_frame_;
};

}  // namespace pose_wall::tools::live
