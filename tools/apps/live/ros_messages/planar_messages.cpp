// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros_messages/planar_messages.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "apps/live/planar/stop_guard.hpp"
#include "apps/live/ros_messages/ros_writer.hpp"
#include "pose_wall_planar_scan.h"
#include "study/planar/plane_pose.hpp"

namespace pose_wall::tools::live {
namespace {

struct Link {
  std::string parent, child;
  pose_wall_planar_pose pose;
};

// geometry_msgs/Pose and Transform alike: three numbers of a place, four of a turn.
void put_pose(RosWriter* message, const pose_wall_planar_pose& pose) {
  for (const double number :
       {pose.x_m, pose.y_m, 0.0, 0.0, 0.0, std::sin(0.5 * pose.yaw_rad), std::cos(0.5 * pose.yaw_rad)}) {
    message->number(number);
  }
}

std::string frame_of_scan(const std::string& base_frame) {
  return base_frame + "_scan";
}

}  // namespace

PlanarMessages::PlanarMessages(MessageEncoding encoding, const PlanarSettings& settings, const std::string& base_frame)
    : encoding_(encoding),
      base_frame_(without_slash(base_frame)),
      map_frame_(without_slash(settings.map_frame)),
      odom_frame_(without_slash(settings.odom_frame)),
      tf_(settings.tf) {}

std::string PlanarMessages::scan(const RoadwayNews& news) const {
  pose_wall_planar_scan scan = news.scan;
  scan.range_m = news.range_m.data();
  pose_wall_planar_laserscan laser{};
  static_cast<void>(pose_wall_planar_laserscan_of(&scan, &laser));
  RosWriter message(encoding_);
  message.header(news.header_stamp_ns, frame_of_scan(base_frame_));
  for (const float number : {laser.angle_min, laser.angle_max, laser.angle_increment, laser.time_increment,
                             laser.scan_time, laser.range_min, laser.range_max}) {
    message.number(number);
  }
  message.count(news.range_m.size());
  for (const float range_m : news.range_m) message.number(range_m);
  message.count(0);  // intensities
  return message.take();
}

std::string PlanarMessages::map(const RoadwayMap& map) const {
  RosWriter message(encoding_);
  message.header(map.header_stamp_ns, map_frame_);
  message.time(map.header_stamp_ns);
  message.number(static_cast<float>(map.resolution_m));
  message.number(map.width);
  message.number(map.height);
  put_pose(&message, {map.origin_x_m, map.origin_y_m, 0.0});
  message.block({reinterpret_cast<const char*>(map.cells.data()), map.cells.size()});
  return message.take();
}

std::string PlanarMessages::pose(const RoadwayNews& news) const {
  // Of x, y, z and the turns about them; ours are x, y and the turn about z.
  constexpr std::size_t kAll = 6;
  constexpr std::array<std::size_t, 3> kOurs = {0, 1, 5};
  // m2 and rad2, as drivers of ROS give for axes that nobody measures: who fuses it gives it no weight. Zeros would
  // make it exact to robot_localization and others.
  constexpr double kUnknown = 1e6;
  const bool is_known = news.covariance[0] > 0.0;
  std::array<double, kAll * kAll> covariance{};
  for (std::size_t row = 0; row < kOurs.size(); ++row) {
    for (std::size_t column = 0; column < kOurs.size(); ++column) {
      const double unknown = row == column ? kUnknown : 0.0;
      covariance[kOurs[row] * kAll + kOurs[column]] = is_known ? news.covariance[row * kOurs.size() + column] : unknown;
    }
  }
  RosWriter message(encoding_);
  message.header(news.header_stamp_ns, map_frame_);
  put_pose(&message, *news.pose);
  for (const double number : covariance) message.number(number);
  return message.take();
}

std::string PlanarMessages::stop(const StopNews& news) const {
  RosWriter message(encoding_);
  const bool is_stop = news.result.state != POSE_WALL_PLANAR_STOP_SLOW && news.result.state != POSE_WALL_PLANAR_STOP_GO;
  message.number(static_cast<std::uint8_t>(is_stop ? 1 : 0));
  return message.take();
}

std::string PlanarMessages::stop_state(const StopNews& news) const {
  const pose_wall_planar_stop_result& result = news.result;
  const bool has_frame = result.frames > 0;
  RosWriter message(encoding_);
  message.header(news.header_stamp_ns, base_frame_);
  message.number(static_cast<std::uint8_t>(result.state));
  message.number(news.rounds);
  message.number(has_frame ? static_cast<double>(result.now_ns - result.stamp_ns) * 1e-9 : std::nan(""));
  message.number(result.allowed_speed_m_s);
  message.number(result.reasons);
  message.text(stop_reasons_text(result.reasons));
  message.number(has_frame ? result.time_to_contact_s : std::nan(""));
  for (const double number : {result.nearest_m[0], result.nearest_m[1], result.nearest_distance_m}) {
    message.number(has_frame ? number : std::nan(""));
  }
  return message.take();
}

std::string PlanarMessages::transforms(const RoadwayNews& news) const {
  std::vector<Link> links;
  if (news.has_scan) {
    links.push_back({base_frame_ + "_level", frame_of_scan(base_frame_), news.scan.sensor});
  }
  if (news.pose && tf_ == "base") links.push_back({map_frame_, base_frame_, *news.pose});
  if (news.pose && news.odometry && tf_ == "odom") {
    const pose_wall_planar_pose odom_in_base = seen_from(*news.odometry, {0.0, 0.0, 0.0});
    links.push_back({map_frame_, odom_frame_, combined(*news.pose, odom_in_base)});
  }
  if (news.odometry && tf_ == "odom") links.push_back({odom_frame_, base_frame_, *news.odometry});
  if (links.empty()) return "";
  RosWriter message(encoding_);
  message.count(links.size());
  for (const Link& link : links) {
    message.header(news.header_stamp_ns, link.parent);
    message.text(link.child);
    put_pose(&message, link.pose);
  }
  return message.take();
}

}  // namespace pose_wall::tools::live
