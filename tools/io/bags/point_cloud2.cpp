// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/point_cloud2.hpp"

#include <fmt/format.h>

#include <limits>
#include <vector>

#include "io/bags/message_cursor.hpp"
#include "io/frames/wide_times.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

// Types of PointField and of pose_wall_field are numbered alike: 1 INT8 to 8 FLOAT64. 9 INT64, 10 UINT64 and 11 BOOLEAN
// came to sensor_msgs later.
constexpr std::uint8_t kTypeMax = kFieldBool;

struct CloudHead {
  std::uint32_t height = 0, width = 0;
  std::uint32_t point_step = 0, row_step = 0;
  PointLayout layout;
  std::vector<std::uint64_t> field_ends;
};

void read_fields(MessageCursor& message, CloudHead& head) {
  const auto count = message.number<std::uint32_t>("fields");
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::string_view name = message.text("name of a field");
    const auto offset = message.number<std::uint32_t>("offset of a field");
    const auto type = message.number<std::uint8_t>("type of a field");
    const auto elements = message.number<std::uint32_t>("count of a field");
    if (type < 1 || type > kTypeMax) {
      message.refuse(say("field '{}' is of type {}; 1 to {} are allowed", name, type, kTypeMax));
    }
    head.layout.fields.push_back({name, {offset, type}});
    head.field_ends.push_back(offset + std::uint64_t{field_type_bytes(type)} * std::max<std::uint32_t>(elements, 1));
  }
}

void check_fields(const MessageCursor& message, const CloudHead& head) {
  for (std::size_t i = 0; i < head.field_ends.size(); ++i) {
    if (head.field_ends[i] > head.point_step) {
      message.refuse(say("field '{}' ends at byte {} of points of {} bytes", head.layout.fields[i].name,
                         head.field_ends[i], head.point_step));
    }
  }
}

// Drivers of one row write anything as its step; it is needed from the second row on.
std::uint64_t bytes_needed(const MessageCursor& message, const CloudHead& head) {
  const std::uint64_t row = std::uint64_t{head.width} * head.point_step;
  if (head.height == 0 || row == 0) return 0;
  if (head.height > 1 && head.row_step < row) {
    message.refuse(say("rows of {} points of {} bytes do not fit the row step of {} bytes", head.width, head.point_step,
                       head.row_step));
  }
  return std::uint64_t{head.height - 1} * head.row_step + row;
}

Frame frame_of(const MessageCursor& message, CloudHead& head, ByteView data) {
  const std::uint64_t points = std::uint64_t{head.width} * head.height;
  if (points > std::numeric_limits<std::uint32_t>::max()) {
    message.refuse(say("{} points; at most {} are allowed", points, std::numeric_limits<std::uint32_t>::max()));
  }
  const std::uint64_t needed = bytes_needed(message, head);
  if (needed > data.size || (points > 0 && head.point_step == 0)) {
    message.refuse(say("{} x {} points of {} bytes, rows of {} bytes, need {} bytes, but data has {}", head.height,
                       head.width, head.point_step, head.row_step, needed, data.size));
  }
  head.layout.point_step = head.point_step;
  head.layout.count = static_cast<std::uint32_t>(points);
  if (head.height > 1) {
    head.layout.rows = head.height;
    head.layout.row_step = head.row_step;
  }
  Frame frame;
  try {
    frame = describe_frame(Bytes(data.data, data.data + data.size), head.layout);
  } catch (const FrameError& fault) {
    message.refuse(fault.what());
  }
  if (head.height > 1 && needed > 0) {
    frame.cloud.width = head.width;
    frame.cloud.height = head.height;
    frame.cloud.row_step = head.row_step;
    frame.cloud.data_bytes = needed;
  }
  return frame;
}

}  // namespace

DecodedCloud decode_point_cloud2(MessageEncoding encoding, ByteView message_bytes, const Place& place) {
  MessageCursor message(encoding, message_bytes, place);
  DecodedCloud cloud;
  const MessageHeader header = read_header(message);
  cloud.stamp_ns = header.stamp_ns;
  cloud.source.frame_id = frame_id_of(header.frame_id);
  CloudHead head;
  head.height = message.number<std::uint32_t>("height");
  head.width = message.number<std::uint32_t>("width");
  read_fields(message, head);
  head.layout.big_endian = message.number<std::uint8_t>("is_bigendian") != 0;
  head.point_step = message.number<std::uint32_t>("point_step");
  head.row_step = message.number<std::uint32_t>("row_step");
  check_fields(message, head);
  const ByteView data = message.block("data");
  message.number<std::uint8_t>("is_dense");
  cloud.frame = frame_of(message, head, data);
  return cloud;
}

SourceIdentity source_of_point_cloud2(MessageEncoding encoding, ByteView message_bytes, const Place& place) {
  MessageCursor message(encoding, message_bytes, place);
  SourceIdentity source;
  source.frame_id = frame_id_of(read_header(message).frame_id);
  return source;
}

}  // namespace pose_wall::tools
