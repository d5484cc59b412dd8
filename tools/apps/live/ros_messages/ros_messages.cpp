// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros_messages/ros_messages.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "apps/live/ros_messages/ros_writer.hpp"
#include "io/numbers/quantities.hpp"
#include "study/results/result_csv.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr std::uint8_t kFloat32 = POSE_WALL_FIELD_FLOAT32, kUint8 = POSE_WALL_FIELD_UINT8;  // numbered as PointField

// "a/B" becomes a + between + B.
std::string joined(const std::string& name, const char* between) {
  const std::size_t slash = name.find('/');
  return name.substr(0, slash) + between + name.substr(slash + 1);
}

double value_or_nan(const pose_wall_value& value) {
  return value.state == POSE_WALL_INVALID ? std::numeric_limits<double>::quiet_NaN() : value.value;
}

double seconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-9;
}

}  // namespace

std::string RosType::ros2_name() const {
  return joined(name, "/msg/");
}

std::string RosType::dds_name() const {
  return joined(name, "::msg::dds_::") + "_";
}

RosMessages::RosMessages(MessageEncoding encoding, std::string base_frame)
    : encoding_(encoding), base_frame_(without_slash(std::move(base_frame))) {}

RosWriter RosMessages::begin(std::int64_t stamp_ns, const std::string& frame_id) const {
  RosWriter writer(encoding_);
  writer.header(stamp_ns, frame_id);
  return writer;
}

std::string RosMessages::attitude(const LiveResult& result) const {
  RosWriter message = begin(result.header_stamp_ns, base_frame_);
  for (const std::size_t q : {POSE_WALL_ROLL, POSE_WALL_PITCH, POSE_WALL_YAW}) {
    message.number(value_or_nan(result.publication.result.quantity[q]));
  }
  return message.take();
}

std::string RosMessages::distances(const LiveResult& result) const {
  constexpr std::uint32_t kDistances = 4;  // d_lf, d_lb, d_rf, d_rb
  std::string labels;
  for (std::uint32_t i = 0; i < kDistances; ++i) {
    labels += std::string(i > 0 ? " " : "") + pose_wall_quantity_name(POSE_WALL_D_LF + i);
  }
  RosWriter message(encoding_);
  message.count(1);
  message.text(labels);
  message.number(kDistances);        // size
  message.number(kDistances);        // stride
  message.number(std::uint32_t{0});  // data_offset
  message.count(kDistances);
  for (std::uint32_t i = 0; i < kDistances; ++i) {
    message.number(static_cast<float>(value_or_nan(result.publication.result.quantity[POSE_WALL_D_LF + i])));
  }
  return message.take();
}

std::string RosMessages::state(const LiveResult& result) const {
  const pose_wall_publication& publication = result.publication;
  const pose_wall_result& r = publication.result;
  RosWriter message = begin(result.header_stamp_ns, base_frame_);
  message.number(static_cast<std::uint8_t>(publication.cause));
  message.number(publication.frame);
  message.number(publication.index);
  message.number(seconds(publication.age_ns));
  message.number(publication.thinning);
  message.number(publication.held_thinning);
  message.number(r.confidence);
  message.number(r.frame_reasons);
  message.text(reason_names(r.frame_reasons));
  message.number(r.source_id);
  message.number(r.config_crc32);
  message.count(POSE_WALL_QUANTITIES);
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value& value = r.quantity[q];
    message.text(pose_wall_quantity_name(q));
    message.number(static_cast<std::uint8_t>(value.state));
    message.number(value_or_nan(value));
    message.number(value.protection_level);
    message.number(value.raw);
    message.number(value.raw_protection_level);
    message.number(value.sigma);
    message.number(value.confidence);
    message.number(value.age_s);
    message.number(value.reasons);
    message.text(reason_names(value.reasons));
    message.text(cause_name(value));
  }
  return message.take();
}

