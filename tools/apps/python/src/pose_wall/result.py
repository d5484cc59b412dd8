# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""What the engine says of a frame, as frozen dataclasses. Angles in rad, lengths in m, ages in s, stamps and times in
ns; NaN where there is no number. include/pose_wall.h is the manual of every member."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass, field
from typing import Any, Optional

import numpy as np

from . import _abi
from ._abi import Part, Quantity, Reason, Sense, Stage, State
from ._library import lib

# The seven, in the order of pose_wall.Quantity: "roll" ... "d_rb".
QUANTITIES = tuple(lib.pose_wall_quantity_name(quantity).decode() for quantity in Quantity)


@dataclass(frozen=True)
class Value:
    """One of the seven quantities."""

    value: float  # to act on: smoothed, or held
    raw: float  # this frame's own measurement
    sigma: float  # standard deviation of raw: its random part
    protection_level: float  # |value - truth| stays within it
    raw_protection_level: float
    confidence: float
    age_s: float
    parts: "dict[Part, float]"  # of the protection level: they add up to it
    state: State
    reasons: Reason
    raw_state: State
    cause: Optional[Part]  # the largest part; None where there is no level

    @classmethod
    def from_c(cls, c: Any) -> Value:
        """From the struct of C."""
        return cls(c.value, c.raw, c.sigma, c.protection_level, c.raw_protection_level, c.confidence, c.age_s,
                   dict(zip(Part, c.part)), State(c.state), Reason(c.reasons), State(c.raw_state),
                   Part(c.cause) if c.cause < _abi.POSE_WALL_PARTS else None)

    @property
    def is_valid(self) -> bool:
        """The only state that a machine may be steered by without a look at the protection level."""
        return self.state is State.VALID


@dataclass(frozen=True)
class Plane:
    """A fitted plane normal . p + d_m = 0. Floor: in base, upwards. Walls: in the levelled frame, to the machine."""

    normal: "tuple[float, float, float]"
    d_m: float
    rms_m: float
    lean_rad: float
    extent_min_m: float
    extent_max_m: float
    area_m2: float
    found: bool  # else only iterations and reasons hold
    inliers: int
    iterations: int
    reasons: Reason

    @classmethod
    def from_c(cls, c: Any) -> Plane:
        """From the struct of C."""
        x, y, z = c.normal
        return cls((x, y, z), c.d_m, c.rms_m, c.lean_rad, c.extent_min_m, c.extent_max_m, c.area_m2, c.found != 0,
                   c.inliers, c.iterations, Reason(c.reasons))


@dataclass(frozen=True)
class Counts:
    """Where the points of a frame went."""

    points_in: int
    dropped_not_finite: int
    dropped_zero: int
    dropped_near: int
    dropped_far: int
    dropped_body: int
    voxels: int
    outliers: int
    open_points: int
    wall_points: int


@dataclass(frozen=True, eq=False)
class Result:
    """One frame, or one moment of silence. Two are equal when all their bits are, times included. Pickles."""

    roll: Value
    pitch: Value
    yaw: Value
    d_lf: Value  # left wall at s_front
    d_lb: Value  # left wall at s_back
    d_rf: Value  # right wall at s_front
    d_rb: Value  # right wall at s_back
    floor: Plane
    left: Plane
    right: Plane
    frame_reasons: Reason
    confidence: float  # the smallest of the seven
    stamp_ns: int
    frame_index: Optional[int]  # None before any frame
    publication: int
    work: int
    config_crc32: int
    source_id: int
    positive_means: "tuple[Sense, Sense, Sense]"  # of roll, pitch and yaw
    R_level_base: "np.ndarray[Any, Any]" = field(repr=False)
    left_right_yaw_difference_rad: float
    voxel_leaf_m: float
    stage_ns: "dict[Stage, int]"  # 0 without timing
    counts: Counts
    bits: bytes = field(repr=False)  # the struct of C

    @classmethod
    def from_c(cls, c: Any) -> Result:
        """From the struct of C, of which nothing is kept but a copy."""
        values = {name: Value.from_c(c.quantity[q]) for q, name in enumerate(QUANTITIES)}
        roll, pitch, yaw = map(Sense, c.positive_means)
        level = np.array(c.R_level_base, dtype=np.float64).reshape(3, 3)
        level.flags.writeable = False
        return cls(
            **values, floor=Plane.from_c(c.floor), left=Plane.from_c(c.left), right=Plane.from_c(c.right),
            frame_reasons=Reason(c.frame_reasons), confidence=c.confidence, stamp_ns=c.stamp_ns,
            frame_index=c.frame_index if c.frame_index != 2**64 - 1 else None, publication=c.publication, work=c.work,
            config_crc32=c.config_crc32, source_id=c.source_id,
            positive_means=(roll, pitch, yaw), R_level_base=level,
            left_right_yaw_difference_rad=c.left_right_yaw_difference_rad, voxel_leaf_m=c.voxel_leaf_m,
            stage_ns=dict(zip(Stage, c.stage_ns)),
            counts=Counts(*(getattr(c, name) for name in Counts.__dataclass_fields__)), bits=bytes(c))

    def to_c(self) -> Any:
        """The struct of C again."""
        return _abi.pose_wall_result.from_buffer_copy(self.bits)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Result):
            return NotImplemented
        return self.bits == other.bits

    def __hash__(self) -> int:
        return hash(self.bits)

    def __getitem__(self, name: "str | int") -> Value:
        """A quantity by its name ("d_lf") or number (Quantity.D_LF)."""
        if isinstance(name, str) and name in QUANTITIES:
            return getattr(self, name)  # type: ignore[no-any-return]
        if isinstance(name, int) and 0 <= name < len(QUANTITIES):
            return getattr(self, QUANTITIES[name])  # type: ignore[no-any-return]
        raise KeyError(f"{name!r}; quantities are {', '.join(QUANTITIES)}, or 0 to {len(QUANTITIES) - 1}")

    @property
    def quantities(self) -> "dict[str, Value]":
        """All seven by their names."""
        return {name: getattr(self, name) for name in QUANTITIES}

    @property
    def worst_state(self) -> State:
        """Of the seven."""
        return min(value.state for value in self.quantities.values())

    @property
    def reasons(self) -> Reason:
        """Of the frame and of all seven."""
        together = self.frame_reasons
        for value in self.quantities.values():
            together |= value.reasons
        return together

    @property
    def engine_ns(self) -> int:
        """All stages together."""
        return sum(self.stage_ns.values())


def reason_names(reasons: Reason) -> "list[str]":
    """As `pose_wall run` writes them: ["wall_short", ...]."""
    return [lib.pose_wall_reason_name(bit).decode() for bit in range(_abi.POSE_WALL_REASON_COUNT) if reasons >> bit & 1]


def reason_texts(reasons: Reason) -> "list[str]":
    """One English sentence each."""
    return [lib.pose_wall_reason_text(bit).decode() for bit in range(_abi.POSE_WALL_REASON_COUNT) if reasons >> bit & 1]


def blank() -> Any:
    """A result of C that says its size, to be written by the engine."""
    made = _abi.pose_wall_result()
    made.struct_size = ctypes.sizeof(made)
    return made
