// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/localise/localiser.hpp"
#include "base/math/fnv1a.hpp"

#include <cmath>
#include <cstring>

namespace pose_wall::planar {
namespace {

Why doubt_of(TrackingState track) {
  if (track == TrackingState::tracked) return Why::none;
  if (track == TrackingState::blind) return Why::few;
  if (track == TrackingState::contradicted) return Why::contradicted;
  return track == TrackingState::loose ? Why::slides : Why::misfit;
}

}  // namespace

void Localiser::lay_out(Arena& arena, const LocaliseSettings& settings) {
  map_.lay_out(arena, settings.tiles_most);
  matcher_.lay_out(arena);
  recent_.lay_out(arena);
  search_.lay_out(arena);
  around_.lay_out(arena);
  scan_around_.lay_out(arena);
  beams_ = arena.take<Beam>(POSE_WALL_PLANAR_BEAMS_MAX);
  scan_points_ = arena.take<ScanPoint>(kMatchPointsMost);
  walls_ = arena.take<PatchWall>(kPatchesMost);
}

void Localiser::open(const LocaliseSettings& settings) {
  settings_ = settings;
  map_.open();
  recent_.open(settings.odometry_m, settings.odometry_rad);
  search_.open();
  follower_.open(settings.odometry_m, settings.odometry_rad);
  searches_ = lost_ = 0;
  seen_ = SeenClouds{};
  forget();
}

void Localiser::forget() {
  recent_.clear();
  search_.open();
  verdict_ = SearchVerdict();
  looked_from_ = judged_from_ = Pose2();
  looked_at_m_ = looked_at_rad_ = 0.0;
  is_tracking_ = has_looked_ = false;
  scans_since_search_ = 0;
  where_ = Where::searching;
}

void Localiser::place(const Pose2& pose, double sigma_m, double sigma_rad) {
  forget();
  follower_.begin(pose, sigma_m, sigma_rad);
  is_tracking_ = true;
  where_ = Where::doubtful;
}

// A new search needs something new: metres, turns, or time in which things may have moved.
bool Localiser::is_due() const {
  constexpr double kTravel_m = 1.0, kTurn_rad = 0.7;  // README.md, metres help: a search begins with every metre
  constexpr std::uint32_t kScans = 50;  // 5 s at 10 Hz. With 25 and with 100 the sweep's restarts were the same
  if (!has_looked_) return true;
  return recent_.travel_m() - looked_at_m_ >= kTravel_m || recent_.turned_rad() - looked_at_rad_ >= kTurn_rad ||
         scans_since_search_ >= kScans;
}

// The one place, if the present scan agrees.
bool Localiser::settle(Span<const ScanPoint> points, const BeamScan& scan, const Pose2* odometry) {
  // A cell of the map, and the yaw that moves its points by one at 3 m.
  constexpr double kKnown_m = 0.1, kKnown_rad = 0.03;
  scan_around_.take(points, scan.origin_m, scan.sigma_m);
  follower_.begin(now(verdict_.candidates[0].pose), kKnown_m, kKnown_rad);
  return follower_.confirm(map_, scan_around_, odometry) == TrackingState::tracked;
}

Where Localiser::wander(Span<const ScanPoint> points, const BeamScan& scan, const Pose2* odometry) {
  if (!recent_.follow(points, scan, odometry, matcher_)) {
    search_.open();
    has_looked_ = false;
    where_ = Where::searching;
    verdict_ = SearchVerdict();
  }
  ++scans_since_search_;
  if (!search_.is_under_way() && is_due()) {
    recent_.gather(points, scan, &around_);
    looked_from_ = recent_.pose();
    looked_at_m_ = recent_.travel_m();
    looked_at_rad_ = recent_.turned_rad();
    has_looked_ = true;
    scans_since_search_ = 0;
    search_.begin(map_, around_);
  }
  if (!search_.is_under_way() || !search_.go_on(map_, around_, settings_.work)) return where_;
  ++searches_;
  judged_from_ = looked_from_;
  judge(map_, around_, search_, settings_.map_is_whole != 0, walls_, &verdict_);
  if (verdict_.finding == Finding::unknown) return Where::unknown;
  if (verdict_.finding == Finding::ambiguous) return Where::ambiguous;
  if (!settle(points, scan, odometry)) {
    verdict_.why = Why::scan_differs;
    return Where::ambiguous;
  }
  is_tracking_ = true;
  tracking_ = Why::none;
  return Where::unique;
}

Where Localiser::track(Span<const ScanPoint> points, const BeamScan& scan, const Pose2* odometry) {
  scan_around_.take(points, scan.origin_m, scan.sigma_m);
  const TrackingState track = follower_.follow(map_, scan_around_, odometry);
  if (track == TrackingState::lost) {
    ++lost_;
    forget();
    return wander(points, scan, odometry);
  }
  tracking_ = doubt_of(track);
  return track == TrackingState::tracked ? Where::unique : Where::doubtful;
}

// By the bits of its ranges. Scans of the same stamp are the same scan once more.
bool Localiser::is_repeat(const BeamScan& scan) {
  std::uint64_t print = kFnv1aOfNothing;
  std::uint32_t ranges = 0;
  for (const Beam& beam : scan.beams) {
    std::uint32_t bits;
    std::memcpy(&bits, &beam.range_m, sizeof(bits));
    print = fnv1a_with(print, bits);
    ranges += beam.end == BeamEnd::thing ? 1U : 0U;
  }
  if (ranges < SeenClouds::kReturnsLeast) return false;
  const Repeat repeat = seen_.keep(print, scan.stamp_ns);
  return repeat.is_one && repeat.age_s != 0.0;
}

// A scan that came before shows nothing of now: a search waits, and a tracked place is carried on without it.
Where Localiser::process(const BeamScan& scan, const Pose2* odometry) {
  const bool repeats = is_repeat(scan);
  if (repeats && !is_tracking_) return where_;
  const Span<const ScanPoint> points =
      repeats ? Span<const ScanPoint>() : even_points(scan, kMatchSpacing_m, scan_points_);
  where_ = is_tracking_ ? track(points, scan, odometry) : wander(points, scan, odometry);
  if (repeats && is_tracking_) tracking_ = Why::repeated;
  return where_;
}

}  // namespace pose_wall::planar
