// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/sources/udp_receiver.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <stdexcept>

#include "apps/live/clocks.hpp"

namespace pose_wall::tools::live {
namespace {

std::string ipv4_text(std::uint32_t address) {
  return fmt::format("{}.{}.{}.{}", address >> 24U, (address >> 16U) & 255U, (address >> 8U) & 255U, address & 255U);
}

// More than a receive buffer ever holds. What seems to have waited longer was stamped before the clock was set.
constexpr std::int64_t kWaitedMost_ns = 1'000'000'000;
// NTP that steers changes it by half a thousandth; between two packets that is less.
constexpr std::int64_t kSetLeast_ns = 5'000'000;

[[noreturn]] void fail(std::uint32_t address, std::uint16_t port, const char* what) {
  throw std::runtime_error(
      fmt::format("udp_address {}, udp_port {}: {}: {}", ipv4_text(address), port, what, std::strerror(errno)));
}

sockaddr_in place_of(std::uint32_t address, std::uint16_t port) {
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(address);
  place.sin_port = htons(port);
  return place;
}

// What only makes counts, times or the start better: the receiver works without.
void turn_on(int file, int level, int option) {
  const int on = 1;
  static_cast<void>(setsockopt(file, level, option, &on, sizeof on));
}

}  // namespace

UdpReceiver::UdpReceiver(std::uint32_t address, std::uint16_t port)
    : address_(address), apart_ns_(wall_ns() - monotonic_ns()) {
  file_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (file_ < 0) fail(address, port, "no socket");
  const int wished = kBufferWished;
  static_cast<void>(setsockopt(file_, SOL_SOCKET, SO_RCVBUF, &wished, sizeof wished));
  socklen_t size = sizeof buffer_bytes_;
  getsockopt(file_, SOL_SOCKET, SO_RCVBUF, &buffer_bytes_, &size);
  turn_on(file_, SOL_SOCKET, SO_TIMESTAMPNS);
  turn_on(file_, SOL_SOCKET, SO_RXQ_OVFL);
  // ip(7): an address that no interface has yet may be bound to. The sensor's cable may come after power-on.
  turn_on(file_, IPPROTO_IP, IP_FREEBIND);
  sockaddr_in own = place_of(address, port);
  size = sizeof own;
  if (bind(file_, reinterpret_cast<const sockaddr*>(&own), size) != 0 ||
      getsockname(file_, reinterpret_cast<sockaddr*>(&own), &size) != 0) {
    const int why = errno;
    close(file_);
    errno = why;
    fail(address, port, "cannot listen there");
  }
  port_ = ntohs(own.sin_port);
}

UdpReceiver::~UdpReceiver() {
  close(file_);
}

// The kernel refuses to bind to what no interface has, unless it is asked not to.
bool UdpReceiver::has_address() const {
  const int file = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (file < 0) return true;  // nobody knows; the receiver itself has its socket
  const sockaddr_in own = place_of(address_, 0);
  const bool is_absent = bind(file, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0 && errno == EADDRNOTAVAIL;
  close(file);
  return !is_absent;
}

std::optional<Datagram> UdpReceiver::next(int timeout_ms) {
  pollfd readable{file_, POLLIN, 0};
  if (poll(&readable, 1, timeout_ms) <= 0) return std::nullopt;
  sockaddr_in sender{};
  iovec place{payload_.data(), payload_.size()};
  alignas(cmsghdr) std::array<std::byte, 256> control{};
  msghdr message{};
  message.msg_name = &sender;
  message.msg_namelen = sizeof sender;
  message.msg_iov = &place;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t bytes = recvmsg(file_, &message, MSG_DONTWAIT);
  if (bytes < 0) return std::nullopt;

  timespec arrived{};
  clock_gettime(CLOCK_REALTIME, &arrived);
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET) continue;
    if (part->cmsg_type == SCM_TIMESTAMPNS) std::memcpy(&arrived, CMSG_DATA(part), sizeof arrived);
    if (part->cmsg_type == SO_RXQ_OVFL) std::memcpy(&lost_, CMSG_DATA(part), sizeof lost_);
  }
  Datagram datagram;
  // The kernel stamps by the clock that people set. Where that was set what waited meanwhile has stamps of before.
  const std::int64_t now_ns = monotonic_ns(), wall_now_ns = wall_ns();
  if (std::abs(wall_now_ns - now_ns - apart_ns_) > kSetLeast_ns) set_at_ns_ = now_ns;
  apart_ns_ = wall_now_ns - now_ns;
  const std::int64_t stamp_ns = std::int64_t{arrived.tv_sec} * 1'000'000'000 + arrived.tv_nsec;
  const std::int64_t waited_ns = std::clamp<std::int64_t>(wall_now_ns - stamp_ns, 0, kWaitedMost_ns);
  datagram.captured_ns = now_ns - (set_at_ns_ > 0 && now_ns - set_at_ns_ < kWaitedMost_ns ? 0 : waited_ns);
  datagram.from.address = ntohl(sender.sin_addr.s_addr);
  datagram.from.port = ntohs(sender.sin_port);
  datagram.from.to_port = port_;
  datagram.payload = {payload_.data(), static_cast<std::size_t>(bytes)};
  return datagram;
}

}  // namespace pose_wall::tools::live
