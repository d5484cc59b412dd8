// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/region/region_plane.hpp"

#include <Eigen/LU>
#include <cmath>

#include "base/estimation/protection.hpp"
#include "base/math/elementary.hpp"
#include "base/math/finite.hpp"

namespace pose_wall {
namespace {

// Of the definition: the width c, and the factor on r² before the plane, where things stand.
constexpr double kWidth_m = 0.15, kBefore = 4.0;
// From all of the region least squares at first, then ever narrower (graduated non-convexity: Blake and Zisserman
// 1987): from 2 m, beyond any opening's influence on a road of 5 m, by the root of two a round.
constexpr double kWidest_m = 2.0, kNarrower = 0.7071;
constexpr int kRounds = 24;              // 8 of them narrow; the definition goes on until it settles
constexpr double kSettled = 1e-5;        // metres and slopes: far below what a level tells
constexpr double kSingular = 1e-6;       // of the product of the diagonal: cells in a line
constexpr std::uint32_t kCellsMin = 24;  // 1.5 m²: fewer show no waves
constexpr double kReach = 4.0;           // widths from the plane: points further off weigh a seventeenth at most
// A cell with less weight shows something else than the surface, and tells nothing of its waves.
constexpr double kShown = 0.2;
// Other readings of the cells (README). Of the mean loss of a cell: what a tenth of them at the formula's width adds.
constexpr double kLossApart = 0.1;
// Half a cell at an end of the region. With a tenth, 16 more of 4,270 values of a real gallery were valid, and three
// more beyond their levels (2026-11-28).
constexpr double kLean = 0.25;
constexpr double kEdge = 0.6;  // of the way from the middle: the last row
// The plane of cells errs by this share of their spread, and by a millimetre, on the offset and per half metre: fully
// seen walls of a real gallery were 5 to 15 mm off, where the waves alone told 1 to 4 (trial, 2026-11).
constexpr double kModelShare = 0.04, kModel_m = 0.001, kModelPerMetre = 0.5;

double weight_of(double t) {
  return 1.0 / (1.0 + t * t * (t < 0.0 ? kBefore : 1.0));
}

FourFloats weights_of(FourFloats t) {
  const FourFloats square = t * t;
  return 1.0F / (1.0F + (t < FourFloats{} ? square * static_cast<float>(kBefore) : square));
}

Eigen::Vector3d row_of(const RegionCell& c) {
  return {1.0, c.u, c.v};
}

// How far one of its layers lies behind the plane, in widths; by default that which most points lie in.
double off(float layer_m, const RegionCell& c, const Eigen::Vector3d& plane) {
  return (layer_m - plane.dot(row_of(c))) / kWidth_m;
}

double off(const RegionCell& c, const Eigen::Vector3d& plane) {
  return off(c.h, c, plane);
}

bool is_singular(const Eigen::Matrix3d& A) {
  return !(A.determinant() > kSingular * A(0, 0) * A(1, 1) * A(2, 2));
}

// The parts that the formula starts from: all of the region, its halves, and both of its ends.
constexpr int kAll = 0, kEnds = 5;
constexpr double kEndsFrom = 0.5;  // half of the way from the middle

// The direction in which a half lies; none of the others.
Eigen::Vector2d towards(int part) {
  const Eigen::Vector2d of[] = {{0.0, 0.0}, {1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}, {0.0, 0.0}};
  return of[part];
}

// 1 for cells in the part, 0 for others.
FourFloats share_in(int part, FourFloats from_middle_u, FourFloats from_middle_v) {
  const Eigen::Vector2f side = towards(part).cast<float>();
  const FourFloats along = side[0] * from_middle_u + side[1] * from_middle_v, none{}, one = all_four(1.0F);
  const FourTruths at_ends = magnitude_of(from_middle_u) > all_four(static_cast<float>(kEndsFrom));
  return (part == kEnds ? at_ends : along >= none) ? one : none;
}

}  // namespace

double RegionPlane::sigma_of_seen(const Eigen::Vector3d& of) const {
  const double model_m = kModelShare * rough_m + kModel_m;
  const double per_m = kModelPerMetre * model_m;
  return std::sqrt(model_m * model_m * of[0] * of[0] + per_m * per_m * (of[1] * of[1] + of[2] * of[2]));
}

double RegionPlane::sigma(const Eigen::Vector3d& of) const {
  const double of_seen = sigma_of_seen(of);
  return std::sqrt(of.dot(covariance_ * of) + of_seen * of_seen);
}

ProtectionParts RegionPlane::bound(const Eigen::Vector3d& of, const Settings& s) const {
  ProtectionParts out;
  out[POSE_WALL_PART_RANGE_BIAS] = s.range_bias_max * std::fabs(of.dot(bias_response_));
  out[POSE_WALL_PART_BEND] = (missing_of_bend_.transpose() * of).cwiseProduct(bend_per_m_).norm();
  const double not_seen = protection_factor(s.protection_sigmas, dof) * (sigma(of) - sigma_of_seen(of));
  double most = 0.0;
  for (std::uint32_t k = 0; k < count_; ++k) {
    const double apart = std::fabs(of.dot(readings_[k].apart));
    most = larger(most, readings_[k].within_random ? apart - not_seen : apart);
  }
  out[POSE_WALL_PART_RIVAL] = most;
  return out;
}

void RegionPlane::take(const UnevenFit& fit) {
  at = fit.correction;
  covariance_ = fit.covariance;
  bias_response_ = fit.bias_response;
  dof = fit.dof;
}

// The first reading is that of the seen cells alone.
RegionPlane RegionPlane::on_endless(const UnevenFit& fit, const Eigen::Array<bool, 2, 1>& goes_on) const {
  RegionPlane out = *this;
  out.readings_[0].apart += at - fit.correction;
  out.take(fit);
  out.bend_per_m_ = goes_on.select(0.0, bend_per_m_);
  for (Reading& reading : out.readings_) reading.within_random |= reading.of_edge && goes_on[1];
  return out;
}

Plane RegionPlane::plane_in(const Region& region) const {
  const double length = std::sqrt(1.0 + at[1] * at[1] + at[2] * at[2]);
  Plane plane;
  plane.n = (at[1] * region.u + at[2] * region.v - region.h) / length;
  plane.d = at[0] / length;
  return plane;
}

UnevenFit over_region(const Region& region, const Plane& plane, const TangentFrame& frame, const UnevenFit& errors) {
  const double per_h = 1.0 / plane.n.dot(region.h);  // where the plane rises by a metre, h changes by so much
  UnevenFit out = errors;
  out.correction = -per_h * Eigen::Vector3d(plane.d, plane.n.dot(region.u), plane.n.dot(region.v));
  Eigen::Matrix3d to = Eigen::Matrix3d::Zero();
  to(0, 0) = 1.0;
  for (int k = 1; k < 3; ++k) {
    const Eigen::Vector3d& axis = k == 1 ? frame.u : frame.v;
    const Eigen::Vector3d over(-axis.dot(frame.origin), axis.dot(region.u), axis.dot(region.v));
    to.col(k) = over + axis.dot(region.h) * out.correction;
  }
  to *= per_h;
  out.covariance = to * errors.covariance * to.transpose();
  out.bias_response = to * errors.bias_response;
  return out;
}

void RegionFit::lay_out(Arena& arena) {
  cells_.lay_out(arena);
  for (Span<float>* row : {&shown_.u, &shown_.v, &shown_.h, &shown_.from_middle_u, &shown_.from_middle_v}) {
    *row = arena.take<float>(RegionCells::kMost);
  }
  patches_ = arena.take<SurfacePatch>(RegionCells::kMost);
  responses_ = arena.take<Eigen::Vector3d>(RegionCells::kMost);
}

std::uint32_t RegionFit::count_seen(RegionPlane* out) const {
  std::uint32_t seen[2] = {}, all[2] = {};
  for (const RegionCell& c : cells_.all()) {
    if (!c.inside) continue;
    const int end = cells_.from_middle(c)[0] > 0.0 ? 1 : 0;
    ++all[end];
    seen[end] += c.is_surface() ? 1U : 0U;
  }
  const double shares[2] = {static_cast<double>(seen[0]) / all[0], static_cast<double>(seen[1]) / all[1]};
  out->seen_at_ends = shares[0] < shares[1] ? shares[0] : shares[1];
  return seen[0] + seen[1];
}

// What the cells show of the settled plane.
void RegionFit::describe(const Eigen::Vector3d& plane, RegionPlane* out) const {
  double squares = 0.0, sum = 0.0, first_m = 0.0, last_m = 0.0;
  for (const RegionCell& c : cells_.all()) {
    if (!c.is_surface() || !c.inside) continue;
    const double t = off(c, plane), weight = weight_of(t);
    if (std::fabs(t) < 1.0) {
      first_m = out->area_m2 > 0.0 ? -larger(-first_m, -c.u) : c.u;
      last_m = out->area_m2 > 0.0 ? larger(last_m, c.u) : c.u;
      out->area_m2 += cells_.cell_area_m2();
    }
    sum += weight;
    squares += weight * t * t;
  }
  out->length_m = last_m - first_m + RegionCells::kCell_m;
  out->rough_m = kWidth_m * std::sqrt(squares / sum);
}

// The cells of the region that show it, by the layer that most points lie in or the first one.
void RegionFit::list_shown(float RegionCell::*layer_m) {
  shown_.count = 0;
  for (const RegionCell& c : cells_.all()) {
    if (!c.is_surface() || !c.inside) continue;
    const Eigen::Vector2d at = cells_.from_middle(c);
    const std::uint32_t k = shown_.count++;
    shown_.u[k] = static_cast<float>(c.u);
    shown_.v[k] = static_cast<float>(c.v);
    shown_.h[k] = c.*layer_m;
    shown_.from_middle_u[k] = static_cast<float>(at[0]);
    shown_.from_middle_v[k] = static_cast<float>(at[1]);
  }
  for (std::uint32_t k = shown_.count; k % kFour != 0; ++k) shown_.u[k] = shown_.v[k] = shown_.h[k] = 0.0F;
}

// From a plane near the cells, so that floats hold what is left. weight_of(t, from the middle along u, along v): of
// four cells that lie t metres behind that plane; 0 leaves one out.
template <typename WeightOf>
bool RegionFit::least_squares(const WeightOf& weight_of, Eigen::Vector3d* plane) const {
  const Eigen::Vector3f p = plane->cast<float>();
  FourFloats sums[9] = {};  // of 1, u, uu, v, uv, vv, r, ur, vr
  for (std::uint32_t k = 0; k < shown_.count; k += kFour) {
    const FourFloats u = load_four(&shown_.u[k]), v = load_four(&shown_.v[k]), none{};
    const FourFloats r = load_four(&shown_.h[k]) - p[0] - p[1] * u - p[2] * v;
    const FourFloats of_each = weight_of(r, load_four(&shown_.from_middle_u[k]), load_four(&shown_.from_middle_v[k]));
    const FourFloats w = first_of_four(shown_.count - k) ? of_each : none, wu = w * u, wv = w * v;
    const FourFloats of[] = {w, wu, wu * u, wv, wu * v, wv * v, w * r, wu * r, wv * r};
    for (int i = 0; i < 9; ++i) sums[i] += of[i];
  }
  double sum[9];
  for (int i = 0; i < 9; ++i) sum[i] = sum_of_lanes(sums[i]);
  Eigen::Matrix3d A;
  A << sum[0], sum[1], sum[3], sum[1], sum[2], sum[4], sum[3], sum[4], sum[5];
  if (is_singular(A)) return false;
  *plane += A.inverse() * Eigen::Vector3d(sum[6], sum[7], sum[8]);
  return true;
}

bool RegionFit::settle(const Manner& manner, Eigen::Vector3d* plane) const {
  const Eigen::Vector2f lean = manner.lean.cast<float>(), edge = manner.edge.cast<float>();
  const auto before_m = static_cast<float>(-manner.before_m), at_edge = static_cast<float>(kEdge);
  double c_m = manner.c_m;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::Vector3d before = *plane;
    const auto per_c = static_cast<float>(1.0 / c_m);
    const auto weight = [&](FourFloats r, FourFloats from_middle_u, FourFloats from_middle_v) {
      const FourFloats leaning = 1.0F + lean[0] * from_middle_u + lean[1] * from_middle_v, none{};
      const FourFloats beyond = edge[0] * from_middle_u + edge[1] * from_middle_v;
      const FourTruths counts = (r >= all_four(before_m)) & (beyond <= all_four(at_edge));
      return counts ? leaning * weights_of(r * per_c) : none;
    };
    if (!least_squares(weight, plane)) return false;
    if (c_m == kWidth_m && (*plane - before).cwiseAbs().maxCoeff() < kSettled) break;
    c_m = larger(c_m * kNarrower, kWidth_m);
  }
  return true;
}

