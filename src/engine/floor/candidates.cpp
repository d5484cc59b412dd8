// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/floor/candidates.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "base/containers/even_share.hpp"
#include "base/estimation/irls.hpp"
#include "base/estimation/mlesac.hpp"
#include "base/math/elementary.hpp"
#include "base/math/rotation.hpp"
#include "engine/gates/gate.hpp"

namespace pose_wall {
namespace {

// Twice its area; slivers give wild normals; swept: half 3 lost 2 won, twice 4 lost 3 won.
constexpr double kTriangleMin_m2 = 0.10;
// Draws for each hypothesis; caps the loop; swept: half 3 lost, twice 2 lost.
constexpr std::uint32_t kDrawsPerIteration = 8;
constexpr std::uint32_t kQuickPointsMax = 500;  // 1000 points cost 1.0 M of 92.1 M instructions more (bench/README.md)
constexpr double kGhostShare = 0.4;  // more rays through a floor make a reflection; swept: half 2 moved, twice 1 moved
// A plane scores at most twice its area. Below this score it can neither be the floor nor rival it.
double tells_nothing_m2(const Settings& s) {
  return 0.5 * limit_of<gate::FLOOR_RIVAL>(s) * limit_of<gate::FLOOR_AREA>(s);
}
// MLESAC spreads outliers over a road's height; swept: half and twice change nothing.
constexpr double kOutlierSpan_m = 4.0;

#ifdef POSE_WALL_TRACE
void note_floor_plane(const Plane& plane, pose_wall_trace_fate fate, double support,
                      const Eigen::Vector3d& sensor_base_m) {
  pose_wall_trace_candidate* const noted = trace::candidate(fate, plane);
  noted->height_m = plane.signed_distance(sensor_base_m);
  noted->tilt_rad = tilt_of_up(plane.n);
  noted->support = support;
}

// Its fate is WEAKER until more is known.
void note_refined(const IrlsResult& refined, double support, const FloorScene& scene) {
  pose_wall_trace_fate fate = POSE_WALL_TRACE_WEAKER;
  if (!may_be_floor(refined.plane, FloorLimits(scene.settings), scene.sensor_base_m)) {
    fate = POSE_WALL_TRACE_OUT_OF_RANGE;
  }
  if (!refined.solved) fate = POSE_WALL_TRACE_UNSUPPORTED;
  note_floor_plane(refined.plane, fate, support, scene.sensor_base_m);
}

// Keeps the drawn planes that explain most points but lie too high, too low or too steep: other readings of the floor.
class BestOutside {
 public:
  BestOutside(const PointSet& subset, const Settings& settings, const Eigen::Vector3d& sensor_base_m)
      : subset_(subset), settings_(settings), sensor_base_m_(sensor_base_m) {}

  void offer(const Plane& plane) {
    constexpr double kSteepest_rad = 1.05;  // 60 degrees, the most of ground_tilt_max_deg: steeper is a wall
    if (may_be_floor(plane, FloorLimits(settings_), sensor_base_m_) || tilt_of_up(plane.n) > kSteepest_rad) return;
    const bool steep = tilt_of_up(plane.n) > radians(settings_.ground_tilt_max_deg);
    Hypothesis& best = steep ? steep_ : displaced_;
    const double cost = truncated_cost(subset_, plane, settings_.ground_ransac_thresh, best.cost);
    if (cost < best.cost) best = {plane, cost};
  }

  void note() const {
    constexpr double kAnything = 0.9;  // for explain alone: a plane that explains less than a tenth is chance
    for (const Hypothesis* best : {&displaced_, &steep_}) {
      if (best->cost < kAnything) {
        note_floor_plane(best->plane, POSE_WALL_TRACE_OUT_OF_RANGE, 1.0 - best->cost, sensor_base_m_);
      }
    }
  }

