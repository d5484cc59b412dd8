// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The runtime: one lock over the slots that change hands, and nothing else done under it.

#pragma once

#include <atomic>
#include <cstdint>

#include "activity.hpp"
#include "box_writer.hpp"
#include "frame_copy.hpp"
#include "frame_slot.hpp"
#include "histogram.hpp"
#include "latest_value.hpp"
#include "pose_wall_runtime.h"
#include "thinning.hpp"
#include "threads.hpp"
#include "watchdog.hpp"

namespace pose_wall::runtime {

// Each is written by one thread: push by the thread inside push, sink by the recorder, the others by the worker.
struct Times {
  Histogram push, wait, work, motion, latency, callback, sink;
  Histogram stage[POSE_WALL_STAGES];
};

// Whether the key `motion` lets an odometry in.
bool config_wants_motion(const pose_wall_config& config);

// Bytes of the blocks within the block; 0: no motion.
struct InnerBytes {
  std::uint64_t engine = 0, motion = 0;
};

// Where everything lies in the caller's block:
//
//   | Runtime | engine | motion, where there is one | box scratch | points, memento of slot 0 | of slot 1 | ... |
//
class Runtime {
 public:
  Runtime(const pose_wall_config& config, const pose_wall_runtime_options& options);

  // Measures (block NULL) or places all but the Runtime itself, which comes first.
  static std::uint64_t lay_out(void* block, const InnerBytes& inner, const pose_wall_runtime_options& options,
                               Runtime* runtime);
  std::int32_t open(std::uint64_t block_bytes);
  bool is_open() const { return magic_ == kMagic && self_ == this; }
  // Whether a runtime that was started and not stopped lives in a block that may hold anything.
  static bool is_started_in(const void* block);

  std::int32_t start();
  std::int32_t wait_idle();
  std::int32_t request_stop();
  std::int32_t stop();
  std::int32_t close();
  std::int32_t push(const pose_wall_cloud& cloud);
  std::int32_t save(const pose_wall_moment* now, void* memento, std::uint64_t bytes);
  std::int32_t load(const pose_wall_moment* now, const void* memento, std::uint64_t bytes);
  // *publication is written whatever comes of it.
  std::int32_t latest(pose_wall_publication* publication) const;
  std::int32_t image(pose_wall_image* image) const;
  std::int32_t image2(pose_wall_image2* image) const;
  std::int32_t motion_image(pose_wall_motion_image* image) const;
  std::int32_t last_points(pose_wall_points* points) const;
  std::int32_t tick();
  void statistics(pose_wall_runtime_statistics* out);

 private:
  static constexpr std::uint64_t kMagic = 0x706F73652D72756EULL;    // 'pose-run' in ASCII
  static constexpr std::uint64_t kStarted = 0x5AC3A53C695A96E1ULL;  // no bytes that a block holds by chance

  std::int64_t now() const { return options_.clock != nullptr ? options_.clock(options_.clock_user) : monotonic_ns(); }
  bool own_thread_calls() const;
  bool callback_calls() const;
  bool is_idle() const;

  // runtime_life.cpp
  std::int32_t open_engine();
  std::int32_t set_engine_clock();
  std::int32_t forget();
  bool config_is_whole() const;
  void replace_damaged_engine();
  int start_recorder();
  int lock_memory();
  std::int32_t start_threads();
  void end_threads();
  void drop_waiting();

  // runtime_motion.cpp
  bool has_motion() const { return motion_bytes_ > 0; }
  std::int32_t open_motion();
  void open_motion_anew();
  void reset_motion();
  pose_wall_motion_result no_motion() const;
  void move(FrameSlot* slot);

  // runtime_push.cpp
  CopiedFields copied_fields(const pose_wall_cloud& cloud) const;
  std::int32_t refusal(const pose_wall_cloud& cloud, pose_wall_runtime_drop* why) const;
  std::int32_t queue(FrameSlot* slot, std::uint64_t epoch);

  // runtime_latest.cpp
  pose_wall_publication nothing() const;
  std::int32_t judge(pose_wall_publication* publication) const;
  void tell_activity(pose_wall_publication* publication) const;

  // runtime_worker.cpp
  static void* run_worker(void* runtime);
  void take_wishes();
  void work();
  void wait_for_work();
  bool drop_if_late();
  void work_frame(FrameSlot* slot);
  void tell_silence(FrameSlot* slot);
  void save_memento(FrameSlot* slot);
  std::int32_t measure(FrameSlot* slot, std::int64_t* work_ns);
  void publish(pose_wall_publication* publication);
  void conclude(FrameSlot* slot, bool is_recorded);
  void hand_on(FrameSlot* slot);

  // runtime_recorder.cpp
  static void* run_recorder(void* runtime);
  void record();

  std::atomic<std::uint64_t> magic_{0};
  const Runtime* self_ = nullptr;
  std::atomic<std::uint64_t> started_{0};  // kStarted until it is stopped again
  std::uint64_t block_bytes_ = 0;
  pose_wall_config config_;
  std::uint32_t config_crc32_ = 0;  // of the config as it was opened with
  pose_wall_runtime_options options_;
  bool with_intensity_ = false;
  pose_wall_engine* engine_ = nullptr;
  void* engine_block_ = nullptr;
  std::uint64_t engine_bytes_ = 0;
  pose_wall_result blank_{};  // the engine's values before any frame
  bool wants_motion_ = false;
  pose_wall_motion* motion_ = nullptr;
  void* motion_block_ = nullptr;
  std::uint64_t motion_bytes_ = 0;
  pose_wall_motion_settings motion_settings_{};
  pose_wall_motion_result blank_motion_{};
  BoxWriter box_;
  std::uint32_t run_seed_ = 0;  // another one in every process that writes into the same file, but for chance

  // Under the lock from here.
  mutable Mutex lock_;
  Condition changed_;
  std::uint32_t state_ = POSE_WALL_RUNTIME_STOPPED;
  std::uint64_t epoch_ = 0;  // of the start; a push that began before a stop does not end up behind it
  bool worker_ready_ = false, joining_ = false, recorder_may_end_ = false;
  bool has_worker_ = false, has_recorder_ = false;
  pthread_t worker_{}, recorder_{};
  FrameSlot slot_[kSlotsMax];
  SlotList free_, waiting_, to_record_;
  bool filling_ = false;                 // a push is copying
  bool busy_ = false, in_work_ = false;  // the worker is at something; it is a frame
  bool look_ = false;                    // tick requested a look at the clock
  bool recording_ = false;
  std::uint32_t callers_inside_ = 0;  // in wait_idle or stop: close must not pull the lock from under them
  bool dropped_since_ = false;        // overtaken since the last worked frame
  std::uint32_t thinning_ = 1;
  std::int64_t newest_received_ns_ = 0;
  bool has_newest_ = false;
  bool loaded_ = false;  // since the last start
  std::int64_t loaded_ns_ = 0;
  pose_wall_runtime_statistics counters_{};  // what counts up, and the errors of the last start

  // Of the worker alone.
  Overload overload_;
  Watchdog watchdog_;
  HeldThinning held_thinning_;
  std::uint64_t events_ = 0, publications_ = 0, last_frame_ = 0;
  std::int64_t last_stamp_ns_ = 0, silence_recorded_ns_ = 0, looked_ns_ = 0;
  pose_wall_publication publication_{};

  // Without a lock.
  std::atomic<std::uint32_t> running_{0};
  Activity activity_;
  LatestValue<pose_wall_publication> latest_;
  Times times_;
};

}  // namespace pose_wall::runtime
