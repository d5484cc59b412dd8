// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The one shape in which frames reach the verbs, whatever they were recorded in: files, bags, captures of packets.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/frames/frame.hpp"

namespace pose_wall::tools {

struct SourcedFrame {
  std::string name;                      // for messages and tables: "a.pcd", "road.bag#12"
  std::optional<std::int64_t> stamp_ns;  // as the input carries it
  std::optional<Frame> frame;            // none: it could not be read
  std::string error;                     // then why
  double load_ms = 0.0;
};

struct SourceTopic {
  std::string name;
  std::string type;
  std::uint64_t messages = 0;
  bool has_clouds = false;   // a message is a frame
  bool has_packets = false;  // messages hold packets, of which frames are put together
};

// What packets tell of their sender, in English: "turn rate", "600 rpm".
struct SourceFact {
  std::string word, found;
};

// One of those who sent what an input holds.
struct SourceSender {
  std::string name;  // what tells it apart, as --source takes it
  std::uint64_t count = 0;
  bool is_read = false;
  std::vector<SourceFact> facts = {};
  std::vector<std::string> oddities = {};  // a sentence each, for people
};

struct SourceAbout {
  std::string kind;                        // "ROS 1 bag"
  std::vector<SourceTopic> topics;         // of a bag
  std::string topic;                       // the one whose clouds are the frames
  std::vector<SourceSender> senders = {};  // of these clouds or packets, where the input tells them
};

// Frames of one input, in its own order. What cannot be read is a frame with an error, and the ones after it follow
// where they can still be found.
class FrameSource {
 public:
  FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;
  virtual ~FrameSource() = default;

  // Nothing at the end.
  virtual std::optional<SourcedFrame> next() = 0;

  // How many will come, unreadable ones included; for progress, not for allocation.
  virtual std::size_t frames() const = 0;

  virtual SourceAbout about() const = 0;

  // A choice that was made of what the input holds, for people; "" where there was none.
  virtual std::string note() const { return ""; }
};

}  // namespace pose_wall::tools