 private:
  const PointSet& subset_;
  const Settings& settings_;
  const Eigen::Vector3d& sensor_base_m_;
  Hypothesis displaced_{Plane{}, 1.0}, steep_{Plane{}, 1.0};
};

#endif

// Draws one of the low points, or of all.
std::uint32_t drawn(const FloorDraw& from, bool of_low, Random* random) {
  return of_low ? from.low[random->below(from.low.size())] : random->below(from.open_base.count);
}

// Half from the low points, half from all. Otherwise a leaning machine, whose lowest points lie on one side, would see
// half of its floor.
void fill_subset(const FloorDraw& from, Random* random, PointSet* subset) {
  for (std::uint32_t k = 0; k < kSubsetPoints; ++k) {
    const std::uint32_t i = drawn(from, k % 2 == 0, random);
    subset->x[k] = from.open_base.x[i];
    subset->y[k] = from.open_base.y[i];
    subset->z[k] = from.open_base.z[i];
  }
  subset->count = kSubsetPoints;
}

// The plane through three drawn points, normal up. False for slivers.
bool draw_plane(const FloorDraw& from, bool of_low, Random* random, Plane* plane) {
  const Eigen::Vector3d a = from.open_base.at(drawn(from, of_low, random));
  const Eigen::Vector3d b = from.open_base.at(drawn(from, of_low, random));
  const Eigen::Vector3d c = from.open_base.at(drawn(from, of_low, random));
  const Eigen::Vector3d cross = (b - a).cross(c - a);
  const double area = std::sqrt(cross.squaredNorm());
  if (!(area >= kTriangleMin_m2)) return false;
  plane->n = cross.z() >= 0.0 ? Eigen::Vector3d(cross / area) : Eigen::Vector3d(cross / -area);
  plane->d = -plane->n.dot(a);
  return true;
}

// The lowest percentile by z, from a histogram of centimetres.
std::uint32_t lowest_part(const PointSet& points, double percentile, Span<std::uint32_t> out) {
  constexpr std::uint32_t kBins = 2048;  // centimetres: 20.48 m, 8 KiB on the stack
  constexpr float kFloor_m = -10.24F;    // half of the bins lie below base; the end bins take all beyond
  std::uint32_t bins[kBins + 1] = {};    // the last takes masked lanes
  const auto bins_of = [](FourFloats z) {
    const FourFloats place = (z - kFloor_m) * 100.0F;
    return cut_off(smaller_of(larger_of(place, FourFloats{}), all_four(kBins - 1.0F)));
  };
  for_each_four(points.count, [&](std::uint32_t k, FourTruths counts) {
    const FourInts bin = counts ? bins_of(load_four(&points.z[k])) : all_four_ints(kBins);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) ++bins[static_cast<std::uint32_t>(bin[lane])];
  });
  const double wanted = percentile / 100.0 * static_cast<double>(points.count);
  double below = 0.0;
  std::int32_t limit = 0;
  for (; limit < static_cast<std::int32_t>(kBins) && below < wanted; ++limit) below += static_cast<double>(bins[limit]);
  std::uint32_t count = 0;
  for_each_four(points.count, [&](std::uint32_t k, FourTruths counts) {
    counts &= bins_of(load_four(&points.z[k])) < limit;
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (counts[lane] != 0) out[count++] = k + lane;
    }
  });
  return count;
}

