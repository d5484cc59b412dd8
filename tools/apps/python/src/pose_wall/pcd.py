# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Frames from PCD files (0.5 to 0.7; ascii, binary, binary_compressed), as `pose_wall run` reads them."""

from __future__ import annotations

import math
import os
import pathlib
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any, Optional, Union

import numpy as np

from ._lzf import decompress
from ._pcd_header import Header, PcdError, parse_header

# As the command has it: a hundred times the largest frame of any sensor on the market.
_FILE_BYTES_MAX = 2_000_000_000

Path = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True, eq=False)
class Frame:
    """One frame. `points` is a structured array with the file's fields: points["x"]; read-only where nothing had to be
    decoded."""

    points: "np.ndarray[Any, Any]"
    stamp_ns: Optional[int]  # of the file's name or header; None: neither tells
    path: pathlib.Path


def _binary(data: bytes, header: Header) -> "np.ndarray[Any, Any]":
    available = len(data) - header.data_offset
    count = header.count(available)
    if count * header.point_step > available:
        raise PcdError(f"the header declares {count} points of {header.point_step} bytes, but the {available} bytes "
                       f"that follow hold {available // header.point_step}")
    return np.frombuffer(data, header.dtype, count, header.data_offset)


def _compressed(data: bytes, header: Header) -> "np.ndarray[Any, Any]":
    body = data[header.data_offset:]
    if len(body) < 8:
        raise PcdError("compressed points: the two sizes before them are missing")
    packed, unpacked = int.from_bytes(body[:4], "little"), int.from_bytes(body[4:8], "little")
    if packed > len(body) - 8:
        raise PcdError(f"compressed points: {packed} bytes announced, {len(body) - 8} bytes follow")
    count = header.count(unpacked)
    if unpacked != count * header.point_step:
        raise PcdError(f"compressed points: {count} points of {header.point_step} bytes are "
                       f"{count * header.point_step} bytes, but the packed size says {unpacked}")
    try:
        columns = decompress(body[8:8 + packed], unpacked)
    except ValueError as error:
        raise PcdError(f"compressed points: {error}") from None
    points = np.zeros(count, header.dtype)
    for field in header.fields:  # all points' values of one field together, field after field
        if field.name != "_" and count:
            kind = header.dtype.fields[field.name][0]  # type: ignore[index]
            points[field.name] = np.frombuffer(columns, kind, count, field.offset * count)
    return points


def _number(word: str, line: int) -> float:
    try:
        if "_" in word:  # Python's own, between digits
            raise ValueError
        return float(word)
    except ValueError:
        raise PcdError(f"line {line}: '{word}' is not a number") from None


def _ascii(data: bytes, header: Header) -> "np.ndarray[Any, Any]":
    places, words = [], 0
    for field in header.fields:
        if field.name != "_" and field.count == 1:
            # As the command keeps them: whole numbers of four bytes (a time in microseconds) do not fit a float32.
            wide = field.size == 8 or (field.size == 4 and field.kind != "<f4")
            places.append((field.name, "f8" if wide else "f4", words))
        words += field.count
    rows: "list[tuple[float, ...]]" = []
    for number, text in enumerate(data[header.data_offset:].split(b"\n"), header.lines + 1):
        if header.points and len(rows) == header.points:
            break
        row = text.decode("latin-1").split()
        if row and len(row) != words:
            raise PcdError(f"line {number}: {len(row)} values, {words} expected")
        if row:
            rows.append(tuple(_number(row[place], number) for _, _, place in places))
    if len(rows) < header.points:
        raise PcdError(f"the header declares {header.points} points, but {len(rows)} lines of points follow")
    with np.errstate(over="ignore"):
        return np.array(rows, np.dtype([(name, kind) for name, kind, _ in places]))


_READERS = {"ascii": _ascii, "binary": _binary, "binary_compressed": _compressed}


def _stamp_of_name(path: pathlib.Path) -> Optional[int]:
    """A name of digits and nothing else is a stamp: 13 are ms since 1970, 16 us, 17 to 19 ns; a date is none."""
    name = path.stem
    if re.fullmatch("(19|20)[0-9]{2}(0[1-9]|1[0-2])(0[1-9]|[12][0-9]|3[01])([01][0-9]|2[0-3])[0-5][0-9][0-9]{5}", name):
        return None
    if re.fullmatch("[1-9][0-9]{12}|[1-9][0-9]{15}", name):
        return int(name) * (1_000_000 if len(name) == 13 else 1_000)
    stamp = int(name) if re.fullmatch("[0-9]{17,19}", name) else None
    return stamp if stamp is None or stamp < 2**63 else None


def read_pcd(path: Path) -> Frame:
    """One file. Compressed points are unpacked in Python, which takes a large cloud about a second."""
    path = pathlib.Path(path)
    size = path.stat().st_size
    if not path.is_file():
        raise PcdError(f"{path}: not a regular file")
    if size > _FILE_BYTES_MAX:
        raise PcdError(f"{path}: {size} bytes; a frame file of at most {_FILE_BYTES_MAX} bytes is read")
    data = path.read_bytes()
    try:
        header = parse_header(data)
        points = _READERS[header.encoding](data, header)
    except PcdError as error:
        raise PcdError(f"{path}: {error}") from None
    by_name = _stamp_of_name(path)
    return Frame(points, header.stamp_ns if by_name is None else by_name, path)


def read_frames(inputs: "Union[Path, Iterable[Path]]", rate_hz: float = 10.0) -> Iterator[Frame]:
    """Files, and folders of them in the order of their names, each with a stamp as `pose_wall run --rate` gives it: its
    own, else the last one's and as many periods as frames came since."""
    if not (math.isfinite(rate_hz) and rate_hz > 0.0):
        raise ValueError(f"rate_hz: {rate_hz}; a number above 0 is allowed")
    base_ns, since = 0, 0
    for path in _files(inputs):
        frame = read_pcd(path)
        if frame.stamp_ns is not None:
            base_ns, since = frame.stamp_ns, 0
        else:
            frame = replace(frame, stamp_ns=base_ns + math.floor(since * 1e9 / rate_hz + 0.5))
        since += 1
        yield frame


def _files(inputs: "Union[Path, Iterable[Path]]") -> "Iterator[pathlib.Path]":
    for one in [inputs] if isinstance(inputs, (str, os.PathLike)) else inputs:
        path = pathlib.Path(one)
        if not path.is_dir():
            yield path
            continue
        found = sorted(path.glob("*.pcd"), key=lambda file: os.fsencode(file.name))
        if not found:
            raise PcdError(f"{path}: holds no .pcd file")
        yield from found
