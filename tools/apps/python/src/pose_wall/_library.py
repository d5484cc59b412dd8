# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Finds the shared library, sees that it is of this package's version, and turns statuses into exceptions."""

from __future__ import annotations

import ctypes
import pathlib
from typing import Any

import numpy as np

from . import _abi
from ._abi import Status

PATH = pathlib.Path(__file__).with_name("libpose_wall_py.so")


class Error(Exception):
    """A call that the library refused. `status` tells which way; the message says what is wrong."""

    def __init__(self, status: int, detail: str = "") -> None:
        try:
            self.status: int = Status(status)
        except ValueError:  # of a later library
            self.status = status
        self.detail = detail
        super().__init__(status, detail)

    def __str__(self) -> str:
        return f"{self.detail}: {status_text(self.status)}" if self.detail else status_text(self.status)


def _open() -> ctypes.CDLL:
    try:
        loaded = ctypes.CDLL(str(PATH))
    except OSError as error:
        raise ImportError(
            f"pose_wall: its library cannot be loaded ({error}). In the source tree it is not built beside the "
            "modules: either `pip install ./tools/apps/python`, or build the target pose_wall_python and put "
            "build/<preset>/python into PYTHONPATH") from error
    for name, (gives, takes) in _abi.FUNCTIONS.items():
        function = getattr(loaded, name)
        function.restype, function.argtypes = gives, takes
    found = (loaded.pose_wall_abi_version(), loaded.pose_wall_runtime_abi_version(), loaded.pose_wall_version())
    needed = (_abi.POSE_WALL_ABI_VERSION, _abi.POSE_WALL_RUNTIME_ABI_VERSION, VERSION.encode())
    if found != needed:
        raise ImportError(f"pose_wall: {PATH} is of (ABI, runtime's ABI, version) {found}; this package needs "
                          f"{needed}: install both anew")
    for asked, real in _abi.RENAMED.items():
        setattr(loaded, asked, getattr(loaded, real))
    return loaded


VERSION = f"{_abi.POSE_WALL_VERSION_MAJOR}.{_abi.POSE_WALL_VERSION_MINOR}.{_abi.POSE_WALL_VERSION_PATCH}"
lib = _open()
# In C, so that no Python runs within a frame.
engine_clock = ctypes.cast(lib.pose_wall_python_clock_ns, _abi.pose_wall_clock)


def status_text(status: int) -> str:
    """One English sentence for every status."""
    return str(lib.pose_wall_runtime_status_text(status).decode())


def check(status: int, detail: str = "") -> None:
    """Raises what a refused call comes to."""
    if status != Status.OK:
        raise Error(status, detail)


def sized(struct: Any) -> Any:
    """A new struct of C that says its own size."""
    made = struct()
    made.struct_size = ctypes.sizeof(struct)
    return made


class Block:
    """Memory for an engine or a runtime, aligned as they ask."""

    def __init__(self, size: int) -> None:
        alignment = _abi.POSE_WALL_BLOCK_ALIGNMENT
        self._bytes = np.empty(size + alignment, np.uint8)  # untouched pages cost nothing
        start = self._bytes.ctypes.data
        self.size = size
        self.address = start + -start % alignment


def integer(name: str, value: Any, low: int, high: int) -> int:
    """A whole number within bounds, of Python or of NumPy; True is none."""
    try:
        if isinstance(value, (bool, np.bool_)):
            raise TypeError
        number = int(value.__index__())
    except (AttributeError, TypeError):
        raise TypeError(f"{name}: a whole number is expected, not {value!r}") from None
    if not low <= number <= high:
        raise ValueError(f"{name}: {number} is not within {low} to {high}")
    return number


def stamp(name: str, value: Any) -> int:
    """Nanoseconds, as many as 64 bits hold."""
    return integer(name, value, -2**63, 2**63 - 1)
