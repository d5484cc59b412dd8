// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/estimation/patch_fit.hpp"

#include <Eigen/LU>
#include <cmath>

#include "base/containers/work.hpp"
#include "base/estimation/normal_equations.hpp"

namespace pose_wall {
namespace {

// Weights of a patch's variance go by the scatter of the round before; of a fit that is only a step two do (2026-11-22,
// bench/README.md):
constexpr int kScatterRounds = 4;         // swept: half 84 moved, twice 83 moved
constexpr int kScatterRoundsOfAStep = 2;  // swept: half 20 moved, twice 18 moved
// Largest scatter along a range, in standard deviations of a range. More is not the sensor's: taken for it, rock seen
// from the side moved walls by 20 mm instead of 13 on steel sets.
constexpr double kScatterMost = 2.0;  // swept: half 2 won, twice 10 lost
// Of the scatter seen square on, where least squares leave nothing: no patch is known a hundred times better than
// others.
constexpr double kScatterLeast = 0.01;  // swept: half 1 moved, twice 14 moved

}  // namespace

void PatchGrid::lay_out(Arena& arena) {
  cells_ = arena.take<PatchSums>(kCapacity);
  means_ = arena.take<Mean>(kCapacity);
  mean_of_cell_ = arena.take<std::int32_t>(kCapacity);
  blocks_ = arena.take<SurfacePatch>(SurfacePatches::kMost);
  responses_ = arena.take<Eigen::Vector3d>(SurfacePatches::kMost);
  uneven_.lay_out(arena);
}

void PatchGrid::begin(double u_min_m, double u_max_m, double v_min_m, double v_max_m, double patch_m,
                      double range_noise_m, std::uint32_t layers) {
  range_noise_m_ = range_noise_m;
  layers_ = layers;
  u_min_ = static_cast<float>(u_min_m);
  v_min_ = static_cast<float>(v_min_m);
  const double width = u_max_m - u_min_m, height = v_max_m - v_min_m;
  // Patches a quarter larger need two thirds of the room; extents of a thousand patches are not met.
  double patch = patch_m;
  for (int growth = 0; growth < 20; ++growth, patch *= 1.25) {
    columns_ = static_cast<std::uint32_t>(width / patch < kCapacity ? width / patch : kCapacity) + 1;
    rows_ = static_cast<std::uint32_t>(height / patch < kCapacity ? height / patch : kCapacity) + 1;
    if (static_cast<std::uint64_t>(columns_) * rows_ * layers <= kCapacity) break;
  }
  if (static_cast<std::uint64_t>(columns_) * rows_ * layers > kCapacity) columns_ = rows_ = 1;
  cells_per_m_ = static_cast<float>(1.0 / patch);
  cells_.first(columns_ * rows_ * layers_).fill(PatchSums{});
}

void PatchGrid::add(const PatchPoint& point, std::uint32_t layer) {
  const float fu = (point.u_m - u_min_) * cells_per_m_, fv = (point.v_m - v_min_) * cells_per_m_;
  if (!(fu >= 0.0F && fu < static_cast<float>(columns_) && fv >= 0.0F && fv < static_cast<float>(rows_))) return;
  const std::uint32_t row = layer * rows_ + static_cast<std::uint32_t>(fv);
  cells_[row * columns_ + static_cast<std::uint32_t>(fu)].add(point.sums);
}

// Points outside count to the nearest patch.
FourInts PatchGrid::patch_of(FourFloats u_m, FourFloats v_m) const {
  const auto index_of = [](FourFloats place, std::uint32_t cells) {
    const FourFloats inside = smaller_of(larger_of(place, FourFloats{}), all_four(static_cast<float>(cells - 1)));
    return cut_off(inside);
  };
  return index_of((v_m - v_min_) * cells_per_m_, rows_) * static_cast<std::int32_t>(columns_) +
         index_of((u_m - u_min_) * cells_per_m_, columns_);
}

void PatchGrid::set(std::uint32_t patch, std::uint32_t layer, const PatchLanes& sums) {
  cells_[layer * patches() + patch] = sums.total();
}

// Rock scatters points alike wherever they are hit; the noise of the range only by its share across the surface. Least
// squares of the patches' own variances on (1, share^2), weighted by how well each is known, neither part negative.
PatchGrid::Scatter PatchGrid::scatter_by_incidence(std::uint32_t first, std::uint32_t cells, int rounds) const {
  Scatter out;
  for (int round = 0; round < rounds; ++round) {
    double g = 0.0, gc = 0.0, gcc = 0.0, gs = 0.0, gcs = 0.0;
    for (std::uint32_t k = first; k < first + cells; ++k) {
      const PatchSums& p = cells_[k];
      if (p.count < 2) continue;
      const double freedom = static_cast<double>(p.count - 1), c = p.share() * p.share();
      const double variance = p.scatter() / freedom, before = round > 0 ? out.at(c) : 1.0;
      const double weight = freedom / (before * before);
      g += weight;
      gc += weight * c;
      gcc += weight * c * c;
      gs += weight * variance;
      gcs += weight * c * variance;
    }
    const double determinant = g * gcc - gc * gc;
    out = Scatter{};
    if (!(g > 0.0)) return out;
    if (determinant > 1e-9 * g * gcc) {
      out.surface = (gcc * gs - gc * gcs) / determinant;
      out.range = (g * gcs - gc * gs) / determinant;
    }
    if (!(out.range > 0.0)) out = Scatter{gs / g, 0.0};
    if (!(out.surface > 0.0) && gcc > 0.0) out = Scatter{0.0, gcs / gcc};
    // Rock is seen less rough from the side, by its bumps: more than a sensor's noise is not the sensor's.
    const double most_m = kScatterMost * range_noise_m_;
    if (!(out.range <= most_m * most_m)) out = Scatter{gs / g, 0.0};
  }
  return out;
}

double PatchGrid::Scatter::at(double share2) const {
  const double variance = surface + range * share2;
  return larger(variance, kScatterLeast * (surface + range + kPatchNoiseMin_m * kPatchNoiseMin_m));
}

std::uint32_t PatchGrid::collect_means(Errors errors) {
  const int rounds = errors == Errors::kPlaneOnly ? kScatterRoundsOfAStep : kScatterRounds;
  std::uint32_t n = 0;
  for (std::uint32_t layer = 0; layer < layers_; ++layer) {
    const std::uint32_t cells = columns_ * rows_, first = layer * cells;
    const Scatter expected = scatter_by_incidence(first, cells, rounds);
    for (std::uint32_t c = first; c < first + cells; ++c) {
      const PatchSums& p = cells_[c];
      mean_of_cell_[c] = -1;
      if (!p.has_weight()) continue;
      const double own = p.scatter_or_none(), share = p.share();
      const double s2 = (kPatchPriorPoints * expected.at(share * share) + own) / (kPatchPriorPoints + p.count - 1.0);
      Mean& m = means_[n];
      m.u = p.wu() / p.w();
      m.v = p.wv() / p.w();
      m.r = p.wr() / p.w();
      m.b = p.wb() / p.w();
      m.noise_variance = s2 / p.w();
      m.information = 1.0 / m.noise_variance;
      m.iu = static_cast<std::int32_t>((c - first) % columns_);
      m.iv = static_cast<std::int32_t>((c - first) / columns_);
      m.layer = layer;
      mean_of_cell_[c] = static_cast<std::int32_t>(n++);
    }
  }
  return n;
}

// Where the strips' patches lie, and how far they stand out, on average.
PatchGrid::StripCentre PatchGrid::strip_centre(std::uint32_t n) const {
  double w = 0.0, wu = 0.0, wv = 0.0, wr = 0.0, wb = 0.0;
  for (const Mean& p : means_.first(n)) {
    if (p.layer == 0) continue;
    w += p.information;
    wu += p.information * p.u;
    wv += p.information * p.v;
    wr += p.information * p.r;
    wb += p.information * p.b;
  }
  return {wu / w, wv / w, wr / w, wb / w};
}

bool PatchGrid::solve(std::uint32_t n, Eigen::Vector3d* solution, Eigen::Matrix3d* inverse) {
  const StripCentre centre = strip_centre(n);
  NormalEquations sums;
  for (Mean& p : means_.first(n)) {
    const bool strip = p.layer != 0;
    p.a = strip ? Eigen::Vector3d(0.0, p.u - centre.u, p.v - centre.v) : Eigen::Vector3d(1.0, p.u, p.v);
    p.r_centred = strip ? p.r - centre.r : p.r;
    p.b_centred = strip ? p.b - centre.b : p.b;
    sums.add_row(p.a, p.r_centred, p.information);
  }
  const Eigen::Matrix3d m = sums.information();
  const double volume = m(0, 0) * m(1, 1) * m(2, 2);
  if (!(volume > 0.0) || !(m.determinant() > 1e-9 * volume)) return false;
  *inverse = m.inverse();
  *solution = *inverse * sums.right_side();
  for (Mean& p : means_.first(n)) p.error = p.r_centred - solution->dot(p.a);
  return true;
}

// DerSimonian and Laird's moment estimate, with the leverage of the fitted parameters taken out.
double PatchGrid::between_patch_variance(std::uint32_t n, std::uint32_t layer, const Eigen::Matrix3d& inverse) const {
  double q = 0.0, sum = 0.0, leverage = 0.0, weighted_leverage = 0.0, squares = 0.0, count = 0.0;
  for (const Mean& p : means_.first(n)) {
    if (p.layer != layer) continue;
    const double h = p.information * p.a.dot(inverse * p.a);
    q += p.information * p.error * p.error;
    sum += p.information;
    squares += p.information * p.information;
    leverage += h;
    weighted_leverage += p.information * h;
    count += 1.0;
  }
  if (!(sum > 0.0)) return 0.0;
  // The strips' step is a parameter of their own.
  const double step = layer == 0 ? 0.0 : 1.0;
  const double excess = q - (count - leverage - step);
  const double scale = sum - weighted_leverage - step * squares / sum;
  return excess > 0.0 && scale > 0.0 ? excess / scale : 0.0;
}

std::uint64_t PatchGrid::work_of(std::uint32_t patches, Errors errors) const {
  Work work;
  work.add(this->patches() * layers_, steps::kCell);
  work.add(patches, steps::kPatch);
  if (errors == Errors::kPlaneOnly) return work.done();
  work.add(patches, steps::kPatchMeasured);
  if (errors != Errors::kCovariance) work.add(patches < kPairedMost ? patches : kPairedMost, steps::kPatchPaired);
  return work.done();
}

PatchFit PatchGrid::fit(Errors errors) {
  PatchFit out;
  const std::uint32_t n = collect_means(errors);
  out.patches = n;
  out.work = work_of(n, errors);
  std::uint32_t of_surface = 0;
  for (const Mean& p : means_.first(n)) of_surface += p.layer == 0 ? 1U : 0U;
  if (of_surface < kPatchesMin) return out;
  Eigen::Matrix3d inverse;
  if (!solve(n, &out.correction, &inverse)) return out;
  double tau2[kLayersMax] = {};
  for (std::uint32_t layer = 0; layer < layers_; ++layer) tau2[layer] = between_patch_variance(n, layer, inverse);
  for (Mean& p : means_.first(n)) p.information = 1.0 / (tau2[p.layer] + p.noise_variance);
  if (!solve(n, &out.correction, &inverse)) return out;
  out.tau_m = std::sqrt(tau2[0]);
  out.solved = true;
  if (errors == Errors::kBend) test_bend(n, &out);
  if (errors == Errors::kPlaneOnly || errors == Errors::kBend) return out;
  if (!measure_errors(n, inverse, &out)) {
    out.solved = false;
    return out;
  }
  if (errors == Errors::kCovariance) return out;
  test_bend(n, &out);
  out.visibility_m = visibility(tau2[0]);
  return out;
}

}  // namespace pose_wall
