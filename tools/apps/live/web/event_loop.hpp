// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The loop that every server of the daemon turns in: one context of libwebsockets and one thread for all connections.
// So a client that is slow, idle or silent costs a descriptor and nobody's time.

#pragma once

#include <libwebsockets.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <string>
#include <thread>

#include "apps/live/log.hpp"
#include "io/config_file/live_settings.hpp"

namespace pose_wall::tools::live {

// Whoever is slower with a request, or takes nothing of an answer for so long, holds a descriptor for nothing. Links
// under ground lose packets for a second or two.
constexpr int kTimeout_s = 5;

// Of a request; empty where it has none.
std::string header_text(lws* connection, lws_token_indexes which);

// "localhost:8080", "[::1]:8080": the name before the port.
std::string host_of(const std::string& header);

// The library is written in C: nothing may be thrown through it. What is thrown ends the connection.
template <typename Answer>
int without_throwing(const char* part, const Answer& answer) {
  try {
    return answer();
  } catch (const std::exception& fault) {
    log_line(Grade::kBad, part, fault.what());
    return -1;
  }
}

class EventLoop {
 public:
  EventLoop() = default;
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;
  ~EventLoop() { stop(); }

  // info: what is the server's own, as protocols, user and a certificate. on_turn: in the loop's thread, twice a
  // second. Throws std::runtime_error where the address cannot be listened at.
  void start(const HostPort& place, unsigned connections_most, lws_context_creation_info info,
             std::function<void()> on_turn);
  // The protocols are called with LWS_CALLBACK_EVENT_WAIT_CANCELLED; from any thread.
  void wake();
  // Ends every connection. May be called twice.
  void stop();
  // False once the loop has failed.
  bool serves() const { return serves_; }

 private:
  struct Timer;

  void serve();

  std::string address_;  // in numbers; the library keeps a pointer to it
  std::function<void()> on_turn_;
  lws_context* context_ = nullptr;
  std::thread thread_;
  std::atomic<bool> ending_{false}, serves_{true};
};

}  // namespace pose_wall::tools::live
