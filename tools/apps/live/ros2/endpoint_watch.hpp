// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The readers or writers of others on some topics, as DDS discovers them, and why they do not come together with ours.

#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/live/ros2/ros2_node.hpp"

namespace pose_wall::tools::live {

struct RemoteEndpoint {
  std::string topic, type;  // as DDS names them: "rt/lidar/points", "sensor_msgs::msg::dds_::PointCloud2_"
  EndpointQos qos;
};

class EndpointWatch {
 public:
  // Of Ros2Node::start and before its end.
  EndpointWatch(const Ros2Node& node, bool of_writers, std::vector<std::string> dds_topics);
  ~EndpointWatch();
  EndpointWatch(const EndpointWatch&) = delete;
  EndpointWatch& operator=(const EndpointWatch&) = delete;

  // Whether something came or went since the last time. One thread at a time.
  bool update();

  std::vector<RemoteEndpoint> of(const std::string& dds_topic) const;
  // The first one whose type or quality of service keeps it from ours, in words; "" where all match.
  std::string mismatch_with(const Ros2Node::Endpoint& ours) const;

 private:
  bool is_of_interest(const std::string& dds_topic) const;

  Gid own_participant_;
  bool of_writers_;
  std::vector<std::string> dds_topics_;
  DdsEntity reader_;
  std::map<Gid, RemoteEndpoint> endpoints_;
};

}  // namespace pose_wall::tools::live
