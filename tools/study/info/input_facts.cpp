// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/info/input_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/frames/field_aliases.hpp"
#include "io/frames/field_value.hpp"
#include "io/frames/point_position.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kErrorsKept = 5;
constexpr double kAbsoluteFrom_s = 1e6;  // no scan takes so long: such times count from 1970

template <typename Visit>
void for_each_point(const pose_wall_cloud& cloud, const Visit& visit) {
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    for (std::uint32_t column = 0; column < cloud.width; ++column) visit(row, column);
  }
}

TimeFacts time_facts(const pose_wall_cloud& cloud, const pose_wall_field& field) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for_each_point(cloud, [&](std::uint32_t row, std::uint32_t column) {
    const double value = field_value(cloud, row, column, field);
    least = std::min(least, value);
    most = std::max(most, value);
  });
  TimeFacts facts;
  facts.spread = std::isfinite(most - least) ? most - least : 0.0;
  const double unit_s = facts.spread > 0.0 ? time_unit_s(facts.spread) : 0.0;
  if (unit_s == 0.0) return facts;
  facts.unit = unit_s == 1.0 ? "s" : unit_s == 1e-3 ? "ms" : unit_s == 1e-6 ? "us" : "ns";
  facts.spread_s = facts.spread * unit_s;
  facts.is_absolute = least * unit_s > kAbsoluteFrom_s;
  return facts;
}

const char* role_name(FieldRole role, const std::string& name) {
  switch (role) {
    case FieldRole::kCoordinate:
      return name == "x" ? "x" : name == "y" ? "y" : "z";
    case FieldRole::kIntensity:
      return "intensity";
    case FieldRole::kTime:
      return "time";
    case FieldRole::kRing:
      return "ring";
    case FieldRole::kNone:
      break;
  }
  return "";
}

bool is_taken(const Frame& frame, const FrameField& field, FieldRole role) {
  for (const std::string_view name : field_names(role)) {
    if (role == FieldRole::kCoordinate) return true;
    for (const FrameField& other : frame.fields) {
      if (other.name == name) return other.name == field.name;
    }
  }
  return false;
}

bool same_fields(const std::vector<FrameField>& a, const std::vector<FrameField>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const FrameField& p, const FrameField& q) {
    return p.name == q.name && p.where.offset == q.where.offset && p.where.type == q.where.type;
  });
}

}  // namespace

void InputFacts::describe(const Frame& frame) {
  const pose_wall_cloud& cloud = frame.cloud;
  layout_fields_ = frame.fields;
  layout_ = LayoutFacts{cloud.height, cloud.width, cloud.point_step, cloud.big_endian != 0};
  for (const FrameField& field : frame.fields) {
    const FieldRole role = field_role(field.name);
    const bool taken = role != FieldRole::kNone && is_taken(frame, field, role);
    FieldFacts facts{field.name, field.where.offset, field.where.type, taken ? role_name(role, field.name) : "", {}};
    if (taken && role == FieldRole::kTime) facts.times = time_facts(cloud, field.where);
    fields_.push_back(std::move(facts));
  }
}

void InputFacts::add(const SourcedFrame& sourced) {
  ++frames_;
  if (!sourced.frame) {
    ++unreadable_;
    if (errors_.size() < kErrorsKept) errors_.push_back(fmt::format("{}: {}", sourced.name, sourced.error));
    return;
  }
  const Frame& frame = *sourced.frame;
  if (sourced.stamp_ns) stamps_.push_back(*sourced.stamp_ns);
  if (!layout_) {
    describe(frame);
  } else if (!same_fields(layout_fields_, frame.fields)) {
    ++other_layouts_;
  }
  points_.push_back(frame.cloud.width * frame.cloud.height);
  count_points(frame.cloud);
  sensor_.add(returns_of(frame.cloud), told_rings(frame));
  times_.add(frame);
}

void InputFacts::count_points(const pose_wall_cloud& cloud) {
  for_each_point(cloud, [&](std::uint32_t row, std::uint32_t column) {
    const Eigen::Vector3d p = point_position(cloud, row, column);
    ++all_points_;
    if (!p.allFinite()) {
      ++not_finite_;
    } else if (p.isZero(0.0)) {
      ++zero_;
    }
  });
}

StampFacts InputFacts::stamps() const {
  StampFacts facts;
  facts.count = stamps_.size();
  if (stamps_.empty()) return facts;
  facts.first_ns = stamps_.front();
  facts.last_ns = stamps_.back();
  facts.steps = look_at_steps(stamps_);
  return facts;
}

double InputFacts::zero_share() const {
  return all_points_ > 0 ? static_cast<double>(zero_) / static_cast<double>(all_points_) : 0.0;
}

double InputFacts::not_finite_share() const {
  return all_points_ > 0 ? static_cast<double>(not_finite_) / static_cast<double>(all_points_) : 0.0;
}

}  // namespace pose_wall::tools
