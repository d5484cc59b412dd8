// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A recording as a source: in its own time, faster, step by step, or as fast as its frames are measured.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

#include "apps/live/edges.hpp"
#include "apps/live/log.hpp"
#include "apps/live/thread_name.hpp"
#include "io/frames/frame_stamps.hpp"
#include "io/inputs/frame_sequence.hpp"

namespace pose_wall::tools::live {
namespace {

// Where a recording has no stamps: the rate that `pose_wall run` takes, too.
constexpr double kUsualRate_hz = 10.0;
// A gap of the recording is waited for, but no longer: a tape of two shifts is one.
constexpr double kGapMost_s = 5.0;
// From the last frame of one round to the first of the next.
constexpr std::int64_t kBetweenRounds_ns = 100'000'000;
// How long a stop may wait for somebody who types.
constexpr int kLook_ms = 100;

class ReplaySource final : public Source {
 public:
  explicit ReplaySource(const ReplayPlan& plan) : plan_(plan) {
    options_.topic = plan.topic;
    options_.source = plan.source;
    options_.packets.metadata = plan.metadata;
    for (const std::string& input : plan.inputs) {
      if (!std::filesystem::exists(input)) throw std::runtime_error(input + ": is not there");
    }
    open();
    if (!sequence_->errors().empty()) throw std::runtime_error(sequence_->errors().front());
    for (const std::string& note : sequence_->notes()) log_line(Grade::kWarning, "source replay", note);
  }
  ~ReplaySource() override { end(); }

  void start(FrameTaker& taker) override {
    ending_ = false;
    thread_ = std::thread([this, &taker] { run(taker); });
  }

  void stop() override { end(); }
  bool is_finished() const override { return finished_; }
  std::string failure() const override { return finished_ ? failure_ : ""; }

  PartHealth health() const override {
    PartHealth health;
    health.part = "source replay";
    const std::string failed = failure();
    health.grade = !failed.empty() ? Grade::kBad : unreadable_ > 0 ? Grade::kWarning : Grade::kGood;
    health.summary = !failed.empty() ? failed : finished_ ? "through" : "plays";
    health.add("frames", frames_.load());
    health.add("unreadable", unreadable_.load());
    health.add("of", sequence_frames_.load());
    return health;
  }

 private:
  using Clock = std::chrono::steady_clock;

  void open() {
    sequence_ = std::make_unique<FrameSequence>(plan_.inputs, options_);
    sequence_frames_ = sequence_->frames();
  }

  void run(FrameTaker& taker) {
    name_this_thread("source-replay");
    try {
      std::uint64_t before = 0;
      do {
        before = frames_;
        play(taker);
        if (plan_.repeat && !ending_) open();
        // A round without a frame is one for ever.
      } while (plan_.repeat && !ending_ && frames_ > before);
      taker.wait_idle();
      if (readable_ == 0 && !ending_) {
        failure_ = fmt::format(
            "--replay: the inputs hold no cloud that can be read ({} are unreadable): {}. pose_walld records clouds "
            "with recording_clouds: 1 alone",
            unreadable_.load(), fmt::join(plan_.inputs, ", "));
      }
    } catch (const std::exception& fault) {
      failure_ = fmt::format("--replay: {}", fault.what());
    }
    finished_ = true;
  }

  void play(FrameTaker& taker) {
    FrameStamps stamps(kUsualRate_hz);
    while (!ending_) {
      std::optional<SourcedFrame> sourced = sequence_->next();
      if (!sourced) return;
      if (!sourced->frame) {
        ++unreadable_;
        log_line(Grade::kWarning, "source replay", sourced->name + ": " + sourced->error);
        continue;
      }
      ++readable_;
      LiveFrame frame;
      frame.frame = std::move(*sourced->frame);
      frame.stamp_ns = stamps.next(sourced->stamp_ns);
      if (!wait_for(frame.stamp_ns, taker)) return;
      // Repeated recordings go on in time, as a sensor does.
      frame.frame.cloud.stamp_ns = frame.stamp_ns += shift_ns_;
      taker.take(std::move(frame));
      ++frames_;
    }
  }

  // False at the end of standard input, and when it is to end.
  bool wait_for(std::int64_t stamp_ns, FrameTaker& taker) {
    const std::int64_t ahead_ns = last_ns_ ? stamp_ns - *last_ns_ : 0;
    if (ahead_ns < 0) shift_ns_ += kBetweenRounds_ns - ahead_ns;
    last_ns_ = stamp_ns;
    if (plan_.step) return wait_for_line();
    if (plan_.speed == 0.0) {
      taker.wait_idle();
      while (!ending_ && !taker.wait_for_room()) {
      }
      return !ending_;
    }
    const double wait_s = std::min(std::max(static_cast<double>(ahead_ns) * 1e-9, 0.0), kGapMost_s) / plan_.speed;
    due_ = std::max(due_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(wait_s)),
                    Clock::now() - std::chrono::seconds(1));
    std::unique_lock<std::mutex> locked(lock_);
    return !changed_.wait_until(locked, due_, [this] { return ending_.load(); });
  }

  // Half a line is no line yet, and nothing to wait for: it may end before the other half comes.
  bool wait_for_line() {
    while (!ending_) {
      const std::size_t end = typed_.find('\n');
      if (end != std::string::npos) {
        typed_.erase(0, end + 1);
        return true;
      }
      pollfd input{STDIN_FILENO, POLLIN, 0};
      if (poll(&input, 1, kLook_ms) <= 0) continue;
      std::array<char, 256> bytes{};
      const ssize_t count = read(STDIN_FILENO, bytes.data(), bytes.size());
      if (count <= 0) return false;
      typed_.append(bytes.data(), static_cast<std::size_t>(count));
    }
    return false;
  }

  void end() {
    {
      const std::lock_guard<std::mutex> locked(lock_);
      ending_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

  ReplayPlan plan_;
  InputOptions options_;
  std::unique_ptr<FrameSequence> sequence_;
  std::thread thread_;
  std::mutex lock_;
  std::condition_variable changed_;
  std::string failure_;  // written before finished_, read after it
  std::atomic<bool> ending_{false}, finished_{false};
  std::atomic<std::uint64_t> frames_{0}, unreadable_{0}, sequence_frames_{0};
  std::uint64_t readable_ = 0;  // clouds, handed on or not
  std::string typed_;           // at standard input, and not used yet
  std::optional<std::int64_t> last_ns_;
  Clock::time_point due_ = Clock::now();
  std::int64_t shift_ns_ = 0;  // of stamps, after rounds
};

}  // namespace

std::unique_ptr<Source> make_replay_source(const ReplayPlan& plan) {
  return std::make_unique<ReplaySource>(plan);
}

}  // namespace pose_wall::tools::live
