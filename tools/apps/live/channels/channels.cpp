// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/channels/channels.hpp"

#include <algorithm>
#include <iterator>

#include "apps/live/channels/well_known_schemas.hpp"
#include "apps/live/recorder/json_schema.hpp"
#include "apps/live/result_json.hpp"
#include "apps/live/ros_messages/ros_messages.hpp"
#include "io/config_file/key_table.hpp"

namespace pose_wall::tools::live {
namespace {

// With every member that a result can have. The numbers mean nothing.
LiveResult whole_result(const LoadedConfig& loaded) {
  LiveResult result;
  result.config = *loaded.config.get();
  result.frame_id = "lidar";
  pose_wall_result& r = result.publication.result;
  r.frame_reasons = 1;
  r.left_right_yaw_difference_rad = 0.0;
  for (pose_wall_value& value : r.quantity) {
    value = {};
    value.state = value.raw_state = POSE_WALL_DEGRADED;  // it has a level, and a cause why it may not steer
    value.reasons = 1;
    value.cause = POSE_WALL_PART_RANDOM;
  }
  for (std::uint32_t& sense : r.positive_means) sense = POSE_WALL_SENSE_RIGHT_DOWN;
  for (pose_wall_plane* const plane : {&r.floor, &r.left, &r.right}) {
    plane->found = 1;
    plane->reasons = 1;
  }
  return result;
}

McapChannel own_json(const char* topic, const char* name, const std::string& example) {
  return {topic, "json", name, "jsonschema", json_schema_of(example)};
}

McapChannel well_known(const char* topic, WellKnown type) {
  return {topic, "json", well_known_name(type), "jsonschema", well_known_schema(type)};
}

McapChannel of_ros(const std::string& topic, const RosType& type) {
  return {topic, "cdr", type.ros2_name(), "ros2msg", type.ros2_definition};
}

}  // namespace

std::vector<McapChannel> live_channels(const LoadedConfig& loaded) {
  // In the order of ChannelNumber. Members may be added; what they mean is said in the README of `pose_wall run`.
  const PartHealth part{"runtime", Grade::kGood, "measures", {}};
  std::vector<McapChannel> channels = {
      own_json("/pose_wall/result", "pose_wall.Result", result_json(whole_result(loaded))),
      own_json("/pose_wall/health", "pose_wall.Health", health_json({part})),
      of_ros(config_text(*loaded.config.get(), "pointcloud_topic"), kPointCloud2Type),
      well_known("/pose_wall/pose", WellKnown::kPoseInFrame),
      well_known("/pose_wall/transforms", WellKnown::kFrameTransforms),
      well_known("/pose_wall/scene", WellKnown::kSceneUpdate),
      well_known("/pose_wall/log", WellKnown::kLog),
      of_ros("/pose_wall/points", kPointCloud2Type)};
  if (!loaded.planar.is_on()) return channels;
  const std::vector<McapChannel> planar = {of_ros("/pose_wall/stop_state", kStopType),
                                           of_ros("/pose_wall/place", kCovariantPoseType),
                                           of_ros("/map", kOccupancyGridType),
                                           // Viewers that seek take the newest message of each topic: one kind in each.
                                           well_known("/pose_wall/stop_scene", WellKnown::kSceneUpdate),
                                           well_known("/pose_wall/place_transform", WellKnown::kFrameTransforms)};
  std::copy(planar.begin(), planar.end(), std::back_inserter(channels));
  return channels;
}

}  // namespace pose_wall::tools::live