// loss(t): what a cell adds that lies so far behind the plane. The mean over the cells.
template <typename LossOf>
double RegionFit::mean_over_cells(const Eigen::Vector3d& plane, const LossOf& loss) const {
  double sum = 0.0, count = 0.0;
  for (const RegionCell& c : cells_.all()) {
    if (!c.is_surface() || !c.inside) continue;
    sum += loss(off(c, plane));
    count += 1.0;
  }
  return sum / count;
}

// The formula's.
double RegionFit::loss_of(const Eigen::Vector3d& plane) const {
  return mean_over_cells(plane, [](double t) { return -natural_log(weight_of(t)); });
}

// What lies a width before the plane and nearer is a thing, however near.
double RegionFit::loss_without_things(const Eigen::Vector3d& plane) const {
  return mean_over_cells(plane, [](double t) { return -natural_log(weight_of(larger(t, -1.0))); });
}

// The surface may lie near more than one plane. Returns the best one's number, -1 without any.
int RegionFit::settle_all(Settled (*settled)[kStarts]) const {
  int best = -1;
  for (int k = 0; k < kStarts; ++k) {
    Settled& of = (*settled)[k];
    const double c_m = k == kAll ? kWidest_m : kWidth_m;
    of.solved = least_squares([k](FourFloats, FourFloats u, FourFloats v) { return share_in(k, u, v); }, &of.start);
    of.plane = of.start;
    of.solved = of.solved && settle({c_m}, &of.plane);
    if (!of.solved) continue;
    of.loss = loss_of(of.plane);
    if (best < 0 || of.loss < (*settled)[best].loss) best = k;
  }
  return best;
}

