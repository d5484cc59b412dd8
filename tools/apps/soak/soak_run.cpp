// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/soak/soak_run.hpp"

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>

#include "apps/soak/heap_count.hpp"
#include "io/box/file_sink.hpp"
#include "pose_wall.hpp"

namespace pose_wall::tools {
namespace {

using Clock = std::chrono::steady_clock;

struct alignas(POSE_WALL_BLOCK_ALIGNMENT) Line {
  unsigned char bytes[POSE_WALL_BLOCK_ALIGNMENT];
};

void need(std::int32_t status) {
  if (status != POSE_WALL_OK) throw std::runtime_error(pose_wall_runtime_status_text(status));
}

class BusyThreads {
 public:
  explicit BusyThreads(std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) {
      threads_.emplace_back([this] {
        volatile std::uint64_t sink = 0;
        while (!over_.load(std::memory_order_relaxed)) sink = sink + 1;
      });
    }
  }
  ~BusyThreads() {
    over_ = true;
    for (std::thread& t : threads_) t.join();
  }
  BusyThreads(const BusyThreads&) = delete;
  BusyThreads& operator=(const BusyThreads&) = delete;

 private:
  std::atomic<bool> over_{false};
  std::vector<std::thread> threads_;
};

class Soak {
 public:
  explicit Soak(const SoakPlan& plan) : plan_(plan) {
    pose_wall_runtime_options options;
    pose_wall_runtime_options_init(&options);
    options.thinning_max = plan.thinning_max;
    std::size_t most = 1;
    for (const SoakPoints& frame : plan.frames) most = frame.size() > most ? frame.size() : most;
    options.cloud_points_max = static_cast<std::uint32_t>(most);
    if (!plan.box.empty()) {
      sink_ = std::make_unique<FileSink>(plan.box);
      options.sink = FileSink::write;
      options.sink_user = sink_.get();
      options.box_bytes = plan.box_mb << 20;
    }
    const char* option = "";
    if (pose_wall_runtime_options_check(&options, &option) == POSE_WALL_RUNTIME_E_OPTION) {
      throw std::runtime_error(std::string("the runtime's option ") + option + " is out of its range");
    }
    need(pose_wall_runtime_memory_needed(&plan.config, &options, &outcome_.bytes));
    block_.resize(outcome_.bytes / sizeof(Line) + 1);
    need(pose_wall_runtime_open(&plan.config, &options, block_.data(), block_.size() * sizeof(Line), &runtime_));
  }
  ~Soak() {
    (void)pose_wall_runtime_stop(runtime_);
    (void)pose_wall_runtime_close(runtime_);
  }
  Soak(const Soak&) = delete;
  Soak& operator=(const Soak&) = delete;

  SoakOutcome run() {
    need(pose_wall_runtime_start(runtime_));
    start_counting_heap_calls();
    plan_.accelerated > 0 ? run_accelerated() : run_by_the_clock();
    (void)pose_wall_runtime_wait_idle(runtime_);
    look();
    outcome_.resident_end_kb = resident_kb();
    outcome_.heap_calls = stop_counting_heap_calls();
    need(pose_wall_runtime_stop(runtime_));
    outcome_.statistics = statistics();
    return outcome_;
  }

 private:
  // Forth and back through the frames: none comes twice in a row.
  void push(std::uint64_t number) {
    const std::uint64_t count = plan_.frames.size();
    const std::uint64_t round = count > 1 ? 2 * (count - 1) : 1, at = number % round;
    const SoakPoints& points = plan_.frames[at < count ? at : round - at];
    pose_wall_cloud cloud;
    const auto stamp_ns = static_cast<std::int64_t>(static_cast<double>(number) * 1e9 / plan_.rate_hz);
    pose_wall_cloud_xyz32(&cloud, points.data(), static_cast<std::uint32_t>(points.size()), sizeof(points[0]),
                          stamp_ns);
    need(pose_wall_runtime_push(runtime_, &cloud));
  }

  void run_accelerated() {
    for (std::uint64_t i = 0; i < plan_.accelerated;) {
      for (std::uint32_t k = 0; k < plan_.burst && i < plan_.accelerated; ++k) {
        push(i++);
        look();  // while the worker is at it: an idle runtime's counters add up more easily
      }
      need(pose_wall_runtime_wait_idle(runtime_));
      if (i % 1024 < plan_.burst) look();
      note_resident_from(plan_.accelerated / 10, i);
    }
  }

  void run_by_the_clock() {
    const auto begin = Clock::now();
    const auto frames = static_cast<std::uint64_t>(plan_.seconds * plan_.rate_hz);
    for (std::uint64_t i = 0; i < frames; ++i) {
      const std::chrono::duration<double> due(static_cast<double>(i) / plan_.rate_hz);
      std::this_thread::sleep_until(begin + std::chrono::duration_cast<Clock::duration>(due));
      push(i);
      look();
      note_resident_from(frames / 10, i);
    }
  }

  void note_resident_from(std::uint64_t first, std::uint64_t number) {
    if (outcome_.resident_begin_kb == kResidentUnknown_kb && number >= first) {
      outcome_.resident_begin_kb = resident_kb();
    }
  }

  pose_wall_runtime_statistics statistics() const {
    pose_wall_runtime_statistics s{};
    s.struct_size = sizeof s;
    need(pose_wall_runtime_statistics_now(runtime_, &s));
    return s;
  }

  void look() {
    const pose_wall_runtime_statistics s = statistics();
    ++outcome_.looks;
    if (s.in_work + s.waiting + s.filling > 0) ++outcome_.looks_at_work;
    const std::uint64_t accounted = s.processed + s.in_work + s.waiting + s.filling + sum_of_drops(s);
    if (s.pushed != accounted) ++outcome_.unbalanced;
    pose_wall_publication p{};
    p.struct_size = sizeof p;
    const std::int32_t status = pose_wall_runtime_latest(runtime_, &p);
    if (status == POSE_WALL_RUNTIME_E_STALE) ++outcome_.stale;
    if (status != POSE_WALL_OK) return;
    ++outcome_.states[p.result.quantity[POSE_WALL_YAW].state & 3U];
  }

  const SoakPlan& plan_;
  std::unique_ptr<FileSink> sink_;
  std::vector<Line> block_;
  pose_wall_runtime* runtime_ = nullptr;
  SoakOutcome outcome_;
};

}  // namespace

SoakOutcome soak(const SoakPlan& plan) {
  const BusyThreads load(plan.load);
  Soak run(plan);
  return run.run();
}

}  // namespace pose_wall::tools
