# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""An array of NumPy as the cloud that the engine reads: in place where the array's layout allows it, else of a copy."""

from __future__ import annotations

import ctypes
import sys
from dataclasses import dataclass
from typing import Any, Optional

import numpy as np

from . import _abi
from ._abi import FieldType, Input, Status
from ._library import Error, sized, stamp

# Names of intensity that drivers use: the first that a cloud has is taken, as `pose_wall run` does.
INTENSITIES = ("intensity", "i", "reflectivity")
_TYPES = {"i1": FieldType.INT8, "u1": FieldType.UINT8, "i2": FieldType.INT16, "u2": FieldType.UINT16,
          "i4": FieldType.INT32, "u4": FieldType.UINT32, "f4": FieldType.FLOAT32, "f8": FieldType.FLOAT64}
_ALLOWED = ("an array of shape (N, 3), or (N, 4) with intensity, of float32 or float64; or a structured one with "
            "fields x, y and z (float32 or float64, metres)")
_STEP_MAX = 2**32 - 1


@dataclass(frozen=True)
class Inputs:
    """What the machine knows of itself since the last frame, in base. None: not known. A speed or turn rate needs its
    sigma. `boxes`: where the boom is, up to four of x_min x_max y_min y_max z_min z_max."""

    standing: bool = False
    speed_m_s: Optional[float] = None
    speed_sigma_m_s: Optional[float] = None
    turn_rate_rad_s: Optional[float] = None
    turn_rate_sigma_rad_s: Optional[float] = None
    boxes: "tuple[tuple[float, ...], ...]" = ()

    def to_c(self) -> Any:
        """The struct of C."""
        inputs = sized(_abi.pose_wall_inputs)
        inputs.given = Input.STANDING if self.standing else 0
        for name, bit in (("speed", Input.SPEED), ("turn_rate", Input.TURN_RATE)):
            unit = "m_s" if bit is Input.SPEED else "rad_s"
            pair = [f"{name}_{unit}", f"{name}_sigma_{unit}"]
            values = [getattr(self, member) for member in pair]
            if (values[0] is None) != (values[1] is None):
                raise ValueError(f"{' and '.join(pair)} go together: give both or none")
            if values[0] is not None:
                inputs.given |= bit
                for member, value in zip(pair, values):
                    setattr(inputs, member, value)
        if len(self.boxes) > _abi.POSE_WALL_INPUT_BOXES:
            raise ValueError(f"boxes: {len(self.boxes)} given; at most {_abi.POSE_WALL_INPUT_BOXES} are allowed")
        for number, box in enumerate(self.boxes):
            if len(box) != 6:
                raise ValueError(f"boxes[{number}]: {len(box)} numbers; x_min x_max y_min y_max z_min z_max are six")
            inputs.body_box[number][:] = box
        return inputs


def _covered(points: "np.ndarray[Any, Any]") -> bool:
    """Whether the memory that the array lies in goes on for a whole step behind its last point, which is what the
    engine is promised of every point."""
    owner = points
    while isinstance(owner.base, np.ndarray):
        owner = owner.base
    start, step = points.__array_interface__["data"][0], points.strides[0]
    first = owner.__array_interface__["data"][0]
    # Of an owner that is no plain block of memory only what lies within the array itself is known.
    if not owner.flags.c_contiguous and not owner.flags.f_contiguous:
        return bool(points.flags.c_contiguous)
    return bool(first <= start and start + len(points) * step <= first + owner.nbytes)


def _in_place(points: "np.ndarray[Any, Any]", offsets: "list[tuple[int, int]]") -> bool:
    """Whether a step and offsets describe where the fields lie. offsets: of each field, its start and its end."""
    if len(points) == 0 or points.flags.c_contiguous:
        return True
    step = points.strides[0]
    fits = 0 < step <= _STEP_MAX and all(0 <= first and last <= step for first, last in offsets)
    return bool(fits) and _covered(points)


def _unstructured(points: "np.ndarray[Any, Any]") -> "tuple[Any, dict[str, tuple[Any, int]]]":
    if points.ndim != 2 or points.shape[1] not in (3, 4):
        raise ValueError(f"points: shape {points.shape}; allowed: {_ALLOWED}")
    names = ("x", "y", "z", "intensity")[:points.shape[1]]

    def fields(array: "np.ndarray[Any, Any]") -> "dict[str, tuple[Any, int]]":
        across = array.strides[1]
        return {name: (array.dtype, column * across) for column, name in enumerate(names)}

    spans = [(offset, offset + points.itemsize) for _, offset in fields(points).values()]
    if not _in_place(points, spans):
        points = np.ascontiguousarray(points)
    return points, fields(points)


