// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Clouds and transforms as messages, for ROS 1 and ROS 2 alike: decoded, counted and handed on.

#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "apps/live/ros_messages/transform_tree.hpp"
#include "apps/live/source.hpp"
#include "io/config_file/load_config.hpp"
#include "io/frames/source_identity.hpp"

namespace pose_wall::tools::live {

class RosReader {
 public:
  RosReader(const LoadedConfig& loaded, MessageEncoding encoding);

  const std::string& topic() const { return topic_; }
  bool wants_transforms() const { return wants_transforms_; }

  // nullptr: to nobody any more; returns when nothing is being delivered.
  void deliver_to(FrameTaker* taker);

  // Bytes of others: whatever they are, nothing is thrown; what is no cloud is counted and named.
  void take_cloud(const std::string& type, ByteView message);
  void take_transforms(ByteView message, bool is_static);
  // A transform by /tf may have grown old without a message.
  void look_at_transforms();

  PartHealth health(const std::string& part) const;

 private:
  void tell_extrinsic();
  // False for a cloud of another sensor than the first: two of them on one topic.
  bool is_of_this_sensor(const SourceIdentity& source);
  // one: what is counted; empty: without counts, as a summary has it.
  std::string of_others_text(const char* one) const;
  void refuse(const std::string& why);

  MessageEncoding encoding_;
  std::string topic_, base_frame_, lidar_frame_;
  bool wants_transforms_;
  mutable std::mutex lock_;
  FrameTaker* taker_ = nullptr;
  TransformTree transforms_;
  bool extrinsic_known_ = false;
  SourceGate sources_;
  bool are_two_ = false;     // another sensor was heard between two clouds of the one that is read
  std::string cloud_frame_;  // of the header of the clouds that are taken
  std::string last_refusal_;
  std::optional<std::int64_t> refusal_logged_ns_;
  std::int64_t last_taken_ns_ = 0;  // of the newest that was handed on
  std::int64_t last_cloud_ns_ = 0;
  std::atomic<std::uint64_t> frames_{0}, refused_{0}, without_stamp_{0}, transforms_taken_{0};
};

}  // namespace pose_wall::tools::live
