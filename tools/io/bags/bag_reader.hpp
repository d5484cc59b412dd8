// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What recordings of messages have in common, whatever container they lie in.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/bags/byte_cursor.hpp"

namespace pose_wall::tools {

enum class MessageEncoding { kRos1, kCdr, kOther };

struct BagTopic {
  std::string name;
  std::string type;  // "sensor_msgs/PointCloud2", "sensor_msgs/msg/PointCloud2"
  MessageEncoding encoding = MessageEncoding::kOther;
};

struct BagMessage {
  std::size_t topic = 0;  // index into topics()
  std::int64_t recorded_ns = 0;
  ByteView data;  // until the next call
  Place place;    // of the data
};

// What a whole recording holds, told without decoding a message.
struct BagSurvey {
  std::vector<std::uint64_t> messages;  // of each topic
  std::vector<std::string> faults;
};

// Messages in the order of the file.
class BagReader {
 public:
  BagReader() = default;
  BagReader(const BagReader&) = delete;
  BagReader& operator=(const BagReader&) = delete;
  virtual ~BagReader() = default;

  // Throws FrameError for what cannot be read; the next call goes on behind it when its end is known, and gives nothing
  // when it is not.
  virtual std::optional<BagMessage> next() = 0;

  virtual void rewind() = 0;

  // Those met so far; all after survey().
  virtual const std::vector<BagTopic>& topics() const = 0;

  // Goes through the recording once, shows each message, and rewinds. What `look` throws as FrameError is no fault of
  // the recording: the reading finds it again.
  virtual BagSurvey survey(const std::function<void(const BagMessage&)>& look = {});
};

}  // namespace pose_wall::tools
