// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Open, start, stop, close, and waiting.

#include <errno.h>  // NOLINT(modernize-deprecated-headers): POSIX names
#include <sys/mman.h>

#include <cstddef>

#include "base/containers/arena.hpp"
#include "base/math/crc32.hpp"
#include "options.hpp"
#include "part/status.hpp"
#include "runtime.hpp"

namespace pose_wall::runtime {

Runtime::Runtime(const pose_wall_config& config, const pose_wall_runtime_options& options)
    : config_(config),
      options_(options),
      overload_(options.thinning_max, options.frame_period_max_ns),
      watchdog_(options.watchdog_ns, options.watchdog_every_ns) {
  counters_.thinning_worst = 1;
  if (options.motion_settings != nullptr) motion_settings_ = *options.motion_settings;
}

std::uint64_t Runtime::lay_out(void* block, const InnerBytes& inner, const pose_wall_runtime_options& options,
                               Runtime* runtime) {
  Arena arena(block);
  const auto take = [&](std::uint64_t bytes) { return static_cast<unsigned char*>(arena.take_bytes(bytes)); };
  take(sizeof(Runtime));
  unsigned char* const engine_block = take(inner.engine);
  unsigned char* const motion_block = take(inner.motion);
  const bool has_box = options.sink != nullptr;
  unsigned char* const scratch = has_box ? take(BoxWriter::scratch_bytes()) : nullptr;
  if (runtime != nullptr) {
    runtime->engine_block_ = engine_block;
    runtime->engine_bytes_ = inner.engine;
    runtime->motion_block_ = motion_block;
    runtime->motion_bytes_ = inner.motion;
    runtime->box_.open(options, scratch);
  }
  for (std::uint32_t i = 0; i < slots_of(options); ++i) {
    unsigned char* const points = take(cloud_bytes_max(options));
    unsigned char* const memento = has_box ? take(pose_wall_memento_bytes()) : nullptr;
    if (runtime == nullptr) continue;
    runtime->slot_[i].points = points;
    runtime->slot_[i].memento = memento;
    runtime->free_.push(&runtime->slot_[i]);
  }
  return arena.bytes();
}

std::int32_t Runtime::open_engine() {
  const std::int32_t status = pose_wall_open(&config_, engine_block_, engine_bytes_, &engine_);
  return status == POSE_WALL_OK ? set_engine_clock() : status;
}

// The cheapest call that checks whether the engine is whole, so it serves for that, too.
std::int32_t Runtime::set_engine_clock() {
  return pose_wall_set_clock(
      engine_, [](void* user) { return static_cast<const Runtime*>(user)->now(); }, this);
}

// An engine that finds its memory changed by others is no use any more. A new one has nothing to hold, and measures the
// next frame.
void Runtime::replace_damaged_engine() {
  if (set_engine_clock() != POSE_WALL_E_ENGINE) return;
  // The damage may have hit the config beside the engine: then there is nothing to open a new one with.
  if (config_is_whole()) open_engine();
}

bool Runtime::config_is_whole() const {
  std::uint32_t crc32 = 0;
  return pose_wall_config_crc(&config_, &crc32) == POSE_WALL_OK && crc32 == config_crc32_;
}

#if defined(__clang__)
__attribute__((no_sanitize("memory")))  // a block may hold bytes that were never written
#endif
bool Runtime::is_started_in(const void* block) {
  const Runtime* const there = static_cast<const Runtime*>(block);
  return there->magic_.load(std::memory_order_relaxed) == kMagic && there->self_ == there &&
         there->started_.load(std::memory_order_relaxed) == kStarted;
}

std::int32_t Runtime::open(std::uint64_t block_bytes) {
  std::int32_t status = open_engine();
  blank_.struct_size = sizeof(blank_);
  if (status == POSE_WALL_OK) status = pose_wall_age(engine_, 0, &blank_);
  if (status == POSE_WALL_OK) status = open_motion();
  if (status != POSE_WALL_OK) return status;
  blank_motion_ = no_motion();
  wants_motion_ = config_wants_motion(config_);
  pose_wall_config_crc(&config_, &config_crc32_);
  // Not the caller's clock: it may stand at the same time after every start. The monotonic one begins anew with the
  // machine, the other may not be set: in nanoseconds the two together hardly come twice.
  const std::int64_t seed[2] = {monotonic_ns(), wall_clock_ns()};
  run_seed_ = crc32(seed, sizeof(seed));
  double weight = 0.0;
  pose_wall_config_get_number(&config_, "intensity_weight", &weight);
  with_intensity_ = weight > 0.0;
  block_bytes_ = block_bytes;
  lock_.open();
  changed_.open();
  self_ = this;
  magic_ = kMagic;
  return POSE_WALL_OK;
}

bool Runtime::own_thread_calls() const {
  const pthread_t caller = pthread_self();
  return (has_worker_ && pthread_equal(caller, worker_) != 0) ||
         (has_recorder_ && pthread_equal(caller, recorder_) != 0);
}

// Everything except the memento loaded for the next start.
std::int32_t Runtime::forget() {
  replace_damaged_engine();
  reset_motion();
  const std::int32_t status = loaded_ ? set_engine_clock() : pose_wall_reset(engine_);
  if (status != POSE_WALL_OK || loaded_) return status;
  held_thinning_.forget();
  last_stamp_ns_ = 0;
  return POSE_WALL_OK;
}

bool Runtime::callback_calls() const {
  return has_worker_ && pthread_equal(pthread_self(), worker_) != 0;
}

std::int32_t Runtime::last_points(pose_wall_points* points) const {
  Locked locked(&lock_);
  if (!callback_calls()) return POSE_WALL_RUNTIME_E_STATE;
  return pose_wall_last_points(engine_, points);
}

std::int32_t Runtime::save(const pose_wall_moment* now, void* memento, std::uint64_t bytes) {
  Locked locked(&lock_);
  // In the callback the engine has nothing to do; while stopped the lock keeps a start out.
  if (!callback_calls() && state_ != POSE_WALL_RUNTIME_STOPPED) return POSE_WALL_RUNTIME_E_STATE;
  return pose_wall_save(engine_, now, memento, bytes);
}

std::int32_t Runtime::load(const pose_wall_moment* now, const void* memento, std::uint64_t bytes) {
  Locked locked(&lock_);
  if (own_thread_calls()) return POSE_WALL_RUNTIME_E_THREAD;
  if (state_ != POSE_WALL_RUNTIME_STOPPED) return POSE_WALL_RUNTIME_E_STATE;
  replace_damaged_engine();
  const std::int32_t status = pose_wall_load(engine_, now, memento, bytes);
  if (status != POSE_WALL_OK) return status;
  loaded_ = true;
  loaded_ns_ = this->now();
  last_stamp_ns_ = now != nullptr ? now->stamp_ns : 0;
  held_thinning_.assume(options_.thinning_max);
  return POSE_WALL_OK;
}

std::int32_t Runtime::start() {
  Locked locked(&lock_);
  if (own_thread_calls()) return POSE_WALL_RUNTIME_E_THREAD;
  if (state_ != POSE_WALL_RUNTIME_STOPPED) return POSE_WALL_RUNTIME_E_STATE;
  const std::int32_t ready = forget();
  if (ready != POSE_WALL_OK) return ready;
  state_ = POSE_WALL_RUNTIME_STARTING;
  started_.store(kStarted, std::memory_order_relaxed);
  ++epoch_;
  latest_.clear();
  publication_ = pose_wall_publication{};
  overload_ = Overload(options_.thinning_max, options_.frame_period_max_ns);
  thinning_ = 1;
  has_newest_ = worker_ready_ = recorder_may_end_ = dropped_since_ = false;
  events_ = 0;
  const std::int32_t status = start_threads();
  if (status != POSE_WALL_OK) {
    state_ = POSE_WALL_RUNTIME_STOPPING;
    end_threads();
    return status;
  }
  state_ = POSE_WALL_RUNTIME_RUNNING;
  running_.store(1, std::memory_order_release);
  changed_.wake_all();
  return POSE_WALL_OK;
}

// The recorder as any other thread: at the priority of a caller that must not wait it would be in the worker's way.
int Runtime::start_recorder() {
  pthread_attr_t attributes;
  int error = pthread_attr_init(&attributes);
  if (error != 0) return error;
  const sched_param usual{};
  pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
  pthread_attr_setschedpolicy(&attributes, SCHED_OTHER);
  pthread_attr_setschedparam(&attributes, &usual);
  error = pthread_create(&recorder_, &attributes, run_recorder, this);
  pthread_attr_destroy(&attributes);
  return error;
}

int Runtime::lock_memory() {
  Unlocked unlocked(&lock_);  // it may take long, and a push that is refused must not wait for it
  return mlock(this, static_cast<std::size_t>(block_bytes_)) == 0 ? 0 : errno;
}

// Under the lock, which the new threads wait for.
std::int32_t Runtime::start_threads() {
  pose_wall_runtime_statistics& c = counters_;
  c.priority_error = c.affinity_error = c.lock_error = c.thread_error = 0;
  if (options_.lock_memory != 0) c.lock_error = lock_memory();
  if (options_.sink != nullptr) {
    c.thread_error = start_recorder();
    has_recorder_ = c.thread_error == 0;
  }
  if (c.thread_error == 0) {
    c.thread_error = pthread_create(&worker_, nullptr, run_worker, this);
    has_worker_ = c.thread_error == 0;
  }
  while (has_worker_ && !worker_ready_) changed_.wait(&lock_);
  const std::uint32_t refused = (c.priority_error != 0 ? std::uint32_t{POSE_WALL_RUNTIME_PRIORITY} : 0U) |
                                (c.affinity_error != 0 ? std::uint32_t{POSE_WALL_RUNTIME_AFFINITY} : 0U) |
                                (c.lock_error != 0 ? std::uint32_t{POSE_WALL_RUNTIME_LOCK} : 0U);
  const bool granted = c.thread_error == 0 && (refused & options_.required) == 0;
  return ok_if(granted, POSE_WALL_RUNTIME_E_SYSTEM);
}

// Under the lock, in state STOPPING, by one thread. The worker stops first, so its last frame is still recorded.
void Runtime::end_threads() {
  running_.store(0, std::memory_order_release);
  joining_ = true;
  changed_.wake_all();
  if (has_worker_) {
    Unlocked unlocked(&lock_);
    pthread_join(worker_, nullptr);
  }
  has_worker_ = false;
  drop_waiting();
  recorder_may_end_ = true;
  changed_.wake_all();
  if (has_recorder_) {
    Unlocked unlocked(&lock_);
    pthread_join(recorder_, nullptr);
  }
  has_recorder_ = joining_ = loaded_ = false;
  activity_.note(POSE_WALL_RUNTIME_AT_NOTHING, now());
  started_.store(0, std::memory_order_relaxed);
  state_ = POSE_WALL_RUNTIME_STOPPED;
  changed_.wake_all();
}

void Runtime::drop_waiting() {
  while (!waiting_.empty()) {
    free_.push(waiting_.pop());
    ++counters_.dropped[POSE_WALL_RUNTIME_DROP_STOPPED];
  }
}

std::int32_t Runtime::request_stop() {
  Locked locked(&lock_);
  if (state_ != POSE_WALL_RUNTIME_RUNNING) return POSE_WALL_RUNTIME_E_STATE;
  state_ = POSE_WALL_RUNTIME_STOPPING;
  running_.store(0, std::memory_order_release);
  changed_.wake_all();
  return POSE_WALL_OK;
}

std::int32_t Runtime::stop() {
  Locked locked(&lock_);
  if (own_thread_calls()) return POSE_WALL_RUNTIME_E_THREAD;
  ++callers_inside_;
  while (state_ == POSE_WALL_RUNTIME_STARTING) changed_.wait(&lock_);
  if (joining_) {
    // Another thread is at it.
    const std::uint64_t epoch = epoch_;
    while (joining_ && epoch == epoch_) changed_.wait(&lock_);
  } else if (state_ != POSE_WALL_RUNTIME_STOPPED) {
    state_ = POSE_WALL_RUNTIME_STOPPING;
    end_threads();
  }
  --callers_inside_;
  return POSE_WALL_OK;
}

bool Runtime::is_idle() const {
  return waiting_.empty() && !busy_ && !look_ && to_record_.empty() && !recording_;
}

std::int32_t Runtime::wait_idle() {
  Locked locked(&lock_);
  if (own_thread_calls()) return POSE_WALL_RUNTIME_E_THREAD;
  ++callers_inside_;
  const std::uint64_t epoch = epoch_;
  while (state_ == POSE_WALL_RUNTIME_RUNNING && epoch == epoch_ && !is_idle()) changed_.wait(&lock_);
  --callers_inside_;
  const bool idle = state_ == POSE_WALL_RUNTIME_RUNNING && epoch == epoch_;
  return ok_if(idle, POSE_WALL_RUNTIME_E_STATE);
}

std::int32_t Runtime::tick() {
  Locked locked(&lock_);
  if (state_ != POSE_WALL_RUNTIME_RUNNING) return POSE_WALL_RUNTIME_E_STATE;
  look_ = true;
  changed_.wake_all();
  return POSE_WALL_OK;
}

std::int32_t Runtime::close() {
  {
    Locked locked(&lock_);
    if (own_thread_calls()) return POSE_WALL_RUNTIME_E_THREAD;
    if (state_ != POSE_WALL_RUNTIME_STOPPED || filling_ || callers_inside_ > 0) return POSE_WALL_RUNTIME_E_STATE;
    magic_ = 0;
    self_ = nullptr;
  }
  changed_.close();
  lock_.close();
  if (options_.lock_memory != 0) munlock(this, static_cast<std::size_t>(block_bytes_));
  return POSE_WALL_OK;
}

}  // namespace pose_wall::runtime
