// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "info/input_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "frames/field_aliases.hpp"
#include "frames/field_value.hpp"
#include "frames/frame_stamps.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kErrorsKept = 5;
constexpr double kGapIntervals = 1.5;

template <typename Look>
void for_each_point(const pose_wall_cloud& cloud, const Look& look) {
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    for (std::uint32_t column = 0; column < cloud.width; ++column) look(row, column);
  }
}

std::string time_note(const pose_wall_cloud& cloud, const pose_wall_field& field) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for_each_point(cloud, [&](std::uint32_t row, std::uint32_t column) {
    const double value = field_value(cloud, row, column, field);
    least = std::min(least, value);
    most = std::max(most, value);
  });
  const double spread = most - least;
  const double unit_s = spread > 0.0 ? time_unit_s(spread) : 0.0;
  if (unit_s == 0.0) return fmt::format("unit unknown, spreads over {:g}", std::isfinite(spread) ? spread : 0.0);
  const char* const unit = unit_s == 1.0 ? "s" : unit_s == 1e-3 ? "ms" : unit_s == 1e-6 ? "us" : "ns";
  return fmt::format("{}, {:.4f} s a frame{}", unit, spread * unit_s, least * unit_s > 1e6 ? ", absolute" : "");
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
  layout_ = fmt::format("{} x {} points, {} bytes a point, {}-endian", cloud.height, cloud.width, cloud.point_step,
                        cloud.big_endian != 0 ? "big" : "little");
  for (const FrameField& field : frame.fields) {
    const FieldRole role = field_role(field.name);
    const bool taken = role != FieldRole::kNone && is_taken(frame, field, role);
    fields_.push_back({field.name, field.where.offset, field.where.type, taken ? role_name(role, field.name) : "",
                       taken && role == FieldRole::kTime ? time_note(cloud, field.where) : ""});
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
  if (layout_.empty()) {
    describe(frame);
  } else if (!same_fields(layout_fields_, frame.fields)) {
    ++other_layouts_;
  }
  points_.push_back(frame.cloud.width * frame.cloud.height);
  add_ranges(frame.cloud);
  if (sensor_.guess.empty() && points_.back() > 0) sensor_ = sensor_facts(frame);
}

void InputFacts::add_ranges(const pose_wall_cloud& cloud) {
  for_each_point(cloud, [&](std::uint32_t row, std::uint32_t column) {
    const double range_m =
        std::hypot(field_value(cloud, row, column, cloud.x), field_value(cloud, row, column, cloud.y),
                   field_value(cloud, row, column, cloud.z));
    ++all_points_;
    if (!std::isfinite(range_m)) {
      ++not_finite_;
    } else if (range_m == 0.0) {
      ++zero_;
    } else {
      range_min_m_ = returns_ == 0 ? range_m : std::min(range_min_m_, range_m);
      range_max_m_ = std::max(range_max_m_, range_m);
      ++returns_;
      ++range_counts_[std::min(kBins - 1, static_cast<std::size_t>(std::min(range_m, 1e6) * kBinsPerMetre))];
    }
  });
}

StampFacts InputFacts::stamps() const {
  StampFacts facts;
  facts.count = stamps_.size();
  if (stamps_.empty()) return facts;
  facts.first_ns = stamps_.front();
  facts.last_ns = stamps_.back();
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < stamps_.size(); ++i) {
    if (stamps_[i] > stamps_[i - 1]) {
      steps_s.push_back(seconds_between(stamps_[i - 1], stamps_[i]));
    } else {
      ++facts.backwards;
    }
  }
  if (steps_s.empty()) return facts;
  std::sort(steps_s.begin(), steps_s.end());
  facts.interval_s = steps_s[steps_s.size() / 2];
  facts.longest_s = steps_s.back();
  facts.gaps = static_cast<std::size_t>(std::count_if(
      steps_s.begin(), steps_s.end(), [&](double step_s) { return step_s > kGapIntervals * facts.interval_s; }));
  return facts;
}

std::optional<RangeFacts> InputFacts::ranges() const {
  if (returns_ == 0) return std::nullopt;
  std::uint64_t below = 0;
  std::size_t bin = 0;
  while (bin + 1 < kBins && below + range_counts_[bin] <= returns_ / 2) below += range_counts_[bin++];
  const double median_m = (static_cast<double>(bin) + 0.5) / kBinsPerMetre;
  return RangeFacts{range_min_m_, std::clamp(median_m, range_min_m_, range_max_m_), range_max_m_};
}

double InputFacts::zero_share() const {
  return all_points_ > 0 ? static_cast<double>(zero_) / static_cast<double>(all_points_) : 0.0;
}

double InputFacts::not_finite_share() const {
  return all_points_ > 0 ? static_cast<double>(not_finite_) / static_cast<double>(all_points_) : 0.0;
}

}  // namespace pose_wall::tools
