# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The engine: one frame in, one result out."""

import ctypes

import numpy

from ._headers import CONSTANTS, STRUCTS, struct
from ._library import LIBRARY, aligned_block, call
from .cloud import describe
from .config import Config
from .result import result_of

_ALIGNMENT = CONSTANTS["POSE_WALL_BLOCK_ALIGNMENT"]


class Engine:
    """Not for two threads at once: a second call while one is inside is refused (Error)."""

    def __init__(self, config=None):
        self.config = config or Config()
        self.config.check()
        size = ctypes.c_uint64()
        call("memory_needed", self.config.struct, ctypes.byref(size))
        self._block, address = aligned_block(size.value, _ALIGNMENT)
        self._engine = ctypes.c_void_p()
        call("open", self.config.struct, address, size, ctypes.byref(self._engine))

    def process(self, points, stamp_ns=0, inputs=None):
        """Points (N, 3), (N, 4) with intensity, or a structured array with x, y, z. inputs: what `inputs` gives."""
        cloud, kept = describe(points, stamp_ns)
        if inputs is not None:
            cloud.inputs = ctypes.addressof(inputs)
        result = struct("pose_wall_result")
        call("process", self._engine, cloud, result)
        del kept
        return result_of(result)

    def age(self, stamp_ns):
        """What the values are at this time when no frame came."""
        result = struct("pose_wall_result")
        call("age", self._engine, ctypes.c_int64(int(stamp_ns)), result)
        return result_of(result)

    def reset(self):
        call("reset", self._engine)

    def last_points(self):
        """Voxels of the last frame: positions (N, 3) in base, and their labels (0 other, 1 floor, 2 left, 3 right)."""
        points = STRUCTS["pose_wall_points"]()
        call("last_points", self._engine, points)

        def copied(at, kind):
            if points.count == 0:
                return numpy.zeros(0, kind)
            size = points.count * numpy.dtype(kind).itemsize
            return numpy.frombuffer(ctypes.string_at(at, size), kind)

        xyz = numpy.stack([copied(getattr(points, f"{axis}_base_m"), numpy.float32) for axis in "xyz"], axis=1)
        return xyz, copied(points.label, numpy.uint8)

    def save(self):
        """All that it remembers, as bytes."""
        memento = ctypes.create_string_buffer(LIBRARY.pose_wall_memento_bytes())
        call("save", self._engine, None, memento, ctypes.c_uint64(len(memento)))
        return memento.raw

    def load(self, memento):
        """What another engine of the same version and settings saved."""
        call("load", self._engine, None, memento, ctypes.c_uint64(len(memento)))


def inputs(speed_m_s=None, turn_rate_rad_s=None, standing=False, boxes=()):
    """What the machine knows of itself since the last frame: speed, turn rate as (value, sigma); up to four boxes."""
    made = struct("pose_wall_inputs")
    if standing:
        made.given |= CONSTANTS["POSE_WALL_INPUT_STANDING"]
    if speed_m_s is not None:
        made.given |= CONSTANTS["POSE_WALL_INPUT_SPEED"]
        made.speed_m_s, made.speed_sigma_m_s = speed_m_s
    if turn_rate_rad_s is not None:
        made.given |= CONSTANTS["POSE_WALL_INPUT_TURN_RATE"]
        made.turn_rate_rad_s, made.turn_rate_sigma_rad_s = turn_rate_rad_s
    if len(boxes) > CONSTANTS["POSE_WALL_INPUT_BOXES"]:
        raise ValueError(f"{len(boxes)} boxes; at most {CONSTANTS['POSE_WALL_INPUT_BOXES']} are allowed")
    for i, box in enumerate(boxes):
        made.body_box[i][:] = [float(edge) for edge in box]
    return made


def image_bytes(result, version=2):
    """The process image of a result, for a controller: 240 bytes of version 1, 248 of version 2."""
    raw = STRUCTS["pose_wall_result"].from_buffer_copy(result.raw_bytes)
    image = struct("pose_wall_image" if version == 1 else "pose_wall_image2")
    if version == 1:
        call("image_fill", raw, image)
    else:
        call("image2_fill", raw, None, image)
    return ctypes.string_at(ctypes.byref(image), ctypes.sizeof(image))
