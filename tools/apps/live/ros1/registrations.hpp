// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the master of ROS 1 knows of this node, and how to tell it anew without giving up a connection: a driver that
// does not register again after the master was started anew goes on sending, as long as nobody hangs up on it.

#pragma once

#include <optional>
#include <set>
#include <string>

namespace pose_wall::tools::live {

struct Registered {
  std::set<std::string> published, subscribed;  // topics
};

// Asks the master; nothing where it does not answer, or answers something else than it should.
std::optional<Registered> registered_topics();

// Whether the master knows another node by this node's name: the newer one, by the rule of ROS; it ends the older.
bool is_replaced();

// The master tells the subscribers.
void register_publisher(const std::string& topic, const std::string& type);

// Publishers that the new master knows are connected to, those that are connected stay.
void register_subscriber(const std::string& topic);

}  // namespace pose_wall::tools::live
