// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// From the returns of each beam to one range: the k-th smallest of its nearest surface, freed of what noise makes it
// too short on average.

#pragma once

#include "base/simd/four_floats.hpp"
#include "planar/scan/evidence.hpp"

namespace pose_wall::planar {

constexpr std::uint32_t kRankMost = kFour;   // the largest k: one register holds them
constexpr std::uint32_t kReturnsKnown = 64;  // more returns of a surface count as these

// Expected k-th smallest of n standard normal numbers, and the k for n.
struct OrderStatistics {
  OrderStatistics();
  static std::uint32_t rank_of(std::uint32_t n) { return n < 4 ? 1U : n < 8 ? 2U : n < 16 ? 3U : kRankMost; }
  double expected(std::uint32_t n) const { return mean[n < kReturnsKnown ? n : kReturnsKnown]; }

  double mean[kReturnsKnown + 1];  // 0 or negative
};

// The returns of a beam's nearest surface, moved to the middle of the beam.
struct Gathered {
  FourFloats least_m;  // ascending, beyond the beam's nearest
  float sum_m, sum_m2;
  float behind_m;  // the nearest return behind the surface
  std::uint32_t count;
};

// A beam that has returns, in the order of directions.
struct SeenBeam {
  std::uint16_t beam;
  std::uint8_t joined;  // can be one surface with the next of these
  std::uint8_t alone;
};

struct BeamRanges {
  void lay_out(Arena& arena, std::uint32_t beams);

  Span<float> range_m;  // NaN: none
  Span<float> bias_m, sigma_m, alone_m;
  Span<float> behind_m;  // the nearest return behind the surface; NaN: none
  Span<std::uint16_t> returns;

  Span<Gathered> gathered;  // scratch, as are the below
  Span<float> slope_m;      // of a beam's surface, for a step
  Span<SeenBeam> seen;
  Span<double> scatter_m2;  // sums of squares up to each seen beam
  Span<std::uint32_t> scatter_count;
};

// Evidence.nearest_m moves to the surface behind where a return is alone and the settings say so.
void find_ranges(const ScanSettings& settings, const OrderStatistics& statistics, Evidence* evidence,
                 BeamRanges* ranges);

}  // namespace pose_wall::planar
