// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A FrameTaker that keeps what it is given, and waits for it.

#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "apps/live/source.hpp"

namespace pose_wall::test {

// Long enough for the slowest machine; what is waited for comes far sooner.
constexpr auto kPatience = std::chrono::seconds(20);

class FrameCatcher final : public tools::live::FrameTaker {
 public:
  void take(tools::live::LiveFrame frame) override {
    const std::lock_guard<std::mutex> locked(lock_);
    frames_.push_back(std::move(frame));
    changed_.notify_all();
  }
  void set_extrinsic(const std::optional<tools::live::Extrinsic>& extrinsic) override {
    const std::lock_guard<std::mutex> locked(lock_);
    extrinsics_.push_back(extrinsic);
    changed_.notify_all();
  }
  void wait_idle() override { ++idle_waits_; }

  // False where they do not come.
  bool wait_for_frames(std::size_t count) {
    std::unique_lock<std::mutex> locked(lock_);
    return changed_.wait_for(locked, kPatience, [&] { return frames_.size() >= count; });
  }
  bool wait_for_extrinsics(std::size_t count) {
    std::unique_lock<std::mutex> locked(lock_);
    return changed_.wait_for(locked, kPatience, [&] { return extrinsics_.size() >= count; });
  }

  // After the source was stopped.
  const std::vector<tools::live::LiveFrame>& frames() const { return frames_; }
  const std::vector<std::optional<tools::live::Extrinsic>>& extrinsics() const { return extrinsics_; }
  std::size_t idle_waits() const { return idle_waits_; }

 private:
  std::mutex lock_;
  std::condition_variable changed_;
  std::vector<tools::live::LiveFrame> frames_;
  std::vector<std::optional<tools::live::Extrinsic>> extrinsics_;
  std::atomic<std::size_t> idle_waits_{0};
};

// Waits until it is true; false where it does not become so.
template <typename Condition>
bool becomes_true(Condition condition) {
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

inline std::string fact(const tools::live::PartHealth& health, const std::string& name) {
  for (const auto& [known, value] : health.facts) {
    if (known == name) return value;
  }
  return "there is no fact '" + name + "'";
}

}  // namespace pose_wall::test
