// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The receiving thread.

#include "frame_copy.hpp"
#include "options.hpp"
#include "part/status.hpp"
#include "runtime.hpp"
#include "saturated.hpp"

namespace pose_wall::runtime {

// Looks at the description only.
std::int32_t Runtime::refusal(const pose_wall_cloud& cloud, pose_wall_runtime_drop* why) const {
  *why = POSE_WALL_RUNTIME_DROP_DESCRIPTION;
  const std::int32_t status = pose_wall_cloud_check(&cloud);
  if (status != POSE_WALL_OK) return status;
  *why = POSE_WALL_RUNTIME_DROP_LARGE;
  const std::uint64_t points = static_cast<std::uint64_t>(cloud.width) * cloud.height;
  const bool fits =
      points <= options_.cloud_points_max && packed_bytes(cloud, with_intensity_) <= options_.point_bytes_max;
  return ok_if(fits, POSE_WALL_RUNTIME_E_LARGE);
}

// The engine reads times where an odometry gives the machine's motion, and motion reads times and rings.
CopiedFields Runtime::copied_fields(const pose_wall_cloud& cloud) const {
  const bool is_given = cloud.inputs != nullptr && (cloud.inputs->given & POSE_WALL_INPUT_ODOMETRY) != 0;
  return {with_intensity_, wants_motion_ && (has_motion() || is_given), has_motion(), options_.point_bytes_max};
}

std::int32_t Runtime::push(const pose_wall_cloud& cloud) {
  const std::int64_t received_ns = now();
  FrameSlot* slot = nullptr;
  std::uint64_t epoch = 0;
  {
    Locked locked(&lock_);
    if (state_ != POSE_WALL_RUNTIME_RUNNING) return POSE_WALL_RUNTIME_E_STATE;
    const std::uint64_t number = counters_.pushed++;
    pose_wall_runtime_drop why = POSE_WALL_RUNTIME_DROP_BUSY;
    const std::int32_t status = filling_ ? static_cast<std::int32_t>(POSE_WALL_RUNTIME_E_BUSY) : refusal(cloud, &why);
    if (status != POSE_WALL_OK) {
      ++counters_.dropped[why];
      return status;
    }
    filling_ = true;
    epoch = epoch_;
    slot = free_.pop();  // there is one: see slots_of
    slot->publication = pose_wall_publication{};
    slot->publication.frame = number;
    slot->publication.received_ns = received_ns;
    slot->publication.thinning = thinning_;
  }
  copy_frame(cloud, copied_fields(cloud), slot->publication.thinning, slot);
  return queue(slot, epoch);
}

std::int32_t Runtime::queue(FrameSlot* slot, std::uint64_t epoch) {
  const std::int64_t received_ns = slot->publication.received_ns;
  Locked locked(&lock_);
  filling_ = false;
  if (state_ != POSE_WALL_RUNTIME_RUNNING || epoch != epoch_) {
    free_.push(slot);
    ++counters_.dropped[POSE_WALL_RUNTIME_DROP_STOPPED];
    changed_.wake_all();
    return POSE_WALL_RUNTIME_E_STATE;
  }
  if (waiting_.count() == options_.queue_frames) {
    free_.push(waiting_.pop());
    ++counters_.dropped[POSE_WALL_RUNTIME_DROP_OVERTAKEN];
    dropped_since_ = true;
  }
  waiting_.push(slot);
  if (waiting_.count() > counters_.waiting_worst) counters_.waiting_worst = waiting_.count();
  times_.push.add(difference(now(), received_ns));
  changed_.wake_all();
  return POSE_WALL_OK;
}

}  // namespace pose_wall::runtime
