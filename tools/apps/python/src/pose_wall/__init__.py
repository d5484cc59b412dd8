# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""pose_wall: how a tunnelling machine stands in its roadway, from one 3D LiDAR; for those who replay and tune.

    engine = pose_wall.Engine(pose_wall.Config.load("pose_wall.yaml", set={"yaw_max_deg": 40}))
    for frame in pose_wall.read_frames("road/frames"):
        result = engine.process(frame.points, stamp_ns=frame.stamp_ns)
        print(result.yaw.value, result.yaw.protection_level, result.yaw.state.name)

Angles in rad, lengths in m, stamps in ns; NaN where there is no number. A refused call raises pose_wall.Error."""

from ._abi import (Activity, Cause, Drop, KeyType, Label, Part, Quantity, Reason, RuntimeState, Sense, Stage, State,
                   Status, Wish)
from ._library import VERSION as __version__
from ._library import Error, status_text
from ._pcd_header import PcdError
from ._yaml import YamlError
from .cloud import CloudView, Inputs
from .config import KEYS, Config, ConfigError, KeyInfo, UnknownKey
from .engine import Engine, Moment, Points, SelfTest, self_test
from .process_image import image2_bytes, image_bytes, read_image
from .pcd import Frame, read_frames, read_pcd
from .publication import Publication, Statistics, Times
from .result import QUANTITIES, Counts, Plane, Result, Value, reason_names, reason_texts
from .runtime import Runtime, RuntimeOptions, StaleError

__all__ = [
    "Activity", "Cause", "CloudView", "Config", "ConfigError", "Counts", "Drop", "Engine", "Error", "Frame", "Inputs",
    "KEYS", "KeyInfo", "KeyType", "Label", "Moment", "Part", "PcdError", "Plane", "Points", "Publication", "QUANTITIES",
    "Quantity", "Reason", "Result", "Runtime", "RuntimeOptions", "RuntimeState", "SelfTest", "Sense", "Stage",
    "StaleError", "State", "Statistics", "Status", "Times", "UnknownKey", "Value", "Wish", "YamlError", "__version__",
    "image2_bytes", "image_bytes", "read_frames", "read_image", "read_pcd", "reason_names", "reason_texts", "self_test",
    "status_text",
]
