// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/service_manager.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace pose_wall::tools::live {

ServiceManager::ServiceManager() {
  if (const char* socket = std::getenv("NOTIFY_SOCKET")) socket_ = socket;
  const char* watchdog_us = std::getenv("WATCHDOG_USEC");
  const long long period_us = watchdog_us != nullptr ? std::atoll(watchdog_us) : 0;
  // Half of the time allowed, as sd_watchdog_enabled(3) advises.
  if (period_us > 0) alive_every_ = std::chrono::microseconds(period_us / 2);
}

void ServiceManager::alive() {
  const Clock::time_point now = Clock::now();
  if (!alive_every_ || now - alive_last_ < *alive_every_) return;
  alive_last_ = now;
  tell("WATCHDOG=1");
}

void ServiceManager::tell(const std::string& message) const {
  sockaddr_un address{};
  if (socket_.empty() || socket_.size() >= sizeof address.sun_path) return;
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, socket_.data(), socket_.size());
  if (address.sun_path[0] == '@') address.sun_path[0] = '\0';  // an abstract socket
  const int file = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (file < 0) return;
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + socket_.size());
  // Nobody to tell is no fault of ours.
  const ssize_t sent =
      sendto(file, message.data(), message.size(), MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&address), length);
  static_cast<void>(sent);
  close(file);
}

}  // namespace pose_wall::tools::live