// Of the nearest cell that is seen. What stands beside a road runs along it.
double RegionFit::weight_near(const RegionCell& place) const {
  constexpr double kAlong = 0.5;  // with 1, walls at the edge of the lane made two floors of three doubtful
  double nearest_m2 = 1e9, weight = 0.0;
  for (const RegionCell& c : cells_.all()) {
    if (!c.seen) continue;
    const double du = kAlong * (c.u - place.u), dv = c.v - place.v, m2 = du * du + dv * dv;
    if (!(m2 < nearest_m2)) continue;
    nearest_m2 = m2;
    weight = c.weight;
  }
  return weight;
}

// Lists the cells that show the surface, then those of the region that are not seen: a thing may stand before them.
RegionFit::Taken RegionFit::take_cells(Span<const PatchSums> sums, const Eigen::Vector3d& settled, double noise2,
                                       RegionPlane* out) {
  const Span<RegionCell> cells = cells_.all();
  Taken taken;
  const auto take = [&](const SurfacePatch& patch, const RegionCell& cell) {
    patches_[taken.all] = patch;
    responses_[taken.all++] = (cell.inside ? cell.weight : 0.0) * Eigen::Vector3d(1.0, patch.u, patch.v);
  };
  for (std::uint32_t k = 0; k < cells.size(); ++k) {
    RegionCell& cell = cells[k];
    if (!cell.is_surface()) continue;
    cell.weight = weight_of(off(cell, settled));
    if (cell.inside) taken.A += cell.weight * row_of(cell) * row_of(cell).transpose();
    const PatchSums& c = sums[k];
    if (cell.inside) {
      out->points += c.w();
      // Noise that is as wide as the formula shows in the points, not in their mean.
      out->near += c.has_weight() ? -larger(-cell.weight, -c.w() / c.count) : cell.weight;
    }
    if (!(cell.weight > kShown) || !c.has_weight() || c.count < 2) continue;
    const double points_of = static_cast<double>(c.count);
    const double own = (kPatchPriorPoints * noise2 + c.scatter_or_none()) / (kPatchPriorPoints - 1.0 + points_of);
    take({c.wu() / c.w(), c.wv() / c.w(), c.wr() / c.w(), c.share(),
          larger(own, kPatchNoiseMin_m * kPatchNoiseMin_m) / points_of},
         cell);
  }
  taken.seen = taken.all;
  double cells_inside = 0.0;
  for (RegionCell& cell : cells) {
    if (!cell.inside) continue;
    if (!cell.seen) {
      cell.weight = weight_near(cell);
      taken.A += cell.weight * row_of(cell) * row_of(cell).transpose();
      take({cell.u, cell.v, 0.0, 0.0, 0.0}, cell);
      out->near += cell.weight;
    }
    cells_inside += 1.0;
  }
  out->near /= cells_inside;
  return taken;
}

