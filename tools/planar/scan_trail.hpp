// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The SLAM of pose_wall_planar over a sequence of scans. It keeps what the map and the poses need at the end.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "pose_wall.h"
#include "pose_wall_planar_slam.h"

namespace pose_wall::tools {

// The block of a part of the library.
class PartBlock {
 public:
  explicit PartBlock(std::uint64_t bytes)
      : lines_(static_cast<std::size_t>((bytes + sizeof(Line) - 1) / sizeof(Line))), place_(new Line[lines_]) {}
  void* data() const { return place_.get(); }
  std::uint64_t bytes() const { return lines_ * sizeof(Line); }

 private:
  struct alignas(POSE_WALL_BLOCK_ALIGNMENT) Line {
    unsigned char bytes[POSE_WALL_BLOCK_ALIGNMENT];
  };
  std::size_t lines_;
  std::unique_ptr<Line[]> place_;  // not touched before it is used: memory that a short trail never takes
};

// A call of the library that failed; the message names the call's purpose.
class PlanarError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};
// Throws PlanarError where status is not POSE_WALL_OK.
void require_ok(std::int32_t status, const char* purpose);

// A scan with its ranges.
struct KeptScan {
  pose_wall_planar_scan scan{};
  std::vector<float> range_m;

  explicit KeptScan(const pose_wall_planar_scan& from)
      : scan(from), range_m(from.range_m, from.range_m + from.beams) {}
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
  pose_wall_planar_pose in_keyframe{};
};

struct Closure {
  std::uint32_t from = 0, to = 0;  // keyframes
};

class ScanTrail {
 public:
  // Throws PlanarError.
  explicit ScanTrail(const pose_wall_planar_slam_settings& settings);

  // odometry may be nullptr. Throws PlanarError for a scan that the library refuses; the trail is then unchanged.
  const pose_wall_planar_slam_result& add(const pose_wall_planar_scan& scan, const pose_wall_planar_pose* odometry,
                                          std::string time);
  // Goes on with the graph until it rests.
  void settle();

  const std::vector<TrailScan>& scans() const { return scans_; }
  const pose_wall_planar_slam_result& last() const { return last_; }
  std::uint64_t block_bytes() const { return block_.bytes(); }

  // The poses as they are known now.
  std::vector<pose_wall_planar_pose> keyframe_poses() const;
  std::vector<pose_wall_planar_pose> scan_poses() const;
  double travel_m() const;
  std::vector<Closure> closures() const;  // that are believed
  // Of each keyframe, in their order.
  const std::vector<KeptScan>& keyframe_scans() const { return keyframe_scans_; }

  std::size_t count(std::uint32_t state) const;
  double explained_mean() const;  // over all scans but the first
  double mean_ms() const;
  double worst_ms() const { return worst_ms_; }

  std::string saved() const;

 private:
  PartBlock block_;
  pose_wall_planar_slam* slam_ = nullptr;
  pose_wall_planar_slam_result last_{};
  std::vector<TrailScan> scans_;
  std::vector<KeptScan> keyframe_scans_;
  double explained_sum_ = 0.0, ms_sum_ = 0.0, worst_ms_ = 0.0;
};

}  // namespace pose_wall::tools
