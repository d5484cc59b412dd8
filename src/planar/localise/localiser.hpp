// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The story of a scan: where the place is known, the follower follows it. Where it is not, the last metres are searched
// for in the whole map, again and again as they grow, until one place is left.

#pragma once

#include <cstdint>

#include "lidar/seen_clouds.hpp"
#include "planar/localise/map_follower.hpp"
#include "planar/localise/recent.hpp"
#include "planar/localise/verdict.hpp"
#include "pose_wall_planar_localise.h"

namespace pose_wall::planar {

using LocaliseSettings = pose_wall_planar_localise_settings;

enum class Where : std::uint32_t { searching, unknown, ambiguous, unique, doubtful };

class Localiser {
 public:
  void lay_out(Arena& arena, const LocaliseSettings& settings);
  void open(const LocaliseSettings& settings);
  // As opened, without a map.
  void clear() { open(settings_); }
  PlaceMap& map() { return map_; }
  const PlaceMap& map() const { return map_; }
  Span<Beam> beams() const { return beams_; }

  Where process(const BeamScan& scan, const Pose2* odometry);
  // Base stands here, as somebody says; scans can contradict.
  void place(const Pose2& pose, double sigma_m, double sigma_rad);
  // Forgets where base stands.
  void forget();

  Where where() const { return where_; }
  // Why it is not unique.
  Why why() const { return is_tracking_ ? tracking_ : verdict_.why; }
  const MapFollower& follower() const { return follower_; }
  bool is_tracking() const { return is_tracking_; }
  const SearchVerdict& verdict() const { return verdict_; }
  const PlaceSearch& search() const { return search_; }
  // Where a candidate of the verdict stands now; the next search may be under way.
  Pose2 now(const Pose2& at_look) const { return compose(at_look, between(judged_from_, recent_.pose())); }
  std::uint32_t searches() const { return searches_; }
  std::uint32_t lost() const { return lost_; }

 private:
  Where wander(Span<const ScanPoint> points, const BeamScan& scan, const Pose2* odometry);
  Where track(Span<const ScanPoint> points, const BeamScan& scan, const Pose2* odometry);
  bool is_due() const;
  bool is_repeat(const BeamScan& scan);
  bool settle(Span<const ScanPoint> points, const BeamScan& scan, const Pose2* odometry);

  LocaliseSettings settings_{};
  PlaceMap map_;
  Matcher matcher_;
  Recent recent_;
  PlaceSearch search_;
  MapFollower follower_;
  Surroundings around_, scan_around_;
  SearchVerdict verdict_;
  Span<Beam> beams_;
  Span<ScanPoint> scan_points_;
  Span<PatchWall> walls_;
  Pose2 looked_from_, judged_from_;  // of the search under way, and of the verdict
  double looked_at_m_ = 0.0, looked_at_rad_ = 0.0;
  Where where_ = Where::searching;
  Why tracking_ = Why::none;  // of the tracked place
  SeenClouds seen_;
  bool is_tracking_ = false, has_looked_ = false;
  std::uint32_t searches_ = 0, lost_ = 0, scans_since_search_ = 0;
};

}  // namespace pose_wall::planar
