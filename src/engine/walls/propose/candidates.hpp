// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Planes that may be a wall: drawn beside a direction, refined, and weighed by their solid area.

#pragma once

#include "base/containers/point_set.hpp"
#include "base/containers/work.hpp"
#include "base/estimation/shortlist.hpp"
#include "base/estimation/tangent_points.hpp"
#include "base/math/random.hpp"
#include "engine/config.hpp"
#include "engine/types.hpp"
#include "engine/walls/propose/evidence.hpp"
#include "engine/walls/scene.hpp"

namespace pose_wall {

// Hypotheses for vertical planes on one side of a direction: two points and the vertical make one. They are scored and
// kept as a short list of different surfaces.

constexpr std::uint32_t kWallShortlist = 10;  // the wall behind the winner stays in the race
// Beyond yaw_max_deg, which gates the fit; swept: half and twice change nothing.
constexpr double kRefineSlack_deg = 5.0;

// A direction to look along, and the horizontal direction to the searched side (both unit, levelled frame). A search
// ahead and behind is a search beside a direction turned by 90 degrees.
struct SideView {
  Eigen::Vector3d along_level;
  Eigen::Vector3d side_level;
};

// True if two planes beside the same direction are the same wall: beside the machine they are no further apart than
// apart_m.
struct SameWall {
  static constexpr double kApart_m = 0.15;  // three default thresholds: nearer planes are the same wall
  SideView view;
  double apart_m = kApart_m;
  bool operator()(const Plane& a, const Plane& b) const;
};

using WallShortlist = Shortlist<kWallShortlist>;

// Limits of a wall's turn from the direction and of its lean, worked out once for all hypotheses.
struct WallLimits {
  double cos_angle_max, cos_lean_max;

  WallLimits(double angle_max_rad, double lean_max_rad);
};

// True for a plane that may be this side's wall: near vertical, not turned too far, its foot on the side.
bool may_be_wall(const Plane& plane, const SideView& view, const WallLimits& limits);

class WallSearch {
 public:
  void lay_out(Arena& arena, std::uint32_t points_max);

  // Takes the points of the band on this side to draw from.
  void begin(const PointSet& band_level, const SideView& view, const Settings& settings, Random* random);
  void offer(const Plane& plane);
  void draw();
  // The one-point problem: with a known direction a histogram holds all offsets at once. Offers the best few.
  void offer_offsets(const Eigen::Vector3d& normal_level);

  WallShortlist& list() { return list_; }
  std::uint32_t scored() const { return scored_; }

 private:
  bool draw_plane(const WallLimits& limits, Plane* plane);

  const PointSet* band_ = nullptr;
  const Settings* settings_ = nullptr;
  Random* random_ = nullptr;
  SideView view_{};
  Span<std::uint32_t> side_;  // indices of the points on this side, count_ of them
  std::uint32_t count_ = 0;
  PointSet subset_;
  WallShortlist list_;
  std::uint32_t scored_ = 0;
};

struct WallCandidate {
  Plane plane;
  Eigen::Vector3d along_level = Eigen::Vector3d::Zero();  // of the evidence's columns
  WallEvidence evidence;
  std::uint32_t failed = 0;  // reasons of the gates that it fails
};

struct WallCandidates {
  WallCandidate item[kWallShortlist];
  std::uint32_t count = 0;

  // The best score of the items that are accepted by their index; nullptr if none is.
  template <typename Accepts>
  const WallCandidate* strongest_of(const Accepts& accepts) const {
    const WallCandidate* best = nullptr;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (accepts(i) && (best == nullptr || item[i].evidence.score_m2 > best->evidence.score_m2)) best = &item[i];
    }
    return best;
  }
  // The same, whatever gates it fails.
  const WallCandidate* strongest() const {
    return strongest_of([](std::uint32_t) { return true; });
  }
};

// Scratch for candidates.
struct ProposeScratch {
  WallSearch search[2];
  BoundedPoints thin_level;  // part of the band, enough to refine hypotheses
  // Shared with later steps.
  Span<std::uint32_t> near;
  TangentPoints* points = nullptr;
  WallGrid* grid = nullptr;
  Work* work = nullptr;

  void lay_out(Arena& arena, std::uint32_t points_max);
};

// Puts an even part of the band into scratch->thin_level, as much from each side.
void thin_out(const WallScene& scene, ProposeScratch* scratch);

// Candidates on two sides that face each other, after thin_out(). last: planes of the last frame or nullptr, scored
// like any other hypothesis.
void propose_walls(const WallScene& scene, const SideView (&views)[2], const Plane* const last[2], Random* random,
                   ProposeScratch* scratch, WallCandidates (*out)[2]);

// The steps of propose_walls(), for a caller that may stop between them. Once both sides are drawn,
// exchange_directions() tries each side with the normal found on the other one. weighed: planes of this view that need
// not be weighed again.
void draw_walls(const WallScene& scene, const SideView& view, const Plane* last, Random* random, WallSearch* search);
void exchange_directions(WallSearch (&search)[2]);
void weigh_walls(const WallScene& scene, const SideView& view, WallSearch* search, ProposeScratch* scratch,
                 WallCandidates* out, const WallCandidates* weighed = nullptr);

// A few rounds of Tukey from a drawn hypothesis on points of the band, with a free lean. False if too few points
// support it. Call it wide first, to find the lean of a wall that an upright hypothesis cuts, then narrow. near and
// points: scratch.
enum class RefineWidth { kWide, kNarrow };
bool refine_hypothesis(const BoundedPoints& band_level, double thresh_m, const Eigen::Vector3d& along_level,
                       RefineWidth width, Span<std::uint32_t> near, TangentPoints* points, Plane* plane);

// The reasons of the gates that a plane fails.
std::uint32_t failed_gates(const Plane& plane, const WallEvidence& evidence, const Settings& settings);

}  // namespace pose_wall
