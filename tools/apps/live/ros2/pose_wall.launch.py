# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""ros2 launch tools/apps/live/ros2/pose_wall.launch.py topic:=/ouster/points

pose_walld is a program beside ROS, not a package of it: it is taken from PATH, with libraries of Debian. A file of
parameters (`params`) holds keys of the daemon by their own names."""

import os

import yaml
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration

HERE = os.path.dirname(os.path.abspath(__file__))
ARGUMENTS = (("topic", "/lidar/points", "PointCloud2 or Livox's CustomMsg, in the sensor's frame"),
             ("config", "/etc/pose_wall/pose_wall.yaml", "its forward_axis and extrinsic must fit the machine"),
             ("extrinsic_from", "config", "config; tf: the transform from the cloud's frame to base_frame"),
             ("ros_distro", "humble", "humble; iron: Iron and all later ones"),
             ("params", os.path.join(HERE, "pose_wall.params.yaml"), "keys of the daemon; they go over the arguments"),
             ("rviz", "false", "true: show points and the levelled frame"))
YES_OR_NO = {"true": "1", "false": "0"}  # of ROS, and of the daemon's keys
NODES = ("/pose_walld", "pose_walld", "/**")  # under any of these names a file of parameters means the node


def settings(params):
    """The parameters as words of pose_walld: --set KEY=VALUE."""
    with open(params, encoding="utf-8") as file:
        read = yaml.load(file, yaml.BaseLoader) or {}  # as written: `off` is a word of some keys, and no falsehood
    words = []
    for node in NODES:
        for key, value in ((read.get(node) or {}).get("ros__parameters") or {}).items():
            if not isinstance(value, str):
                raise ValueError(f"{params}: {key} has more than one value")
            words += ["--set", f"{key}={YES_OR_NO.get(value, value)}"]
    return words


def daemon(context):
    def value(name):
        return LaunchConfiguration(name).perform(context)
    return [ExecuteProcess(
        cmd=["pose_walld", "--config", value("config"), "--set", "source=ros2", "--set", "ros2=1",
             "--set", f"pointcloud_topic={value('topic')}", "--set", f"extrinsic_from={value('extrinsic_from')}",
             "--set", f"ros_distro={value('ros_distro')}", *settings(value("params"))],
        # ROS has a libddsc of its own, which must not come into this process.
        additional_env={"LD_LIBRARY_PATH": ""}, output="screen", respawn=True, respawn_delay=2.0)]


def generate_launch_description():
    rviz = ExecuteProcess(cmd=["rviz2", "-d", os.path.join(HERE, "pose_wall.rviz")],
                          condition=IfCondition(LaunchConfiguration("rviz")))
    arguments = [DeclareLaunchArgument(name, default_value=default, description=text)
                 for name, default, text in ARGUMENTS]
    return LaunchDescription([*arguments, OpaqueFunction(function=daemon), rviz])
