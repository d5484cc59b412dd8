// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros1/node_words.hpp"

#include <cstring>

namespace pose_wall::tools::live {
namespace {

// Both sides are of one machine.
template <typename Number>
void add(std::string* bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes->append(raw, sizeof raw);
}

void add_text(std::string* bytes, std::string_view text) {
  add(bytes, static_cast<std::uint32_t>(text.size()));
  bytes->append(text);
}

ByteCursor cursor_of(ByteView bytes) {
  ByteCursor cursor(bytes);
  cursor.set_big_endian(host_is_big_endian());
  return cursor;
}

}  // namespace

std::string status_bytes(const NodeStatus& status) {
  std::string bytes;
  add(&bytes, static_cast<std::uint8_t>(status.has_master));
  add(&bytes, static_cast<std::uint8_t>(status.was_ended_by_ros));
  add(&bytes, status.publishers);
  add(&bytes, status.masters_seen);
  for (const std::uint32_t count : status.subscribers) add(&bytes, count);
  return bytes;
}

std::optional<NodeStatus> read_status(ByteView bytes) {
  try {
    ByteCursor cursor = cursor_of(bytes);
    NodeStatus status;
    status.has_master = cursor.number<std::uint8_t>("master") != 0;
    status.was_ended_by_ros = cursor.number<std::uint8_t>("end") != 0;
    status.publishers = cursor.number<std::uint32_t>("publishers");
    status.masters_seen = cursor.number<std::uint64_t>("masters");
    while (cursor.left() > 0) status.subscribers.push_back(cursor.number<std::uint32_t>("subscribers"));
    return status;
  } catch (const FrameError&) {
    return std::nullopt;
  }
}

std::string advertised_bytes(const std::string& topic, const RosType& type) {
  std::string bytes;
  for (const std::string_view text : {std::string_view(topic), std::string_view(type.name), std::string_view(type.md5),
                                      std::string_view(type.definition)}) {
    add_text(&bytes, text);
  }
  return bytes;
}

std::optional<AdvertisedTopic> read_advertised(ByteView bytes) {
  try {
    ByteCursor cursor = cursor_of(bytes);
    AdvertisedTopic advertised;
    for (std::string* text : {&advertised.topic, &advertised.type, &advertised.md5, &advertised.definition}) {
      *text = text_of(cursor.counted_bytes("text"));
    }
    return advertised;
  } catch (const FrameError&) {
    return std::nullopt;
  }
}

}  // namespace pose_wall::tools::live
