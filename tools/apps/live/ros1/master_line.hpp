// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The line to the master of ROS 1, on which no call waits for ever: roscpp calls the master without a time limit, so it
// is told an address of this process, which passes the bytes on and hangs up where no answer comes.

#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "io/config_file/live_settings.hpp"

namespace pose_wall::tools::live {

// "http://HOST:PORT" or "http://HOST:PORT/" in its parts; nothing where it is none.
std::optional<HostPort> parse_master_uri(const std::string& uri);

struct MasterAddress {
  std::string uri;
  HostPort place;
};
// By ROS_MASTER_URI, else the usual one. Throws std::runtime_error that says what is allowed.
MasterAddress master_of_environment();
// Whether a variable of the environment says something.
bool is_told(const char* variable);

class MasterLine {
 public:
  // Listens at a free port of loopback from now on. Throws std::runtime_error where there is none.
  explicit MasterLine(const HostPort& master);
  ~MasterLine();
  MasterLine(const MasterLine&) = delete;
  MasterLine& operator=(const MasterLine&) = delete;

  // What to call instead of the master.
  std::string uri() const;

  // All calls end within this time from now, answered or not, and no new one is taken after it. From any thread.
  void end_within(std::chrono::milliseconds time);

  // A call waits this long for its answer. A master on a slow machine takes some ten milliseconds.
  static constexpr std::chrono::milliseconds kPatience{2000};
  // roscpp needs one line a thread; whoever else on this machine finds the port gets no more than these.
  static constexpr std::size_t kCallsMost = 16;

 private:
  class Call;
  struct Lookup;
  using Clock = std::chrono::steady_clock;

  void run();
  void take_call();
  // The address as of the last lookup; nothing while it is looked up.
  std::shared_ptr<const Lookup> look_up();

  HostPort master_;
  int listens_ = -1, wakes_ = -1;
  std::uint16_t port_ = 0;
  std::atomic<Clock::rep> ends_at_;
  std::atomic<bool> closing_{false};
  std::vector<std::unique_ptr<Call>> calls_;
  std::shared_ptr<Lookup> lookup_;
  std::thread thread_;
};

}  // namespace pose_wall::tools::live
