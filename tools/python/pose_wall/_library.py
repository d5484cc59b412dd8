# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The shared library, and its statuses as exceptions."""

import ctypes
import os
import pathlib

NAME = "libpose_wall_shared.so"


class Error(RuntimeError):
    """A status that the library gave; `status` is its number."""

    def __init__(self, status, what=""):
        text = LIBRARY.pose_wall_runtime_status_text(status).decode()
        super().__init__(f"{what}: {text}" if what else text)
        self.status = status


def _load():
    here = pathlib.Path(__file__).parent / NAME
    named = os.environ.get("POSE_WALL_LIBRARY", "")
    path = pathlib.Path(named) if named else here
    if not path.exists():
        raise ImportError(f"{path} is not there: install the package (pip install tools/python), or build the target "
                          f"pose_wall_shared and name its {NAME} in POSE_WALL_LIBRARY")
    library = ctypes.CDLL(str(path))
    for name in ("version", "status_text", "state_name", "reason_name", "reason_text", "part_name", "sense_name",
                 "runtime_status_text", "runtime_drop_name", "runtime_activity_name"):
        getattr(library, f"pose_wall_{name}").restype = ctypes.c_char_p
    library.pose_wall_memento_bytes.restype = ctypes.c_uint64
    return library


LIBRARY = _load()


def check(status, what=""):
    if status != 0:
        raise Error(status, what)


def call(name, *arguments, what=""):
    """Calls pose_wall_NAME; structs go by reference. Raises Error unless the status is 0."""
    passed = [ctypes.byref(a) if isinstance(a, ctypes.Structure) else a for a in arguments]
    check(getattr(LIBRARY, f"pose_wall_{name}")(*passed), what)


def aligned_block(size, alignment):
    """Memory for an engine: the buffer that holds it, and the address in it."""
    buffer = ctypes.create_string_buffer(size + alignment)
    address = ctypes.addressof(buffer)
    return buffer, ctypes.c_void_p(address + -address % alignment)
