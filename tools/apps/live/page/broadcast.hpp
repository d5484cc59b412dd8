// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Events for any number of viewers. Of each kind only the newest is kept: who is slow gets fewer and holds up nobody.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

namespace pose_wall::tools::live {

class Broadcast {
 public:
  // In the order in which a viewer must get them.
  enum Kind { kHello, kHealth, kStop, kMap, kRoadway, kFrame, kKinds };

  // What one viewer has seen; 0: nothing.
  using Seen = std::array<std::uint64_t, kKinds>;

  void post(Kind kind, std::string event);
  // The first kind's event that this viewer has not seen, which it then has; none: nothing is new.
  std::shared_ptr<const std::string> next(Seen* seen) const;
  // All but the hello.
  void forget_frames();

 private:
  struct Newest {
    std::shared_ptr<const std::string> event;
    std::uint64_t number = 0;
  };

  mutable std::mutex lock_;
  std::array<Newest, kKinds> newest_;
  std::uint64_t posted_ = 0;
};

}  // namespace pose_wall::tools::live
