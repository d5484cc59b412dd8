// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The planar scan, the map, the place on it and the obstacle stop as ROS messages, typed as slam_toolbox and Nav2 have
// them. Stamps are those of the clouds' headers.

#pragma once

#include <string>

#include "apps/live/planar/planar_news.hpp"
#include "apps/live/ros_messages/ros_messages.hpp"
#include "io/bags/bag_reader.hpp"
#include "io/config_file/planar_settings.hpp"

namespace pose_wall::tools::live {

class PlanarMessages {
 public:
  PlanarMessages(MessageEncoding encoding, const PlanarSettings& settings, const std::string& base_frame);

  // sensor_msgs/LaserScan in base_frame + "_scan": levelled, at the sensor, its x along base's. NaN is unknown,
  // infinity is open. There must be a scan.
  std::string scan(const RoadwayNews& news) const;
  // nav_msgs/OccupancyGrid.
  std::string map(const RoadwayMap& map) const;
  // geometry_msgs/PoseWithCovarianceStamped. There must be a pose. Variances of 1e6 are not known; those of z,
  // roll and pitch are 0, as AMCL has them.
  std::string pose(const RoadwayNews& news) const;
  // std_msgs/Bool: true is stop.
  std::string stop(const StopNews& news) const;
  std::string stop_state(const StopNews& news) const;
  // tf2_msgs/TFMessage: to base_frame + "_scan" where there is a scan, and by planar_tf from the map. Empty: none.
  std::string transforms(const RoadwayNews& news) const;

 private:
  MessageEncoding encoding_;
  std::string base_frame_, map_frame_, odom_frame_, tf_;
};

}  // namespace pose_wall::tools::live
