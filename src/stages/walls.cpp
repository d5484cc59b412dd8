// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/walls.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "containers/even_share.hpp"
#include "estimation/near_plane.hpp"
#include "math/elementary.hpp"
#include "math/larger.hpp"
#include "stages/walls_across.hpp"
#include "stages/walls_edges.hpp"
#include "stages/walls_measure.hpp"
#include "stages/walls_notes.hpp"
#include "stages/walls_select.hpp"
#include "stages/walls_sight.hpp"

namespace pose_wall {
namespace {

constexpr double kSeenThroughMax = 0.5;
constexpr double kSeenThroughDoubt = 0.25;
constexpr double kOnWallInThresholds = 3.0;
constexpr double kRivalStretch = 1.05;
constexpr double kRivalMargin_m = 0.03;
constexpr double kSilentMax = 0.025;
constexpr double kOpenDoubt = 0.01;
constexpr double kOpenMax = 0.1;
// What passes through small gaps ends right behind them, on whatever is there, and what is hardly seen may be anything:
// the wall may be this far behind.
constexpr double kMayBeBehind_m = 2.0;
constexpr double kToplessMax = 0.08;
constexpr double kExplainedMin = 0.3;

std::uint32_t faults_of(const Plane& plane, const WallEvidence& evidence, const Settings& s) {
  std::uint32_t faults = 0;
  if (!(evidence.inliers >= s.wall_inlier_min)) faults |= POSE_WALL_R_WALL_FEW_INLIERS;
  if (!(evidence.length_m >= s.wall_length_min)) faults |= POSE_WALL_R_WALL_SHORT;
  if (!(evidence.seen_through <= kSeenThroughMax)) faults |= POSE_WALL_R_WALL_SEEN_THROUGH;
  if (!(std::fabs(lean_of(plane)) <= radians(s.wall_lean_max_deg))) faults |= POSE_WALL_R_WALL_LEANS;
  return faults;
}

#ifdef POSE_WALL_TRACE
// As faults_of() asks.
void note_faults(const Plane& plane, const WallEvidence& evidence, const Settings& s) {
  const double lean_rad = std::fabs(lean_of(plane));
  trace::gate(POSE_WALL_TRACE_WALL_INLIERS, evidence.inliers, s.wall_inlier_min, evidence.inliers >= s.wall_inlier_min);
  trace::gate(POSE_WALL_TRACE_WALL_LENGTH, evidence.length_m, s.wall_length_min,
              evidence.length_m >= s.wall_length_min);
  trace::gate(POSE_WALL_TRACE_WALL_SOLID, evidence.seen_through, kSeenThroughMax,
              evidence.seen_through <= kSeenThroughMax);
  trace::gate(POSE_WALL_TRACE_WALL_LEAN, lean_rad, radians(s.wall_lean_max_deg),
              lean_rad <= radians(s.wall_lean_max_deg));
}

void note_fitted(const Plane& plane, const WallEvidence& evidence, const Settings& s, bool stayed) {
  note_faults(plane, evidence, s);
  trace::gate(POSE_WALL_TRACE_FIT_STAYED, stayed);
}

// The gates of the plane that is chosen, or of the one that shows most where none is.
void note_side(const WallChoice& choice, const WallCandidates (&beside)[2], int side, const Settings& s) {
  trace::subject(trace::side_subject(side));
  trace::attempt(0);
  const WallCandidate* const shown = choice.side[side] != nullptr ? choice.side[side] : strongest(beside[side]);
  trace::gate(POSE_WALL_TRACE_WALL_PLANES, beside[side].count, 1.0, shown != nullptr);
  if (shown != nullptr) note_faults(shown->plane, shown->evidence, s);
  for (std::uint32_t i = 0; i < beside[side].count; ++i) note_chosen(beside[side].item[i], choice, side);
  trace::attempt(1);
}

void note_explained(double share, bool explained) {
  trace::gate_of(POSE_WALL_TRACE_WALLS, POSE_WALL_TRACE_EXPLAINED, share, kExplainedMin, explained);
}

void note_sight(const WallSight& sight, const WallEdges& edges, bool grooved) {
  trace::gate(POSE_WALL_TRACE_WALL_BRIGHT, !sight.dim);
  trace::gate(POSE_WALL_TRACE_WALL_TOP_SEEN, !edges.top_unseen);
  trace::gate(POSE_WALL_TRACE_WALL_OPEN_DOUBT, sight.open, kOpenDoubt, !(sight.open > kOpenDoubt));
  trace::gate(POSE_WALL_TRACE_WALL_GROOVES, !grooved);
  trace::gate(POSE_WALL_TRACE_WALL_SILENT, sight.silent, kSilentMax, sight.silent <= kSilentMax);
  trace::gate(POSE_WALL_TRACE_WALL_OPEN, sight.open, kOpenMax, sight.open <= kOpenMax);
  trace::gate(POSE_WALL_TRACE_WALL_TOPLESS, sight.topless, kToplessMax, sight.topless <= kToplessMax);
  trace::gate(POSE_WALL_TRACE_WALL_ISLAND, !edges.island);
  trace::gate(POSE_WALL_TRACE_WALL_LOW, !edges.low);
  trace::gate(POSE_WALL_TRACE_WALL_LAYER, !edges.layer_behind);
}
#endif

// One side after the other, so that blocks of points lie on one.
void thin_out(const WallScene& scene, BoundedPoints* thin_level) {
  const PointSet& band = scene.band_level;
  thin_level->count = 0;
  for (const bool left : {true, false}) {
    for_even_share(band.count, kThinMost, [&](std::uint32_t i) {
      const Eigen::Vector3d p = band.at(i);
      if ((scene.left_level.dot(p) > 0.0) == left) thin_level->set(thin_level->count++, p, band.weight[i]);
    });
  }
  thin_level->bound();
}

bool holds_one_like(const WallCandidates& list, const SameWall& same, const Plane& plane) {
  bool holds = false;
  for (std::uint32_t i = 0; i < list.count; ++i) holds = holds || same(list.item[i].plane, plane);
  POSE_WALL_NOTE(if (holds) trace::fate(plane, POSE_WALL_TRACE_REPEATS));
  return holds;
}

// Refines the short list, merges what became alike, and weighs what is left.
void weigh(const WallScene& scene, const SideView& view, WallSearch* search, WallsScratch* scratch,
           WallCandidates* out) {
  const SameWall same{view}, surely_same{view, 0.5 * SameWall::kApart_m};
  const WallLimits limits(radians(scene.settings.yaw_max_deg + kRefineSlack_deg), 0.5 * kPi);
  const auto refine = [&](RefineWidth width, Plane* plane) {
    const double thresh_m = scene.settings.wall_ransac_thresh;
    const bool holds = refine_hypothesis(scratch->thin_level, thresh_m, view.along_level, width, &scratch->fit, plane);
    POSE_WALL_NOTE(if (holds) note_refined_wall(
        *plane, width == RefineWidth::kWide ? POSE_WALL_TRACE_UNSUPPORTED : POSE_WALL_TRACE_OUT_OF_RANGE));
    return holds;
  };
  POSE_WALL_NOTE(trace::subject(subject_of(scene, view)));
  out->count = 0;
  for (std::uint32_t k = 0; k < search->list().count(); ++k) {
    Plane plane = search->list()[k].plane;
    POSE_WALL_NOTE(note_drawn_wall(plane));
    if (!refine(RefineWidth::kWide, &plane)) continue;
    // What is this near one that is there already would come still nearer.
    if (holds_one_like(*out, surely_same, plane)) continue;
    if (!refine(RefineWidth::kNarrow, &plane)) continue;
    if (!may_be_wall(plane, view, limits) || holds_one_like(*out, same, plane)) continue;
    mark_wall(scene, plane, along_of(plane, view.along_level), MarkWidth::kThreshold, &scratch->grid);
    const WallEvidence evidence = scratch->grid.evidence();
    out->item[out->count++] = {plane, evidence, faults_of(plane, evidence, scene.settings)};
    POSE_WALL_NOTE(note_weighed_wall(out->item[out->count - 1]));
  }
}

void draw(const WallScene& scene, const SideView& view, const Plane* last, Random* random, WallSearch* search) {
  search->begin(scene.band_level, view, scene.settings, random);
  if (last != nullptr) search->offer(*last);
  search->draw();
}

// Each side of a direction gets the other's.
void exchange_directions(WallSearch (&search)[2]) {
  for (int side = 0; side < 2; ++side) {
    WallShortlist& other = search[1 - side].list();
    if (other.count() > 0) search[side].offer_offsets(other[0].plane.n);
  }
}

// Nothing is reported of a machine that stands across the road.
void refuse_where_across(const WallScene& scene, Random* random, WallsScratch* scratch, WallChoice* choice) {
  const double most_m2 = choice->any() ? most_area_across_m2(scene) : 0.0;
  if (!may_stand_across(2.0 * most_m2, *choice)) return;
  const Eigen::Vector3d f = scene.forward_level, l = scene.left_level;
  const SideView ends[2] = {{l, f}, {l, -f}};
  WallCandidates ahead, behind;
  draw(scene, ends[0], nullptr, random, &scratch->search[0]);
  weigh(scene, ends[0], &scratch->search[0], scratch, &ahead);
  // With the most that could be behind, what is ahead may still be too little.
  const WallCandidate* const best = strongest(ahead);
  if (!is_behind_to_be_drawn(best != nullptr ? best->evidence.score_m2 : 0.0, most_m2, *choice)) return;
  draw(scene, ends[1], nullptr, random, &scratch->search[1]);
  exchange_directions(scratch->search);
  weigh(scene, ends[0], &scratch->search[0], scratch, &ahead);
  weigh(scene, ends[1], &scratch->search[1], scratch, &behind);
  refuse_if_across(ahead, behind, scene.settings, choice);
}

// The truth may be the rival: the protection levels reach to it.
void reach_to_rival(const WallScene& scene, const Plane& rival, int side, WallResult* wall) {
  const double yaw = yaw_of(along_of(rival, scene.forward_level), scene.forward_level);
  wall->yaw_to_rival_rad = larger(wall->yaw_to_rival_rad, std::fabs(yaw - wall->yaw_rad));
  for (int end = 0; end < 2; ++end) {
    const double distance = distance_at(rival, scene.sample_level_m[side][end]);
    // The rival was looked at in passing: it is not known to the centimetre.
    wall->distance_bound_m[end] += kRivalStretch * std::fabs(distance - wall->distance_m[end]) + kRivalMargin_m;
  }
  wall->fit.reasons |= POSE_WALL_R_WALL_AMBIGUOUS;
}

// A wall that is seen only well ahead of the machine, or behind it: in between the road may bend.
void extend_to_machine(double away_m, WallResult* wall) {
  constexpr double kAwayMax_m = 2.0;
  constexpr double kMayBend_rad = 0.44;  // 25 degrees
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_WALL_AWAY, away_m, kAwayMax_m, !(away_m > kAwayMax_m)));
  if (!(away_m > kAwayMax_m)) return;
  wall->fit.reasons |= POSE_WALL_R_EXTRAPOLATED;
  wall->yaw_to_rival_rad = kMayBend_rad;
}

