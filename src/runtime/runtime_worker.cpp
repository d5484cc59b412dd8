// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The worker's thread: frames, and the watchdog when there are none.

#include <cstring>

#include "base/math/time_units.hpp"
#include "freshness.hpp"
#include "pose_wall_box.h"
#include "runtime.hpp"
#include "saturated.hpp"
#include "thinning.hpp"

namespace pose_wall::runtime {
namespace {

bool same_states(const pose_wall_result& a, const pose_wall_result& b) {
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    if (a.quantity[q].state != b.quantity[q].state || a.quantity[q].reasons != b.quantity[q].reasons) return false;
  }
  return true;
}

}  // namespace

void* Runtime::run_worker(void* runtime) {
  Runtime* const r = static_cast<Runtime*>(runtime);
  r->take_wishes();
  r->work();
  return nullptr;
}

void Runtime::take_wishes() {
  const int priority_error = options_.worker_priority > 0 ? set_priority(options_.worker_priority) : 0;
  const int affinity_error = options_.worker_cpu >= 0 ? set_processor(options_.worker_cpu) : 0;
  looked_ns_ = loaded_ ? loaded_ns_ : now();
  watchdog_.feed(looked_ns_);
  activity_.note(POSE_WALL_RUNTIME_AT_CHOICE, looked_ns_);
  Locked locked(&lock_);
  counters_.priority_error = priority_error;
  counters_.affinity_error = affinity_error;
  worker_ready_ = true;
  changed_.wake_all();
}

void Runtime::work() {
  Locked locked(&lock_);
  while (state_ != POSE_WALL_RUNTIME_STOPPING) {
    look_ = false;
    // Silence goes first: where frames are worked late, the newest that is known is old all the same.
    activity_.note(POSE_WALL_RUNTIME_AT_CHOICE, looked_ns_);
    looked_ns_ = now();
    const bool silent = watchdog_.is_due(looked_ns_, !waiting_.empty());
    const bool has_frame = !silent && !waiting_.empty();
    if (has_frame && drop_if_late()) continue;
    if (!silent && !has_frame) {
      changed_.wake_all();  // a thread waiting for idleness must see that a tick was handled
      wait_for_work();
      continue;
    }
    busy_ = true;
    in_work_ = has_frame;
    FrameSlot* const slot = has_frame ? waiting_.pop() : free_.pop();
    has_frame ? work_frame(slot) : tell_silence(slot);
    in_work_ = busy_ = false;
    changed_.wake_all();
  }
}

// Under the lock: the oldest that waits. Published, a frame that is older than the watchdog's time would pass for
// fresh.
bool Runtime::drop_if_late() {
  if (!watchdog_.is_late(now(), waiting_.front()->publication.received_ns)) return false;
  free_.push(waiting_.pop());
  ++counters_.dropped[POSE_WALL_RUNTIME_DROP_LATE];
  dropped_since_ = true;
  return true;
}

void Runtime::wait_for_work() {
  activity_.note(POSE_WALL_RUNTIME_AT_WAIT, looked_ns_);
  if (watchdog_.is_on() && options_.clock == nullptr) {
    changed_.wait_until(&lock_, watchdog_.wake_ns(now()));
  } else {
    changed_.wait(&lock_);
  }
}

// Under the lock, which is free while the engine works and the callback runs.
void Runtime::work_frame(FrameSlot* slot) {
  const bool dropped = dropped_since_;
  dropped_since_ = false;
  std::int32_t status = POSE_WALL_OK;
  std::int64_t work_ns = 0;
  bool is_news = true;
  {
    Unlocked unlocked(&lock_);
    status = measure(slot, &work_ns);
    // Silence is due at once, with the measured values and their age.
    is_news = !watchdog_.is_late(now(), slot->publication.received_ns);
    if (status == POSE_WALL_OK && is_news) publish(&slot->publication);
  }
  if (status != POSE_WALL_OK) {
    // Earlier values may have been wrong already: nothing is known any more, and that cannot wait for silence.
    in_work_ = false;
    ++counters_.dropped[POSE_WALL_RUNTIME_DROP_ENGINE];
    tell_silence(slot);
    return;
  }
  overload_.note(slot->publication.thinning, work_ns, dropped);
  thinning_ = overload_.thinning();
  if (thinning_ > counters_.thinning_worst) counters_.thinning_worst = thinning_;
  newest_received_ns_ = slot->publication.received_ns;
  has_newest_ = true;
  if (!is_news) {
    free_.push(slot);
    ++counters_.dropped[POSE_WALL_RUNTIME_DROP_LATE];
    return;
  }
  times_.latency.add(difference(publication_.published_ns, publication_.received_ns));
  if (slot->publication.thinning > 1) ++counters_.thinned;
  if (slot->publication.motion_status != POSE_WALL_OK) ++counters_.motion_refused;
  conclude(slot, true);
  ++counters_.processed;
}

