// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Recorded datagrams of a sensor as frames.

#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/frames/frame_source.hpp"
#include "io/packets/datagram_source.hpp"
#include "io/packets/sensors.hpp"

namespace pose_wall::tools {

// How the datagrams are read, and what is said of them.
struct PacketRecording {
  std::string name;  // of frames: "a.pcap", behind it "#12"
  SourceAbout about;
  std::function<std::unique_ptr<DatagramSource>()> open;
  bool may_be_ousters = false;  // by the type of their messages
  std::string ouster_hint;      // where metadata was looked for and is not; "" where it is there
};

class PacketFrames : public FrameSource {
 public:
  // Goes through the recording once. A turn at either end that was not seen whole is left out, unless there is no
  // other. Throws FrameError where there is no frame, with what is there instead.
  PacketFrames(PacketRecording recording, const SensorChoice& choice);
  ~PacketFrames() override;

  std::optional<SourcedFrame> next() override;
  std::size_t frames() const override { return frames_; }
  SourceAbout about() const override { return recording_.about; }
  std::string note() const override { return note_; }

 private:
  class Others;
  class ScanWalk;

  [[noreturn]] void refuse_empty(const ScanWalk& survey, const SensorChoice& choice) const;
  [[noreturn]] void refuse_without_metadata() const;

  PacketRecording recording_;
  std::unique_ptr<ScanWalk> walk_;
  std::string note_;
  std::size_t frames_ = 0;
  std::size_t next_ = 0;
};

}  // namespace pose_wall::tools
