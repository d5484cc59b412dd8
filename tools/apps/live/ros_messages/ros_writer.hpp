// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A message of ROS with what many of them have: a header, a time, a pose.

#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "io/bags/message_writer.hpp"

namespace pose_wall::tools::live {

class RosWriter : public MessageWriter {
 public:
  using MessageWriter::MessageWriter;

  void header(std::int64_t stamp_ns, const std::string& frame_id) {
    if (!is_cdr()) number(std::uint32_t{0});  // seq, which nobody reads any more
    time(stamp_ns);
    text(frame_id);
  }
  // Before 1970 there is no time in ROS 1.
  void time(std::int64_t ns) {
    const std::int64_t from_1970_ns = std::max<std::int64_t>(ns, 0);
    number(static_cast<std::uint32_t>(from_1970_ns / 1'000'000'000));
    number(static_cast<std::uint32_t>(from_1970_ns % 1'000'000'000));
  }
  // Of PointCloud2.
  void field(const char* name, std::uint32_t offset, std::uint8_t type) {
    text(name);
    number(offset);
    number(type);
    number(std::uint32_t{1});
  }
  void key_value(const std::string& key, const std::string& value) {
    text(key);
    text(value);
  }
};

// "/map" is "map": tf2 takes no leading slash.
inline std::string without_slash(std::string frame) {
  if (frame.rfind('/', 0) == 0) frame.erase(0, 1);
  return frame;
}

}  // namespace pose_wall::tools::live
