# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""ros2 launch tools/apps/live/ros2/pose_wall.launch.py topic:=/ouster/points

pose_walld is a program beside ROS, not a package of it: it is taken from PATH, with libraries of Debian."""

import os

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration

HERE = os.path.dirname(os.path.abspath(__file__))
ARGUMENTS = (("topic", "/lidar/points", "PointCloud2 or Livox's CustomMsg, in the sensor's frame"),
             ("config", "/etc/pose_wall/pose_wall.yaml", "its forward_axis and extrinsic must fit the machine"),
             ("extrinsic_from", "config", "config; tf: the transform from the cloud's frame to base_frame"),
             ("ros_distro", "humble", "humble; iron: Iron and all later ones"),
             ("rviz", "false", "true: show points and the levelled frame"))


def generate_launch_description():
    value = LaunchConfiguration
    daemon = ExecuteProcess(
        cmd=["pose_walld", "--config", value("config"), "--set", "source=ros2", "--set", "ros2=1",
             "--set", ["pointcloud_topic=", value("topic")], "--set", ["extrinsic_from=", value("extrinsic_from")],
             "--set", ["ros_distro=", value("ros_distro")]],
        # ROS has a libddsc of its own, which must not come into this process.
        additional_env={"LD_LIBRARY_PATH": ""}, output="screen", respawn=True, respawn_delay=2.0)
    rviz = ExecuteProcess(cmd=["rviz2", "-d", os.path.join(HERE, "pose_wall.rviz")],
                          condition=IfCondition(value("rviz")))
    arguments = [DeclareLaunchArgument(name, default_value=default, description=text)
                 for name, default, text in ARGUMENTS]
    return LaunchDescription([*arguments, daemon, rviz])
