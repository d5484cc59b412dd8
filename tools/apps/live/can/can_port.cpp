// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/can/can_port.hpp"

#include <fmt/format.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace pose_wall::tools::live {

CanPort::~CanPort() {
  if (file_ >= 0) close(file_);
}

int CanPort::send(const pose_wall_can_frame& frame) const {
  can_frame sent{};
  sent.can_id = frame.id | (frame.is_long != 0 ? CAN_EFF_FLAG : 0U);
  sent.can_dlc = sizeof frame.data;
  std::memcpy(sent.data, frame.data, sizeof frame.data);
  const ssize_t bytes = ::send(file_, &sent, sizeof sent, MSG_DONTWAIT | MSG_NOSIGNAL);
  if (bytes == static_cast<ssize_t>(sizeof sent)) return 0;
  if (bytes >= 0) return EIO;
  // The kernel tells ENOBUFS of the interface's queue, EAGAIN of the socket's.
  return errno == ENOBUFS || errno == EWOULDBLOCK ? EAGAIN : errno;
}

CanPort open_can_port(const std::string& interface_name) {
  const auto refuse = [&](const char* what) {
    throw std::runtime_error(fmt::format("can: {}: {}: {}", interface_name, what, std::strerror(errno)));
  };
  const int file = socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW);
  if (file < 0) refuse("this kernel has no SocketCAN");
  CanPort port(file);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(if_nametoindex(interface_name.c_str()));
  if (address.can_ifindex == 0) refuse("no such interface");
  // Nothing is read here, so nothing may pile up: an empty filter takes no frame.
  setsockopt(file, SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0);
  if (bind(file, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) refuse("cannot send by it");
  return port;
}

}  // namespace pose_wall::tools::live
