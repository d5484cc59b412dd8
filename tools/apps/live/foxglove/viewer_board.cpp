// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/foxglove/viewer_board.hpp"

#include <utility>

namespace pose_wall::tools::live {

ViewerBoard::ViewerBoard(std::vector<Keeping> channels) {
  for (const Keeping& keeping : channels) channels_.push_back({keeping, {}, 0, 0});
}

void ViewerBoard::put(std::size_t channel, std::string bytes, std::int64_t time_ns) {
  auto shared = std::make_shared<const std::string>(std::move(bytes));
  const std::lock_guard<std::mutex> locked(lock_);
  Channel& to = channels_[channel];
  to.kept.push_back({std::move(shared), time_ns, ++to.put});
  if (to.kept.size() > to.keeping.messages) to.kept.pop_front();
}

std::uint64_t ViewerBoard::enter(std::size_t channel) {
  const std::lock_guard<std::mutex> locked(lock_);
  Channel& entered = channels_[channel];
  ++entered.subscribers;
  return entered.keeping.for_late ? entered.put - entered.kept.size() : entered.put;
}

void ViewerBoard::leave(std::size_t channel) {
  const std::lock_guard<std::mutex> locked(lock_);
  Channel& left = channels_[channel];
  // What nobody keeps for later takes memory for nothing: clouds are large.
  if (--left.subscribers == 0 && !left.keeping.for_late) left.kept.clear();
}

bool ViewerBoard::has_subscribers(std::size_t channel) const {
  const std::lock_guard<std::mutex> locked(lock_);
  return channels_[channel].subscribers > 0;
}

std::optional<ViewerBoard::Message> ViewerBoard::behind(std::size_t channel, std::uint64_t number) const {
  const std::lock_guard<std::mutex> locked(lock_);
  for (const Message& message : channels_[channel].kept) {
    if (message.number > number) return message;
  }
  return std::nullopt;
}

}  // namespace pose_wall::tools::live
