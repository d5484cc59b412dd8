// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A sink with a thread and a mailbox of its own: posting never waits for it.

#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "apps/live/sink.hpp"

namespace pose_wall::tools::live {

class SinkThread {
 public:
  explicit SinkThread(std::unique_ptr<Sink> sink) : sink_(std::move(sink)) {}
  SinkThread(const SinkThread&) = delete;
  SinkThread& operator=(const SinkThread&) = delete;
  ~SinkThread() { stop(); }

  // Throws what the sink's start throws.
  void start();
  // Puts it into the mailbox under a short lock, without the clouds and points that the sink does not want. Where the
  // mailbox is full, the oldest result is lost and counted.
  void post(const std::shared_ptr<const LiveResult>& whole_result);
  // Where the one before still waits, it is lost and counted.
  void post(const std::shared_ptr<const StopNews>& news) { put(&stop_news_, news); }
  void post(const std::shared_ptr<const RoadwayNews>& news) { put(&roadway_news_, news); }
  // Waits until the next result would cost none that the sink was to keep, or the time is up.
  bool wait_for_room(std::chrono::milliseconds at_most);
  // Takes what waits, then ends the thread and the sink. May be called twice.
  void stop();

  bool wants_points() const { return sink_->wants_points(); }
  // The sink's, with what its mailbox lost.
  PartHealth health() const;

 private:
  template <typename News>
  void put(std::shared_ptr<const News>* place, std::shared_ptr<const News> news) {
    if (!sink_->wants_planar()) return;
    {
      const std::lock_guard<std::mutex> locked(lock_);
      if (ending_) return;
      if (*place) ++news_lost_;
      place->swap(news);
    }
    changed_.notify_one();
  }
  bool has_work() const { return !waiting_.empty() || stop_news_ || roadway_news_; }
  void run();
  std::shared_ptr<const LiveResult> as_wanted(const std::shared_ptr<const LiveResult>& result) const;

  std::unique_ptr<Sink> sink_;
  std::thread thread_;
  mutable std::mutex lock_;
  std::condition_variable changed_, taken_one_;
  std::deque<std::shared_ptr<const LiveResult>> waiting_;
  bool ending_ = false;
  std::shared_ptr<const StopNews> stop_news_;
  std::shared_ptr<const RoadwayNews> roadway_news_;
  std::uint64_t taken_ = 0, lost_ = 0, news_lost_ = 0;
};

}  // namespace pose_wall::tools::live
