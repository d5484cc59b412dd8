// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/propose/candidates.hpp"

#include <cmath>

#include "base/containers/even_share.hpp"
#include "base/estimation/irls.hpp"
#include "base/estimation/mlesac.hpp"
#include "base/estimation/near_plane.hpp"
#include "base/math/elementary.hpp"
#include "engine/gates/gate.hpp"

namespace pose_wall {
namespace {

// 5 cm of rock over a metre turn a draw by 3 degrees; swept: half 1 won, twice 187 moved.
constexpr double kBaselineMin_m = 1.0;
// Twice the floor's, since fewer draws pass; swept: half 2 moved, twice 2 moved.
constexpr std::uint32_t kDrawsPerIteration = 16;
constexpr std::uint32_t kPointsMin = 30;  // fewer points of the band draw no wall; swept: half nothing, twice 1 moved
// Beyond yaw_max_deg, since refinement moves them; swept: half 7 moved, twice 10 moved.
constexpr double kDrawSlack_deg = 5.0;

// Of the band, to score hypotheses; half of a fit's; swept: half 2 lost 1 won, twice 2 lost 3 won.
constexpr std::uint32_t kThinMost = 4096;
constexpr double kWideInThresholds = 5.0;  // wide enough to find the lean of a wall that a vertical hypothesis cuts
// The lean is known; as near as points of a wall; swept: half 8 lost, twice 1 won.
constexpr double kNarrowInThresholds = 3.0;
// Refine a hypothesis to within the threshold; swept: half 3 lost 1 won 1 beyond, twice 1 lost 1 won.
constexpr int kQuickRounds = 3;
constexpr std::uint32_t kQuickPointsMax = 500;  // 800 at first; 250 missed rivals that cast doubt (bench/README.md)

#ifdef POSE_WALL_TRACE
std::uint32_t subject_of(const WallScene& scene, const SideView& view) {
  const double left = view.side_level.dot(scene.left_level), ahead = view.side_level.dot(scene.forward_level);
  if (left * left > 0.5) return left > 0.0 ? POSE_WALL_TRACE_LEFT : POSE_WALL_TRACE_RIGHT;
  return ahead > 0.0 ? POSE_WALL_TRACE_AHEAD : POSE_WALL_TRACE_BEHIND;
}

// Noted before refinement. A plane without support stays UNSUPPORTED.
void note_drawn_wall(const Plane& plane) {
  trace::candidate(POSE_WALL_TRACE_UNSUPPORTED, plane);
}

// The last noted plane, refined, with its fate if it ends here.
void note_refined_wall(const Plane& plane, pose_wall_trace_fate fate) {
  trace::refined(fate, plane);
}

void note_weighed_wall(const WallCandidate& c) {
  pose_wall_trace_candidate* const noted = trace::noted(c.plane);
  if (noted == nullptr) return;
  noted->fate = c.failed != 0 ? POSE_WALL_TRACE_GATES_FAILED : POSE_WALL_TRACE_WEAKER;
  noted->reasons = c.failed;
  noted->tilt_rad = lean_of(c.plane);
  noted->score_m2 = c.evidence.score_m2;
  noted->area_m2 = c.evidence.area_m2;
  noted->length_m = c.evidence.length_m;
  noted->seen_through = c.evidence.seen_through;
  noted->inliers = c.evidence.inliers;
}
#endif

bool holds_one_like(const WallCandidates& list, const SameWall& same, const Plane& plane) {
  bool holds = false;
  for (std::uint32_t i = 0; i < list.count; ++i) holds = holds || same(list.item[i].plane, plane);
  POSE_WALL_NOTE(if (holds) trace::fate(plane, POSE_WALL_TRACE_REPEATS));
  return holds;
}

Span<std::uint32_t> points_near(const BoundedPoints& points, const Plane& plane, double gate_m,
                                Span<std::uint32_t> out) {
  std::uint32_t count = 0;
  for_each_in(points, Slab(plane, gate_m), [&](std::uint32_t i, float) { out[count++] = i; });
  return out.first(count);
}

}  // namespace

bool SameWall::operator()(const Plane& a, const Plane& b) const {
  // Compared beside the machine and so far along the road; swept: half 3 lost, twice 1 won.
  constexpr double kReach_m = 3.0;
  const double across_a = a.n.dot(view.side_level), across_b = b.n.dot(view.side_level);
  if (!(std::fabs(across_a) > 1e-3 && std::fabs(across_b) > 1e-3)) return false;
  for (const double s : {-kReach_m, 0.0, kReach_m}) {
    const Eigen::Vector3d p = s * view.along_level;
    const double lateral_a = -a.signed_distance(p) / across_a, lateral_b = -b.signed_distance(p) / across_b;
    if (!(std::fabs(lateral_a - lateral_b) <= apart_m)) return false;
  }
  return true;
}

WallLimits::WallLimits(double angle_max_rad, double lean_max_rad)
    : cos_angle_max(cosine(angle_max_rad)), cos_lean_max(cosine(lean_max_rad)) {}

bool may_be_wall(const Plane& plane, const SideView& view, const WallLimits& limits) {
  const double horizontal = std::sqrt(plane.n.x() * plane.n.x() + plane.n.y() * plane.n.y());
  if (!(horizontal >= limits.cos_lean_max)) return false;
  // The normal points to the machine: against the side, and the origin lies on its positive side.
  const double against_side = -plane.n.dot(view.side_level) / horizontal;
  return plane.d > 0.0 && against_side >= limits.cos_angle_max;
}

void WallSearch::lay_out(Arena& arena, std::uint32_t points_max) {
  side_ = arena.take<std::uint32_t>(points_max);
  subset_.lay_out(arena, kSubsetPoints);
}

void WallSearch::begin(const PointSet& band_level, const SideView& view, const Settings& settings, Random* random) {
  band_ = &band_level;
  settings_ = &settings;
  random_ = random;
  view_ = view;
  scored_ = 0;
  list_.clear();
  count_ = 0;
  const auto side_x = static_cast<float>(view.side_level.x()), side_y = static_cast<float>(view.side_level.y());
  for_each_four_points(band_level, [&](std::uint32_t i, FourFloats x, FourFloats y, FourFloats, FourTruths counts) {
    const FourTruths here = counts & (side_x * x + side_y * y > FourFloats{});
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (here[lane] != 0) side_[count_++] = i + lane;
    }
  });
  subset_.count = count_ < kPointsMin ? 0 : kSubsetPoints;
  for (std::uint32_t k = 0; k < subset_.count; ++k) {
    const std::uint32_t i = side_[random->below(count_)];
    subset_.x[k] = band_level.x[i];
    subset_.y[k] = band_level.y[i];
    subset_.z[k] = band_level.z[i];
  }
}

