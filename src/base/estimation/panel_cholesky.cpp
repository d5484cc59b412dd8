// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/estimation/panel_cholesky.hpp"

#include <cmath>

namespace pose_wall {
namespace {

// Four rows against four others: a column of four sums for each of these.
struct FourByFour {
  FourFloats of[kFour];
};

// Over the first columns, a multiple of four. Even and odd ones apart: a processor has two sums to wait for.
FourByFour products(const float* rows, const float* others, std::uint32_t columns) {
  FourFloats even[kFour] = {}, odd[kFour] = {};
  for (const float* const end = rows + kFour * columns; rows != end; rows += 2 * kFour, others += 2 * kFour) {
    const FourFloats rows0 = load_four(rows), rows1 = load_four(rows + kFour);
    for (std::uint32_t k = 0; k < kFour; ++k) {
      even[k] += rows0 * others[k];
      odd[k] += rows1 * others[kFour + k];
    }
  }
  FourByFour out;
  for (std::uint32_t k = 0; k < kFour; ++k) out.of[k] = even[k] + odd[k];
  return out;
}

}  // namespace

// Forward substitution, four columns at a time.
void PanelCholesky::eliminate(std::uint32_t panels, float* rows) const {
  for (std::uint32_t p = 0; p < panels; ++p) {
    const float* const factor = &panels_[p * kPanel];
    const std::uint32_t first = kFour * p;
    const FourByFour sums = products(rows, factor, first);
    FourFloats done[kFour];
    for (std::uint32_t k = 0; k < kFour; ++k) {
      FourFloats left = load_four(rows + kFour * (first + k)) - sums.of[k];
      for (std::uint32_t before = 0; before < k; ++before) left -= done[before] * factor[kFour * (first + before) + k];
      done[k] = left * factor[kFour * (first + k) + k];
      store_four(done[k], rows + kFour * (first + k));
    }
  }
}

bool PanelCholesky::factor(std::uint32_t rows) {
  const std::uint32_t panels = panels_of(rows);
  for (std::uint32_t p = 0; p < panels; ++p) {
    float* const own = panel(p);
    eliminate(p, own);
    const std::uint32_t first = kFour * p;
    const FourByFour sums = products(own, own, first);
    FourFloats done[kFour];
    for (std::uint32_t k = 0; k < kFour; ++k) {
      FourFloats left = load_four(own + kFour * (first + k)) - sums.of[k];
      for (std::uint32_t before = 0; before < k; ++before) left -= done[before] * done[before][k];
      const float pivot = left[k];
      if (!(pivot > 0.0F)) return false;
      const float inverse = 1.0F / std::sqrt(pivot);
      done[k] = left * inverse;
      store_four(done[k], own + kFour * (first + k));
      own[kFour * (first + k) + k] = inverse;
    }
  }
  return true;
}

}  // namespace pose_wall
