// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/page/broadcast.hpp"

#include <utility>

namespace pose_wall::tools::live {

void Broadcast::post(Kind kind, std::string event) {
  auto shared = std::make_shared<const std::string>(std::move(event));
  const std::lock_guard<std::mutex> locked(lock_);
  newest_[kind].event.swap(shared);
  newest_[kind].number = ++posted_;
}

std::shared_ptr<const std::string> Broadcast::next(Seen* seen) const {
  const std::lock_guard<std::mutex> locked(lock_);
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    if (newest_[kind].number <= (*seen)[kind]) continue;
    (*seen)[kind] = newest_[kind].number;
    return newest_[kind].event;
  }
  return nullptr;
}

void Broadcast::forget_frames() {
  const std::lock_guard<std::mutex> locked(lock_);
  for (std::size_t kind = kHello + 1; kind < kKinds; ++kind) newest_[kind] = {};
}

}  // namespace pose_wall::tools::live
