// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/fit/points.hpp"

#include <cmath>

namespace pose_wall {
namespace {

struct Extent {
  FourFloats least{}, most{};

  void add(FourFloats x) {
    least = smaller_of(least, x);
    most = larger_of(most, x);
  }
  double from() const { return -static_cast<double>(largest_of(-least)); }
  double to() const { return static_cast<double>(largest_of(most)); }
};

// Values read behind the last point do not count, but must be numbers.
void pad(Span<float> row, std::uint32_t count) {
  store_four(FourFloats{}, &row[count]);
}

void move_within(Span<float> row, std::uint32_t begin, std::uint32_t end, Span<const std::uint32_t> places,
                 Span<float> spare) {
  for (std::uint32_t k = begin; k < end; ++k) spare[places[k]] = row[k];
  for (std::uint32_t k = begin; k < end; ++k) row[k] = spare[k];
}

// The groups, in their order within a patch.
enum Part : std::int32_t { kSurfaceOnly, kBoth, kStripOnly, kNeither, kParts };

FourInts parts_of(const StripProfile::FourColumns& columns) {
  const FourInts both = {kBoth, kBoth, kBoth, kBoth}, surface = {};
  const FourInts strip = {kStripOnly, kStripOnly, kStripOnly, kStripOnly};
  const FourInts neither = {kNeither, kNeither, kNeither, kNeither};
  const FourInts if_surface = columns.is_strip ? both : surface, if_not = columns.is_strip ? strip : neither;
  return columns.surface_probability > FourFloats{} ? if_surface : if_not;
}

// A patch with a known end and no groups yet.
WallPoints::Patch all_surface(std::uint32_t end) {
  return {end, end, end, end};
}

}  // namespace

void WallPoints::lay_out(Arena& arena) {
  at.lay_out(arena, kMost);
  const std::uint32_t row = at.u.size();  // rows swap places with those of the points
  bias = arena.take<float>(row);
  probability = arena.take<float>(row);
  spare = arena.take<float>(row);
  part = arena.take<std::uint8_t>(row);
  patch_room = arena.take<Patch>(PatchGrid::kCapacity);
  surface.lay_out(arena, kMost);
}

void WallPoints::begin(const WallScene& scene, const Plane& around, const Eigen::Vector3d& along_level) {
  at.begin(around, Eigen::Vector3d::Zero(), along_level);
  sensor = at.in_frame(scene.sensor_level_m);
  range_noise_m = scene.settings.range_noise;
  z_at_origin_m = at.frame.origin.z();
  z_per_v = at.frame.v.z();
  z_per_r = around.n.z();
}

void WallPoints::add(const PointSet& points_level, Span<const std::uint32_t> list) {
  at.add(points_level, list);
  const Eigen::Vector3f from = sensor.cast<float>();
  for_each_four(at.count, [&](std::uint32_t k, FourTruths) {
    const FourFloats u = load_four(&at.u[k]) - from.x(), v = load_four(&at.v[k]) - from.y();
    const FourFloats r = load_four(&at.r[k]) - from.z();
    store_four(r / root_of(u * u + v * v + r * r), &bias[k]);
  });
}

void WallPoints::sort_by_patch(PatchGrid* grid, Span<std::uint32_t> places) {
  Extent of_u, of_v;
  for_each_four(at.count, [&](std::uint32_t k, FourTruths counts) {
    of_u.add(counts ? load_four(&at.u[k]) : FourFloats{});
    of_v.add(counts ? load_four(&at.v[k]) : FourFloats{});
  });
  // Room for the strips' fronts, too.
  grid->begin(of_u.from(), of_u.to(), of_v.from(), of_v.to(), PatchGrid::kPatch_m, range_noise_m,
              PatchGrid::kLayersMax);
  patches = patch_room.first(grid->patches());
  patches.fill(Patch{});
  for_each_four(at.count, [&](std::uint32_t k, FourTruths counts) {
    const FourFloats none{};
    const FourInts of = grid->patch_of(counts ? load_four(&at.u[k]) : none, counts ? load_four(&at.v[k]) : none);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (counts[lane] == 0) continue;
      const auto patch = static_cast<std::uint32_t>(of[lane]);
      places[k + lane] = patch;
      ++patches[patch].end;
    }
  });
  std::uint32_t begin = 0;
  for (Patch& patch : patches) {
    const std::uint32_t of_patch = patch.end;
    patch.end = begin;
    begin += of_patch;
  }
  // Each point takes the next place of its patch.
  for (std::uint32_t& place : places.first(at.count)) place = patches[place].end++;
  for (Patch& patch : patches) patch = all_surface(patch.end);
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
  for (Patch& patch : patches) {
    for (; k < patch.end; ++k) {
      if (!(weights[k] > 0.0F)) continue;
      for_each_row([&](const Span<float>* row) { (*row)[kept] = (*row)[k]; });
      ++kept;
    }
    patch = all_surface(kept);
  }
  at.count = kept;
  for_each_row([&](const Span<float>* row) { pad(*row, kept); });
}

void WallPoints::mark_columns(const StripProfile& strips, Span<std::uint32_t> places) {
  for_each_four(at.count, [&](std::uint32_t k, FourTruths counts) {
    const StripProfile::FourColumns columns = strips.columns_of(counts ? load_four(&at.u[k]) : FourFloats{});
    store_four(columns.surface_probability, &probability[k]);
    const FourInts parts = parts_of(columns);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) part[k + lane] = static_cast<std::uint8_t>(parts[lane]);
  });
  pad(probability, at.count);
  std::uint32_t begin = 0;
  for (Patch& patch : patches) {
    patch = put_into_order(begin, patch.end, places);
    begin = patch.end;
  }
}

WallPoints::Patch WallPoints::put_into_order(std::uint32_t begin, std::uint32_t end, Span<std::uint32_t> places) {
  std::uint32_t ends[kParts] = {};
  bool in_order = true;  // as most patches are since the last ring
  std::uint8_t last = 0;
  for (std::uint32_t k = begin; k < end; ++k) {
    in_order = in_order && part[k] >= last;
    last = part[k];
    ++ends[last];
  }
  std::uint32_t next[kParts], sum = begin;
  for (std::uint32_t of = 0; of < kParts; ++of) {
    next[of] = sum;
    sum += ends[of];  // the count until here, an end from here on
    ends[of] = sum;
  }
  if (!in_order) {
    for (std::uint32_t k = begin; k < end; ++k) places[k] = next[part[k]]++;
    const auto move = [&](const Span<float>* row) { move_within(*row, begin, end, places, spare); };
    for_each_row(move);
    move(&probability);
  }
  return {ends[kSurfaceOnly], ends[kBoth], ends[kStripOnly], ends[kNeither]};
}

void WallPoints::copy_surface() {
  surface.plane = at.plane;
  surface.frame = at.frame;
  std::uint32_t count = 0;
  for_each_patch([&](const Patch& patch, std::uint32_t begin) {
    for (std::uint32_t k = begin; k < patch.surface_end; ++k) {
      if (!(probability[k] >= 0.5F)) continue;
      surface.u[count] = at.u[k];
      surface.v[count] = at.v[k];
      surface.r[count] = at.r[k];
      surface.weight[count] = at.weight[k];
      ++count;
    }
  });
  surface.count = count;
}

}  // namespace pose_wall
