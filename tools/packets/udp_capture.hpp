// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The UDP datagrams of a capture of packets (.pcap, .pcapng), put together where they were sent in fragments.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "bags/byte_cursor.hpp"

namespace pose_wall::tools {

struct Datagram {
  std::int64_t captured_ns = 0;
  std::uint32_t source_address = 0;
  ByteView payload;  // until the next call
};

class UdpCapture {
 public:
  UdpCapture() = default;
  UdpCapture(const UdpCapture&) = delete;
  UdpCapture& operator=(const UdpCapture&) = delete;
  virtual ~UdpCapture() = default;

  // Nothing at the end. What is no UDP over IPv4 is passed over. Throws FrameError for a capture that is cut; nothing
  // more comes then.
  virtual std::optional<Datagram> next() = 0;
};

// Throws FrameError when the file is no capture or this build has no libpcap.
std::unique_ptr<UdpCapture> open_udp_capture(const std::string& path);

}  // namespace pose_wall::tools
