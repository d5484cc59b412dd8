# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""What a runtime publishes and counts, as frozen dataclasses. include/pose_wall_runtime.h is the manual of every
member."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any, Optional

from . import _abi
from ._abi import Activity, Cause, Drop, RuntimeState, Stage
from ._library import sized
from .result import Result


@dataclass(frozen=True)
class Publication:
    """A result with where it came from and how old it is. Times by the runtime's clock, CLOCK_MONOTONIC."""

    cause: Optional[Cause]  # None: nothing was published
    thinning: int
    held_thinning: int
    index: int
    frame: int  # counts pushes from 0
    received_ns: int
    published_ns: int
    age_ns: int
    activity: Activity
    activity_since_ns: int
    result: Result

    @classmethod
    def from_c(cls, c: Any) -> Publication:
        """From the struct of C."""
        return cls(Cause(c.cause) if c.cause else None, c.thinning, c.held_thinning, c.index, c.frame, c.received_ns,
                   c.published_ns, c.age_ns, Activity(c.activity), c.activity_since_ns, Result.from_c(c.result))


@dataclass(frozen=True)
class Times:
    """Quantiles since open; 0 where nothing was counted."""

    count: int
    p50_ns: int
    p99_ns: int
    p999_ns: int
    worst_ns: int

    @classmethod
    def from_c(cls, c: Any) -> Times:
        """From the struct of C."""
        return cls(c.count, c.p50_ns, c.p99_ns, c.p999_ns, c.worst_ns)


@dataclass(frozen=True)
class Statistics:
    """Counters: pushed = processed + in_work + waiting + filling + the sum of dropped."""

    state: RuntimeState
    pushed: int
    processed: int
    dropped: "dict[Drop, int]"
    filling: int
    waiting: int
    in_work: int
    waiting_worst: int
    published: int
    silences: int
    thinned: int
    thinning: int
    thinning_worst: int
    activity: Activity
    activity_since_ns: int
    newest_age_ns: Optional[int]  # None: not known
    priority_error: int  # 0, or an errno
    affinity_error: int
    lock_error: int
    thread_error: int
    push: Times
    wait: Times
    work: Times
    latency: Times
    callback: Times
    stage: "dict[Stage, Times]"

    @classmethod
    def from_c(cls, c: Any) -> Statistics:
        """From the struct of C."""
        members: "dict[str, Any]" = {name: getattr(c, name) for name in cls.__dataclass_fields__}
        for name in ("push", "wait", "work", "latency", "callback"):
            members[name] = Times.from_c(members[name])
        members.update(
            state=RuntimeState(c.state), activity=Activity(c.activity), dropped=dict(zip(Drop, c.dropped)),
            newest_age_ns=c.newest_age_ns if c.newest_age_ns >= 0 else None,
            stage={stage: Times.from_c(c.stage[stage]) for stage in Stage})
        return cls(**members)

    @property
    def dropped_total(self) -> int:
        """Of all kinds."""
        return sum(self.dropped.values())


def blank() -> Any:
    """A publication of C that says its sizes, to be written by the runtime."""
    made = sized(_abi.pose_wall_publication)
    made.result.struct_size = ctypes.sizeof(_abi.pose_wall_result)
    return made
