# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The engine in threads of its own: frames are pushed, the newest result is there at any time."""

import ctypes
import sys
import threading
import traceback
from dataclasses import dataclass
from typing import Dict, Optional

from ._headers import CALLBACKS, CONSTANTS, STRUCTS, struct
from ._library import LIBRARY, Error, aligned_block, call
from .cloud import describe
from .config import Config
from .result import Result, result_of

_ALIGNMENT = CONSTANTS["POSE_WALL_BLOCK_ALIGNMENT"]


@dataclass(frozen=True)
class Publication:
    result: Result
    is_frame: bool  # False: silence, values age
    frame: int
    index: int
    age_ns: int
    thinning: int
    held_thinning: int
    is_stale: bool


def _publication_of(p, is_stale):
    return Publication(result_of(p.result), p.cause == CONSTANTS["POSE_WALL_RUNTIME_FRAME"], p.frame, p.index, p.age_ns,
                       p.thinning, p.held_thinning, is_stale)


class Runtime:
    """A context manager: started at its beginning, stopped at its end.

    callback: gets each Publication, in a thread of the runtime; what it raises is printed, and the next one is given.
    options: members of pose_wall_runtime_options by name. push: one thread at a time; latest and statistics: any."""

    def __init__(self, config=None, callback=None, **options):
        self.config = config or Config()
        self.config.check()
        self._options = struct("pose_wall_runtime_options")
        call("runtime_options_init_3", self._options)
        for name, value in options.items():
            if name in ("struct_size", "callback", "callback_user") or not hasattr(self._options, name):
                raise TypeError(f"there is no option '{name}' (pose_wall_runtime.h)")
            setattr(self._options, name, value)
        self._callback = callback
        # Kept, or C would call what is no longer there.
        self._called_back = CALLBACKS["pose_wall_runtime_callback"](self._on_publication)
        if callback is not None:
            self._options.callback = self._called_back
        size = ctypes.c_uint64()
        call("runtime_memory_needed", self.config.struct, self._options, ctypes.byref(size), what=self._wrong_option())
        self._block, address = aligned_block(size.value, _ALIGNMENT)
        self._runtime = ctypes.c_void_p()
        call("runtime_open", self.config.struct, self._options, address, size, ctypes.byref(self._runtime))
        self._pushing = threading.Lock()

    def _wrong_option(self):
        name = ctypes.c_char_p()
        status = LIBRARY.pose_wall_runtime_options_check(ctypes.byref(self._options), ctypes.byref(name))
        return name.value.decode() if status != 0 and name.value else ""

    def _on_publication(self, _user, publication):
        try:
            raw = STRUCTS["pose_wall_publication"].from_address(publication)
            self._callback(_publication_of(raw, False))
        except Exception:  # pylint: disable=broad-except  # C cannot take it
            traceback.print_exc(file=sys.stderr)

    def __enter__(self):
        call("runtime_start", self._runtime)
        return self

    def __exit__(self, *_):
        call("runtime_stop", self._runtime)

    def close(self):
        if self._runtime:
            call("runtime_stop", self._runtime)
            call("runtime_close", self._runtime)
            self._runtime = ctypes.c_void_p()

    def __del__(self):
        try:
            if getattr(self, "_runtime", None):
                self.close()
        except Error:
            pass

    def push(self, points, stamp_ns=0, inputs=None):
        """Returns before the frame is worked; the array may be reused at once."""
        cloud, kept = describe(points, stamp_ns)
        if inputs is not None:
            cloud.inputs = ctypes.addressof(inputs)
        with self._pushing:
            call("runtime_push", self._runtime, cloud)
        del kept

    def wait_idle(self):
        call("runtime_wait_idle", self._runtime)

    def latest(self) -> Optional[Publication]:
        """The newest one; None where nothing was published. A stale one says so, and all its values are invalid."""
        publication = struct("pose_wall_publication")
        status = LIBRARY.pose_wall_runtime_latest(self._runtime, ctypes.byref(publication))
        if status == CONSTANTS["POSE_WALL_RUNTIME_E_NOTHING"]:
            return None
        if status not in (0, CONSTANTS["POSE_WALL_RUNTIME_E_STALE"]):
            raise Error(status)
        return _publication_of(publication, status != 0)

    def statistics(self) -> Dict[str, int]:
        """Counters by name; drops as dropped_NAME."""
        raw = struct("pose_wall_runtime_statistics")
        call("runtime_statistics_now", self._runtime, raw)
        told = {name: getattr(raw, name) for name, kind in raw._fields_
                if isinstance(getattr(raw, name), int) and name not in ("struct_size", "reserved")}
        for why, count in enumerate(raw.dropped):
            told[f"dropped_{LIBRARY.pose_wall_runtime_drop_name(why).decode()}"] = count
        return told