// What is not seen moves the settled plane as far as the waves predict, and no model knows it better.
bool RegionFit::predict(const BoundedPoints& points, const Region& region, const Settings& settings,
                        const Eigen::Vector3d& settled, UnevenPlane* waves, const UnevenFit& endless, RegionPlane* out,
                        UnevenFit* by_endless) {
  const Span<const PatchSums> sums = cells_.sums_near(points, region, settled, kWidth_m, kReach, weights_of);
  const Taken taken = take_cells(sums, settled, settings.range_noise * settings.range_noise, out);
  if (taken.seen < kCellsMin || is_singular(taken.A)) return false;
  const Eigen::Matrix3d inverse = taken.A.inverse();
  Eigen::Vector3d of_seen = Eigen::Vector3d::Zero();  // these have settled
  for (std::uint32_t k = 0; k < taken.all; ++k) {
    responses_[k] = inverse * responses_[k];
    if (k < taken.seen) of_seen += responses_[k] * patches_[k].residual;
  }
  UnevenFit below = endless;  // the residuals
  below.correction -= settled;
  PredictedPlane predicted =
      waves->predict(Span<const SurfacePatch>(patches_.data(), taken.all), taken.seen,
                     Span<const Eigen::Vector3d>(responses_.data(), taken.all), below, settings.protection_sigmas);
  if (!predicted.solved) return false;
  predicted.correction += settled - of_seen;
  predicted.by_endless.correction += settled - of_seen;
  out->take(predicted);
  out->about_endless_ = predicted.about_endless;
  out->missing_of_bend_ = predicted.missing_of_bend;
  *by_endless = predicted.by_endless;
  out->of_endless_ = predicted.of_endless;
  return true;
}

