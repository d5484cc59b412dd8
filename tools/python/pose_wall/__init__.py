# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""How a tunnelling machine stands in its roadway, from one LiDAR: the engine and its runtime for Python.

    import pose_wall
    engine = pose_wall.Engine(pose_wall.Config({"forward_axis": "+X"}))
    result = engine.process(pose_wall.read_pcd("frame.pcd"), stamp_ns=0)
    print(result.yaw.value, result.yaw.protection_level, result.yaw.state.name)

What the numbers mean is said in pose_wall.h; angles are in rad, lengths in m."""

from ._library import LIBRARY as _LIBRARY
from ._library import Error
from .config import KEYS, Config
from .engine import Engine, image_bytes, inputs
from .pcd import read_pcd
from .result import NAMES, Plane, Reason, Result, State, Value, explain
from .runtime import Publication, Runtime

__version__ = _LIBRARY.pose_wall_version().decode()
__all__ = ["Config", "Engine", "Error", "KEYS", "NAMES", "Plane", "Publication", "Reason", "Result", "Runtime", "State",
           "Value", "explain", "image_bytes", "inputs", "read_pcd"]
