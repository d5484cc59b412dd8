# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Process images for controllers, as the bytes that they are: tools/apps/plc has the function block that reads them."""

from __future__ import annotations

from typing import Any, Optional

from . import _abi
from ._abi import Cause
from ._library import check, lib, sized
from .result import Result


def image_bytes(result: Result) -> bytes:
    """Image 1, POSE_WALL_IMAGE_BYTES, for controllers that read it already."""
    image = sized(_abi.pose_wall_image)
    check(lib.pose_wall_image_fill(result.to_c(), image))
    return bytes(image)


def image2_bytes(result: Result, *, cause: Optional[Cause] = None, latency_ns: Optional[int] = None) -> bytes:
    """Image 2, POSE_WALL_IMAGE2_BYTES. cause: what told the result, Cause.FRAME or Cause.SILENCE (of Engine.age).
    latency_ns: from reception to publication, by a clock of yours."""
    source = sized(_abi.pose_wall_image_source)
    source.cause = cause or 0
    source.thinning = source.held_thinning = 1 if cause else 0
    source.publication = result.publication
    source.latency_ns = -1 if latency_ns is None else latency_ns
    image = sized(_abi.pose_wall_image2)
    check(lib.pose_wall_image2_fill(result.to_c(), source, image))
    return bytes(image)


def read_image(data: bytes) -> Any:
    """The members of an image of either version, after its CRC was checked: read_image(data).roll.value_mdeg."""
    kinds = {_abi.POSE_WALL_IMAGE_BYTES: (_abi.pose_wall_image, lib.pose_wall_image_check),
             _abi.POSE_WALL_IMAGE2_BYTES: (_abi.pose_wall_image2, lib.pose_wall_image2_check)}
    if len(data) not in kinds:
        raise ValueError(f"an image of {len(data)} bytes; {' and '.join(map(str, kinds))} are known")
    kind, check_image = kinds[len(data)]
    members = kind.from_buffer_copy(data)
    check(check_image(members))
    return members
