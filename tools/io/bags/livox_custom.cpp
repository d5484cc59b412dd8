// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/livox_custom.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "io/bags/message_cursor.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

// CustomPoint: a time, three coordinates, three bytes. CDR begins each at a multiple of four.
constexpr std::size_t kCustomPointBytes = 19;
constexpr std::size_t kCdrStep = 20;

PointLayout layout_of(const MessageCursor& message, std::uint32_t points) {
  PointLayout layout;
  layout.count = points;
  layout.point_step = static_cast<std::uint32_t>(message.is_cdr() ? kCdrStep : kCustomPointBytes);
  layout.big_endian = message.is_big_endian();
  layout.fields = {{"offset_time", {0, POSE_WALL_FIELD_UINT32}},  {"x", {4, POSE_WALL_FIELD_FLOAT32}},
                   {"y", {8, POSE_WALL_FIELD_FLOAT32}},           {"z", {12, POSE_WALL_FIELD_FLOAT32}},
                   {"reflectivity", {16, POSE_WALL_FIELD_UINT8}}, {"tag", {17, POSE_WALL_FIELD_UINT8}},
                   {"line", {18, POSE_WALL_FIELD_UINT8}}};
  return layout;
}

// Beyond it a scan would end where 64 bits do.
constexpr std::uint64_t kBaseMost_ns = 9'000'000'000'000'000'000;

std::size_t step_of(const MessageCursor& message) {
  return message.is_cdr() ? kCdrStep : kCustomPointBytes;
}

// Throws FrameError where the message has fewer.
std::uint64_t bytes_of_points(const MessageCursor& message, std::uint32_t points) {
  // Behind the last point nothing fills up to a multiple of four.
  const std::uint64_t needed = points == 0 ? 0 : std::uint64_t{points - 1} * step_of(message) + kCustomPointBytes;
  if (needed > message.left()) {
    message.refuse(say("{} points need {} bytes, but {} are left", points, needed, message.left()));
  }
  return needed;
}

struct LivoxHead {
  std::int64_t stamp_ns = 0;
  std::uint64_t base_ns = 0;
  SourceIdentity source;
};

LivoxHead read_head(MessageCursor& message) {
  LivoxHead head;
  const MessageHeader header = read_header(message);
  head.stamp_ns = header.stamp_ns;
  head.source.frame_id = frame_id_of(header.frame_id);
  head.base_ns = message.number<std::uint64_t>("timebase");
  // What point_num says is said again by the list of points, which is what is believed.
  message.number<std::uint32_t>("point_num");
  head.source.lidar_id = message.number<std::uint8_t>("lidar_id");
  message.bytes(3, "rsvd");
  return head;
}

}  // namespace

DecodedCloud decode_livox_custom(MessageEncoding encoding, ByteView message_bytes, const Place& place) {
  MessageCursor message(encoding, message_bytes, place);
  const LivoxHead head = read_head(message);
  const auto points = message.number<std::uint32_t>("points");
  const std::size_t step = step_of(message);
  const std::uint64_t needed = bytes_of_points(message, points);
  const ByteView data = message.bytes(static_cast<std::size_t>(needed), "points");
  Bytes bytes(std::size_t{points} * step);
  std::copy_n(data.data, data.size, bytes.begin());

  DecodedCloud cloud;
  cloud.source = head.source;
  cloud.stamp_ns = head.stamp_ns;
  const std::uint64_t most = std::numeric_limits<std::int64_t>::max();
  if (cloud.stamp_ns == 0 && head.base_ns <= most) cloud.stamp_ns = static_cast<std::int64_t>(head.base_ns);
  cloud.frame = describe_frame(std::move(bytes), layout_of(message, points));
  return cloud;
}

ScanSpan span_of_livox_custom(MessageEncoding encoding, ByteView message_bytes, const Place& place) {
  MessageCursor message(encoding, message_bytes, place);
  const LivoxHead head = read_head(message);
  const auto points = message.number<std::uint32_t>("points");
  bytes_of_points(message, points);
  ScanSpan span;
  span.begin_ns = static_cast<std::int64_t>(std::min(head.base_ns, kBaseMost_ns));
  span.end_ns = span.begin_ns;
  if (points == 0) return span;
  message.bytes(std::size_t{points - 1} * step_of(message), "points");
  span.end_ns += message.number<std::uint32_t>("offset_time of the last point");
  return span;
}

SourceIdentity source_of_livox_custom(MessageEncoding encoding, ByteView message_bytes, const Place& place) {
  MessageCursor message(encoding, message_bytes, place);
  return read_head(message).source;
}

}  // namespace pose_wall::tools
