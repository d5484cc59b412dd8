# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The runtime: an engine on a thread of its own, with a queue, a watchdog and the newest value for every thread."""

from __future__ import annotations

import atexit
import contextlib
import ctypes
import dataclasses
import os
import threading
import weakref
from collections.abc import Callable, Iterator
from typing import Any, Optional

import numpy as np

from . import _abi, publication
from ._abi import Status, Wish
from ._library import Block, Error, check, lib, sized
from .cloud import CloudView, Inputs
from .config import Config
from .engine import Moment, Points, moment_argument
from .publication import Publication, Statistics

Callback = Callable[[Publication], None]
# With these an image was written all the same, with every value invalid.
_WRITTEN = (Status.OK, Status.RUNTIME_STALE, Status.RUNTIME_STATE, Status.RUNTIME_NOTHING, Status.ENGINE)


class StaleError(Error):
    """Nothing fresh to act on: stale, nothing yet, or not running. `publication` is what there is, every value
    invalid."""

    def __init__(self, status: int, newest: Publication) -> None:
        super().__init__(status)
        self.publication = newest


@dataclasses.dataclass(frozen=True)
class RuntimeOptions:
    """As in pose_wall_runtime.h; None: its default."""

    queue_frames: Optional[int] = None
    cloud_points_max: Optional[int] = None
    point_bytes_max: Optional[int] = None
    thinning_max: Optional[int] = None
    worker_priority: Optional[int] = None
    worker_cpu: Optional[int] = None
    lock_memory: Optional[bool] = None
    required: Optional[Wish] = None
    frame_period_max_ns: Optional[int] = None
    watchdog_ns: Optional[int] = None
    watchdog_every_ns: Optional[int] = None

    def to_c(self) -> Any:
        """The struct of C, checked."""
        options = _abi.pose_wall_runtime_options()
        check(lib.pose_wall_runtime_options_init(options))
        for name, value in dataclasses.asdict(self).items():
            if value is None:
                continue
            if not hasattr(value, "__index__"):
                raise TypeError(f"{name}: a whole number is expected, not {value!r}")
            setattr(options, name, value)
            if getattr(options, name) != value:  # ctypes cuts off what does not fit
                raise Error(Status.RUNTIME_OPTION, f"{name} = {value}")
        fault = ctypes.c_char_p()
        status = lib.pose_wall_runtime_options_check(options, fault)
        if status == Status.RUNTIME_OPTION and fault.value:
            name = fault.value.decode()
            raise Error(status, f"{name} = {getattr(options, name)}")
        check(status)
        return options


class _Open:
    """An open runtime of C with all that it may reach. It outlives its Runtime where a thread is still inside."""

    def __init__(self, config: Config, options: Any) -> None:
        size = ctypes.c_uint64()
        check(lib.pose_wall_runtime_memory_needed(config._c, options, size))
        self.block = Block(size.value)
        self.options = options  # and with it the callback
        self.c = ctypes.c_void_p()
        self.process_id = os.getpid()
        self.calls = 0
        self.is_closing = False
        self.changed = threading.Condition()
        check(lib.pose_wall_runtime_open(config._c, options, self.block.address, self.block.size, self.c))

    @contextlib.contextmanager
    def use(self) -> Iterator[Any]:
        """While a call is inside, the runtime is not closed."""
        if os.getpid() != self.process_id:
            raise Error(Status.RUNTIME_HANDLE, "opened before a fork, and its threads did not come along")
        with self.changed:
            if self.is_closing:
                raise Error(Status.RUNTIME_HANDLE, "closed")
            self.calls += 1
        try:
            yield self.c
        finally:
            with self.changed:
                self.calls -= 1
                self.changed.notify_all()

    def close(self) -> None:
        """Stops it, waits until every call has left, closes it. Twice is once."""
        with self.changed:
            if self.is_closing or os.getpid() != self.process_id:
                return
            self.is_closing = True
        try:
            check(lib.pose_wall_runtime_stop(self.c))  # every call that is inside comes back soon
        except Error:  # from the callback
            self.is_closing = False
            raise
        with self.changed:
            self.changed.wait_for(lambda: self.calls == 0)
        check(lib.pose_wall_runtime_stop(self.c))  # where one of them had started it again
        check(lib.pose_wall_runtime_close(self.c))
        _unclosed.discard(self)


# Runtimes that were dropped by the thread of their own callback, which cannot wait for itself.
_unclosed: "set[_Open]" = set()


def _close_dropped(opened: _Open) -> None:
    """Of a Runtime that was collected, on whatever thread, or was left open at the end of the program."""
    try:
        opened.close()
    except Error:
        _unclosed.add(opened)
        lib.pose_wall_runtime_request_stop(opened.c)


def _close_unclosed() -> None:
    for opened in list(_unclosed):
        _close_dropped(opened)


atexit.register(_close_unclosed)


class _Failures:
    """Of a callback."""

    count = 0
    text: Optional[str] = None


def _c_callback(callback: Callback, failures: _Failures) -> Any:
    """Knows nothing of the Runtime, which can so be collected."""

    def call(_user: Any, newest: Any) -> None:
        try:
            callback(Publication.from_c(newest.contents))
        except BaseException as error:
            failures.count += 1
            failures.text = repr(error)
            raise  # to sys.unraisablehook, which prints it; the worker goes on

    return _abi.pose_wall_runtime_callback(call)