// Near the sensor, what passes for a wall and is none gives itself away.
void look_closely(const WallScene& scene, bool grooved, WallsScratch* scratch, WallResult* wall) {
  const Plane& plane = wall->fit.plane;
  const double reach_m = kOnWallInThresholds * scene.settings.wall_ransac_thresh;
  const WallSight sight = look_at(scene, plane, wall->along_level, kWellBehind_m, &scratch->sight);
  const WallEdges edges = look_past(scene, plane, wall->along_level, reach_m, &scratch->edges);
  const bool little_seen = sight.dim || edges.top_unseen, shows_behind = sight.open > kOpenDoubt || edges.layer_behind;
  POSE_WALL_NOTE(note_sight(sight, edges, grooved));
  if (little_seen) wall->fit.reasons |= POSE_WALL_R_WALL_FEW_INLIERS;
  if (shows_behind) wall->fit.reasons |= POSE_WALL_R_WALL_SEEN_THROUGH;
  if (grooved) wall->fit.reasons |= POSE_WALL_R_WALL_AMBIGUOUS;
  if (little_seen || shows_behind || grooved) {
    const double behind_m = larger(kRivalStretch * sight.depth_m + kRivalMargin_m, kMayBeBehind_m);
    for (double& bound : wall->distance_bound_m) bound += behind_m;
  }
  const bool whole = sight.silent <= kSilentMax && sight.open <= kOpenMax && sight.topless <= kToplessMax;
  if (whole && !edges.island && !edges.low) return;
  wall->fit.refused = true;
  wall->fit.reasons |= POSE_WALL_R_WALL_SEEN_THROUGH;
}

