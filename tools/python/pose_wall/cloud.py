# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""NumPy arrays as clouds, read by the engine where they lie."""

import sys

import numpy

from ._headers import CONSTANTS, struct

_TYPES = {"float32": CONSTANTS["POSE_WALL_FIELD_FLOAT32"], "float64": CONSTANTS["POSE_WALL_FIELD_FLOAT64"],
          "uint8": CONSTANTS["POSE_WALL_FIELD_UINT8"], "uint16": CONSTANTS["POSE_WALL_FIELD_UINT16"],
          "uint32": CONSTANTS["POSE_WALL_FIELD_UINT32"], "int8": CONSTANTS["POSE_WALL_FIELD_INT8"],
          "int16": CONSTANTS["POSE_WALL_FIELD_INT16"], "int32": CONSTANTS["POSE_WALL_FIELD_INT32"]}
_READ = ("x", "y", "z", "intensity")


def _structured(points):
    """Any points as a structured array without a copy where that is possible."""
    if points.dtype.names:
        return points.reshape(-1)
    if points.ndim != 2 or points.shape[1] < 3:
        raise ValueError(f"points of shape {points.shape}: (N, 3), (N, 4) with intensity, or fields x, y, z are "
                         "allowed")
    if points.dtype.kind != "f" or points.dtype.itemsize not in (4, 8):
        raise ValueError(f"points of {points.dtype}: float32 and float64 are allowed")
    if points.strides[1] != points.dtype.itemsize:
        points = numpy.ascontiguousarray(points)
    names = _READ[:min(4, points.shape[1])]
    fields = {"names": names, "formats": [points.dtype] * len(names),
              "offsets": [i * points.dtype.itemsize for i in range(len(names))],
              "itemsize": points.shape[1] * points.dtype.itemsize}
    if points.strides[0] != fields["itemsize"] and len(points):
        points = numpy.ascontiguousarray(points)
    return points.view(numpy.dtype(fields)).reshape(-1)


def describe(points, stamp_ns):
    """The cloud of an array, and what must live as long as the cloud is used."""
    points = _structured(numpy.asarray(points))
    if points.ndim == 1 and len(points) > 1 and points.strides[0] < points.dtype.itemsize:
        points = numpy.ascontiguousarray(points)
    missing = [name for name in "xyz" if name not in points.dtype.names]
    if missing:
        raise ValueError(f"the fields {points.dtype.names} lack {', '.join(missing)}")
    native = {points.dtype.fields[name][0].isnative for name in "xyz"}
    if len(native) > 1:
        raise ValueError("x, y and z differ in their order of bytes")
    cloud = struct("pose_wall_cloud", width=len(points), height=1, stamp_ns=int(stamp_ns))
    cloud.big_endian = int((sys.byteorder == "big") == native.pop())
    cloud.point_step = points.strides[0] if len(points) > 1 else points.dtype.itemsize
    cloud.data_bytes = (len(points) - 1) * cloud.point_step + points.dtype.itemsize if len(points) else 0
    cloud.data = points.ctypes.data if len(points) else None
    for name in _READ:
        if name not in points.dtype.names:
            continue
        kind, offset = points.dtype.fields[name][:2]
        if kind.newbyteorder("=").name not in _TYPES:
            raise ValueError(f"field {name} is {kind}; allowed: {', '.join(_TYPES)}")
        field = getattr(cloud, name)
        field.offset, field.type = offset, _TYPES[kind.newbyteorder("=").name]
    return cloud, points
