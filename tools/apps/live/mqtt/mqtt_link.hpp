// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A connection to a broker of MQTT that is sought for ever, publishes and never waits. What a slow broker does not take
// is refused here, not gathered.

#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "io/config_file/live_settings.hpp"

namespace pose_wall::tools::live {

class MqttLink {
 public:
  // Under `topic` it tells "online" in topic/status, retained; "offline" when it ends, and by the broker when it is
  // gone. Throws std::runtime_error for a topic that nobody may publish under.
  MqttLink(const HostPort& broker, std::string topic);
  MqttLink(const MqttLink&) = delete;
  MqttLink& operator=(const MqttLink&) = delete;
  ~MqttLink();

  // Seeks the broker where there is none. Returns at once; to be called again and again, by one thread.
  void look();
  // Under topic/name, at least once, not retained. False where there is no broker, or it is behind. From any thread.
  bool publish(const char* name, const std::string& message);
  // Tells "offline" and leaves, within kLeaveMost; no `look` may be under way.
  void leave();

  bool is_connected() const;
  // Counts connections: what changed while there was none must be told anew. 0: none yet.
  std::uint64_t connections() const;
  std::string trouble() const;  // why there is no broker
  std::uint64_t acknowledged() const;
  std::uint64_t not_sent() const;

  static constexpr std::chrono::milliseconds kLeaveMost{300};

 private:
  struct State;
  struct Events;

  std::shared_ptr<State> state_;
};

}  // namespace pose_wall::tools::live