// How far both the upper and the lower edge lie behind the plane at least, in widths; of each the mean.
double RegionFit::seen_behind_at_edges(const Eigen::Vector3d& plane) const {
  constexpr double kMost = 2.0;  // widths: beyond it is an opening
  double sums[2] = {}, counts[2] = {};
  for (const RegionCell& c : cells_.all()) {
    const double v = cells_.from_middle(c)[1];
    if (!c.is_surface() || !c.inside || std::fabs(v) < kEdge) continue;
    const int edge = v > 0.0 ? 1 : 0;
    sums[edge] += -larger(-kMost, -larger(-kMost, off(c, plane)));
    counts[edge] += 1.0;
  }
  if (counts[0] == 0.0 || counts[1] == 0.0) return 0.0;
  return -larger(-sums[0] / counts[0], -sums[1] / counts[1]);
}

// Other planes that the region's may be (README). The level reaches to each, as far as it moves the value.
void RegionFit::read_otherwise(const Settled (&settled)[kStarts], int best, RegionPlane* out) {
  const Eigen::Vector3d& plane = settled[best].plane;
  const auto add = [out](const Eigen::Vector3d& apart) { out->readings_[out->count_++] = {apart, false, false}; };
  out->readings_[out->count_++] = {plane - out->at, true, false};  // as if the wall ended with what is seen of it
  const double loss = loss_without_things(plane);
  for (int k = 0; k < kStarts; ++k) {
    const Settled& other = settled[k];
    if (!other.solved) continue;
    if (k != best && other.loss < settled[best].loss + kLossApart) add(other.plane - plane);
    // Things may stand before the surface, so what is nearer costs no more than a thing.
    Eigen::Vector3d hidden = k == kAll ? plane : other.start;
    Manner without_things{kWidth_m};
    without_things.before_m = kWidth_m;
    if (!settle(without_things, &hidden)) continue;
    if (loss_without_things(hidden) < loss + kLossApart) add(hidden - plane);
  }
  // What hangs before a wall in its middle leaves it at the top and at the foot.
  const double behind_m = kWidth_m * seen_behind_at_edges(plane);
  if (behind_m > 0.0) add({behind_m, 0.0, 0.0});
  // At its ends the cells may stand for a little more or less of the area than the surveyor's. At its edges another
  // surface may begin: a wall's foot beside the floor, a heap or a roof's arch at a wall.
  for (int k = kAll + 1; k < kEnds; ++k) {
    Eigen::Vector3d leaning = plane;
    Manner manner{kWidth_m};
    const Eigen::Vector2d side = towards(k);
    manner.lean = {kLean * side[0], 0.0};
    manner.edge = {0.0, side[1]};
    if (settle(manner, &leaning)) out->readings_[out->count_++] = {leaning - plane, false, side[1] != 0.0};
  }
  // Where a cell shows two layers, a surveyor's ray may end at the nearer one, or begin behind it.
  Eigen::Vector3d nearer = plane;
  list_shown(&RegionCell::first_h);
  if (settle({kWidth_m}, &nearer)) add(nearer - plane);
}

