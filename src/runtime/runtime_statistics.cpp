// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The counters, readable while it runs.

#include "runtime.hpp"
#include "saturated.hpp"

namespace pose_wall::runtime {

void Runtime::statistics(pose_wall_runtime_statistics* out) {
  pose_wall_runtime_statistics s{};
  {
    Locked locked(&lock_);
    const std::int64_t age_ns = difference(now(), newest_received_ns_);
    const Activity::Told told = activity_.now();
    s = counters_;
    s.state = state_;
    s.filling = filling_ ? 1 : 0;
    s.waiting = waiting_.count();
    s.in_work = in_work_ ? 1 : 0;
    s.thinning = thinning_;
    s.activity = told.activity;
    s.activity_since_ns = told.since_ns;
    s.newest_age_ns = has_newest_ && age_ns >= 0 ? age_ns : -1;
  }
  s.struct_size = sizeof(s);
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
