// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// An interface of SocketCAN, to send by, or to read one identifier from.

#pragma once

#include <functional>
#include <string>
#include <utility>

#include "can_frames.h"

namespace pose_wall::tools::live {

class CanPort {
 public:
  explicit CanPort(int file = -1) : file_(file) {}
  CanPort(CanPort&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  CanPort& operator=(CanPort&& other) noexcept {
    std::swap(file_, other.file_);
    return *this;
  }
  CanPort(const CanPort&) = delete;
  CanPort& operator=(const CanPort&) = delete;
  ~CanPort();

  bool is_open() const { return file_ >= 0; }

  // What became of a frame: sent (0), the queue is full (EAGAIN), or why it cannot be sent (errno).
  int send(const pose_wall_can_frame& frame) const;
  // A frame of 8 bytes came (0), none within the time (EAGAIN), another length (EBADMSG), or why none can come (errno).
  int receive(int at_most_ms, pose_wall_can_frame* frame) const;

 private:
  int file_;
};

// Throws std::runtime_error, with the reason.
using OpenCanPort = std::function<CanPort(const std::string& interface_name)>;
CanPort open_can_port(const std::string& interface_name);
// Frames of this identifier alone come, with 29 bits or 11.
CanPort open_can_reader(const std::string& interface_name, std::uint32_t id, bool is_long);

}  // namespace pose_wall::tools::live
