// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall {

// Points as a structure of arrays, in one frame that the owner's name gives. weight: the number of measured points in
// the centroid (times its intensity weight, if that is on). Rows go on for a four behind the capacity. The last points
// are read four at a time too, and the values behind them may be anything.
struct PointSet {
  Span<float> x, y, z, weight;
  std::uint32_t count = 0;

  void lay_out(Arena& arena, std::uint32_t capacity) {
    for (Span<float>* row : {&x, &y, &z, &weight}) *row = arena.take<float>(capacity + kFour);
    count = 0;
  }

  std::uint32_t capacity() const { return x.size() < kFour ? 0 : x.size() - kFour; }

  Eigen::Vector3d at(std::uint32_t i) const {
    return {static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])};
  }

  void set(std::uint32_t i, const Eigen::Vector3d& p, float w) {
    x[i] = static_cast<float>(p.x());
    y[i] = static_cast<float>(p.y());
    z[i] = static_cast<float>(p.z());
    weight[i] = w;
  }

  void add(float x_m, float y_m, float z_m, float w) {
    x[count] = x_m;
    y[count] = y_m;
    z[count] = z_m;
    weight[count] = w;
    ++count;
  }

  void copy(std::uint32_t to, std::uint32_t from) {
    x[to] = x[from];
    y[to] = y[from];
    z[to] = z[from];
    weight[to] = weight[from];
  }
  // The four of a set from there on; in this set itself some of them may lie where they go.
  void copy_four(std::uint32_t to, const PointSet& of, std::uint32_t from) {
    store_four(load_four(&of.x[from]), &x[to]);
    store_four(load_four(&of.y[from]), &y[to]);
    store_four(load_four(&of.z[from]), &z[to]);
    store_four(load_four(&of.weight[from]), &weight[to]);
  }
};

// The indices k to k + 3 of a list that holds the k-th; those behind its last one are the last one again.
struct FourIndices {
  std::uint32_t lane[kFour];

  FourIndices(Span<const std::uint32_t> list, std::uint32_t k) {
    for (std::uint32_t i = 0; i < kFour; ++i) lane[i] = list[k + i < list.size() ? k + i : list.size() - 1];
  }
  FourFloats of(Span<const float> row) const {
    return FourFloats{row[lane[0]], row[lane[1]], row[lane[2]], row[lane[3]]};
  }
};

// visit(first index, x, y, z, which of the four count) over all points; those that do not count are anything.
template <typename Visit>
void for_each_four_points(const PointSet& points, const Visit& visit) {
  for_each_four(points.count, [&](std::uint32_t i, FourTruths counts) {
    visit(i, load_four(&points.x[i]), load_four(&points.y[i]), load_four(&points.z[i]), counts);
  });
}

// In their order. which(x, y, z, counts): of the four that count, those to copy.
template <typename Which>
void copy_where(const PointSet& points, PointSet* out, const Which& which) {
  out->count = 0;
  for_each_four_points(points, [&](std::uint32_t k, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
    const FourTruths chosen = which(x, y, z, counts);
    if (!any_of(~chosen)) {  // as most fours that have any
      out->copy_four(out->count, points, k);
      out->count += kFour;
      return;
    }
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (chosen[lane] != 0) out->add(x[lane], y[lane], z[lane], points.weight[k + lane]);
    }
  });
}

}  // namespace pose_wall
