// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Points of a surface averaged over square patches, few enough to know how they wave.

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "base/estimation/patch_sums.hpp"

namespace pose_wall {

// (u, v) in the plane, mean residual from it, its change per metre of range bias, and its variance by the noise of the
// points.
struct SurfacePatch {
  double u, v, residual, bias, noise_variance;
};

class SurfacePatches {
 public:
  // A floor of 5 m around the machine, or a wall of 38 m, in half metres; 96 before the work grew with the number and
  // not with its cube (2026-11-26).
  static constexpr std::uint32_t kMost = 384;

  void lay_out(Arena& arena);

  // Around (0, 0) out to reach_m.
  void begin(double reach_m, double patch_m);
  void add(const PatchPoint& point);
  // At most kMost patches of patch_m, or of the smallest multiple of it that needs no more.
  Span<const SurfacePatch> collect();

 private:
  static constexpr std::uint32_t kSide = 64;  // a row of cells is the bits of one word
  // A bit for each cell of a row that holds something.
  struct Occupied {
    std::uint64_t row[kSide] = {};

    // visit(first column): the blocks of side rows from iv on that hold something.
    template <typename Visit>
    void for_each_block(std::uint32_t iv, std::uint32_t side, const Visit& visit) const;
    std::uint32_t count_blocks(std::uint32_t side) const;
  };

  Occupied occupied() const;
  PatchSums block(std::uint32_t iu, std::uint32_t iv, std::uint32_t side) const;
  double pooled_variance() const;

  Span<PatchSums> cells_;
  Span<SurfacePatch> patches_;
  float from_m_ = 0.0F, cells_per_m_ = 1.0F;
  std::uint32_t side_ = kSide;  // cells from -reach to reach
};

}  // namespace pose_wall
