// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The story of a frame: image, segments, features, two steps, the match along the road, the map. All that lives from
// frame to frame is here.

#pragma once

#include "lidar/seen_clouds.hpp"
#include "motion/frame.hpp"
#include "motion/range_image.hpp"
#include "motion/relief_map.hpp"
#include "motion/scan_motion.hpp"
#include "motion/start_counts.hpp"

namespace pose_wall::motion {

struct MotionSettings {
  double speed_max_m_s = 2.0, turn_max_rad_s = 1.5, keyframe_m = 0.2;
  double protection_sigmas = 0.0;  // by the engine's integrity_risk
  Eigen::Vector3d forward_base = Eigen::Vector3d::UnitX();
};

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
  void expect(Frame* frame) const;
  void look(Frame* frame);
  void measure(Frame* frame);
  void begin_map(Frame* frame);
  void begin_anew(Frame* frame);
  void keep_time(const Frame& frame);
  bool place_scan(Frame* frame);
  bool is_repeat(const pose_wall_cloud& cloud);
  void align(Frame* frame);
  void check_reach(Frame* frame) const;
  void match_way(Frame* frame);
  Curve match_near(Frame* frame);
  void refine(const Scan& scan, Frame* frame);
  void use_prior(Frame* frame) const;
  double slip_of(const Frame& frame, double along_m) const;
  void learn_twist(const Frame& frame);
  void keep_map(const Frame& frame);
  void conclude(Frame* frame);
  void learn_alignment(Frame* frame);
  bool begins_unbent(const Frame& frame) const;
  void begin_unbent(const Frame& frame);
  void begin_map_here();
  void begin_run(std::int64_t stamp_ns);
  void forget_motion();
  Six in_road(const RoadAxes& axes, const Twist& twist) const;
  Twist in_base(const RoadAxes& axes, const Six& rate) const;
  void take_in_scan();
  void tell_nothing(pose_wall_odometry* out) const;
  Scan scan_of(const Frame& frame) const;

  Mount mount_;
  MotionSettings settings_;
  // scratch
  RangeImage image_;
  SegmentScratch segment_;
  ObservationScratch choice_;
  Span<Observation> observation_;
  Work work_;  // of this frame so far
  StepScratch steps_;
  CurveScratch curve_;
  StartScratch starts_;  // in the place of the two before it, which are used later
  CloudPrint* print_ = nullptr;
  // memory
  Freshness freshness_;
  ReliefMap map_;
  Pose pose_, start_, keyframe_;
  Twist twist_;  // smoothed, to expect the next place by
  ScanMotion scan_motion_;
  RoadAxes axes_;
  Travel travel_;
  SixBySix last_covariance_;
  SixBySix last_alignment_;        // the same by the patches of rock alone
  double rock_variance_m2_ = 0.0;  // of the way along by the rock, pooled over frames; 0: none yet on this map
  std::int64_t stamp_ns_ = 0;
  double period_s_ = 0.0;  // usual time between frames
  std::uint64_t frames_ = 0;
  std::uint64_t run_ = 0;          // names the map that poses are comparable in
  bool has_pose_ = false;          // of the last frame
  std::uint32_t back_ = 0;         // stamps in a row that went back
  std::uint32_t since_start_ = 0;  // frames on this map
  double slipped_m_ = 0.0;         // since the way was last known
  double lost_s_ = 0.0;            // since the last pose, where the map began anew
  bool has_map_ = false;
  bool is_bent_ = false;  // the map's scans, by unknown motion
  bool guesses_ = false;  // keyframes of unknown place since then
};

}  // namespace pose_wall::motion
