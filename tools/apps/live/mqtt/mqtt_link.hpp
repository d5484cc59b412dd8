// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A connection to a broker of MQTT that is sought for ever, publishes and never waits. What a slow broker does not take
// is refused here, not gathered.

#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "apps/live/mqtt/mqtt_access.hpp"

namespace pose_wall::tools::live {

// A retained message of a link's own, in topic/name.
struct MqttPresence {
  std::string name;
  std::string online;   // at each connection; empty: nothing
  std::string offline;  // when it ends, and by the broker when it is gone
};

class MqttLink {
 public:
  // Throws std::runtime_error for a topic that nobody may publish under.
  MqttLink(MqttAccess access, std::string topic, MqttPresence presence);
  MqttLink(const MqttLink&) = delete;
  MqttLink& operator=(const MqttLink&) = delete;
  ~MqttLink();

  // Seeks the broker where there is none. Returns at once; to be called again and again, by one thread.
  void look();
  // Under topic/name, at least once. False where there is no broker, or it is behind. From any thread.
  bool publish(const char* name, const std::string& message, bool retained = false);
  // Tells that it is offline and leaves, within kLeaveMost; no `look` may be under way.
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
