// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The last metres in a frame of their own, while the place in the map is not known: each scan is matched with those
// before it. All that they saw together tells more about the place than one scan.

#pragma once

#include <cstdint>

#include "planar/localise/surroundings.hpp"
#include "planar/match/scan_follower.hpp"

namespace pose_wall::planar {

class Recent {
 public:
  void lay_out(Arena& arena);
  // Standard deviation of a step of odometry by its length and turn.
  void open(double odometry_m, double odometry_rad);
  void clear();
  // False: the scan does not continue what was seen before. The frame then begins anew with it.
  bool follow(Span<const ScanPoint> points, const BeamScan& scan, const Pose2* odometry, Matcher& matcher);
  const Pose2& pose() const { return pose_; }
  double travel_m() const { return travel_m_; }  // since the beginning
  double turned_rad() const { return turned_rad_; }
  double look_back_m() const;  // travel that gather() holds now
  // What the last metres and the scan that was followed last saw, from where base stands now.
  void gather(Span<const ScanPoint> points, const BeamScan& scan, Surroundings* out) const;

 private:
  static constexpr std::uint32_t kKeyframesMost = 40;  // half as many again as 8 m have, for turns
  struct Kept {
    Pose2 pose;
    double travel_m;
    std::uint32_t count;
  };

  void keep(Span<const ScanPoint> points);
  void draw();
  const Kept& kept(std::uint32_t k) const { return kept_[(first_ + k) % kKeyframesMost]; }
  Span<const ScanPoint> points_of(std::uint32_t k) const;

  SurfaceMap near_;
  Span<Kept> kept_;
  Span<ScanPoint> points_;
  ScanFollower follower_;
  Pose2 pose_;
  std::uint32_t first_ = 0, count_ = 0;
  double travel_m_ = 0.0, turned_rad_ = 0.0;
};

}  // namespace pose_wall::planar