WallResult measure(const WallScene& scene, const WallChoice& choice, int side, WallsScratch* scratch) {
  const WallCandidate& chosen = *choice.side[side];
  const WallSurface surface = fit_surface(scene, chosen.plane, &scratch->grid, &scratch->fit);
  WallResult wall = measure_wall(scene, surface, side, scratch->grid);
  wall.area_m2 = chosen.evidence.area_m2;
  wall.along_min_m = chosen.evidence.along_min_m;
  wall.along_max_m = chosen.evidence.along_max_m;
  extend_to_machine(chosen.evidence.away_m, &wall);
  if (choice.rival[side] != nullptr) reach_to_rival(scene, choice.rival[side]->plane, side, &wall);
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_WALL_SOLID_DOUBT, chosen.evidence.seen_through, kSeenThroughDoubt,
                             !(chosen.evidence.seen_through > kSeenThroughDoubt)));
  if (chosen.evidence.seen_through > kSeenThroughDoubt) wall.fit.reasons |= POSE_WALL_R_WALL_SEEN_THROUGH;
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_FIT_INLIERS, wall.fit.inliers, scene.settings.wall_inlier_min,
                             wall.fit.inliers >= scene.settings.wall_inlier_min));
  if (!(wall.fit.inliers >= scene.settings.wall_inlier_min)) {
    wall.fit.refused = true;
    wall.fit.reasons |= POSE_WALL_R_WALL_FEW_INLIERS;
  }
  // The fit may have wandered off, or shrunk to what is no wall any more.
  const SideView view{scene.forward_level, side == 0 ? scene.left_level : Eigen::Vector3d(-scene.left_level)};
  const std::uint32_t faults =
      wall.fit.found ? faults_of(wall.fit.plane, scratch->grid.evidence(), scene.settings) : 0U;
  POSE_WALL_NOTE(if (wall.fit.found) note_fitted(wall.fit.plane, scratch->grid.evidence(), scene.settings,
                                                 faults == 0 && SameWall{view}(wall.fit.plane, chosen.plane)));
  if (wall.fit.found && (faults != 0 || !SameWall{view}(wall.fit.plane, chosen.plane))) {
    wall.fit.refused = true;
    wall.fit.reasons |= POSE_WALL_R_WALL_NOT_FOUND | faults;
  }
  if (!(std::fabs(wall.yaw_rad) <= radians(scene.settings.yaw_max_deg))) {
    wall.fit.refused = true;
    wall.fit.reasons |= POSE_WALL_R_YAW_OUT_OF_RANGE;
  }
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_WALL_YAW, std::fabs(wall.yaw_rad), radians(scene.settings.yaw_max_deg),
                             std::fabs(wall.yaw_rad) <= radians(scene.settings.yaw_max_deg)));
  if (wall.fit.found) look_closely(scene, surface.grooved, scratch, &wall);
  return wall;
}

