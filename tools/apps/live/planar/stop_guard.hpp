// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The obstacle stop of the daemon. It has a thread of its own and waits for nobody: each frame is answered as it comes,
// beside the engine, and every 20 ms without one there is an answer as well, so that silence stops the machine.

#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "apps/live/delays.hpp"
#include "apps/live/health.hpp"
#include "apps/live/live_frame.hpp"
#include "apps/live/planar/command_board.hpp"
#include "apps/live/planar/planar_news.hpp"
#include "apps/live/planar/stamp_clock.hpp"
#include "apps/live/sink.hpp"
#include "apps/live/state_times.hpp"
#include "io/config_file/load_config.hpp"
#include "study/planar/part_block.hpp"
#include "study/planar/stop_line.hpp"

namespace pose_wall::tools::live {

class StopGuard final : public StopBoard {
 public:
  // In the guard's thread: after each frame, at each change of the state, and ten times a second. It must not wait.
  using Tell = std::function<void(const std::shared_ptr<const StopNews>&)>;

  // commands: what the drive is told; none where no key names a place that commands come from.
  // Throws std::runtime_error where the library refuses settings or config.
  StopGuard(const LoadedConfig& loaded, Tell tell, CommandBoard* commands = nullptr);
  ~StopGuard() override { stop(); }

  void start();
  void stop();

  // A raw frame, with the config whose extrinsic holds for it. From any thread; never waits. Where the frame before
  // still waits, it is lost and counted.
  void take(const std::shared_ptr<const LiveFrame>& frame, const pose_wall_config& config);
  // What motion measured in a frame, for those to come. From any thread.
  void note_motion(const LiveResult& result);

  // Somebody has looked: close around the machine there is nothing (pose_wall_planar_stop_confirm). It counts only
  // while frames come, and only as long as the machine's motion is known. From any thread.
  void confirm();

  StopNews stop_now() const override;
  std::vector<std::int64_t> state_ns() const override;
  // False where its thread hangs (kHangs_ns of health.hpp). By then the machine stands for long: see kSilent_ns.
  bool is_alive() const;
  PartHealth health() const;

  // An answer comes every kTick_ns at least, and each is a beat of the heartbeat. If none came for kSilent_ns, the
  // thread is held up or hangs, and the state is stop.
  static constexpr std::int64_t kTick_ns = 20'000'000, kSilent_ns = 200'000'000;

 private:
  struct Job {
    std::shared_ptr<const LiveFrame> frame;
    pose_wall_config config;
    std::int64_t received_ns;
  };
  // Where the odometry saw base, by the sensor's stamp.
  struct Seen {
    pose_wall_odometry odometry;
    std::int64_t stamp_ns;
  };
  // A frame's stamp by its sensor and by this machine's clock.
  struct Stamp {
    std::int64_t of_sensor_ns, placed_ns;
  };

  void open(const pose_wall_config& config);
  void begin_answers();
  void run();
  void answer_frame(const Job& job, StopNews* news);
  void answer_silence(StopNews* news);
  void heed_look(const StopNews& news);
  bool comes_too_slowly(std::int64_t stamp_ns);
  void refuse(StopNews* news, std::uint32_t reason) const;
  void note_cause(StopNews* news);
  void put(const StopNews& news, const Job* job);
  StopNews newest() const;
  void note_seen();
  pose_wall_planar_stop_motion motion_now(bool is_measured) const;

  pose_wall_planar_stop_settings settings_;
  bool takes_motion_, takes_command_;
  CommandBoard* commands_;
  StopLine line_;
  Tell tell_;
  // Of the guard's thread.
  PartBlock block_;
  pose_wall_config config_{};
  pose_wall_planar_stop* stop_ = nullptr;
  StampClock stamps_;
  std::deque<Stamp> frames_;  // of the last ones, for an odometry that comes later
  std::int64_t told_ns_ = 0, header_stamp_ns_ = 0;
  std::uint32_t first_beat_ = 0;  // the heartbeat of a controller is so far ahead of the rounds
  std::int64_t stamp_ns_ = 0;     // of the newest frame, by its sensor
  StopCause cause_ = StopCause::kNothing;
  int slow_frames_ = 0;         // so many in turn came too long after the one before
  bool frame_refused_ = false;  // the newest one

  mutable std::mutex lock_;
  std::condition_variable changed_;
  std::optional<Job> waiting_;
  std::deque<Seen> seen_;  // not yet told to the stop
  bool ending_ = false, confirmed_ = false;
  StopNews newest_;
  mutable StateTimes times_;      // by pose_wall_planar_stop_state
  bool is_slow_ = false;          // the sensor
  std::int64_t received_ns_ = 0;  // when the newest frame came
  std::uint64_t answered_ = 0, lost_ = 0, refused_ = 0, stops_ = 0, looks_ = 0;
  Delays latency_;  // from a frame's reception to its answer

  std::thread thread_;
};

// "thing, nearing": names of the reasons.
std::string stop_reasons_text(std::uint32_t reasons);

}  // namespace pose_wall::tools::live