std::int32_t Runtime::measure(FrameSlot* slot, std::int64_t* work_ns) {
  pose_wall_publication& p = slot->publication;
  const std::int64_t begin_ns = looked_ns_;
  activity_.note(POSE_WALL_RUNTIME_AT_FRAME, begin_ns);
  // Inputs speak of the time since the frame before. Where that was dropped, the engine would take them for all the
  // time since the last one that it measured. Where the boom is holds all the same.
  // An odometry's places are of their own time.
  if (p.frame != last_frame_ + 1) slot->inputs.given &= POSE_WALL_INPUT_ODOMETRY;
  move(slot);
  const std::int64_t engine_ns = looked_ns_;
  save_memento(slot);
  p.result.struct_size = sizeof(p.result);
  const std::int32_t status = pose_wall_process(engine_, &slot->cloud, &p.result);
  if (status != POSE_WALL_OK) {
    replace_damaged_engine();
    return status;
  }
  p.held_thinning = held_thinning_.note(p.result, p.thinning);
  finish_result(slot->left_out_not_finite, slot->left_out_zero, p.thinning, &p.result);
  slot->kind = POSE_WALL_BOX_FRAME;
  p.cause = POSE_WALL_RUNTIME_FRAME;
  last_frame_ = p.frame;
  last_stamp_ns_ = p.result.stamp_ns;
  watchdog_.feed(p.received_ns);
  looked_ns_ = now();
  *work_ns = difference(looked_ns_, begin_ns);
  times_.wait.add(difference(begin_ns, p.received_ns));
  times_.work.add(difference(looked_ns_, engine_ns));
  for (int stage = 0; stage < POSE_WALL_STAGES; ++stage) times_.stage[stage].add(p.result.stage_ns[stage]);
  return POSE_WALL_OK;
}

// A record that cannot be computed must not look as if it could.
void Runtime::save_memento(FrameSlot* slot) {
  const std::uint64_t bytes = pose_wall_memento_bytes();
  if (slot->memento == nullptr || pose_wall_save(engine_, nullptr, slot->memento, bytes) == POSE_WALL_OK) return;
  std::memset(slot->memento, 0, static_cast<std::size_t>(bytes));
}

void Runtime::tell_silence(FrameSlot* slot) {
  bool says_more = false;
  {
    Unlocked unlocked(&lock_);
    const std::int64_t now_ns = now();
    looked_ns_ = now_ns;
    activity_.note(POSE_WALL_RUNTIME_AT_SILENCE, now_ns);
    slot->cloud = pose_wall_cloud{};
    slot->left_out_not_finite = slot->left_out_zero = 0;
    slot->kind = POSE_WALL_BOX_SILENCE;
    pose_wall_publication& p = slot->publication;
    p = pose_wall_publication{};
    p.cause = POSE_WALL_RUNTIME_SILENCE;
    p.thinning = 1;
    p.frame = last_frame_;
    p.received_ns = watchdog_.since_ns();
    replace_damaged_engine();
    save_memento(slot);
    p.result.struct_size = sizeof(p.result);
    const std::int64_t stamp_ns = sum(last_stamp_ns_, watchdog_.speak(now_ns));
    // Without an engine nothing is known, and that is published.
    if (pose_wall_age(engine_, stamp_ns, &p.result) != POSE_WALL_OK) p.result = blank_;
    p.held_thinning = held_thinning_.note(p.result, 1);
    p.motion = no_motion();
    // A sensor that is dead for hours must not push the hour before out of the black box.
    says_more = publication_.cause != POSE_WALL_RUNTIME_SILENCE || !same_states(p.result, publication_.result) ||
                difference(now_ns, silence_recorded_ns_) >= kMinute_ns;
    if (says_more) silence_recorded_ns_ = now_ns;
    publish(&p);
  }
  ++counters_.silences;
  conclude(slot, says_more);
}

// Readers first, then the black box, then the callback, which may take its time or never come back.
void Runtime::publish(pose_wall_publication* p) {
  p->struct_size = sizeof(*p);
  p->index = publications_++;
  p->published_ns = looked_ns_ = now();
  p->age_ns = Freshness(*p, p->published_ns, options_.watchdog_ns).age_ns();
  latest_.store(*p);
  publication_ = *p;
}

void Runtime::conclude(FrameSlot* slot, bool is_recorded) {
  ++counters_.published;
  if (is_recorded) {
    slot->sequence = events_++;
    hand_on(slot);
  } else {
    free_.push(slot);
  }
  if (options_.callback == nullptr) return;
  Unlocked unlocked(&lock_);
  const std::int64_t begin_ns = now();
  activity_.note(POSE_WALL_RUNTIME_AT_CALLBACK, begin_ns);
  tell_activity(&publication_);
  options_.callback(options_.callback_user, &publication_);
  activity_.note(POSE_WALL_RUNTIME_AT_CHOICE, begin_ns);
  looked_ns_ = now();
  times_.callback.add(difference(looked_ns_, begin_ns));
}

// To the recorder, if it keeps up: the worker waits for no disk.
void Runtime::hand_on(FrameSlot* slot) {
  const std::uint32_t at_recorder = to_record_.count() + (recording_ ? 1U : 0U);
  if (options_.sink != nullptr && at_recorder < options_.box_backlog) {
    to_record_.push(slot);
    changed_.wake_all();
    return;
  }
  if (options_.sink != nullptr) ++counters_.box_lost;
  free_.push(slot);
}

}  // namespace pose_wall::runtime
