// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The one table of what viewers read: recordings hold it, and the edge of Foxglove sends it live.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/live/recorder/mcap_writer.hpp"
#include "io/config_file/load_config.hpp"

namespace pose_wall::tools::live {

// Places in the table. Those from kStopChannel on are there only where the key `planar` is on.
enum ChannelNumber : std::uint16_t {
  kResultChannel,     // pose_wall.Result
  kHealthChannel,     // pose_wall.Health
  kCloudChannel,      // the raw cloud, as ROS 2 has it
  kPoseChannel,       // base in the road
  kTransformChannel,  // base to lidar, levelled frame and road
  kSceneChannel,      // floor, walls, distances
  kLogChannel,        // parts that fare otherwise than they did
  kPointsChannel,     // labelled points
  kStopChannel,
  kPlaceChannel,  // base on the map
  kMapChannel,
  kStopSceneChannel,       // machine and stop
  kPlaceTransformChannel,  // map to base
  kChannels
};

std::vector<McapChannel> live_channels(const LoadedConfig& loaded);

}  // namespace pose_wall::tools::live
