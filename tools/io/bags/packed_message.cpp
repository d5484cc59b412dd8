// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/packed_message.hpp"

#include <fmt/format.h>

#include <string_view>

#include "io/bags/cloud_message.hpp"
#include "io/bags/decompress.hpp"
#include "io/bags/packet_message.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::string_view kZstdMagic = "\x28\xB5\x2F\xFD";

bool is_read(std::string_view type) {
  return is_cloud_type(type) || is_packet_type(type) || type == "std_msgs/msg/String";
}

}  // namespace

void PackedMessage::unpack(const BagTopic& topic, BagMessage* message) {
  if (topic.encoding != MessageEncoding::kCdr || !is_read(topic.type)) return;
  if (text_of(message->data).substr(0, kZstdMagic.size()) != kZstdMagic) return;
  try {
    content_ = decompress("zstd", message->data, zstd_content_bytes(message->data));
  } catch (const FrameError& fault) {
    throw FrameError(say("{}: a message that its recorder compressed: {}", message->place.text(0), fault.what()));
  }
  message->place = {0, say("message at {}", message->place.text(0))};
  message->data = {content_.data(), content_.size()};
}

}  // namespace pose_wall::tools
