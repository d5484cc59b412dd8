// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What one viewer says and is told, by the protocol of Foxglove: its version 1, which the names foxglove.websocket.v1
// and foxglove.sdk.v1 stand for. A viewer subscribes to channels; all else that it may ask for is refused in words.

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/live/foxglove/socket_server.hpp"
#include "apps/live/foxglove/viewer_board.hpp"
#include "apps/live/recorder/mcap_writer.hpp"

namespace pose_wall::tools::live {

// Of all viewers, for the health.
struct ViewerCounts {
  std::atomic<std::uint64_t> viewers{0}, sent{0}, skipped{0}, refused{0};
};

class ViewerTalk final : public SocketTalk {
 public:
  // All must outlive the talk. is_asked: called before each look for news.
  ViewerTalk(const std::vector<McapChannel>& channels, const std::string& session, ViewerBoard& board,
             ViewerCounts& counts, std::function<void()> is_asked);
  ~ViewerTalk() override;

  std::optional<SocketMessage> next() override;
  void hear(std::string_view message, bool is_text) override;

 private:
  struct Subscription {
    std::uint32_t id;
    std::size_t channel;
    std::uint64_t seen;
    std::uint64_t bytes = 0;  // that were sent when its next message is due
  };
  void subscribe(std::uint64_t id, std::uint64_t channel);
  void unsubscribe(std::uint64_t id);
  void refuse(const std::string& why);

  const std::vector<McapChannel>& channels_;
  ViewerBoard& board_;
  ViewerCounts& counts_;
  std::function<void()> is_asked_;
  std::deque<std::string> greetings_;
  std::string refusal_;  // the newest one; empty: none waits
  std::vector<Subscription> subscriptions_;
  std::uint64_t served_ = 0;  // `bytes` of the message that was sent last
};

}  // namespace pose_wall::tools::live
