// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Datagrams of one UDP port, with the kernel's time of arrival and its count of those it had no room for.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "io/packets/udp_capture.hpp"

namespace pose_wall::tools::live {

class UdpReceiver {
 public:
  // The address as parse_ipv4 numbers it. One that no interface has is waited for: datagrams come as soon as one has
  // it. Throws std::runtime_error that names address and port: taken, not allowed.
  UdpReceiver(std::uint32_t address, std::uint16_t port);
  ~UdpReceiver();
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;

  // The next one, captured_ns by the monotonic clock; its payload lasts until the next call. Nothing after timeout_ms.
  std::optional<Datagram> next(int timeout_ms);

  std::uint16_t port() const { return port_; }
  // Whether an interface of this machine has the address just now.
  bool has_address() const;
  // By the kernel, since the socket was opened.
  std::uint32_t lost() const { return lost_; }
  // What the kernel granted; less than kBufferWished loses packets while the machine is busy.
  int buffer_bytes() const { return buffer_bytes_; }

  // A 128-beam sensor sends 30 MB/s: a quarter of a second of it.
  static constexpr int kBufferWished = 8 * 1024 * 1024;

 private:
  // The largest datagram that UDP over IPv4 carries.
  static constexpr std::size_t kDatagramMax = 65507;

  std::uint32_t address_;
  int file_ = -1;
  std::uint16_t port_ = 0;
  int buffer_bytes_ = 0;
  std::uint32_t lost_ = 0;
  std::int64_t apart_ns_;       // the clock that people set less the one that nobody sets
  std::int64_t set_at_ns_ = 0;  // when it was set last, by the latter; 0: never
  std::array<std::byte, kDatagramMax> payload_{};
};

}  // namespace pose_wall::tools::live