void WallSearch::offer(const Plane& plane) {
  if (subset_.count == 0) return;
  list_.offer({plane, truncated_cost(subset_, plane, settings_->wall_ransac_thresh, list_.too_much())},
              SameWall{view_});
  ++scored_;
}

bool WallSearch::draw_plane(const WallLimits& limits, Plane* plane) {
  const Eigen::Vector3d a = band_->at(side_[random_->below(count_)]);
  const Eigen::Vector3d b = band_->at(side_[random_->below(count_)]);
  const Eigen::Vector3d along(b.x() - a.x(), b.y() - a.y(), 0.0);
  const double baseline = std::sqrt(along.squaredNorm());
  if (!(baseline >= kBaselineMin_m)) return false;
  plane->n = Eigen::Vector3d(along.y() / baseline, -along.x() / baseline, 0.0);
  plane->d = -plane->n.dot(a);
  if (plane->d < 0.0) *plane = plane->flipped();
  return may_be_wall(*plane, view_, limits);
}

void WallSearch::draw() {
  if (subset_.count == 0) return;
  const WallLimits limits(radians(settings_->yaw_max_deg + kDrawSlack_deg), radians(settings_->wall_lean_max_deg));
  const std::uint32_t draws = settings_->wall_iterations * kDrawsPerIteration;
  for (std::uint32_t draw = 0; draw < draws && scored_ < settings_->wall_iterations; ++draw) {
    Plane plane;
    if (draw_plane(limits, &plane)) offer(plane);
  }
}

