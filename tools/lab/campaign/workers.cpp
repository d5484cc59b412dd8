// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/workers.hpp"

#include <fmt/format.h>

#include <atomic>
#include <mutex>
#include <string>
#include <thread>

#include "io/terminal/counted.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/progress_bar.hpp"

namespace pose_wall::tools::campaign {
namespace {

class Workers {
 public:
  Workers(const std::vector<Run>& runs, const Crew& crew, const std::function<RunWork()>& make_worker)
      : runs_(runs),
        crew_(crew),
        make_worker_(make_worker),
        frames_(frames_of(runs)),
        bar_(frames_, crew.tell_progress && is_terminal(2)) {}

  void run() {
    std::vector<std::thread> threads;
    for (unsigned i = 1; i < crew_.jobs; ++i) threads.emplace_back([this] { take_runs(); });
    take_runs();
    for (std::thread& thread : threads) thread.join();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void take_runs() {
    try {
      const RunWork work = make_worker_();
      for (std::size_t i = next_++; i < runs_.size() && !failed_; i = next_++) take(runs_[i], work);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failed_ = true;
      if (!error_) error_ = std::current_exception();
    }
  }

  void take(const Run& run, const RunWork& work) {
    const std::string note = run.scene + " " + run.sensor;
    work(run, [this, &note] { count_frame(note); });
  }

  void count_frame(const std::string& note) {
    stop_if_interrupted();
    const std::lock_guard lock(mutex_);
    ++done_;
    bar_.advance(note);
    const bool is_tenth = 10 * done_ / frames_ > 10 * (done_ - 1) / frames_;
    if (is_tenth && crew_.tell_progress && !is_terminal(2)) {
      bar_.print_above(fmt::format("{} of {}", done_, counted(frames_, "frame")));
    }
  }

  const std::vector<Run>& runs_;
  const Crew& crew_;
  const std::function<RunWork()>& make_worker_;
  const std::size_t frames_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;  // of what follows
  std::size_t done_ = 0;
  ProgressBar bar_;
  std::exception_ptr error_;
};

}  // namespace

void work_on(const std::vector<Run>& runs, const Crew& crew, const std::function<RunWork()>& make_worker) {
  Workers(runs, crew, make_worker).run();
}

}  // namespace pose_wall::tools::campaign
