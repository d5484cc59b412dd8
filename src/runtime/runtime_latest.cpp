// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The readers' functions. They need no thread of the runtime, neither its word nor, but for the counters, a lock.

#include "freshness.hpp"
#include "runtime.hpp"
#include "saturated.hpp"

namespace pose_wall::runtime {
namespace {

pose_wall_image_source source_of(const pose_wall_publication& p) {
  const bool is_published = p.cause != 0;
  pose_wall_image_source source{};
  source.struct_size = sizeof(source);
  source.cause = p.cause;
  source.thinning = p.thinning;
  source.held_thinning = p.held_thinning;
  source.publication = is_published ? p.index + 1 : 0;
  source.latency_ns = is_published ? difference(p.published_ns, p.received_ns) : -1;
  return source;
}

// The remains of a motion that is too old.
pose_wall_motion_result without_pose(const pose_wall_motion_result& blank, const pose_wall_motion_result& of) {
  pose_wall_motion_result left = blank;
  left.stamp_ns = of.stamp_ns;
  left.frame_index = of.frame_index;
  return left;
}

}  // namespace

void Runtime::tell_activity(pose_wall_publication* publication) const {
  const Activity::Told told = activity_.now();
  publication->activity = told.activity;
  publication->activity_since_ns = told.since_ns;
}

pose_wall_publication Runtime::nothing() const {
  pose_wall_publication p{};
  p.struct_size = sizeof(p);
  p.thinning = p.held_thinning = 1;
  p.age_ns = INT64_MAX;
  p.result = blank_;
  p.motion = blank_motion_;
  return p;
}

std::int32_t Runtime::latest(pose_wall_publication* publication) const {
  std::int32_t status = POSE_WALL_RUNTIME_E_STATE;
  if (running_.load(std::memory_order_acquire) != 0) {
    const LatestStatus there = latest_.load(publication);
    if (there == LatestStatus::kThere) return judge(publication);
    status = there == LatestStatus::kNothing ? std::int32_t{POSE_WALL_RUNTIME_E_NOTHING} : POSE_WALL_E_ENGINE;
  }
  *publication = nothing();
  tell_activity(publication);
  return status;
}

// The clock is read after the copy, so the copy is no older than it seems.
std::int32_t Runtime::judge(pose_wall_publication* publication) const {
  tell_activity(publication);
  const Freshness freshness(*publication, now(), options_.watchdog_ns);
  publication->age_ns = freshness.age_ns();
  if (!freshness.is_stale()) return POSE_WALL_OK;
  make_stale(freshness.elapsed_s(), &publication->result);
  publication->has_motion = 0;
  if (has_motion()) publication->motion = without_pose(blank_motion_, publication->motion);
  return POSE_WALL_RUNTIME_E_STALE;
}

std::int32_t Runtime::image(pose_wall_image* image) const {
  pose_wall_publication publication;
  const std::int32_t status = latest(&publication);
  const std::int32_t filled = pose_wall_image_fill(&publication.result, image);
  return filled != POSE_WALL_OK ? filled : status;
}

std::int32_t Runtime::image2(pose_wall_image2* image) const {
  pose_wall_publication publication;
  const std::int32_t status = latest(&publication);
  const pose_wall_image_source source = source_of(publication);
  const std::int32_t filled = pose_wall_image2_fill(&publication.result, &source, image);
  return filled != POSE_WALL_OK ? filled : status;
}

std::int32_t Runtime::motion_image(pose_wall_motion_image* image) const {
  if (!has_motion()) return POSE_WALL_RUNTIME_E_MOTION;
  pose_wall_publication publication;
  const std::int32_t status = latest(&publication);
  const pose_wall_image_source source = source_of(publication);
  const std::int32_t filled = options_.motion->image_fill(&publication.motion, &source, image);
  return filled != POSE_WALL_OK ? filled : status;
}

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
