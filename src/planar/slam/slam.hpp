// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The story of a scan: prediction, match with the last metres, keyframe, closures, graph.

#pragma once

#include <cstdint>

#include "planar/match/scan_follower.hpp"
#include "planar/slam/loops.hpp"
#include "pose_wall_planar_slam.h"

namespace pose_wall::planar {

using SlamSettings = pose_wall_planar_slam_settings;

struct SlamStep {
  Pose2 pose;
  std::uint32_t keyframe = 0;  // that the scan belongs to
  Pose2 in_keyframe;
  bool is_keyframe = false;
  bool is_valid = false;    // it has points on surfaces
  bool is_trusted = false;  // so many of them that the pose is right
  double explained = 0.0, rms_m = 0.0;
  std::uint32_t closures = 0;  // believed with this scan
};

class Slam {
 public:
  void lay_out(Arena& arena, const SlamSettings& settings);
  void open(const SlamSettings& settings);
  // As opened, without a map.
  void clear() { open(settings_); }
  SlamStep process(const BeamScan& scan, const Pose2* odometry);
  // Goes on with the graph until it rests, at most kRoundsMost rounds. process() does one round a scan.
  void settle();
  bool is_settled() const { return rounds_left_ == 0; }
  std::uint32_t solution() const { return solution_; }  // another number whenever earlier poses have changed
  bool is_full() const { return is_full_; }
  Span<Beam> beams() const { return beams_; }  // room for a scan
  // The trail was replaced by one that was saved: goes on from this pose in its map.
  void resume(const Pose2& base);
  Trail& trail() { return trail_; }

  const Trail& trail() const { return trail_; }
  const Loops& loops() const { return loops_; }

 private:
  double noise_m(const BeamScan& scan) const;
  void learn_scatter(const Fit& placed);
  bool is_due(const Fit& placed) const;
  void begin_keyframe(Span<const ScanPoint> points, const BeamScan& scan, const Eigen::Matrix3d& information);
  void tie_to_saved(const Eigen::Matrix3d& information);

  static constexpr std::uint32_t kRoundsMost = 12;  // of the graph after a closure: a bound, should it not come to rest

  void improve();
  void draw_near();

  SlamSettings settings_{};
  Matcher matcher_;
  PoseGraph graph_;
  Trail trail_;
  Loops loops_;
  SurfaceMap near_;
  Span<Beam> beams_;
  Span<ScanPoint> scan_points_;
  ScanFollower follower_;
  Pose2 pose_;
  double scatter_ = 1.0;        // of points about surfaces, in range noises
  std::uint32_t doubtful_ = 0;  // scans since the last keyframe that fitted badly
  std::uint32_t rounds_left_ = 0, solution_ = 0;
  std::uint32_t resumes_at_ = 0;  // the keyframe that the machine stands near after that
  bool resumes_ = false;
  bool is_full_ = false;
};

}  // namespace pose_wall::planar
