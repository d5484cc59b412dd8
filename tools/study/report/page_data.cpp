// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/report/page_data.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/config_file/resolved_frames.hpp"
#include "io/frames/point_position.hpp"
#include "io/picture/parts.hpp"
#include "study/steer/steer_cause.hpp"

namespace pose_wall::tools::report {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
// Beside pose_wall_label.
constexpr std::uint8_t kDropped = 4;
// Beside pose_wall_state: what the engine never saw is not invalid, which would be its word.
constexpr std::uint32_t kUnreadable = POSE_WALL_VALID + 1;
// Of the points of a frame, at most one in so many may be dropped ones.
constexpr std::size_t kDroppedShare = 8;

std::int16_t centimetres(double metres) {
  constexpr double kMost = 32767.0;
  return static_cast<std::int16_t>(std::lround(std::clamp(100.0 * metres, -kMost, kMost)));
}

}  // namespace

PageData::PageData(const api::Config& config, std::size_t frames, std::size_t points_max)
    : config_(config), mount_(config), choice_(frames, points_max) {}

void PageData::look(const pose_wall_cloud& cloud, const pose_wall_points& points, const pose_wall_result& result) {
  if (!choice_.takes(frames(), result)) return;
  const picture::DrawnFrame frame(*config_.get(), result);
  cloud_frame_.add(frames());
  cloud_first_.add(point_label_.size());
  const std::size_t most = choice_.points_per_frame();
  add_dropped(cloud, frame, most / kDroppedShare);
  const std::size_t rest = most - most / kDroppedShare;
  const std::size_t stride = std::max<std::size_t>(1, (points.count + rest - 1) / rest);
  for (std::size_t i = 0; i < points.count; i += stride) {
    add_point(frame.from_base(points.x_base_m[i], points.y_base_m[i], points.z_base_m[i]), points.label[i]);
  }
}

void PageData::add_dropped(const pose_wall_cloud& cloud, const picture::DrawnFrame& frame, std::size_t most) {
  std::vector<Eigen::Vector3d> dropped;
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    for (std::uint32_t column = 0; column < cloud.width; ++column) {
      const Eigen::Vector3d p_lidar = point_position(cloud, row, column), p = mount_.to_base(p_lidar);
      const double range_m = p_lidar.norm();
      // The default of a sensor for what did not come back is no point.
      if (std::isfinite(range_m) && range_m > 0.0 && !mount_.is_used(range_m, p)) dropped.push_back(p);
    }
  }
  const std::size_t stride = std::max<std::size_t>(1, (dropped.size() + most - 1) / std::max<std::size_t>(1, most));
  for (std::size_t i = 0; i < dropped.size(); i += stride) {
    add_point(frame.from_base(dropped[i].x(), dropped[i].y(), dropped[i].z()), kDropped);
  }
}

void PageData::add_point(const picture::Drawn& p, std::uint8_t label) {
  for (const double metres : {p.along, p.left, p.up}) point_cm_.add(centimetres(metres));
  point_label_.add(label);
}

void PageData::add(const FrameOutcome& outcome) {
  sources_.push_back(outcome.source);
  errors_.push_back(outcome.error);
  // What stays of a frame that could not be read: nothing of it is known.
  pose_wall_result result = api::make_result();
  for (pose_wall_value& value : result.quantity) {
    value.value = value.raw = value.sigma = value.protection_level = value.confidence = value.age_s = kNone;
    value.raw_protection_level = kNone;
    std::fill(std::begin(value.part), std::end(value.part), kNone);
    value.state = kUnreadable;
    value.cause = POSE_WALL_PARTS;
  }
  if (outcome.result) {
    result = *outcome.result;
    std::copy(std::begin(result.positive_means), std::end(result.positive_means), positive_means_.begin());
  }
  add_values(result);
  stamp_s_.add(1e-9 * static_cast<double>(outcome.stamp_ns));
  engine_ms_.add(outcome.result ? outcome.total_ms : kNone);
  confidence_.add(result.confidence);
  frame_reasons_.add(result.frame_reasons);
  add_planes(result);
  add_machine(picture::DrawnFrame(*config_.get(), result));
  for (const std::int64_t ns : result.stage_ns) stage_ms_.add(1e-6 * static_cast<double>(ns));
  for (const std::uint32_t count :
       {result.points_in, result.dropped_not_finite, result.dropped_zero, result.dropped_near, result.dropped_far,
        result.dropped_body, result.voxels, result.outliers, result.open_points, result.wall_points}) {
    counts_.add(count);
  }
}