// Refines the short list, drops planes that became alike, and weighs each of the rest as a floor.
void weigh(const FloorScene& scene, const PointSet& within, Among among, FloorShortlist* list, FloorScratch* scratch,
           FloorCandidates* out) {
  const Settings& s = scene.settings;
  const Eigen::Vector3d& sensor = scene.sensor_base_m;
  const FloorLimits limits(s);
  const IrlsSettings quick = quick_irls(2.0 * s.ground_ransac_thresh, 0.005, s.ground_ransac_thresh, 2);
  // The low points are not needed any more. Their room now holds a part of all points, enough to refine a hypothesis.
  std::uint32_t of_part = 0;
  for_even_share(within.count, kQuickPointsMax, [&](std::uint32_t k) { scratch->low[of_part++] = k; });
  const Span<const std::uint32_t> part = scratch->low.first(of_part);
  out->count = 0;
  for (std::uint32_t k = 0; k < list->count() && !scratch->work.stops(); ++k) {
    const IrlsResult refined =
        irls_tukey(within, part, (*list)[k].plane, Eigen::Vector3d::UnitX(), quick, &scratch->points);
    scratch->work.add(steps::kFloorRefined);
    POSE_WALL_NOTE(note_refined(refined, 1.0 - (*list)[k].cost, scene));
    if (!refined.solved || !may_be_floor(refined.plane, limits, sensor)) continue;
    bool repeats = false;
    for (const FloorCandidate& c : out->all())
      repeats = repeats || (c.may_carry() && same_floor(c.plane, refined.plane));
    POSE_WALL_NOTE(if (repeats) trace::fate(refined.plane, POSE_WALL_TRACE_REPEATS));
    if (repeats) continue;
    POSE_WALL_NOTE(trace::fate(refined.plane, POSE_WALL_TRACE_UNSUPPORTED));
    scratch->work.add(within.count, steps::kPointWeighed);
    if (mlesac_score(within, refined.plane, s.ground_ransac_thresh / 2.0, kOutlierSpan_m).cost >= 0.0) continue;
    scratch->grid.mark(within, refined.plane, s.ground_ransac_thresh);
    const FloorEvidence evidence = scratch->grid.evidence(scene.axes);
    scratch->work.add(steps::kFloorWeighed);
    if (evidence.area_m2 < tells_nothing_m2(s)) continue;
    // Ground below counts as another floor does.
    const bool much_below =
        among == Among::kOpen && scratch->grid.much_lies_below(refined.plane, scene.cloud_base, s.ground_roi_radius_max,
                                                               sensor, limit_of<gate::FLOOR_RIVAL>(s));
    out->item[out->count++] = {refined.plane, evidence, false, much_below};
  }
}

bool is_below(const Plane& above, const Plane& below, const Eigen::Vector3d& sensor_base_m) {
  // Three thresholds; a nearer plane is the same floor; swept: half nothing, twice 1 moved.
  constexpr double kBelow_m = 0.1;
  return below.signed_distance(sensor_base_m) > above.signed_distance(sensor_base_m) + kBelow_m;
}

// Marks planes that are seen through the open floor of another plane above: reflections in wet ground.
void mark_ghosts(const FloorScene& scene, const PointSet& within, FloorScratch* scratch,
                 Span<FloorCandidate> candidates) {
  for (const FloorCandidate& above : candidates) {
    if (above.much_below || above.evidence.area_m2 < limit_of<gate::FLOOR_AREA>(scene.settings)) continue;
    bool marked = false;
    for (FloorCandidate& below : candidates) {
      if (below.much_below || !is_below(above.plane, below.plane, scene.sensor_base_m)) continue;
      if (scratch->work.stops()) return;
      scratch->work.add(within.count, steps::kPointCompared);
      if (!marked) scratch->grid.mark(within, above.plane, scene.settings.ground_ransac_thresh);
      marked = true;
      below.ghost = below.ghost || is_reflection(scene, within, above.plane, below.plane, scratch->grid);
    }
  }
}

}  // namespace

FloorLimits::FloorLimits(const Settings& settings)
    : up_min(cosine(limit_of<gate::FLOOR_TILT>(settings))),
      height_min_m(limit_of<gate::FLOOR_HEIGHT_MIN>(settings)),
      height_max_m(limit_of<gate::FLOOR_HEIGHT_MAX>(settings)) {}

bool may_be_floor(const Plane& plane, const FloorLimits& limits, const Eigen::Vector3d& sensor_base_m) {
  const double height_m = plane.signed_distance(sensor_base_m);
  return plane.n.z() >= limits.up_min && height_m >= limits.height_min_m && height_m <= limits.height_max_m;
}

