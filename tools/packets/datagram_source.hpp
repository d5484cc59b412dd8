// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Datagrams one after another, wherever they were recorded: a capture, messages of a bag.

#pragma once

#include <cstdint>
#include <optional>

#include "bags/byte_cursor.hpp"

namespace pose_wall::tools {

struct Datagram {
  std::int64_t captured_ns = 0;
  std::uint32_t source_address = 0;
  ByteView payload;  // until the next call
};

class DatagramSource {
 public:
  DatagramSource() = default;
  DatagramSource(const DatagramSource&) = delete;
  DatagramSource& operator=(const DatagramSource&) = delete;
  virtual ~DatagramSource() = default;

  // Nothing at the end. Throws FrameError for what cannot be read; the next call goes on behind it where that can be
  // found, and gives nothing where it cannot.
  virtual std::optional<Datagram> next() = 0;
};

}  // namespace pose_wall::tools
