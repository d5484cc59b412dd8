# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The header of a PCD file, which is a stranger's: every number is checked before it is believed."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Optional

import numpy as np

_HEADER_BYTES_MAX = 64 * 1024  # as the command has them: a file that is no PCD is refused quickly
_POINT_BYTES_MAX = 1024 * 1024
_KINDS = {"F": (4, 8), "I": (1, 2, 4, 8), "U": (1, 2, 4, 8)}


class PcdError(ValueError):
    """A file that is no PCD; the message names file, what was found and what is allowed."""


@dataclass(frozen=True)
class Field:
    """One field of a point, or padding, which is called "_"."""

    name: str
    kind: str  # of NumPy: "<f4"
    size: int
    count: int
    offset: int


@dataclass(frozen=True)
class Header:
    """What stands before the points."""

    fields: "tuple[Field, ...]"
    point_step: int
    points: int  # 0: as many as there are
    encoding: str
    data_offset: int
    lines: int
    stamp_ns: Optional[int]

    @property
    def dtype(self) -> "np.dtype[Any]":
        """Of a point as it lies in the file, without its padding."""
        named = [field for field in self.fields if field.name != "_"]
        return np.dtype({"names": [field.name for field in named],
                         "formats": [field.kind if field.count == 1 else (field.kind, (field.count,))
                                     for field in named],
                         "offsets": [field.offset for field in named], "itemsize": self.point_step})

    def count(self, available: int) -> int:
        """How many points the header declares, or so many bytes hold where it declares none."""
        return self.points or (available // self.point_step if available % self.point_step == 0 else 0)


def _numbers(name: str, words: "list[str]", low: int, high: int) -> "list[int]":
    for word in words:
        if not re.fullmatch("[0-9]{1,20}", word) or not low <= int(word) <= high:
            raise PcdError(f"PCD header: {name} is '{word}'; a whole number from {low} to {high} is allowed")
    return [int(word) for word in words]


def _lines(data: bytes) -> "tuple[dict[str, list[str]], int, int, Optional[int]]":
    entries: "dict[str, list[str]]" = {}
    offset, lines = 0, 0
    stamp: Optional[int] = None
    head = data[:_HEADER_BYTES_MAX]
    while offset < len(head):
        end = head.find(b"\n", offset)
        end = len(head) if end < 0 else end
        words = head[offset:end].decode("latin-1").split()
        offset, lines = min(end + 1, len(head)), lines + 1
        if len(words) == 3 and words[:2] == ["#", "stamp_ns"]:
            stamp = int(words[2]) if re.fullmatch("[+-]?[0-9]{1,19}", words[2]) else None
            stamp = stamp if stamp is not None and -2**63 <= stamp < 2**63 else None
        if not words or words[0].startswith("#"):
            continue
        name = "FIELDS" if words[0] == "COLUMNS" else words[0]
        if name in entries:
            raise PcdError(f"PCD header line {lines}: {name} appears twice")
        entries[name] = words[1:]
        if name == "DATA":
            return entries, offset, lines, stamp
    raise PcdError("no PCD header: " + (f"no DATA line within the first {len(head)} bytes" if data else
                                        "the file is empty"))


def _fields(entries: "dict[str, list[str]]") -> "tuple[list[Field], int]":
    for name in ("FIELDS", "SIZE", "TYPE"):
        if name not in entries:
            raise PcdError(f"PCD header: {name} is missing")
    names = entries["FIELDS"]
    columns = {name: entries.get(name, ["1"] * len(names)) for name in ("SIZE", "TYPE", "COUNT")}
    for name, words in columns.items():
        if len(words) != len(names):
            raise PcdError(f"PCD header: {name} has {len(words)} values for {len(names)} FIELDS")
    sizes = _numbers("SIZE", columns["SIZE"], 1, 8)
    counts = _numbers("COUNT", columns["COUNT"], 1, _POINT_BYTES_MAX)
    fields: "list[Field]" = []
    offset = 0
    for name, size, kind, count in zip(names, sizes, columns["TYPE"], counts):
        if size not in _KINDS.get(kind, ()):
            raise PcdError(f"PCD header: field '{name}' has TYPE '{kind}' SIZE {size}; F of 4 or 8, I and U of 1, 2, 4 "
                           "or 8 bytes are allowed")
        if name != "_" and any(field.name == name for field in fields):
            raise PcdError(f"field '{name}' appears twice")
        fields.append(Field(name, f"<{kind.lower()}{size}", size, count, offset))
        offset += size * count
        if offset > _POINT_BYTES_MAX:
            raise PcdError(f"PCD header: a point of more than {_POINT_BYTES_MAX} bytes")
    return fields, offset


def _check_coordinates(fields: "list[Field]") -> None:
    for axis in "xyz":
        found = next((field for field in fields if field.name == axis), None)
        if found is None:
            present = ", ".join(field.name for field in fields if field.name != "_")
            raise PcdError(f"field '{axis}' is missing; fields present: {present or 'none'}")
        if found.kind not in ("<f4", "<f8") or found.count != 1:
            raise PcdError(f"field '{axis}' must be a float of 4 or 8 bytes")


def _points(entries: "dict[str, list[str]]") -> int:
    # WIDTH and HEIGHT are often wrong (0 x 0 in recorded files), so they count only where POINTS is absent.
    names = ("POINTS",) if "POINTS" in entries else ("WIDTH", "HEIGHT")
    if names[0] not in entries:
        raise PcdError("PCD header: WIDTH is missing")
    points = 1
    for name in filter(entries.__contains__, names):
        points *= _numbers(name, entries[name][:1] or [""], 0, 2**32 - 1)[0]
    return points


def parse_header(data: bytes) -> Header:
    """Raises PcdError, which does not name the file."""
    entries, offset, lines, stamp = _lines(data)
    version = (entries.get("VERSION") or ["0.7"])[0]
    if version not in ("0.7", ".7", "0.6", ".6", "0.5", ".5"):
        raise PcdError(f"PCD version '{version}'; 0.5, 0.6 and 0.7 are read")
    fields, point_step = _fields(entries)
    _check_coordinates(fields)
    encoding = (entries["DATA"] or [""])[0]
    if encoding not in ("ascii", "binary", "binary_compressed"):
        raise PcdError(f"PCD header: DATA is '{encoding}'; ascii, binary and binary_compressed are allowed")
    return Header(tuple(fields), point_step, _points(entries), encoding, offset, lines, stamp)