bool same_floor(const Plane& a, const Plane& b) {
  // Planes are compared under the machine and so far around it; swept: half 1 lost 1 won, twice 16 lost 3 won.
  constexpr double kReach_m = 2.0;
  // Below three thresholds (9 cm); nearer planes are one; swept: half 18 lost 4 won, twice 2 lost 1 won.
  constexpr double kApart_m = 0.08;
  const double places[][2] = {{0.0, 0.0}, {kReach_m, 0.0}, {-kReach_m, 0.0}, {0.0, kReach_m}, {0.0, -kReach_m}};
  for (const auto& p : places) {
    const double za = -(a.n.x() * p[0] + a.n.y() * p[1] + a.d) / a.n.z();
    const double zb = -(b.n.x() * p[0] + b.n.y() * p[1] + b.d) / b.n.z();
    if (!(std::fabs(za - zb) <= kApart_m)) return false;
  }
  return true;
}

std::uint32_t FloorCandidates::plausible() const {
  std::uint32_t plausible = 0;
  for (const FloorCandidate& c : all()) plausible += c.may_carry() ? 1U : 0U;
  return plausible;
}

const FloorCandidate* FloorCandidates::best() const {
  const FloorCandidate* best = nullptr;
  for (const FloorCandidate& c : all()) {
    if (!c.may_carry()) continue;
    if (best == nullptr || c.evidence.score_m2 > best->evidence.score_m2) best = &c;
  }
  return best;
}

bool is_reflection(const FloorScene& scene, const PointSet& open_base, const Plane& above, const Plane& below,
                   const FloorGrid& grid) {
  return is_below(above, below, scene.sensor_base_m) &&
         share_seen_through(grid, above, below, open_base, scene.sensor_base_m, scene.settings.ground_ransac_thresh) >
             kGhostShare;
}

std::uint32_t search_floor(const FloorScene& scene, const FloorDraw& from, Random* random, PointSet* subset,
                           FloorShortlist* list) {
  const Settings& settings = scene.settings;
  list->clear();
  if (from.low.size() < 3) return 0;
  fill_subset(from, random, subset);
  const double thresh_m = settings.ground_ransac_thresh;
  const FloorLimits limits(settings);
  std::uint32_t scored = 0;
  const auto score = [&](const Plane& plane) {
    list->offer({plane, truncated_cost(*subset, plane, thresh_m, list->too_much())}, same_floor);
    ++scored;
  };
  if (scene.last_floor != nullptr) score(*scene.last_floor);
  const std::uint32_t draws = settings.ground_iterations * kDrawsPerIteration;
  POSE_WALL_NOTE(BestOutside outside(*subset, settings, scene.sensor_base_m));
  for (std::uint32_t draw = 0; draw < draws && scored < settings.ground_iterations; ++draw) {
    Plane plane;
    // Every other draw takes all points: where reflections lie lowest, the low points hold no floor.
    if (!draw_plane(from, draw % 2 == 0, random, &plane)) continue;
    POSE_WALL_NOTE(outside.offer(plane));
    if (may_be_floor(plane, limits, scene.sensor_base_m)) score(plane);
  }
  POSE_WALL_NOTE(outside.note());
  return scored;
}

std::uint32_t find_candidates(const FloorScene& scene, const PointSet& within_base, Among among, Random* random,
                              FloorScratch* scratch, FloorCandidates* out) {
  const std::uint32_t low = lowest_part(within_base, scene.settings.ground_z_percentile, scratch->low);
  FloorShortlist list;
  const std::uint32_t scored =
      search_floor(scene, {within_base, scratch->low.first(low)}, random, &scratch->subset, &list);
  scratch->work.add(scored, steps::kFloorDrawn);
  weigh(scene, within_base, among, &list, scratch, out);
  mark_ghosts(scene, within_base, scratch, Span<FloorCandidate>(out->item, out->count));
  return scored;
}

}  // namespace pose_wall