class Runtime:
    """An engine on a thread of its own. `with Runtime(config, callback=f) as runtime:` starts it, and stops and closes
    it at the end. Every method may be called by any thread; what must not be called from the callback (start, stop,
    wait_idle, close, load) is refused there with Status.RUNTIME_THREAD. The callback runs on the worker's thread with a
    Publication, and the next frame waits for it; what it raises goes to sys.unraisablehook, is counted, and ends
    nothing. After a fork the child is refused: threads do not come along."""

    def __init__(self, config: Optional[Config] = None, options: Optional[RuntimeOptions] = None, *,
                 callback: Optional[Callback] = None) -> None:
        _close_unclosed()
        self._failures = _Failures()
        c_options = (options or RuntimeOptions()).to_c()
        if callback is not None:
            if not callable(callback):
                raise TypeError(f"callback: a function of a Publication is expected, not {callback!r}")
            c_options.callback = _c_callback(callback, self._failures)
        self._opened = _Open(config if config is not None else Config(), c_options)
        self._finalize = weakref.finalize(self, _close_dropped, self._opened)

    def __enter__(self) -> Runtime:
        try:
            self.start()
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def start(self) -> None:
        """Starts the threads, with an engine that remembers nothing but what was loaded since the last start."""
        with self._opened.use() as runtime:
            check(lib.pose_wall_runtime_start(runtime))

    def stop(self) -> None:
        """Ends the threads and waits for them. Frames that wait are dropped and counted."""
        with self._opened.use() as runtime:
            check(lib.pose_wall_runtime_stop(runtime))

    def request_stop(self) -> None:
        """Asks the worker to end after what it is at; comes back at once."""
        with self._opened.use() as runtime:
            check(lib.pose_wall_runtime_request_stop(runtime))

    def close(self) -> None:
        """Stops it and gives its memory back; afterwards every call is refused. In a forked child nothing happens."""
        self._opened.close()

    def push(self, points: "np.ndarray[Any, Any]", *, stamp_ns: int, inputs: Optional[Inputs] = None) -> None:
        """Copies a frame into the queue, as Engine.process takes it, and comes back before it is worked. When all
        places are taken, the oldest that waits is dropped and counted."""
        cloud = CloudView(points, stamp_ns, inputs)
        with self._opened.use() as runtime:
            check(lib.pose_wall_runtime_push(runtime, cloud.c))

    def wait_idle(self) -> None:
        """Waits until every frame is worked. An interrupt from the keyboard is looked at afterwards."""
        with self._opened.use() as runtime:
            check(lib.pose_wall_runtime_wait_idle(runtime))

    def tick(self) -> None:
        """Has the worker look at its clock."""
        with self._opened.use() as runtime:
            check(lib.pose_wall_runtime_tick(runtime))

    def latest(self) -> Publication:
        """The newest publication. Raises StaleError where there is nothing fresh to act on."""
        newest = publication.blank()
        with self._opened.use() as runtime:
            status = lib.pose_wall_runtime_latest(runtime, newest)
        if status == Status.OK:
            return Publication.from_c(newest)
        if status in _WRITTEN:
            raise StaleError(status, Publication.from_c(newest))
        raise Error(status)

    def image_bytes(self) -> bytes:
        """Image 1 of the newest publication, for a controller. Where that is not fresh, every value is invalid."""
        return self._image(_abi.pose_wall_image, lib.pose_wall_runtime_image)

    def image2_bytes(self) -> bytes:
        """Image 2 of the same, likewise."""
        return self._image(_abi.pose_wall_image2, lib.pose_wall_runtime_image2)

    def _image(self, kind: Any, fill: Any) -> bytes:
        image = sized(kind)
        with self._opened.use() as runtime:
            status = fill(runtime, image)
        if status not in _WRITTEN:
            raise Error(status)
        return bytes(image)

    def last_points(self) -> Points:
        """The points of the frame that is told, labelled. From the callback only."""
        points = _abi.pose_wall_points()
        with self._opened.use() as runtime:
            check(lib.pose_wall_runtime_last_points(runtime, points))
            return Points.from_c(points)

    def statistics(self) -> Statistics:
        """Counters and times since open."""
        statistics = sized(_abi.pose_wall_runtime_statistics)
        with self._opened.use() as runtime:
            check(lib.pose_wall_runtime_statistics_now(runtime, statistics))
        return Statistics.from_c(statistics)

    @property
    def callback_failures(self) -> int:
        """How often the callback raised."""
        return self._failures.count

    @property
    def callback_error(self) -> Optional[str]:
        """What it raised last."""
        return self._failures.text

    def save(self, moment: Optional[Moment] = None) -> bytes:
        """What the engine remembers: from the callback, or while it is stopped."""
        memento = ctypes.create_string_buffer(lib.pose_wall_memento_bytes())
        with self._opened.use() as runtime:
            check(lib.pose_wall_runtime_save(runtime, moment_argument(moment), memento, len(memento)))
        return memento.raw

    def load(self, memento: bytes, moment: Optional[Moment] = None) -> None:
        """Gives the next start, and it alone, what was saved."""
        held = bytes(memento)
        with self._opened.use() as runtime:
            check(lib.pose_wall_runtime_load(runtime, moment_argument(moment), held, len(held)))
