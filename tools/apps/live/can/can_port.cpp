// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/can/can_port.hpp"

#include <fmt/format.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
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

int CanPort::receive(int at_most_ms, pose_wall_can_frame* frame) const {
  pollfd waiting{file_, POLLIN, 0};
  if (poll(&waiting, 1, at_most_ms) == 0) return EAGAIN;
  can_frame received{};
  const ssize_t bytes = recv(file_, &received, sizeof received, MSG_DONTWAIT);
  if (bytes < 0) return errno == EWOULDBLOCK || errno == EINTR ? EAGAIN : errno;
  if (bytes == 0) return ENETDOWN;
  if (bytes != static_cast<ssize_t>(sizeof received) || received.can_dlc != sizeof frame->data) return EBADMSG;
  frame->is_long = (received.can_id & CAN_EFF_FLAG) != 0 ? 1U : 0U;
  frame->id = received.can_id & CAN_EFF_MASK;
  std::memcpy(frame->data, received.data, sizeof frame->data);
  return 0;
}

namespace {

// No filter takes no frame.
CanPort open_filtered(const std::string& interface_name, const can_filter* filter) {
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
  setsockopt(file, SOL_CAN_RAW, CAN_RAW_FILTER, filter, filter != nullptr ? sizeof *filter : 0);
  if (bind(file, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) refuse("cannot be used");
  return port;
}

}  // namespace

// What is sent by a port that nobody reads must not pile up behind it.
CanPort open_can_port(const std::string& interface_name) {
  return open_filtered(interface_name, nullptr);
}

// Requests for a frame (RTR) have its identifier, too, and are none.
CanPort open_can_reader(const std::string& interface_name, std::uint32_t id, bool is_long) {
  const can_filter filter{id | (is_long ? CAN_EFF_FLAG : 0U),
                          CAN_EFF_FLAG | CAN_RTR_FLAG | (is_long ? CAN_EFF_MASK : CAN_SFF_MASK)};
  return open_filtered(interface_name, &filter);
}

}  // namespace pose_wall::tools::live