// How far what is seen on the other side of the road runs apart from a wall that stands alone: what was chosen there
// and was no wall after all, what its fit came to, and whatever else could be a wall by itself, be it much weaker.
// Radians.
double apart_from_other_side(const WallCandidate& wall, const WallCandidate* chosen, const WallResult& fitted,
                             const WallCandidates& seen, const Settings& s) {
  constexpr double kWeakestShare = 0.1;
  double apart = chosen != nullptr ? angle_in_plan(wall.plane, chosen->plane) : 0.0;
  if (fitted.fit.found) apart = larger(apart, angle_in_plan(wall.plane, fitted.fit.plane));
  for (std::uint32_t i = 0; i < seen.count; ++i) {
    const WallCandidate& c = seen.item[i];
    // Few points are no excuse: they are enough to doubt which way the road runs.
    const std::uint32_t faults = c.faults & ~static_cast<std::uint32_t>(POSE_WALL_R_WALL_FEW_INLIERS);
    if (faults != 0 || !(c.evidence.length_m >= s.wall_alone_length_min)) continue;
    if (!(c.evidence.score_m2 >= kWeakestShare * wall.evidence.score_m2)) continue;
    apart = larger(apart, angle_in_plan(wall.plane, c.plane));
  }
  return apart;
}

// What is left of a pair of which the other one was no wall after all must be as long as a wall that stands alone.
void doubt_what_is_left(const WallCandidate& left, const Settings& s, WallResult* out) {
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_LEFT_ALONE, left.evidence.length_m, s.wall_alone_length_min,
                             left.evidence.length_m >= s.wall_alone_length_min));
  if (left.evidence.length_m >= s.wall_alone_length_min) return;
  out->fit.refused = true;
  out->fit.reasons |= POSE_WALL_R_WALL_SHORT;
}

