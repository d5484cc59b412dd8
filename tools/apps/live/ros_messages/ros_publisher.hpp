// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Results as topics, for ROS 1 and ROS 2 alike: which topic gets what, and when.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "apps/live/images.hpp"
#include "apps/live/ros_messages/ros_messages.hpp"
#include "apps/live/sink.hpp"
#include "io/config_file/load_config.hpp"

namespace pose_wall::tools::live {

// How either ROS publishes bytes.
class RosOut {
 public:
  RosOut() = default;
  RosOut(const RosOut&) = delete;
  RosOut& operator=(const RosOut&) = delete;
  virtual ~RosOut() = default;

  // Before start; the number to publish by.
  // is_latched: who comes later still gets the last message.
  virtual std::size_t advertise(const std::string& topic, const RosType& type, bool is_latched) = 0;
  virtual void start() = 0;
  virtual void stop() = 0;
  // Never waits for a subscriber.
  virtual void publish(std::size_t number, const std::string& message) = 0;
  virtual std::uint32_t subscribers(std::size_t number) const = 0;
  // Why nobody can hear it; empty when all is well.
  virtual std::string trouble() const = 0;
  // What else its health tells.
  virtual void add_facts(PartHealth* /*health*/) const {}
};

// Topics: /pose_wall/attitude, /pose_wall/distances, /pose_wall/state, /pose_wall/points, /diagnostics, /tf. With the
// key `planar` on also /scan, /map, /pose (or /amcl_pose in a saved map), /pose_wall/stop, /pose_wall/stop_state.
std::unique_ptr<Sink> make_ros_publisher(const std::string& part, const LoadedConfig& loaded, const HealthBoard& health,
                                         MessageEncoding encoding, std::unique_ptr<RosOut> out);

}  // namespace pose_wall::tools::live
