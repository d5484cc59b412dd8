// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros_messages/transform_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "io/bags/message_cursor.hpp"

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

std::vector<TransformTree::Step> TransformTree::chain_of(const std::string& frame) const {
  std::vector<Step> chain = {{frame, Eigen::Isometry3d::Identity(), nullptr}};
  while (chain.size() <= kStepsMost) {
    const auto found = links_.find(chain.back().frame);
    if (found == links_.end()) break;
    const Link& link = found->second;
    chain.push_back({link.parent, link.parent_from_child * chain.back().here_from_first, &link});
  }
  return chain;
}

bool TransformTree::is_fresh(const std::vector<Step>& chain, std::size_t end, std::int64_t now_ns) {
  return std::all_of(chain.begin() + 1, chain.begin() + static_cast<std::ptrdiff_t>(end) + 1,
                     [&](const Step& step) { return step.link->is_static || now_ns - step.link->taken_ns <= kOld_ns; });
}

std::optional<Extrinsic> TransformTree::extrinsic(const std::string& base_frame, const std::string& lidar_frame,
                                                  std::int64_t now_ns) const {
  const std::vector<Step> of_lidar = chain_of(frame_name(lidar_frame)), of_base = chain_of(frame_name(base_frame));
  for (std::size_t i = 0; i < of_lidar.size(); ++i) {
    for (std::size_t k = 0; k < of_base.size(); ++k) {
      if (of_lidar[i].frame != of_base[k].frame) continue;
      // What is above the frame where both meet is the machine's place in the world: it may be as old as it likes.
      if (!is_fresh(of_lidar, i, now_ns) || !is_fresh(of_base, k, now_ns)) return std::nullopt;
      return extrinsic_of(of_base[k].here_from_first.inverse() * of_lidar[i].here_from_first);
    }
  }
  return std::nullopt;
}

}  // namespace pose_wall::tools::live
