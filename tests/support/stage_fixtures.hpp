// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// White box: what the engine lays out in its block, laid out one by one for the test of a single stage.

#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "base/containers/arena.hpp"
#include "base/containers/bounded_points.hpp"
#include "base/estimation/patch_sums.hpp"
#include "base/estimation/tangent_points.hpp"
#include "engine/config.hpp"
#include "support/aligned_block.hpp"
#include "support/engine_under_test.hpp"

namespace pose_wall::test {

// An object with lay_out(Arena&, args...) on memory of its own, full of garbage.
template <typename T>
class Placed {
 public:
  template <typename... Args>
  explicit Placed(Args... args) : block_(measured(args...), Dirt::kRandom) {
    Arena arena(block_.data());
    object_.lay_out(arena, args...);
  }
  Placed(Placed&&) = default;
  Placed& operator=(Placed&&) = default;
  Placed(const Placed&) = delete;
  Placed& operator=(const Placed&) = delete;
  ~Placed() = default;

  T* operator->() { return &object_; }
  T& operator*() { return object_; }
  T* get() { return &object_; }

 private:
  template <typename... Args>
  static std::uint64_t measured(Args... args) {
    T unplaced;
    Arena arena(nullptr);
    unplaced.lay_out(arena, args...);
    return arena.bytes();
  }

  AlignedBlock block_;
  T object_;
};

// Points that grow up to their capacity, with the list of all their indices; bounded whenever they are asked for.
class OwnedPoints {
 public:
  explicit OwnedPoints(std::uint32_t capacity) : points_(capacity) { points_->count = 0; }

  void add(double x, double y, double z, float weight = 1.0F) {
    points_->set(points_->count, Eigen::Vector3d(x, y, z), weight);
    indices_.push_back(points_->count++);
    bounded_ = false;
  }
  void add(const Eigen::Vector3d& p) { add(p.x(), p.y(), p.z()); }

  BoundedPoints& set() {
    if (!bounded_) points_->bound();
    bounded_ = true;
    return *points_;
  }
  Span<const std::uint32_t> all() const {
    return Span<const std::uint32_t>(indices_.data(), static_cast<std::uint32_t>(indices_.size()));
  }

 private:
  Placed<BoundedPoints> points_;
  std::vector<std::uint32_t> indices_;
  bool bounded_ = false;
};

// One point more, told in doubles.
inline void add_point(const Eigen::Vector3d& p, float weight, TangentPoints* points) {
  const Eigen::Vector3d q = points->in_frame(p);
  const std::uint32_t k = points->count++;
  points->u[k] = static_cast<float>(q.x());
  points->v[k] = static_cast<float>(q.y());
  points->r[k] = static_cast<float>(q.z());
  points->weight[k] = weight;
}

inline PatchPoint patch_point(double u_m, double v_m, double residual_m, double weight, double bias) {
  return PatchPoint::of(static_cast<float>(u_m), static_cast<float>(v_m), static_cast<float>(residual_m),
                        static_cast<float>(weight), static_cast<float>(bias));
}

inline Settings settings_with(std::initializer_list<KeyValue> values = {}) {
  return read_settings(config_with(values));
}

class Noise {
 public:
  explicit Noise(std::uint32_t seed) : random_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  double normal(double sigma) { return std::normal_distribution<double>(0.0, sigma)(random_); }

 private:
  std::mt19937 random_;
};

}  // namespace pose_wall::test
