// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The newest messages of each channel, for any number of viewers. Who is slow gets fewer, and holds up nobody.

#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace pose_wall::tools::live {

// How a channel is kept.
struct Keeping {
  std::size_t messages = 1;  // so many; then the oldest is lost to those who have not taken it
  bool for_late = false;     // who subscribes later gets what is kept
};

class ViewerBoard {
 public:
  struct Message {
    std::shared_ptr<const std::string> bytes;
    std::int64_t time_ns = 0;
    std::uint64_t number = 0;  // counts the messages of a channel from 1
  };

  explicit ViewerBoard(std::vector<Keeping> channels);

  // All from any thread.
  void put(std::size_t channel, std::string bytes, std::int64_t time_ns);
  // The number behind which a new subscriber begins; it counts as one until it leaves.
  std::uint64_t enter(std::size_t channel);
  void leave(std::size_t channel);
  bool has_subscribers(std::size_t channel) const;
  // The oldest message that is kept and has a larger number; none: nothing is new.
  std::optional<Message> behind(std::size_t channel, std::uint64_t number) const;

 private:
  struct Channel {
    Keeping keeping;
    std::deque<Message> kept;
    std::uint64_t put = 0;
    std::size_t subscribers = 0;
  };
  mutable std::mutex lock_;
  std::vector<Channel> channels_;
};

}  // namespace pose_wall::tools::live
