// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "containers/arena.hpp"
#include "containers/span.hpp"

namespace pose_wall {

// Points as a structure of arrays, in one frame that the owner's name tells. weight: how many measured points the
// centroid stands for (times its intensity weight, where that is on).
struct PointSet {
  Span<float> x, y, z, weight;
  std::uint32_t count = 0;

  void lay_out(Arena& arena, std::uint32_t capacity) {
    x = arena.take<float>(capacity);
    y = arena.take<float>(capacity);
    z = arena.take<float>(capacity);
    weight = arena.take<float>(capacity);
    count = 0;
  }

  std::uint32_t capacity() const { return x.size(); }

  Eigen::Vector3d at(std::uint32_t i) const {
    return {static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])};
  }

  void set(std::uint32_t i, const Eigen::Vector3d& p, float w) {
    x[i] = static_cast<float>(p.x());
    y[i] = static_cast<float>(p.y());
    z[i] = static_cast<float>(p.z());
    weight[i] = w;
  }

  void copy(std::uint32_t to, std::uint32_t from) {
    x[to] = x[from];
    y[to] = y[from];
    z[to] = z[from];
    weight[to] = weight[from];
  }
};

}  // namespace pose_wall