void WallSearch::offer_offsets(const Eigen::Vector3d& normal_level) {
  constexpr std::uint32_t kBins = 640;  // 32 m, as far as the wall's grid
  constexpr double kBin_m = 0.05;       // the inlier threshold's default
  // The wall, a plane before it, one behind it, one more; swept: half and twice change nothing.
  constexpr int kPeaks = 4;
  constexpr std::uint32_t kApart = 3;  // bins between peaks: 15 cm, as SameWall::kApart_m
  const double flat = std::sqrt(normal_level.x() * normal_level.x() + normal_level.y() * normal_level.y());
  if (!(flat > 0.5)) return;
  Plane plane;
  plane.n = Eigen::Vector3d(normal_level.x() / flat, normal_level.y() / flat, 0.0);
  if (plane.n.dot(view_.side_level) > 0.0) plane.n = -plane.n;
  std::uint32_t bins[kBins] = {};
  for (std::uint32_t k = 0; k < count_; ++k) {
    const double distance = -plane.n.dot(band_->at(side_[k]));
    if (distance >= 0.0 && distance < kBins * kBin_m) ++bins[static_cast<std::uint32_t>(distance / kBin_m)];
  }
  for (int peak = 0; peak < kPeaks; ++peak) {
    std::uint32_t best = 0;
    for (std::uint32_t b = 1; b < kBins; ++b) {
      if (bins[b] > bins[best]) best = b;
    }
    if (bins[best] == 0) return;
    plane.d = (static_cast<double>(best) + 0.5) * kBin_m;
    offer(plane);
    const std::uint32_t from = best > kApart ? best - kApart : 0;
    for (std::uint32_t b = from; b <= best + kApart && b < kBins; ++b) bins[b] = 0;
  }
}

void ProposeScratch::lay_out(Arena& arena, std::uint32_t points_max) {
  for (WallSearch& s : search) s.lay_out(arena, points_max);
  thin_level.lay_out(arena, kThinMost);
}

void thin_out(const WallScene& scene, ProposeScratch* scratch) {
  BoundedPoints* const thin = &scratch->thin_level;
  scratch->work->add(scene.band_level.count, steps::kPointParted);
  const PointSet& band = scene.band_level;
  thin->count = 0;
  for (const bool left : {true, false}) {
    for_even_share(band.count, kThinMost, [&](std::uint32_t i) {
      const Eigen::Vector3d p = band.at(i);
      if ((scene.left_level.dot(p) > 0.0) == left) thin->set(thin->count++, p, band.weight[i]);
    });
  }
  thin->bound();
}

std::uint32_t failed_gates(const Plane& plane, const WallEvidence& evidence, const Settings& s) {
  Verdict verdict;
  demand<gate::WALL_INLIERS>(&verdict, evidence.inliers, s);
  demand<gate::WALL_LENGTH>(&verdict, evidence.length_m, s);
  demand<gate::WALL_SOLID>(&verdict, evidence.seen_through, s);
  demand<gate::WALL_LEAN>(&verdict, std::fabs(lean_of(plane)), s);
  return verdict.reasons;
}

bool refine_hypothesis(const BoundedPoints& band_level, double thresh_m, const Eigen::Vector3d& along_level,
                       RefineWidth width, Span<std::uint32_t> near, TangentPoints* points, Plane* plane) {
  const IrlsSettings quick = quick_irls(kNarrowInThresholds * thresh_m, kFitScaleMin_m, thresh_m, kQuickRounds);
  const double gate_m = (width == RefineWidth::kWide ? kWideInThresholds : kNarrowInThresholds) * thresh_m;
  const Span<std::uint32_t> part = thinned(points_near(band_level, *plane, gate_m, near), kQuickPointsMax);
  const IrlsResult refined = irls_tukey(band_level, part, *plane, along_level, quick, points);
  if (refined.solved) *plane = refined.plane;
  return refined.solved;
}

