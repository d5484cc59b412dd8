// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "live/ros_messages/transform_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "bags/message_cursor.hpp"

namespace pose_wall::tools::live {
namespace {

// A quaternion that is further from length 1 is no rotation that somebody meant.
constexpr double kUnitWithin = 0.01;

// Frames of ROS 1 before 2012 began with a slash.
std::string frame_name(std::string_view name) {
  if (!name.empty() && name.front() == '/') name.remove_prefix(1);
  return std::string(name);
}

void pass_over_header_time(MessageCursor& message) {
  if (!message.is_cdr()) message.number<std::uint32_t>("header.seq");
  message.number<std::uint32_t>("header.stamp");
  message.number<std::uint32_t>("header.stamp");
}

std::optional<Eigen::Isometry3d> read_transform(MessageCursor& message) {
  std::array<double, 7> numbers{};
  for (double& number : numbers) number = message.number<double>("transform");
  const Eigen::Quaterniond q(numbers[6], numbers[3], numbers[4], numbers[5]);
  const bool is_number = std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); });
  if (!is_number || std::abs(q.norm() - 1.0) > kUnitWithin) return std::nullopt;
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear() = q.normalized().toRotationMatrix();
  transform.translation() = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
  return transform;
}

}  // namespace

Extrinsic extrinsic_of(const Eigen::Isometry3d& base_from_lidar) {
  const Eigen::Matrix3d R = base_from_lidar.linear();
  Extrinsic extrinsic;
  extrinsic.x_m = base_from_lidar.translation().x();
  extrinsic.y_m = base_from_lidar.translation().y();
  extrinsic.z_m = base_from_lidar.translation().z();
  // At a pitch of 90 degrees roll and yaw turn about one axis: all of it is then told as yaw.
  const double across = std::hypot(R(2, 1), R(2, 2));
  extrinsic.pitch_rad = std::atan2(-R(2, 0), across);
  if (across > 1e-9) {
    extrinsic.roll_rad = std::atan2(R(2, 1), R(2, 2));
    extrinsic.yaw_rad = std::atan2(R(1, 0), R(0, 0));
  } else {
    extrinsic.yaw_rad = std::atan2(-R(0, 1), R(1, 1));
  }
  return extrinsic;
}

void TransformTree::take(MessageEncoding encoding, ByteView bytes, bool is_static, std::int64_t now_ns) {
  MessageCursor message(encoding, bytes, {});
  std::vector<std::pair<std::string, Link>> read;
  const auto count = message.number<std::uint32_t>("transforms");
  for (std::uint32_t i = 0; i < count; ++i) {
    pass_over_header_time(message);
    Link link;
    link.parent = frame_name(message.text("header.frame_id"));
    std::string child = frame_name(message.text("child_frame_id"));
    const std::optional<Eigen::Isometry3d> transform = read_transform(message);
    if (!transform || child.empty() || link.parent.empty() || child == link.parent) continue;
    link.parent_from_child = *transform;
    link.is_static = is_static;
    link.taken_ns = now_ns;
    read.emplace_back(std::move(child), std::move(link));
  }
  for (auto& [child, link] : read) {
    if (links_.size() < kLinksMost || links_.count(child) > 0) links_[child] = std::move(link);
  }
}

std::optional<TransformTree::Root> TransformTree::root_of(const std::string& frame, std::int64_t now_ns) const {
  Root root;
  root.name = frame;
  for (std::size_t steps = 0; steps <= links_.size(); ++steps) {
    const auto found = links_.find(root.name);
    if (found == links_.end()) return root;
    const Link& link = found->second;
    if (!link.is_static && now_ns - link.taken_ns > kOld_ns) return std::nullopt;
    root.root_from_frame = link.parent_from_child * root.root_from_frame;
    root.name = link.parent;
  }
  return std::nullopt;  // a ring
}

std::optional<Extrinsic> TransformTree::extrinsic(const std::string& base_frame, const std::string& lidar_frame,
                                                  std::int64_t now_ns) const {
  const std::optional<Root> of_base = root_of(frame_name(base_frame), now_ns);
  const std::optional<Root> of_lidar = root_of(frame_name(lidar_frame), now_ns);
  if (!of_base || !of_lidar || of_base->name != of_lidar->name) return std::nullopt;
  return extrinsic_of(of_base->root_from_frame.inverse() * of_lidar->root_from_frame);
}

}  // namespace pose_wall::tools::live
