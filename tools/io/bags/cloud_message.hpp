// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Messages that are a cloud each, of bags and of live sources: bytes in, a frame with its stamp and who sent it out.

#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "io/bags/bag_reader.hpp"
#include "io/bags/scan_overlap.hpp"
#include "io/frames/frame.hpp"
#include "io/frames/source_identity.hpp"

namespace pose_wall::tools {

struct DecodedCloud {
  std::int64_t stamp_ns = 0;  // of its header; 0: none
  SourceIdentity source;      // its frame_id, of Livox its lidar_id, too
  Frame frame;
};

// sensor_msgs/PointCloud2 and livox_ros_driver(2)/CustomMsg, named as ROS 1 or ROS 2 does.
bool is_cloud_type(std::string_view type);

// `message` is a serialised message of ROS 1, or CDR with its head of four bytes. `place` is where its bytes lie, for
// what is said of faults. Throws FrameError that names the place, and for a type that is no cloud's.
DecodedCloud decode_cloud(std::string_view type, MessageEncoding encoding, ByteView message, const Place& place = {});

// Only who sent it; what stands behind that is not looked at. Throws as decode_cloud().
SourceIdentity source_of_cloud(std::string_view type, MessageEncoding encoding, ByteView message,
                               const Place& place = {});

// From the first of its points to the last; of Livox's CustomMsg alone. Throws likewise.
std::optional<ScanSpan> span_of_cloud(std::string_view type, MessageEncoding encoding, ByteView message,
                                      const Place& place = {});

}  // namespace pose_wall::tools
