// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The SLAM of pose_wall_planar over a sequence of scans. It keeps what the map and the poses need at the end.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pose_wall_planar_slam.h"
#include "study/planar/part_block.hpp"

namespace pose_wall::tools {

// A scan with its ranges.
struct KeptScan {
  std::uint32_t keyframe = 0;
  pose_wall_planar_pose in_keyframe{};  // of base
  pose_wall_planar_scan scan{};
  std::vector<float> range_m;

  KeptScan(const pose_wall_planar_scan& from, const pose_wall_planar_slam_result& at)
      : keyframe(at.keyframe),
        in_keyframe(at.in_keyframe),
        scan(from),
        range_m(from.range_m, from.range_m + from.beams) {}
  pose_wall_planar_scan view() const {
    pose_wall_planar_scan whole = scan;
    whole.range_m = range_m.data();
    return whole;
  }
};

struct TrailScan {
  std::string time;  // as the input writes it
  std::uint32_t state = 0;
  std::uint32_t keyframe = 0;
  pose_wall_planar_pose in_keyframe{};  // of what the scan's pose is
};

struct Closure {
  std::uint32_t from = 0, to = 0;  // keyframes
};

// Of a SLAM of the library.
pose_wall_planar_keyframe keyframe_of(const pose_wall_planar_slam* slam, std::uint32_t number);
std::vector<Closure> closures_of(const pose_wall_planar_slam* slam);  // that are believed

class ScanTrail {
 public:
  // Throws PlanarError.
  explicit ScanTrail(const pose_wall_planar_slam_settings& settings);

  // odometry may be nullptr. place: in base, of what the scan's pose is to be. Throws PlanarError for a scan that the
  // library refuses; the trail is then unchanged.
  const pose_wall_planar_slam_result& add(const pose_wall_planar_scan& scan, const pose_wall_planar_pose* odometry,
                                          const pose_wall_planar_pose& place, std::string time);
  // Goes on with the graph until it rests.
  void settle();

  const std::vector<TrailScan>& scans() const { return scans_; }
  const pose_wall_planar_slam_result& last() const { return last_; }
  std::uint64_t block_bytes() const { return block_.bytes(); }

  // The poses as they are known now.
  std::vector<pose_wall_planar_pose> keyframe_poses() const;
  std::vector<pose_wall_planar_pose> scan_poses() const;
  double travel_m() const;
  std::vector<Closure> closures() const { return closures_of(slam_); }
  // For the map, with the pose of base at each: every scan while memory allows it, then those of keyframes.
  const std::vector<KeptScan>& kept_scans() const { return kept_scans_; }
  std::vector<pose_wall_planar_pose> kept_poses() const;

  std::size_t count(std::uint32_t state) const;
  double explained_mean() const;  // over all scans but the first
  // Processor time of a scan.
  double mean_ms() const;
  double worst_ms() const { return worst_ms_; }

  std::string saved() const;

 private:
  PartBlock block_;
  pose_wall_planar_slam* slam_ = nullptr;
  pose_wall_planar_slam_result last_{};
  std::vector<TrailScan> scans_;
  std::vector<KeptScan> kept_scans_;
  std::size_t kept_beams_ = 0;
  double explained_sum_ = 0.0, ms_sum_ = 0.0, worst_ms_ = 0.0;
};

}  // namespace pose_wall::tools
