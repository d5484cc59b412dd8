// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/region/region_cells.hpp"

#include <cmath>

#include "base/math/finite.hpp"

namespace pose_wall {

void RegionCells::lay_out(Arena& arena) {
  cells_ = arena.take<RegionCell>(kMost);
  bins_ = arena.take<Bin>(kMost * kBins);
  sums_ = arena.take<PatchSums>(kMost);
}

void RegionCells::begin(const Region& region) {
  const auto cells_over = [](double length) { return static_cast<std::uint32_t>(length + 0.5); };
  const std::uint32_t margin = cells_over(kMargin_m / kCell_m);
  cell_u_m_ = larger(kCell_m, 2.0 * region.u_to_m / kColumnsMost);
  columns_ = cells_over(2.0 * region.u_to_m / cell_u_m_) + 2 * margin;
  rows_ = cells_over((region.v_max_m - region.v_min_m) / kCell_m) + 2 * margin;
  // A band that is higher than there is room for is seen from below up to there.
  if (columns_ * rows_ > kMost) rows_ = kMost / columns_;
  const double u_from_m = -region.u_to_m - margin * cell_u_m_, v_from_m = region.v_min_m - kMargin_m;
  u_from_m_ = static_cast<float>(u_from_m);
  v_from_m_ = static_cast<float>(v_from_m);
  for (std::uint32_t row = 0; row < rows_; ++row) {
    for (std::uint32_t column = 0; column < columns_; ++column) {
      RegionCell& cell = cells_[row * columns_ + column];
      cell = RegionCell{};
      cell.u = u_from_m + (column + 0.5) * cell_u_m_;
      cell.v = v_from_m + (row + 0.5) * kCell_m;
      cell.inside = column >= margin && column + margin < columns_ && row >= margin && row + margin < rows_ &&
                    std::fabs(cell.u) >= region.u_from_m;
    }
  }
  bins_.first(columns_ * rows_ * kBins).fill(Bin{});
}

// The cells of four points, of those that lie in one.
RegionCells::FourCells RegionCells::cells_of(FourFloats u, FourFloats v, FourTruths counts) const {
  const auto per_column = static_cast<float>(1.0 / cell_u_m_), per_row = static_cast<float>(1.0 / kCell_m);
  const FourFloats column = (u - u_from_m_) * per_column, row = (v - v_from_m_) * per_row, none{};
  counts &= (column >= none) & (column < all_four(static_cast<float>(columns_))) & (row >= none) &
            (row < all_four(static_cast<float>(rows_)));
  const FourInts cell =
      cut_off(counts ? row : none) * static_cast<std::int32_t>(columns_) + cut_off(counts ? column : none);
  return {cell, counts};
}

void RegionCells::fill(const BoundedPoints& points, const Region& region) {
  begin(region);
  constexpr auto kPerBin = static_cast<float>(1.0 / kBin_m);  // bins to a metre
  const auto h_from = static_cast<float>(region.h_min_m);
  for_each_in(points, region, [&](std::uint32_t, FourFloats u, FourFloats v, FourFloats h, FourTruths counts) {
    const FourFloats depth = (h - h_from) * kPerBin, none{};
    const FourCells at = cells_of(u, v, counts & (depth >= none));
    if (!any_of(at.counts)) return;
    const FourInts bin = cut_off(at.counts ? smaller_of(depth, all_four(static_cast<float>(kBins - 1))) : none);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (at.counts[lane] == 0) continue;
      Bin& to = bins_[static_cast<std::uint32_t>(at.cell[lane]) * kBins + static_cast<std::uint32_t>(bin[lane])];
      to.count += 1.0F;
      to.u += u[lane];
      to.v += v[lane];
      to.h += h[lane];
    }
  });
  find_layers();
  find_openings();
}

// Two bins that follow each other and hold most of a cell's points; of equal ones the nearer.
void RegionCells::find_layers() {
  for (std::uint32_t k = 0; k < columns_ * rows_; ++k) {
    const Bin* const bin = &bins_[k * kBins];
    std::uint32_t best = 0;
    float most = 0.0F;
    for (std::uint32_t j = 0; j + 2 < kBins; ++j) {
      const float count = bin[j].count + bin[j + 1].count;
      if (!(count > most)) continue;
      most = count;
      best = j;
    }
    RegionCell& cell = cells_[k];
    cell.open = bin[kBins - 1].count > most;
    cell.seen = most > 0.0F || cell.open;
    if (cell.open || !cell.seen) continue;
    cell.u = static_cast<double>((bin[best].u + bin[best + 1].u) / most);
    cell.v = static_cast<double>((bin[best].v + bin[best + 1].v) / most);
    cell.h = cell.first_h = (bin[best].h + bin[best + 1].h) / most;
    for (std::uint32_t j = 0; j + 1 < best; ++j) {
      const float count = bin[j].count + bin[j + 1].count;
      if (count < kLayerMin) continue;
      cell.first_h = (bin[j].h + bin[j + 1].h) / count;
      break;
    }
  }
}

// What lies far behind the nearest tenth: the end of a crosscut is no wall of this road.
void RegionCells::find_openings() {
  std::uint32_t seen = 0;
  for (const RegionCell& c : all()) seen += c.is_surface() && c.inside ? 1U : 0U;
  double tenth_m = 0.0;
  for (double step_m = kBin_m * kBins; step_m > kBin_m / kBins; step_m *= 0.5) {
    std::uint32_t nearer = 0;
    for (const RegionCell& c : all()) nearer += c.is_surface() && c.inside && c.h < tenth_m + step_m ? 1U : 0U;
    if (10 * nearer < seen) tenth_m += step_m;
  }
  for (RegionCell& c : all()) c.open = c.open || (c.seen && c.h > tenth_m + kOpening_m);
}

Eigen::Vector2d RegionCells::from_middle(const RegionCell& cell) const {
  const double u = (cell.u - static_cast<double>(u_from_m_)) / (columns_ * cell_u_m_);
  const double v = (cell.v - static_cast<double>(v_from_m_)) / (rows_ * kCell_m);
  return {2.0 * u - 1.0, 2.0 * v - 1.0};
}

}  // namespace pose_wall
