// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/walls_points.hpp"

#include <cmath>

namespace pose_wall {
namespace {

constexpr double kPatch_m = 0.5;

struct Extent {
  FourFloats least{}, most{};

  void add(FourFloats x) {
    least = smaller_of(least, x);
    most = larger_of(most, x);
  }
  double from() const { return -static_cast<double>(largest_of(-least)); }
  double to() const { return static_cast<double>(largest_of(most)); }
};

// What is read behind the last point counts for nothing, and must be a number.
void pad(Span<float> row, std::uint32_t count) {
  store_four(FourFloats{}, &row[count]);
}

// visit(point, patch)
template <typename Visit>
void for_each_patch(const TangentPoints& at, const PatchGrid& patches, const Visit& visit) {
  for_each_four(at.count, [&](std::uint32_t k, FourTruths counts) {
    const FourFloats none{};
    const FourInts patch = patches.patch_of(counts ? load_four(&at.u[k]) : none, counts ? load_four(&at.v[k]) : none);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (counts[lane] != 0) visit(k + lane, static_cast<std::uint32_t>(patch[lane]));
    }
  });
}

}  // namespace

void WallPoints::lay_out(Arena& arena) {
  // A patch's points are read four at a time, the last ones with what lies behind them.
  constexpr std::uint32_t kRow = kMost + kFour;
  at.lay_out(arena, kRow);
  bias = arena.take<float>(kRow);
  column_mark = arena.take<float>(kRow);
  spare = arena.take<float>(kRow);
  patch_room = arena.take<std::uint32_t>(PatchGrid::kCapacity);
}

void WallPoints::begin(const WallScene& scene, const Plane& around, const Eigen::Vector3d& along_level) {
  at.begin(around, Eigen::Vector3d::Zero(), along_level);
  const TangentFrame& f = at.frame;
  const Eigen::Vector3d from_origin = scene.sensor_level_m - f.origin;
  sensor = Eigen::Vector3d(f.u.dot(from_origin), f.v.dot(from_origin), around.n.dot(from_origin));
  z_at_origin_m = f.origin.z();
  z_per_v = f.v.z();
  z_per_r = around.n.z();
}

void WallPoints::add(const Eigen::Vector3d& p_level, float weight) {
  const std::uint32_t k = at.count;
  at.add(p_level, weight);
  const Eigen::Vector3d ray = Eigen::Vector3d(at.u[k], at.v[k], at.r[k]) - sensor;
  bias[k] = static_cast<float>(ray.z() / std::sqrt(ray.squaredNorm()));
}

void WallPoints::sort_by_patch(PatchGrid* patches, Span<std::uint32_t> places) {
  Extent of_u, of_v;
  for_each_four(at.count, [&](std::uint32_t k, FourTruths counts) {
    of_u.add(counts ? load_four(&at.u[k]) : FourFloats{});
    of_v.add(counts ? load_four(&at.v[k]) : FourFloats{});
  });
  // Room for the strips' fronts, too.
  patches->begin(of_u.from(), of_u.to(), of_v.from(), of_v.to(), kPatch_m, PatchGrid::kLayersMax);
  patch_end = patch_room.first(patches->patches());
  patch_end.fill(0);
  for_each_patch(at, *patches, [&](std::uint32_t, std::uint32_t patch) { ++patch_end[patch]; });
  std::uint32_t begin = 0;
  for (std::uint32_t& end : patch_end) {
    const std::uint32_t of_patch = end;
    end = begin;
    begin += of_patch;
  }
  // Each goes to where its patch has got to.
  for_each_patch(at, *patches, [&](std::uint32_t k, std::uint32_t patch) { places[k] = patch_end[patch]++; });
  for_each_row([&](Span<float>* row) {
    for (std::uint32_t k = 0; k < at.count; ++k) spare[places[k]] = (*row)[k];
    const Span<float> sorted = spare;
    spare = *row;
    *row = sorted;
    pad(sorted, at.count);
  });
}

void WallPoints::keep(Span<const float> weights) {
  std::uint32_t kept = 0, k = 0;
  for (std::uint32_t& end : patch_end) {
    for (; k < end; ++k) {
      if (!(weights[k] > 0.0F)) continue;
      for_each_row([&](const Span<float>* row) { (*row)[kept] = (*row)[k]; });
      ++kept;
    }
    end = kept;
  }
  at.count = kept;
  for_each_row([&](const Span<float>* row) { pad(*row, kept); });
}

void WallPoints::mark_columns(const StripProfile& strips) {
  for_each_four(at.count, [&](std::uint32_t k, FourTruths counts) {
    const StripProfile::FourColumns columns = strips.columns_of(counts ? load_four(&at.u[k]) : FourFloats{});
    const FourFloats p = columns.surface_probability;
    store_four(columns.is_strip ? p - kStripMark : p, &column_mark[k]);
  });
  pad(column_mark, at.count);
}

}  // namespace pose_wall
