// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Places that were seen before. A match of the last metres with an old stretch of the trail is a candidate. It becomes
// a closure when enough candidates agree with each other about the same shift, none of them slides along the road, and
// no line of sight passes through what the other saw.

#pragma once

#include <cstdint>

#include "planar/match/matcher.hpp"
#include "planar/slam/trail.hpp"

namespace pose_wall::planar {

struct Candidate {
  Edge edge;  // from the old keyframe to the new one
  double explained = 0.0, second = 0.0, seen_through = 0.0;
  double slide_m = 0.0;  // along the direction that holds least
  double reach_m = 0.0;
  bool is_distinct = false;
};

// How far the relation of two keyframes can be off.
struct Drift {
  double travel_m = 0.0, doubt_rad = 0.0;

  double place_m() const;
  double yaw_rad() const;
};

class Loops {
 public:
  static constexpr double kOld_m = 15.0;  // travel after which a place counts as seen before

  void lay_out(Arena& arena);
  void open();
  // Looks for an old place about the keyframe added last. Ties the closures that are believed to the trail, or takes
  // back those that turned out wrong. True if the trail has to be solved.
  bool look(Trail* trail, Matcher& matcher);
  // Takes the trail's closures for believed, for good: of a trail that was saved.
  void adopt(const Trail& trail);
  // Two keyframes whose relation is known as a closure's is: the trail's last edge.
  void assume(const Trail& trail);
  std::uint32_t believed() const { return believed_count_; }
  std::uint32_t taken_back() const { return taken_back_; }

 private:
  // A stretch of the last metres about `now`, guessed to lie about `old`.
  struct Revisit {
    std::uint32_t old, now;
    Pose2 guess;
    double reach_m, group_m;
  };
  struct Believed {
    std::uint32_t from, to;
    std::uint32_t edge;   // of the trail
    std::uint32_t group;  // believed together
  };

  Drift drift(const Trail& trail, std::uint32_t old, std::uint32_t now) const;
  bool nearest_old(const Trail& trail, std::uint32_t now, std::uint32_t* old, double* reach_m);
  bool match(const Trail& trail, Matcher& matcher, const Revisit& visit, Candidate* candidate);
  bool is_confirmed(const Trail& trail, Matcher& matcher, const Candidate& newest);
  Span<const ScanPoint> group(const Trail& trail, std::uint32_t now, Trail::Range range) const;
  double seen_through(const Trail& trail, std::uint32_t old, std::uint32_t now, const Pose2& now_in_old) const;
  bool agrees(const Trail& trail, const Candidate& a, const Candidate& b) const;
  std::uint32_t believe(Trail* trail, Matcher& matcher, const Candidate& newest);
  bool doubt(Trail* trail, const Candidate& newest);

  // Those of the last 12 m count, and looks are 0.5 m apart: 24 of them, and as many that wait to be dropped.
  static constexpr std::uint32_t kPoolMost = 48;
  SurfaceMap old_;
  Span<ScanPoint> group_;
  Span<Candidate> pool_;
  Span<Believed> believed_;
  Span<float> profile_;
  std::uint32_t pool_count_ = 0, believed_count_ = 0;
  double looked_at_m_ = 0.0;
  std::uint32_t taken_back_ = 0;
  std::uint32_t groups_ = 0;                     // beliefs so far
  std::uint32_t fits_ = 0, contradictions_ = 0;  // since the last belief
  double believed_at_m_ = 0.0, confirmed_at_m_ = 0.0;
};

}  // namespace pose_wall::planar
