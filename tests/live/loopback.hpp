// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Datagrams to a port of this machine, as a sensor sends them.

#pragma once

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace pose_wall::test {

class LoopbackSender {
 public:
  // from: 127.0.0.2 is another machine to who looks at addresses.
  explicit LoopbackSender(std::uint16_t port, const char* from = "127.0.0.1")
      : file_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in own{};
    own.sin_family = AF_INET;
    inet_pton(AF_INET, from, &own.sin_addr);
    is_bound_ = bind(file_, reinterpret_cast<const sockaddr*>(&own), sizeof own) == 0;
    to_.sin_family = AF_INET;
    to_.sin_port = htons(port);
    to_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  }
  LoopbackSender(const LoopbackSender&) = delete;
  LoopbackSender& operator=(const LoopbackSender&) = delete;
  ~LoopbackSender() { close(file_); }

  bool send(std::string_view packet) const {
    return is_bound_ && sendto(file_, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to_),
                               sizeof to_) == static_cast<ssize_t>(packet.size());
  }

 private:
  int file_;
  bool is_bound_ = false;
  sockaddr_in to_{};
};

// A port that nobody has just now, for SOCK_DGRAM or SOCK_STREAM: what is free for one may be taken for the other.
inline std::uint16_t free_port(int kind) {
  const int file = socket(AF_INET, kind | SOCK_CLOEXEC, 0);
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof own;
  const bool known = bind(file, reinterpret_cast<const sockaddr*>(&own), size) == 0 &&
                     getsockname(file, reinterpret_cast<sockaddr*>(&own), &size) == 0;
  close(file);
  return known ? ntohs(own.sin_port) : 0;
}

inline std::uint16_t free_udp_port() {
  return free_port(SOCK_DGRAM);
}
inline std::uint16_t free_tcp_port() {
  return free_port(SOCK_STREAM);
}

}  // namespace pose_wall::test
