// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/page/broadcast.hpp"

#include <chrono>

namespace pose_wall::tools::live {

void Broadcast::post(Kind kind, std::string event) {
  auto shared = std::make_shared<const std::string>(std::move(event));
  {
    const std::lock_guard<std::mutex> locked(lock_);
    newest_[kind].event.swap(shared);
    newest_[kind].number = ++posted_;
  }
  changed_.notify_all();
}

std::vector<std::shared_ptr<const std::string>> Broadcast::next(Seen* seen, int timeout_ms) {
  std::unique_lock<std::mutex> locked(lock_);
  const auto has_news = [&] {
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
      if (newest_[kind].number > (*seen)[kind]) return true;
    }
    return false;
  };
  changed_.wait_for(locked, std::chrono::milliseconds(timeout_ms), [&] { return ending_ || has_news(); });
  std::vector<std::shared_ptr<const std::string>> news;
  if (ending_) return news;
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    if (newest_[kind].number <= (*seen)[kind]) continue;
    (*seen)[kind] = newest_[kind].number;
    news.push_back(newest_[kind].event);
  }
  return news;
}

void Broadcast::forget_frames() {
  const std::lock_guard<std::mutex> locked(lock_);
  for (std::size_t kind = kHello + 1; kind < kKinds; ++kind) newest_[kind] = {};
}

void Broadcast::end() {
  {
    const std::lock_guard<std::mutex> locked(lock_);
    ending_ = true;
  }
  changed_.notify_all();
}

bool Broadcast::is_ending() const {
  const std::lock_guard<std::mutex> locked(lock_);
  return ending_;
}

}  // namespace pose_wall::tools::live
