// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// rosbag2 can compress each message by itself (compression_mode MESSAGE). Only the folder's metadata.yaml says so, and
// a file that is named alone has none; but no CDR begins as zstd does.

#pragma once

#include "io/bags/bag_reader.hpp"

namespace pose_wall::tools {

class PackedMessage {
 public:
  // What the message holds, until the next call; the message itself where it is not compressed, and where its type is
  // none that is read. Throws FrameError that names the place.
  void unpack(const BagTopic& topic, BagMessage* message);

 private:
  Bytes content_;
};

}  // namespace pose_wall::tools