namespace {

const WallCandidate* same_of(const WallCandidates* weighed, const Plane& plane) {
  for (std::uint32_t k = 0; weighed != nullptr && k < weighed->count; ++k) {
    const WallCandidate& c = weighed->item[k];
    if (c.plane.n == plane.n && c.plane.d == plane.d) return &c;
  }
  return nullptr;
}

WallCandidate weighed_anew(const WallScene& scene, const Plane& plane, const Eigen::Vector3d& along_level,
                           ProposeScratch* scratch) {
  mark_wall(scene, plane, along_level, MarkWidth::kThreshold, scratch->grid);
  const WallEvidence evidence = scratch->grid->evidence();
  scratch->work->add(steps::kWallWeighed);
  scratch->work->add(scene.band_level.count, steps::kPointMarked);
  return {plane, along_level, evidence, failed_gates(plane, evidence, scene.settings)};
}

}  // namespace

void weigh_walls(const WallScene& scene, const SideView& view, WallSearch* search, ProposeScratch* scratch,
                 WallCandidates* out, const WallCandidates* weighed) {
  const SameWall same{view}, surely_same{view, 0.5 * SameWall::kApart_m};
  const WallLimits limits(radians(scene.settings.yaw_max_deg + kRefineSlack_deg), 0.5 * kPi);
  const auto refine = [&](RefineWidth width, Plane* plane) {
    const double thresh_m = scene.settings.wall_ransac_thresh;
    scratch->work->add(steps::kWallRefined);
    const bool holds = refine_hypothesis(scratch->thin_level, thresh_m, view.along_level, width, scratch->near,
                                         scratch->points, plane);
    POSE_WALL_NOTE(if (holds) note_refined_wall(
        *plane, width == RefineWidth::kWide ? POSE_WALL_TRACE_UNSUPPORTED : POSE_WALL_TRACE_OUT_OF_RANGE));
    return holds;
  };
  POSE_WALL_NOTE(const trace::About about(subject_of(scene, view)));
  POSE_WALL_NOTE(const trace::Silence until_chosen);
  out->count = 0;
  scratch->work->add(scene.band_level.count, steps::kPointSided);
  scratch->work->add(search->scored(), steps::kWallDrawn);
  for (std::uint32_t k = 0; k < search->list().count() && !scratch->work->stops(); ++k) {
    Plane plane = search->list()[k].plane;
    POSE_WALL_NOTE(note_drawn_wall(plane));
    if (!refine(RefineWidth::kWide, &plane)) continue;
    // Refined further, a plane this near to a listed one would come still nearer.
    if (holds_one_like(*out, surely_same, plane)) continue;
    if (!refine(RefineWidth::kNarrow, &plane)) continue;
    if (!may_be_wall(plane, view, limits) || holds_one_like(*out, same, plane)) continue;
    const WallCandidate* const known = same_of(weighed, plane);
    out->item[out->count++] =
        known != nullptr ? *known : weighed_anew(scene, plane, along_of(plane, view.along_level), scratch);
    POSE_WALL_NOTE(note_weighed_wall(out->item[out->count - 1]));
  }
}

void draw_walls(const WallScene& scene, const SideView& view, const Plane* last, Random* random, WallSearch* search) {
  search->begin(scene.band_level, view, scene.settings, random);
  if (last != nullptr) search->offer(*last);
  search->draw();
}

void exchange_directions(WallSearch (&search)[2]) {
  for (int side = 0; side < 2; ++side) {
    WallShortlist& other = search[1 - side].list();
    if (other.count() > 0) search[side].offer_offsets(other[0].plane.n);
  }
}

void propose_walls(const WallScene& scene, const SideView (&views)[2], const Plane* const last[2], Random* random,
                   ProposeScratch* scratch, WallCandidates (*out)[2]) {
  for (int side = 0; side < 2; ++side) draw_walls(scene, views[side], last[side], random, &scratch->search[side]);
  exchange_directions(scratch->search);
  for (int side = 0; side < 2; ++side) weigh_walls(scene, views[side], &scratch->search[side], scratch, &(*out)[side]);
}

}  // namespace pose_wall
