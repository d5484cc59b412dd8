// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/sink_thread.hpp"

#include <algorithm>
#include <utility>

#include "apps/live/thread_name.hpp"

namespace pose_wall::tools::live {

void SinkThread::start() {
  sink_->start();
  ending_ = false;
  thread_ = std::thread([this] { run(); });
}

// A cloud is megabytes, and a mailbox keeps what it is given for as long as its sink is slow.
std::shared_ptr<const LiveResult> SinkThread::as_wanted(const std::shared_ptr<const LiveResult>& result) const {
  const bool drops_cloud = result->frame && !sink_->wants_clouds();
  const bool drops_points = result->points && !sink_->wants_points();
  if (!drops_cloud && !drops_points) return result;
  auto lighter = std::make_shared<LiveResult>(*result);
  if (drops_cloud) lighter->frame.reset();
  if (drops_points) lighter->points.reset();
  return lighter;
}

void SinkThread::post(const std::shared_ptr<const LiveResult>& whole_result) {
  std::shared_ptr<const LiveResult> result = as_wanted(whole_result);
  std::shared_ptr<const LiveResult> oldest;  // its memory is given back outside of the lock
  {
    const std::lock_guard<std::mutex> locked(lock_);
    if (ending_) return;
    if (waiting_.size() >= sink_->backlog()) {
      oldest = std::move(waiting_.front());
      waiting_.pop_front();
      ++lost_;
    }
    waiting_.push_back(std::move(result));
  }
  changed_.notify_one();
}

void SinkThread::run() {
  std::string name = sink_->health().kind();
  std::replace(name.begin(), name.end(), ' ', '-');
  name_this_thread(name);
  std::unique_lock<std::mutex> locked(lock_);
  while (true) {
    changed_.wait(locked, [this] { return ending_ || has_work(); });
    if (!has_work()) return;
    const std::shared_ptr<const StopNews> stop = std::exchange(stop_news_, nullptr);
    const std::shared_ptr<const RoadwayNews> roadway = std::exchange(roadway_news_, nullptr);
    std::shared_ptr<const LiveResult> result;
    if (!waiting_.empty()) {
      result = std::move(waiting_.front());
      waiting_.pop_front();
    }
    locked.unlock();
    if (stop) sink_->take_stop(*stop);
    if (result) sink_->take(*result);
    if (roadway) sink_->take_roadway(*roadway);
    locked.lock();
    if (result) ++taken_;
    taken_one_.notify_all();
  }
}

bool SinkThread::wait_for_room(std::chrono::milliseconds at_most) {
  if (sink_->backlog() == 1) return true;  // it wants the newest alone
  std::unique_lock<std::mutex> locked(lock_);
  return taken_one_.wait_for(locked, at_most, [this] { return ending_ || waiting_.size() < sink_->backlog(); });
}

void SinkThread::stop() {
  {
    const std::lock_guard<std::mutex> locked(lock_);
    ending_ = true;
  }
  changed_.notify_one();
  if (!thread_.joinable()) return;
  thread_.join();
  sink_->stop();
}

PartHealth SinkThread::health() const {
  PartHealth health = sink_->health();
  const std::lock_guard<std::mutex> locked(lock_);
  health.add("results taken", taken_);
  health.add("results lost to slowness", lost_);
  if (sink_->wants_planar()) health.add("planar news lost to slowness", news_lost_);
  return health;
}

}  // namespace pose_wall::tools::live
