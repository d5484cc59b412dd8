# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Results as frozen dataclasses. Angles in rad, lengths in m; NaN where there is no number."""

import ctypes
import enum
from dataclasses import dataclass
from typing import Dict, Optional, Tuple

from ._headers import CONSTANTS, ENUMS
from ._library import LIBRARY



State = enum.IntEnum("State", {key: CONSTANTS[f"POSE_WALL_{key}"] for key in ("INVALID", "HELD", "DEGRADED", "VALID")})
State.__doc__ = "How far a value can be trusted; later ones are better."
Reason = enum.IntFlag("Reason", {LIBRARY.pose_wall_reason_name(bit).decode().upper(): 1 << bit
                                 for bit in range(CONSTANTS["POSE_WALL_REASON_COUNT"])})
Reason.__doc__ = "Why a value is not better, or what happened to a frame; texts by `explain`."

NAMES = ("roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb")
PARTS = tuple(LIBRARY.pose_wall_part_name(part).decode() for part in range(CONSTANTS["POSE_WALL_PARTS"]))


def explain(reasons: Reason) -> Tuple[str, ...]:
    """One sentence for each reason."""
    return tuple(LIBRARY.pose_wall_reason_text(bit).decode() for bit in range(CONSTANTS["POSE_WALL_REASON_COUNT"])
                 if int(reasons) >> bit & 1)


@dataclass(frozen=True)
class Value:
    value: float
    raw: float
    sigma: float
    protection_level: float
    raw_protection_level: float
    confidence: float
    age_s: float
    state: State
    reasons: Reason
    raw_state: State
    parts: Dict[str, float]
    cause: Optional[str]

    @property
    def is_usable(self) -> bool:
        """Valid or degraded: the protection level holds, whether or not it is within the alert limit."""
        return self.state >= State.DEGRADED


@dataclass(frozen=True)
class Plane:
    """n . p + d = 0."""
    found: bool
    normal: Tuple[float, float, float]
    d_m: float
    rms_m: float
    lean_rad: float
    along_min_m: float
    along_max_m: float
    area_m2: float
    inliers: int
    iterations: int
    reasons: Reason


@dataclass(frozen=True)
class Result:
    stamp_ns: int
    frame_index: int
    publication: int
    confidence: float
    frame_reasons: Reason
    roll: Value
    pitch: Value
    yaw: Value
    d_lf: Value
    d_lb: Value
    d_rf: Value
    d_rb: Value
    floor: Plane
    left: Plane
    right: Plane
    counts: Dict[str, int]
    voxel_leaf_m: float
    work: int
    config_crc32: int
    raw_bytes: bytes

    def __getitem__(self, name: str) -> Value:
        if name not in NAMES:
            raise KeyError(f"there is no value '{name}'; there are {', '.join(NAMES)}")
        return getattr(self, name)

    @property
    def values(self) -> Dict[str, Value]:
        return {name: getattr(self, name) for name in NAMES}


_COUNTS = ("points_in", "dropped_not_finite", "dropped_zero", "dropped_near", "dropped_far", "dropped_body", "voxels",
           "outliers", "ground_candidates", "wall_points")


def _value(v):
    return Value(v.value, v.raw, v.sigma, v.protection_level, v.raw_protection_level, v.confidence, v.age_s,
                 State(v.state), Reason(v.reasons), State(v.raw_state), dict(zip(PARTS, v.part)),
                 PARTS[v.cause] if v.cause < len(PARTS) else None)


def _plane(p):
    return Plane(bool(p.found), tuple(p.normal), p.d_m, p.rms_m, p.lean_rad, p.along_min_m, p.along_max_m, p.area_m2,
                 p.inliers, p.iterations, Reason(p.reasons))


def result_of(r) -> Result:
    """A pose_wall_result as a dataclass; raw_bytes is the struct itself, for images and comparisons."""
    values = {name: _value(r.quantity[q]) for q, name in enumerate(NAMES)}
    return Result(stamp_ns=r.stamp_ns, frame_index=r.frame_index, publication=r.publication, confidence=r.confidence,
                  frame_reasons=Reason(r.frame_reasons), **values,
                  floor=_plane(r.floor), left=_plane(r.left), right=_plane(r.right),
                  counts={name: getattr(r, name) for name in _COUNTS}, voxel_leaf_m=r.voxel_leaf_m, work=r.work,
                  config_crc32=r.config_crc32, raw_bytes=ctypes.string_at(ctypes.byref(r), ctypes.sizeof(r)))
