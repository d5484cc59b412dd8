// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Events for any number of viewers. Of each kind only the newest is kept: who is slow gets fewer and holds up nobody.

#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace pose_wall::tools::live {

class Broadcast {
 public:
  // In the order in which a viewer must get them.
  enum Kind { kHello, kHealth, kStop, kMap, kRoadway, kFrame, kKinds };

  // What one viewer has seen; 0: nothing.
  using Seen = std::array<std::uint64_t, kKinds>;

  void post(Kind kind, std::string event);
  // The events that this viewer has not seen, which it then has; waits until there is one or time is up (none) or `end`
  // was called (none).
  std::vector<std::shared_ptr<const std::string>> next(Seen* seen, int timeout_ms);
  // All but the hello.
  void forget_frames();
  void end();
  bool is_ending() const;

 private:
  struct Newest {
    std::shared_ptr<const std::string> event;
    std::uint64_t number = 0;
  };

  mutable std::mutex lock_;
  std::condition_variable changed_;
  std::array<Newest, kKinds> newest_;
  std::uint64_t posted_ = 0;
  bool ending_ = false;
};

}  // namespace pose_wall::tools::live
