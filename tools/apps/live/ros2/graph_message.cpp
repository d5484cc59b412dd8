// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros2/graph_message.hpp"

#include <fmt/format.h>

#include "io/bags/message_writer.hpp"

namespace pose_wall::tools::live {
namespace {

void write_gid(MessageWriter& message, RosDistro distro, const Gid& gid) {
  for (const std::uint8_t byte : gid) message.number(byte);
  constexpr std::size_t kHumbleBytes = 24;
  if (distro == RosDistro::kHumble) {
    for (std::size_t i = gid.size(); i < kHumbleBytes; ++i) message.number(std::uint8_t{0});
  }
}

void write_gids(MessageWriter& message, RosDistro distro, const std::vector<Gid>& gids) {
  message.count(gids.size());
  for (const Gid& gid : gids) write_gid(message, distro, gid);
}

}  // namespace

std::string graph_message(RosDistro distro, const Gid& participant, const std::vector<GraphNode>& nodes) {
  MessageWriter message(MessageEncoding::kCdr);
  write_gid(message, distro, participant);
  message.count(nodes.size());
  for (const GraphNode& node : nodes) {
    message.text(node.node_namespace);
    message.text(node.name);
    write_gids(message, distro, node.readers);
    write_gids(message, distro, node.writers);
  }
  return message.take();
}

std::string participant_user_data() {
  return "enclave=/;";
}

std::string endpoint_user_data(RosDistro distro, const std::string& type_hash) {
  return distro == RosDistro::kHumble || type_hash.empty() ? "" : "typehash=" + type_hash + ";";
}

std::string gid_text(const Gid& gid) {
  std::string text;
  for (const std::uint8_t byte : gid) text += fmt::format("{}{:02x}", text.empty() ? "" : ".", byte);
  return text;
}

}  // namespace pose_wall::tools::live
