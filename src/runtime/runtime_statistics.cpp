// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The counters, readable while it runs.

#include "runtime.hpp"
#include "saturated.hpp"

namespace pose_wall::runtime {

// Member by member.  NOLINTNEXTLINE(readability-function-size)
void Runtime::statistics(pose_wall_runtime_statistics* out) {
  pose_wall_runtime_statistics s{};
  s.struct_size = sizeof(s);
  {
    Locked locked(&lock_);
    const Counters& c = counters_;
    const std::int64_t age_ns = difference(now(), newest_received_ns_);
    s.state = state_;
    s.pushed = c.pushed;
    s.processed = c.processed;
    for (int i = 0; i < POSE_WALL_RUNTIME_DROPS; ++i) s.dropped[i] = c.dropped[i];
    s.filling = filling_ ? 1 : 0;
    s.waiting = waiting_.count();
    s.in_work = in_work_ ? 1 : 0;
    s.waiting_worst = c.waiting_worst;
    s.published = c.published;
    s.silences = c.silences;
    s.thinned = c.thinned;
    s.thinning = thinning_;
    s.thinning_worst = c.thinning_worst;
    const Activity::Told told = activity_.now();
    s.activity = told.activity;
    s.activity_since_ns = told.since_ns;
    s.newest_age_ns = has_newest_ && age_ns >= 0 ? age_ns : -1;
    s.motion_refused = c.motion_refused;
    s.box_written = c.box_written;
    s.box_lost = c.box_lost;
    s.box_failed = c.box_failed;
    s.box_bytes_written = c.box_bytes_written;
    s.priority_error = c.priority_error;
    s.affinity_error = c.affinity_error;
    s.lock_error = c.lock_error;
    s.thread_error = c.thread_error;
  }
  s.push = times_.push.times();
  s.wait = times_.wait.times();
  s.work = times_.work.times();
  s.motion = times_.motion.times();
  s.latency = times_.latency.times();
  s.callback = times_.callback.times();
  s.sink = times_.sink.times();
  for (int stage = 0; stage < POSE_WALL_STAGES; ++stage) s.stage[stage] = times_.stage[stage].times();
  *out = s;
}

}  // namespace pose_wall::runtime