void PageData::add_truth(const std::vector<const TruthRow*>& truth) {
  for (const TruthRow* row : truth) {
    for (std::size_t q = 0; q < kTruthQuantities; ++q) truth_.add(row != nullptr ? row->value[q] : kNone);
  }
}

void PageData::add_values(const pose_wall_result& result) {
  for (const pose_wall_value& value : result.quantity) {
    value_.add(value.value);
    raw_.add(value.raw);
    sigma_.add(value.sigma);
    level_.add(value.protection_level);
    raw_level_.add(value.raw_protection_level);
    for (const double part : value.part) part_.add(part);
    cause_.add(value.cause);
    steer_.add(steer_cause(value));
    age_s_.add(value.age_s);
    state_.add(value.state);
    reasons_.add(value.reasons);
  }
}

void PageData::add_planes(const pose_wall_result& result) {
  const picture::DrawnFrame frame(*config_.get(), result);
  for (const pose_wall_plane* plane : {&result.left, &result.right}) {
    const picture::DrawnPlane wall = frame.wall(*plane);
    for (const double number : {wall.found ? 1.0 : 0.0, wall.normal.along, wall.normal.left, wall.normal.up, wall.d_m,
                                wall.extent_min_m, wall.extent_max_m, plane->rms_m}) {
      planes_.add(number);
    }
  }
  for (const double number : {frame.has_floor() ? 1.0 : 0.0, frame.floor_up_m(), frame.has_yaw() ? 1.0 : 0.0}) {
    floor_.add(number);
  }
}

// Four corners of the machine's outline, the sensor, and the four sampling points.
void PageData::add_machine(const picture::DrawnFrame& frame) {
  const auto add = [this](const picture::Drawn& p) {
    for (const double metres : {p.along, p.left, p.up}) machine_.add(metres);
  };
  const double nose = 0.5 * picture::kMachineLength_m, flank = 0.5 * picture::kMachineWidth_m;
  for (const auto& [forward, left] :
       {std::pair(nose, flank), std::pair(nose, -flank), std::pair(-nose, -flank), std::pair(-nose, flank)}) {
    add(frame.from_machine(forward, left, 0.0));
  }
  const Eigen::Vector3d& sensor = mount_.position_base_m();
  add(frame.from_base(sensor.x(), sensor.y(), sensor.z()));
  for (const Vector3& point : resolve_frames(config_).sampling_points_base_m) {
    add(frame.from_base(point[0], point[1], point[2]));
  }
}

Json PageData::json() const {
  return {{"frames", frames()},
          {"source", sources_},
          {"error", errors_},
          {"value", value_.text()},
          {"raw", raw_.text()},
          {"sigma", sigma_.text()},
          {"level", level_.text()},
          {"raw_level", raw_level_.text()},
          {"part", part_.text()},
          {"cause", cause_.text()},
          {"steer", steer_.text()},
          {"positive_means", positive_means_},
          {"age_s", age_s_.text()},
          {"truth", truth_.text()},
          {"state", state_.text()},
          {"reasons", reasons_.text()},
          {"stamp_s", stamp_s_.text()},
          {"engine_ms", engine_ms_.text()},
          {"confidence", confidence_.text()},
          {"frame_reasons", frame_reasons_.text()},
          {"planes", planes_.text()},
          {"floor", floor_.text()},
          {"machine", machine_.text()},
          {"stage_ms", stage_ms_.text()},
          {"counts", counts_.text()},
          {"cloud_frame", cloud_frame_.text()},
          {"cloud_first", cloud_first_.text()},
          {"point_cm", point_cm_.text()},
          {"point_label", point_label_.text()}};
}

}  // namespace pose_wall::tools::report
