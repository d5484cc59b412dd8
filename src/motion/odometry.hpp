// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The story of a frame: expect, look, place, conclude, keep. Each step takes what the ones before hand on and gives a
// type of its own. What lives from frame to frame is here, and here alone is it written.

#pragma once

#include "motion/conclude.hpp"
#include "motion/frame_clock.hpp"
#include "motion/keyframes.hpp"

namespace pose_wall::motion {

class Odometry {
 public:
  void lay_out(Arena& arena);
  void open(const Mount& mount, const MotionSettings& settings);
  void reset();
  void process(const pose_wall_cloud& cloud, pose_wall_motion_result* result);
  // The last frame's pose as the engine takes it; without a pose, that nothing is known. False before the first frame.
  bool tell(pose_wall_odometry* out) const;
  std::uint64_t run() const { return run_; }
  std::uint64_t steps() const { return work_.done(); }  // of the last frame (frame_steps.hpp)
  std::uint32_t map_points(std::uint32_t first, std::uint32_t capacity, float* xyz_start_m) const;

 private:
  struct AlongVerdict {
    std::uint32_t state = POSE_WALL_ALONG_LOST, reasons = 0;
  };
  AlongVerdict measure(const Frame& frame, pose_wall_motion_result* result);
  AlongVerdict begin(const Frame& frame, const Expected& expected, const Seen& seen, pose_wall_motion_result* result);
  AlongVerdict go_on(const Frame& frame, const Expected& expected, const Seen& seen, pose_wall_motion_result* result);
  AlongVerdict stay(const Frame& frame, pose_wall_motion_result* result);
  void begin_anew(const Frame& frame, const Seen& seen);
  void begin_map(const Frame& frame, const Seen& seen, const Pose& at);
  void begin_map_here();
  void take(const Frame& frame, const Placed& placed, const Concluded& concluded);
  bool is_keyframe(const Placed& placed) const;
  void take_in_scan();
  bool begins_unbent(const Frame& frame, const Placed& placed) const;
  void begin_unbent(const Frame& frame);
  void tell_nothing(pose_wall_odometry* out) const;

  Mount mount_;
  MotionSettings settings_;
  Work work_;  // of this frame so far
  PlaceScratch scratch_;
  // memory
  Imager imager_;
  FrameClock clock_;
  MotionModel model_;
  Keyframes keyframes_;
  Course course_;
  Pose start_;             // of the first frame
  std::uint64_t run_ = 0;  // names the map that poses are comparable in
  bool has_map_ = false;
  bool has_pose_ = false;  // of the last frame
};

}  // namespace pose_wall::motion