std::string RosMessages::diagnostics(const std::vector<PartHealth>& parts, std::int64_t now_ns) const {
  RosWriter message = begin(now_ns, "");
  message.count(parts.size());
  for (const PartHealth& part : parts) {
    message.number(static_cast<std::uint8_t>(part.grade));
    message.text("pose_walld: " + part.part);
    message.text(part.summary);
    message.text("pose_wall");
    message.count(part.facts.size());
    for (const auto& [name, value] : part.facts) message.key_value(name, value);
  }
  return message.take();
}

bool RosMessages::has_level(const LiveResult& result) {
  // Where the frame has no floor the matrix is the identity, though roll and pitch may be held.
  const pose_wall_result& r = result.publication.result;
  return result.publication.cause == POSE_WALL_RUNTIME_FRAME && r.floor.found != 0 &&
         std::min(r.quantity[POSE_WALL_ROLL].state, r.quantity[POSE_WALL_PITCH].state) >= POSE_WALL_DEGRADED;
}

std::string RosMessages::level_transform(const LiveResult& result) const {
  Eigen::Matrix3d R_level_base;
  for (int i = 0; i < 9; ++i) R_level_base(i / 3, i % 3) = result.publication.result.R_level_base[i];
  const Eigen::Quaterniond q_base_level(Eigen::Matrix3d(R_level_base.transpose()));
  RosWriter message(encoding_);
  message.count(1);
  // A transform's header stands behind the count, so that alignment goes on from there.
  message.header(result.header_stamp_ns, base_frame_);
  message.text(base_frame_ + "_level");
  for (int i = 0; i < 3; ++i) message.number(0.0);
  for (const double part : {q_base_level.x(), q_base_level.y(), q_base_level.z(), q_base_level.w()}) {
    message.number(part);
  }
  return message.take();
}

std::string RosMessages::points(const LiveResult& result) const {
  constexpr std::uint32_t kStep = 16;  // three floats, the label, and three bytes to keep floats aligned
  const LabelledPoints& points = *result.points;
  const auto count = static_cast<std::uint32_t>(points.label.size());
  RosWriter message = begin(result.header_stamp_ns, base_frame_);
  message.number(std::uint32_t{1});
  message.number(count);
  message.count(4);
  message.field("x", 0, kFloat32);
  message.field("y", 4, kFloat32);
  message.field("z", 8, kFloat32);
  message.field("label", 12, kUint8);
  message.number(std::uint8_t{0});
  message.number(kStep);
  message.number(kStep * count);
  std::string data(std::size_t{kStep} * count, '\0');
  for (std::size_t i = 0; i < count; ++i) {
    char* at = data.data() + kStep * i;
    std::memcpy(at, &points.x_base_m[i], 4);
    std::memcpy(at + 4, &points.y_base_m[i], 4);
    std::memcpy(at + 8, &points.z_base_m[i], 4);
    at[12] = static_cast<char>(points.label[i]);
  }
  message.block(data);
  message.number(std::uint8_t{1});  // dense
  return message.take();
}

std::string RosMessages::cloud(const LiveFrame& frame) const {
  const pose_wall_cloud& cloud = frame.frame.cloud;
  const std::uint32_t row_step = cloud.row_step != 0 ? cloud.row_step : cloud.width * cloud.point_step;
  RosWriter message = begin(frame.stamp_ns, frame.frame_id);
  message.number(cloud.height);
  message.number(cloud.width);
  message.count(frame.frame.fields.size());
  for (const FrameField& field : frame.frame.fields) {
    message.field(field.name.c_str(), field.where.offset, static_cast<std::uint8_t>(field.where.type));
  }
  message.number(static_cast<std::uint8_t>(cloud.big_endian));
  message.number(cloud.point_step);
  message.number(row_step);
  message.block({static_cast<const char*>(cloud.data), static_cast<std::size_t>(cloud.data_bytes)});
  message.number(std::uint8_t{0});
  return message.take();
}

}  // namespace pose_wall::tools::live