double RegionFit::step_at(double u_m, const Eigen::Vector3d& plane) const {
  constexpr double kAbout_m = 0.5, kMost_m = 3.0;  // two columns to each side; an opening
  double count = 0.0, weights = 0.0, sum_m = 0.0;
  for (const RegionCell& c : cells_.all()) {
    if (!c.seen || !c.inside || std::fabs(c.u - u_m) > kAbout_m) continue;
    // Rays that pass beside a pillar may meet more behind it, and a mesh hangs before a void: the worse layer counts.
    const double most = c.open ? kMost_m / kWidth_m : off(c, plane), first = c.open ? most : off(c.first_h, c, plane);
    const double t = weight_of(first) < weight_of(most) ? first : most;
    const double weight = weight_of(t), off_m = std::fabs(kWidth_m * t);
    count += 1.0;
    weights += weight;
    sum_m += (1.0 - weight) * (off_m < kMost_m ? off_m : kMost_m);
  }
  return weights < 0.5 * count ? sum_m / (count - weights) : 0.0;
}

RegionPlane RegionFit::fit(const BoundedPoints& points, const Region& region, const Settings& settings,
                           UnevenPlane* waves, Work* work, const UnevenFit& endless, RegionPlane* by_endless) {
  RegionPlane out;
  out.bend_per_m_ = region.bend_per_m;
  work->add(2ULL * points.count, steps::kPointSided);
  cells_.fill(points, region);
  const std::uint32_t seen = count_seen(&out);
  if (seen < kCellsMin) return out;
  work->add(seen, steps::kCellSettled);
  list_shown(&RegionCell::h);
  Settled settled[kStarts];
  const int best = settle_all(&settled);
  if (best < 0) return out;
  describe(settled[best].plane, &out);
  work->add(cells_.all().size(), steps::kPatchWaved);
  UnevenFit with;
  out.found = predict(points, region, settings, settled[best].plane, waves, endless, &out, &with);
  if (!out.found) return out;
  out.may_be_endless = endless.solved && loss_of(endless.correction) < settled[best].loss + kLossApart;
  read_otherwise(settled, best, &out);
  if (with.solved) *by_endless = out.on_endless(with, region.goes_on);
  return out;
}

}  // namespace pose_wall
