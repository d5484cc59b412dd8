# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The engine: one frame in, one result out."""

from __future__ import annotations

import contextlib
import ctypes
import threading
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Optional

import numpy as np

from . import _abi
from ._abi import MomentKnown, Status
from ._library import Block, Error, check, engine_clock, lib, sized, stamp
from .cloud import CloudView, Inputs
from .config import Config
from .result import Result, blank


@dataclass(frozen=True)
class Moment:
    """When a memento is saved or loaded, as far as is known: without it nobody knows how old its values are."""

    stamp_ns: int  # now, in the clock of the frames' stamps
    boot_id: Optional[bytes] = None  # 16 bytes, others after each start of the machine
    wall_ns: Optional[int] = None  # since any fixed date, by a clock that goes on while the machine is off
    same_clock: bool = False  # load only: the stamps go on in the clock of the saved ones

    def to_c(self) -> Any:
        """The struct of C."""
        moment = sized(_abi.pose_wall_moment)
        moment.stamp_ns = stamp("stamp_ns", self.stamp_ns)
        if self.boot_id is not None:
            if len(self.boot_id) != len(moment.boot_id):
                raise ValueError(f"boot_id: {len(self.boot_id)} bytes; {len(moment.boot_id)} are asked")
            moment.known |= MomentKnown.BOOT
            moment.boot_id[:] = self.boot_id
        if self.wall_ns is not None:
            moment.known |= MomentKnown.WALL
            moment.wall_ns = stamp("wall_ns", self.wall_ns)
        if self.same_clock:
            moment.known |= MomentKnown.SAME_CLOCK
        return moment


@dataclass(frozen=True)
class Points:
    """The voxels of the last frame, in base, and what became of each: pose_wall.Label. Copies."""

    xyz_base_m: "np.ndarray[Any, Any]"  # (N, 3) float32
    label: "np.ndarray[Any, Any]"  # (N,) uint8

    @classmethod
    def from_c(cls, c: Any) -> Points:
        """From the struct of C, whose pointers are good for the moment."""
        if c.count == 0:
            return cls(np.empty((0, 3), np.float32), np.empty(0, np.uint8))
        axes = [np.ctypeslib.as_array(axis, (c.count,)) for axis in (c.x_base_m, c.y_base_m, c.z_base_m)]
        return cls(np.stack(axes, axis=1), np.ctypeslib.as_array(c.label, (c.count,)).copy())


@dataclass(frozen=True)
class SelfTest:
    """That this machine computes the bits that were tested."""

    frames: int
    digest: int
    code_bytes: int
    code_crc32: int


def moment_argument(moment: Optional[Moment]) -> Any:
    """What save and load are given in C."""
    return None if moment is None else moment.to_c()


class Engine:
    """An engine on a block of its own. One thread at a time: a call that finds another one inside is refused with
    Status.BUSY, and the interpreter's lock is free while a frame is measured. Engines are independent. After a fork the
    child has a copy of its own. timing=False leaves stage_ns 0; the other bits are the same."""

    def __init__(self, config: Optional[Config] = None, *, timing: bool = True) -> None:
        self._config = (config if config is not None else Config()).copy()
        self._block = Block(self._config.memory_bytes)
        self._c = ctypes.c_void_p()
        self._inside = threading.Lock()
        check(lib.pose_wall_open(self._config._c, self._block.address, self._block.size, self._c))
        if timing:
            check(lib.pose_wall_set_clock(self._c, engine_clock, None))

    @contextlib.contextmanager
    def _alone(self) -> Iterator[Any]:
        if not self._inside.acquire(blocking=False):
            raise Error(Status.BUSY)
        try:
            yield self._c
        finally:
            self._inside.release()

    @property
    def config(self) -> Config:
        """A copy of the settings: an open engine's do not change."""
        return self._config.copy()

    @property
    def memory_bytes(self) -> int:
        """Of its block."""
        return self._block.size

    def process(self, points: "np.ndarray[Any, Any]", *, stamp_ns: int, inputs: Optional[Inputs] = None) -> Result:
        """Measures one frame: every return of one scan, in the sensor's frame, in metres. points: shape (N, 3), or
        (N, 4) with intensity, of float32 or float64; or a structured array with x, y, z and maybe intensity, of
        whatever further fields, either byte order. Nothing is copied where a constant step leads from point to point
        (see CloudView.copied)."""
        cloud = CloudView(points, stamp_ns, inputs)
        result = blank()
        with self._alone() as engine:
            check(lib.pose_wall_process(engine, cloud.c, result))
        return Result.from_c(result)

    def age(self, stamp_ns: int) -> Result:
        """What the seven are at that time when no frame has come since the last."""
        result = blank()
        with self._alone() as engine:
            check(lib.pose_wall_age(engine, stamp("stamp_ns", stamp_ns), result))
        return Result.from_c(result)

    def reset(self) -> None:
        """Forgets all that was measured."""
        with self._alone() as engine:
            check(lib.pose_wall_reset(engine))

    def save(self, moment: Optional[Moment] = None) -> bytes:
        """All that it remembers from frame to frame."""
        memento = ctypes.create_string_buffer(lib.pose_wall_memento_bytes())
        with self._alone() as engine:
            check(lib.pose_wall_save(engine, moment_argument(moment), memento, len(memento)))
        return memento.raw

    def load(self, memento: bytes, moment: Optional[Moment] = None) -> None:
        """Takes what was saved by an engine of the same version and config. A memento is trusted like the config."""
        held = bytes(memento)
        with self._alone() as engine:
            check(lib.pose_wall_load(engine, moment_argument(moment), held, len(held)))

    def last_points(self) -> Points:
        """The points of the last frame, labelled."""
        points = _abi.pose_wall_points()
        with self._alone() as engine:
            check(lib.pose_wall_last_points(engine, points))
            return Points.from_c(points)


def self_test() -> SelfTest:
    """Raises Error(Status.SELF_TEST) where this library does not compute as it did when it was tested."""
    block = Block(lib.pose_wall_self_test_bytes())
    report = sized(_abi.pose_wall_self_test_report)
    status = lib.pose_wall_self_test(block.address, block.size, report)
    check(status, "" if status != Status.SELF_TEST else
          f"{report.values_wrong} values wrong, digest {report.digest_found:016x}, not {report.digest_expected:016x}")
    return SelfTest(report.frames, report.digest_found, report.code_bytes, report.code_crc32)
