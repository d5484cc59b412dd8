// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Datagrams one after another, wherever they were recorded: a capture, messages of a bag.

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/bags/byte_cursor.hpp"

namespace pose_wall::tools {

// Who sent a datagram, as far as its recording tells. Sensors leave the factory with one address for all of a kind:
// then the port that one is told to send to, or the address of its network card, tells two of them apart.
struct Sender {
  std::uint32_t address = 0;            // of IPv4; 0: not told
  std::uint16_t port = 0, to_port = 0;  // it is sent from, and to; 0: not told
  std::uint64_t card = 0;               // of Ethernet, its lower 48 bits; 0: not told
  std::string frame_id;                 // of a message in a bag
};

inline bool operator==(const Sender& a, const Sender& b) {
  return a.address == b.address && a.port == b.port && a.to_port == b.to_port && a.card == b.card &&
         a.frame_id == b.frame_id;
}

// Whether one device may have sent both: what it says of itself comes by a port of its own, in a bag maybe without a
// frame_id.
inline bool may_be_one_device(const Sender& a, const Sender& b) {
  const bool is_frame_same = a.frame_id == b.frame_id || a.frame_id.empty() || b.frame_id.empty();
  return a.address == b.address && a.card == b.card && is_frame_same;
}

struct Datagram {
  std::int64_t captured_ns = 0;
  Sender from;
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
