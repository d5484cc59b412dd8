// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A runtime on a block of garbage, with a clock that stands until the test moves it, and a gate in its callback.

#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "pose_wall_runtime.h"
#include "support/aligned_block.hpp"
#include "support/clouds.hpp"
#include "support/room.hpp"

namespace pose_wall::test {

constexpr std::int64_t kMs = 1000000;

// Nanoseconds that pass only when the test says so; or, with a step, by each look.
class StandingClock {
 public:
  void advance(std::int64_t by_ns) { now_ns_ += by_ns; }
  void set_step(std::int64_t step_ns) { step_ns_ = step_ns; }
  static std::int64_t read(void* clock) {
    StandingClock& c = *static_cast<StandingClock*>(clock);
    return c.now_ns_ += c.step_ns_;
  }

 private:
  std::atomic<std::int64_t> now_ns_{1000000000}, step_ns_{0};
};

// Whoever passes waits while it is shut.
class Gate {
 public:
  void shut() {
    const std::lock_guard<std::mutex> lock(mutex_);
    shut_ = true;
  }
  void open() {
    const std::lock_guard<std::mutex> lock(mutex_);
    shut_ = false;
    changed_.notify_all();
  }
  void pass() {
    std::unique_lock<std::mutex> lock(mutex_);
    ++inside_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return !shut_; });
    --inside_;
  }
  void wait_until_somebody_is_inside() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return inside_ > 0; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool shut_ = false;
  int inside_ = 0;
};

class RuntimeUnderTest {
 public:
  using Publications = std::vector<pose_wall_publication>;
  using Change = std::function<void(pose_wall_runtime_options*)>;

  explicit RuntimeUnderTest(const Change& change = nullptr, const pose_wall_config& config = small_config())
      : options_(options(change)), block_(needed(config, options_), Dirt::kRandom) {
    note(pose_wall_runtime_open(&config, &options_, block_.data(), block_.size(), &runtime_));
  }
  ~RuntimeUnderTest() {
    gate.open();
    (void)pose_wall_runtime_stop(runtime_);
    (void)pose_wall_runtime_close(runtime_);
  }
  RuntimeUnderTest(const RuntimeUnderTest&) = delete;
  RuntimeUnderTest& operator=(const RuntimeUnderTest&) = delete;

  void start() { note(pose_wall_runtime_start(runtime_)); }
  void stop() { note(pose_wall_runtime_stop(runtime_)); }
  std::int32_t push(const Points& points, std::int64_t stamp_ns) {
    const pose_wall_cloud cloud = cloud_of(points, stamp_ns);
    return pose_wall_runtime_push(runtime_, &cloud);
  }
  void wait_idle() { note(pose_wall_runtime_wait_idle(runtime_)); }
  // Time passes, and the worker looks at its clock.
  void pass(std::int64_t ns) {
    clock.advance(ns);
    note(pose_wall_runtime_tick(runtime_));
    wait_idle();
  }
  pose_wall_publication latest() const {
    pose_wall_publication p{};
    p.struct_size = sizeof p;
    note(pose_wall_runtime_latest(runtime_, &p));
    return p;
  }
  pose_wall_runtime_statistics statistics() const {
    pose_wall_runtime_statistics s{};
    s.struct_size = sizeof s;
    note(pose_wall_runtime_statistics_now(runtime_, &s));
    return s;
  }
  pose_wall_runtime* get() const { return runtime_; }
  AlignedBlock& block() { return block_; }
  // What the callback got; read it when the worker is idle.
  Publications published() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return published_;
  }

  StandingClock clock;
  Gate gate;
  std::function<void()> in_callback;

 private:
  static void note(std::int32_t status) {
    if (status != POSE_WALL_OK) throw std::runtime_error(pose_wall_runtime_status_text(status));
  }
  static std::uint64_t needed(const pose_wall_config& config, const pose_wall_runtime_options& options) {
    std::uint64_t bytes = 0;
    note(pose_wall_runtime_memory_needed(&config, &options, &bytes));
    return bytes;
  }
  pose_wall_runtime_options options(const Change& change) {
    pose_wall_runtime_options o;
    pose_wall_runtime_options_init(&o);
    o.cloud_points_max = 30000;
    o.clock = StandingClock::read;
    o.clock_user = &clock;
    o.callback = on_result;
    o.callback_user = this;
    if (change) change(&o);
    return o;
  }
  static void on_result(void* self, const pose_wall_publication* publication) {
    RuntimeUnderTest& r = *static_cast<RuntimeUnderTest*>(self);
    {
      const std::lock_guard<std::mutex> lock(r.mutex_);
      if (r.published_.size() < 4096) r.published_.push_back(*publication);
    }
    if (r.in_callback) r.in_callback();
    r.gate.pass();
  }

  std::mutex mutex_;
  Publications published_;
  pose_wall_runtime_options options_;
  AlignedBlock block_;
  pose_wall_runtime* runtime_ = nullptr;
};

inline std::uint64_t dropped(const pose_wall_runtime_statistics& s) {
  std::uint64_t sum = 0;
  for (const std::uint64_t d : s.dropped) sum += d;
  return sum;
}

// What the header promises of the counters, at any time.
inline bool accounts_balance(const pose_wall_runtime_statistics& s) {
  return s.pushed == s.processed + s.in_work + s.waiting + s.filling + dropped(s);
}

}  // namespace pose_wall::test