def _structured(points: "np.ndarray[Any, Any]") -> "tuple[Any, dict[str, tuple[Any, int]]]":
    if points.ndim == 2:  # an organised cloud: rows by columns
        points = points.reshape(-1)
    if points.ndim != 1:
        raise ValueError(f"points: a structured array of {points.ndim} dimensions; one, or rows by columns, is allowed")
    known = points.dtype.fields
    for name in "xyz":
        if name not in known:
            raise ValueError(f"points: field '{name}' is missing; fields present: {', '.join(known) or 'none'}")
    if not _in_place(points, [(0, points.itemsize)]):
        points = np.ascontiguousarray(points)
    fields = {name: known[name][:2] for name in "xyz"}
    intensity = next((name for name in INTENSITIES if name in known), None)
    if intensity:
        fields["intensity"] = known[intensity][:2]
    return points, fields


def _described(name: str, kind: "np.dtype[Any]", offset: int) -> Any:
    found = _TYPES.get(kind.str[1:]) if kind.subdtype is None else None
    if name in "xyz" and found not in (FieldType.FLOAT32, FieldType.FLOAT64):
        raise TypeError(f"points: {name} is of type {kind}; float32 or float64, in metres, is allowed: "
                        "points.astype(np.float32)")
    if found is None:
        if name == "intensity" and kind.subdtype is None:
            raise TypeError(f"points: intensity is of type {kind}; float32, float64 and integers of up to 32 bits are "
                            "allowed")
        found = FieldType.NONE
    return _abi.pose_wall_field(offset, found)


def _in_one_order(points: "np.ndarray[Any, Any]", fields: "dict[str, tuple[Any, int]]") -> bool:
    """Whether all fields have their bytes in the other order. A cloud has one for all of them."""
    swapped = {kind.byteorder not in "=|" + ("<" if sys.byteorder == "little" else ">") for kind, _ in fields.values()
               if kind.itemsize > 1}
    if len(swapped) > 1:
        raise TypeError(f"points: fields of both byte orders, {points.dtype}; one for all is allowed: points.astype of "
                        "a type of this machine's order")
    return True in swapped


class CloudView:
    """A pose_wall_cloud over an array. The array, or its copy, lives as long as this does."""

    def __init__(self, points: "np.ndarray[Any, Any]", stamp_ns: int, inputs: Optional[Inputs] = None) -> None:
        if not isinstance(points, np.ndarray):
            raise TypeError(f"points: a NumPy array is expected, not {type(points).__name__}; allowed: {_ALLOWED}")
        if isinstance(points, np.ma.MaskedArray):
            raise TypeError("points: a masked array; fill what is masked with NaN: points.filled(np.nan)")
        self.array, fields = (_structured if points.dtype.names is not None else _unstructured)(np.asarray(points))
        self.copied = points.size > 0 and not np.may_share_memory(self.array, points)
        cloud = self.c = sized(_abi.pose_wall_cloud)
        foreign = _in_one_order(points, fields)
        cloud.big_endian = int(foreign != (sys.byteorder == "big"))
        for name, (kind, offset) in fields.items():
            setattr(cloud, name, _described(name, kind, offset))
        count = len(self.array)
        if count > _STEP_MAX:  # the engine takes 2^26
            raise Error(Status.CLOUD_SIZE, f"points: {count} of them")
        cloud.width, cloud.height = count, 1
        # The strides of an axis of one element, or none, mean nothing.
        packed = self.array.itemsize * (self.array.shape[1] if self.array.ndim == 2 else 1)
        cloud.point_step = packed if self.array.flags.c_contiguous else self.array.strides[0]
        cloud.stamp_ns = stamp("stamp_ns", stamp_ns)
        if count:
            cloud.data = self.array.__array_interface__["data"][0]
            cloud.data_bytes = count * cloud.point_step
        if inputs is not None:
            if not isinstance(inputs, Inputs):
                raise TypeError(f"inputs: pose_wall.Inputs is expected, not {type(inputs).__name__}")
            self.inputs = inputs.to_c()
            cloud.inputs = ctypes.pointer(self.inputs)