// A wall that stands alone tells the road's direction only as well as the other side does not speak against it.
void doubt_those_alone(const Settings& s, const WallChoice& choice, const WallCandidates (&beside)[2],
                       WallsResult* out) {
  for (int side = 0; side < 2; ++side) {
    const int other = 1 - side;
    if (choice.side[side] == nullptr || !out->side[other].fit.refused) continue;
    const WallCandidate& wall = *choice.side[side];
    POSE_WALL_NOTE(trace::subject(trace::side_subject(side)));
    const double apart = apart_from_other_side(wall, choice.side[other], out->side[other], beside[other], s);
    POSE_WALL_NOTE(
        trace::gate(POSE_WALL_TRACE_ALONE_APART, apart, WallResult::kApart_rad, apart <= WallResult::kApart_rad));
    out->side[side].reach_to_other_side(apart);
    if (choice.side[other] != nullptr) doubt_what_is_left(wall, s, &out->side[side]);
  }
}

// Two walls vouch for each other as far as they run alike. One that is too short to stand alone, beside one that runs
// otherwise, may be a boulder.
void doubt_short_ones_apart(const Settings& s, const WallChoice& choice, WallResult (*walls)[2]) {
  constexpr double kUnlike_rad = 0.14;  // 8 degrees: walls of one road rarely differ by four
  if (choice.side[0] == nullptr || choice.side[1] == nullptr) return;
  const double apart = angle_in_plan((*walls)[0].fit.plane, (*walls)[1].fit.plane);
  for (int side = 0; side < 2; ++side) {
    if (choice.side[side]->evidence.length_m >= s.wall_alone_length_min) continue;
    POSE_WALL_NOTE(trace::gate_of(trace::side_subject(side), POSE_WALL_TRACE_SHORT_APART, apart, kUnlike_rad,
                                  !(apart > kUnlike_rad)));
    if (!(apart > kUnlike_rad)) continue;
    (*walls)[side].fit.reasons |= POSE_WALL_R_WALLS_NOT_PARALLEL;
    for (double& bound : (*walls)[side].distance_bound_m) bound += kMayBeBehind_m;
  }
}

