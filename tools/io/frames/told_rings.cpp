// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/told_rings.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "io/frames/field_aliases.hpp"
#include "io/frames/field_value.hpp"
#include "io/frames/point_position.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kRingsMax = 256;

std::size_t distinct_values(const pose_wall_cloud& cloud, const pose_wall_field& field) {
  std::unordered_set<double> values;
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    for (std::uint32_t column = 0; column < cloud.width && values.size() <= kRingsMax; ++column) {
      const double value = field_value(cloud, row, column, field);
      if (std::isfinite(value)) values.insert(value);
    }
  }
  return values.size() <= kRingsMax ? values.size() : 0;
}

bool is_ring_count(std::uint32_t count) {
  return count == 8 || count == 16 || count == 32 || count == 40 || count == 64 || count == 80 || count == 128;
}

// The beams of a planar scanner lie in a plane through the sensor, whichever way it is mounted. Those of one with more
// rings do not.
bool lie_in_a_plane(const pose_wall_cloud& cloud) {
  constexpr double kOff_rad = 0.035;  // 2 deg: a planar scanner keeps half a degree, four rings of 2 deg have 2.2
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double count = 0.0;
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    for (std::uint32_t column = 0; column < cloud.width; ++column) {
      const Eigen::Vector3d p = point_position(cloud, row, column);
      if (!p.allFinite() || p.isZero(0.0)) continue;
      sum += p.normalized() * p.normalized().transpose();
      count += 1.0;
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(sum, Eigen::EigenvaluesOnly);
  return axes.eigenvalues()[0] <= kOff_rad * kOff_rad * count;
}

struct NamedRings {
  const FrameField* field = nullptr;
  std::size_t count = 0;
};

NamedRings named_rings(const Frame& frame) {
  for (const std::string_view name : field_names(FieldRole::kRing)) {
    for (const FrameField& field : frame.fields) {
      if (field.name != name) continue;
      const std::size_t count = distinct_values(frame.cloud, field.where);
      if (count > 1 || (count == 1 && lie_in_a_plane(frame.cloud))) return {&field, count};
    }
  }
  return {};
}

}  // namespace

std::optional<pose_wall_field> told_ring_field(const Frame& frame) {
  const NamedRings named = named_rings(frame);
  return named.field != nullptr ? std::optional<pose_wall_field>(named.field->where) : std::nullopt;
}

ToldRings told_rings(const Frame& frame) {
  const NamedRings named = named_rings(frame);
  if (named.field != nullptr) return {named.count, fmt::format("field {}", named.field->name)};
  const std::uint32_t rows = std::min(frame.cloud.height, frame.cloud.width);
  return is_ring_count(rows) ? ToldRings{rows, "rows of the cloud"} : ToldRings{};
}

}  // namespace pose_wall::tools
