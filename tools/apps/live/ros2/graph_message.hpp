// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What makes a DDS participant a node of ROS's graph: the message ros_discovery_info, and the words in USER_DATA.

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/live/ros2/environment.hpp"

namespace pose_wall::tools::live {

using Gid = std::array<std::uint8_t, 16>;

struct GraphNode {
  std::string node_namespace, name;  // "/", "pose_wall"
  std::vector<Gid> readers, writers;
};

// rmw_dds_common/msg/ParticipantEntitiesInfo as CDR. Its gids have 24 bytes in Humble and 16 later, under one name.
std::string graph_message(RosDistro distro, const Gid& participant, const std::vector<GraphNode>& nodes);

// "enclave=/;"
std::string participant_user_data();
// "typehash=RIHS01_...;" from Iron on; nothing before.
std::string endpoint_user_data(RosDistro distro, const std::string& type_hash);

// "01.10.de.17..." as `ros2 topic info --verbose` writes it.
std::string gid_text(const Gid& gid);

}  // namespace pose_wall::tools::live
