// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What systemd is told, where it started the daemon (sd_notify(3)); by the protocol, which is one datagram.

#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace pose_wall::tools::live {

class ServiceManager {
 public:
  // Reads NOTIFY_SOCKET and WATCHDOG_USEC.
  ServiceManager();

  void ready() { tell("READY=1"); }
  void stopping() { tell("STOPPING=1"); }
  void status(const std::string& text) { tell("STATUS=" + text); }
  // Only while all is well; call it as often as the loop turns.
  void alive();

 private:
  using Clock = std::chrono::steady_clock;

  void tell(const std::string& message) const;

  std::string socket_;
  std::optional<Clock::duration> alive_every_;
  Clock::time_point alive_last_{};
};

}  // namespace pose_wall::tools::live