// Both sides lean the same way about the road: one out, the other in. Each wall may lean by itself, but where both do
// so by this much it is the level that is wrong: a heap's flank was taken for the floor. Returns the turn by which the
// level may be off, as a vector along the road, rad. Zero unless both are sure.
Eigen::Vector3d tilt_by_walls(const WallScene& scene, const WallCandidates (&beside)[2]) {
  constexpr double kLeansMin_rad = 0.2;          // 11.5 degrees: simulated and real walls lean by 10
  constexpr double kWallsThemselves_rad = 0.17;  // so much of it may yet be the walls' own
  constexpr double kAreaMin_m2 = 4.0;
  double lean[2] = {};
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  for (int side = 0; side < 2; ++side) {
    const WallCandidate* const best = strongest(beside[side]);
    if (best == nullptr || !(best->evidence.area_m2 >= kAreaMin_m2)) return Eigen::Vector3d::Zero();
    lean[side] = lean_of(best->plane);
    along += 0.5 * along_of(best->plane, scene.forward_level);
  }
  const bool same_way = lean[0] * lean[1] < 0.0;
  if (!same_way || !(std::fabs(lean[0]) > kLeansMin_rad && std::fabs(lean[1]) > kLeansMin_rad)) {
    return Eigen::Vector3d::Zero();
  }
  return (0.5 * std::fabs(lean[0] - lean[1]) + kWallsThemselves_rad) * along;
}

// Share of the band that lies on the chosen walls. In a cavern or a hall full of things, two flat spots may happen to
// be parallel, but they explain next to nothing of what is seen.
double explained_share(const WallScene& scene, const WallChoice& choice) {
  const auto slab = [&](const WallCandidate* wall) {
    if (wall == nullptr) return Slab::empty();
    return Slab(wall->plane, kOnWallInThresholds * scene.settings.wall_ransac_thresh);
  };
  const Slab left = slab(choice.side[0]), right = slab(choice.side[1]);
  const PointSet& band = scene.band_level;
  FourInts explained{};  // true is -1
  for_each_four_points(band, [&](std::uint32_t, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
    explained -= counts & (left.holds(x, y, z) | right.holds(x, y, z));
  });
  return band.count > 0 ? static_cast<double>(sum_of_lanes(explained)) / static_cast<double>(band.count) : 0.0;
}

}  // namespace

void WallsScratch::lay_out(Arena& arena, std::uint32_t points_max) {
  for (WallSearch& s : search) s.lay_out(arena, points_max);
  thin_level.lay_out(arena, kThinMost);
  grid.lay_out(arena);
  fit.lay_out(arena, points_max);
  sight.lay_out(arena, points_max);
  edges.lay_out(arena);
}

WallsResult find_walls(const WallScene& scene, const Plane* const last[2], Random* random, WallsScratch* scratch) {
  const Eigen::Vector3d f = scene.forward_level, l = scene.left_level;
  const SideView sides[2] = {{f, l}, {f, -l}};
  thin_out(scene, &scratch->thin_level);
  WallCandidates beside[2];
  for (int side = 0; side < 2; ++side) draw(scene, sides[side], last[side], random, &scratch->search[side]);
  exchange_directions(scratch->search);
  for (int side = 0; side < 2; ++side) weigh(scene, sides[side], &scratch->search[side], scratch, &beside[side]);
  // Before the same searches look ahead and behind.
  const std::uint32_t scored[2] = {scratch->search[0].scored(), scratch->search[1].scored()};
  WallChoice choice = choose_walls(beside[0], beside[1], scene.settings);
  refuse_where_across(scene, random, scratch, &choice);

  note_directions(scene, &scratch->sight);
  const bool explained = explained_share(scene, choice) >= kExplainedMin;
  POSE_WALL_NOTE(note_explained(explained_share(scene, choice), explained));
  WallsResult out;
  out.tilt_level_rad = tilt_by_walls(scene, beside);
  for (int side = 0; side < 2; ++side) {
    POSE_WALL_NOTE(note_side(choice, beside, side, scene.settings));
    if (choice.side[side] != nullptr) out.side[side] = measure(scene, choice, side, scratch);
    out.side[side].fit.iterations = scored[side];
    out.side[side].fit.refused = out.side[side].fit.refused || choice.refused[side];
    out.side[side].fit.reasons |= choice.reasons[side];
    if (!explained) {
      out.side[side].fit.refused = true;
      out.side[side].fit.reasons |= POSE_WALL_R_WALL_NOT_FOUND;
    }
  }
  doubt_those_alone(scene.settings, choice, beside, &out);
  doubt_short_ones_apart(scene.settings, choice, &out.side);
  return out;
}

}  // namespace pose_wall
