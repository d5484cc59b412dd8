// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What goes into the channels, for recordings and viewers alike.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/live/channels/channels.hpp"
#include "apps/live/channels/scene.hpp"
#include "apps/live/ros_messages/planar_messages.hpp"
#include "apps/live/ros_messages/ros_messages.hpp"

namespace pose_wall::tools::live {

// Who keeps or sends messages.
class ChannelOut {
 public:
  ChannelOut() = default;
  ChannelOut(const ChannelOut&) = delete;
  ChannelOut& operator=(const ChannelOut&) = delete;
  virtual ~ChannelOut() = default;
  // What it does not want is not made.
  virtual bool wants(ChannelNumber channel) const = 0;
  // May throw; what comes behind it is then not made.
  virtual void put(ChannelNumber channel, std::string message) = 0;
};

class LiveMessages {
 public:
  explicit LiveMessages(const LoadedConfig& loaded);

  void tell(const LiveResult& result, ChannelOut* out) const;
  void tell(const StopNews& news, ChannelOut* out) const;
  // A map once for each version; once more after a time in which nobody wanted it.
  void tell(const RoadwayNews& news, ChannelOut* out);
  // The log tells what fares otherwise than the last time.
  void tell(const std::vector<PartHealth>& parts, std::int64_t now_ns, ChannelOut* out);

 private:
  RosMessages ros_;
  PlanarMessages planar_;
  SceneWriter scene_;
  std::uint64_t map_told_ = 0;
  std::vector<PartHealth> parts_told_;
};

}  // namespace pose_wall::tools::live
