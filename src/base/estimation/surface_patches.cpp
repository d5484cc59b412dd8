// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/estimation/surface_patches.hpp"

namespace pose_wall {

void SurfacePatches::lay_out(Arena& arena) {
  cells_ = arena.take<PatchSums>(kSide * kSide);
  patches_ = arena.take<SurfacePatch>(kMost);
}

void SurfacePatches::begin(double reach_m, double patch_m) {
  const double fits = 2.0 * reach_m / static_cast<double>(kSide - 1);
  cells_per_m_ = static_cast<float>(1.0 / (patch_m > fits ? patch_m : fits));
  from_m_ = static_cast<float>(-reach_m);
  side_ = static_cast<std::uint32_t>(2.0 * reach_m * static_cast<double>(cells_per_m_)) + 1;
  if (side_ > kSide) side_ = kSide;
  cells_.first(side_ * kSide).fill(PatchSums{});
}

void SurfacePatches::add(const PatchPoint& point) {
  const float fu = (point.u_m - from_m_) * cells_per_m_, fv = (point.v_m - from_m_) * cells_per_m_;
  const auto side = static_cast<float>(side_);
  if (!(fu >= 0.0F && fu < side && fv >= 0.0F && fv < side)) return;
  cells_[static_cast<std::uint32_t>(fv) * kSide + static_cast<std::uint32_t>(fu)].add(point.sums);
}

// side x side cells as one.
PatchSums SurfacePatches::block(std::uint32_t iu, std::uint32_t iv, std::uint32_t side) const {
  PatchSums sum;
  for (std::uint32_t v = iv; v < iv + side && v < side_; ++v) {
    for (std::uint32_t u = iu; u < iu + side && u < kSide; ++u) sum.add(cells_[v * kSide + u]);
  }
  return sum;
}

SurfacePatches::Occupied SurfacePatches::occupied() const {
  static_assert(kSide == 64, "a row's bits are one word");
  Occupied out;
  for (std::uint32_t v = 0; v < side_; ++v) {
    std::uint64_t bits = 0;
    for (std::uint32_t u = 0; u < kSide; ++u) {
      bits |= static_cast<std::uint64_t>(cells_[v * kSide + u].has_weight()) << u;
    }
    out.row[v] = bits;
  }
  return out;
}

template <typename Visit>
void SurfacePatches::Occupied::for_each_block(std::uint32_t iv, std::uint32_t side, const Visit& visit) const {
  std::uint64_t bits = 0;
  for (std::uint32_t v = iv; v < iv + side && v < kSide; ++v) bits |= row[v];
  const std::uint64_t block = (1ULL << side) - 1;
  for (std::uint32_t iu = 0; bits != 0; iu += side, bits >>= side) {
    if ((bits & block) != 0) visit(iu);
  }
}

std::uint32_t SurfacePatches::Occupied::count_blocks(std::uint32_t side) const {
  std::uint32_t count = 0;
  for (std::uint32_t iv = 0; iv < kSide; iv += side) {
    for_each_block(iv, side, [&count](std::uint32_t) { ++count; });
  }
  return count;
}

double SurfacePatches::pooled_variance() const {
  double scatter = 0.0, freedom = 0.0;
  for (const PatchSums& c : cells_.first(side_ * kSide)) {
    if (c.count < 2) continue;
    scatter += c.scatter_or_none();
    freedom += static_cast<double>(c.count - 1);
  }
  const double variance = freedom > 0.0 ? scatter / freedom : 0.0;
  return larger(variance, kPatchNoiseMin_m * kPatchNoiseMin_m);
}

Span<const SurfacePatch> SurfacePatches::collect() {
  const Occupied cells = occupied();
  std::uint32_t side = 1;
  while (cells.count_blocks(side) > kMost) ++side;
  const double pooled = pooled_variance();
  std::uint32_t count = 0;
  for (std::uint32_t iv = 0; iv < kSide; iv += side) {
    cells.for_each_block(iv, side, [&](std::uint32_t iu) {
      const PatchSums c = block(iu, iv, side);
      const double variance =
          (kPatchPriorPoints * pooled + c.scatter_or_none()) / (kPatchPriorPoints - 1.0 + static_cast<double>(c.count));
      patches_[count++] = {c.wu() / c.w(), c.wv() / c.w(), c.wr() / c.w(), c.share(),
                           larger(variance, kPatchNoiseMin_m * kPatchNoiseMin_m) / c.w()};
    });
  }
  return Span<const SurfacePatch>(patches_.data(), count);
}

}  // namespace pose_wall
