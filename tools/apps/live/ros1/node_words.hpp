// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What stands in the parcels of daemon and node, as bytes. What is read comes from another process and is checked.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/live/ros_messages/ros_messages.hpp"
#include "io/bags/byte_cursor.hpp"

namespace pose_wall::tools::live {

// How the node fares; told some times a second.
struct NodeStatus {
  bool has_master = false, was_ended_by_ros = false;
  std::uint32_t publishers = 0;  // of the subscribed topics, all together
  std::uint64_t masters_seen = 0;
  std::vector<std::uint32_t> subscribers;  // of each advertised topic
};

std::string status_bytes(const NodeStatus& status);
// Nothing where the bytes are none.
std::optional<NodeStatus> read_status(ByteView bytes);

struct AdvertisedTopic {
  std::string topic, type, md5, definition;
};

std::string advertised_bytes(const std::string& topic, const RosType& type);
std::optional<AdvertisedTopic> read_advertised(ByteView bytes);

}  // namespace pose_wall::tools::live
