# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Reads PCD files into structured arrays: ascii, binary and binary_compressed."""

import pathlib

import numpy

_KINDS = {("F", 4): "f4", ("F", 8): "f8", ("U", 1): "u1", ("U", 2): "u2", ("U", 4): "u4", ("I", 1): "i1",
          ("I", 2): "i2", ("I", 4): "i4"}


def _header(data, path):
    head, at = {}, 0
    while "DATA" not in head:
        end = data.find(b"\n", at)
        if end < 0 or at > 65536:
            raise ValueError(f"{path}: the header has no DATA line")
        words = data[at:end].decode("ascii", "replace").split()
        at = end + 1
        if words and not words[0].startswith("#"):
            head[words[0]] = words[1:]
    return head, at


def _dtype(head, path):
    try:
        rows = list(zip(head["FIELDS"], head["SIZE"], head["TYPE"], head.get("COUNT", ["1"] * len(head["FIELDS"]))))
        fields = []
        for i, (name, size, kind, count) in enumerate(rows):
            # Padding is named "_", and a dtype wants each name once.
            fields.append((name if name != "_" else f"_{i}", "<" + _KINDS[kind, int(size)], (int(count),))
                          if count != "1" else (name if name != "_" else f"_{i}", "<" + _KINDS[kind, int(size)]))
        return numpy.dtype(fields)
    except KeyError as missing:
        raise ValueError(f"{path}: the header lacks or has an unknown {missing}") from None


def _lzf(data, size):
    """Decompresses LZF, as binary_compressed has it."""
    out, at = bytearray(), 0
    while at < len(data):
        control = data[at]
        at += 1
        if control < 32:
            out += data[at:at + control + 1]
            at += control + 1
            continue
        length, offset = control >> 5, (control & 31) << 8
        if length == 7:
            length += data[at]
            at += 1
        begin = len(out) - offset - data[at] - 1
        at += 1
        if begin < 0:
            raise ValueError("compressed data point before their beginning")
        for i in range(length + 2):
            out.append(out[begin + i])
    if len(out) != size:
        raise ValueError(f"{len(out)} bytes came out, {size} were told")
    return bytes(out)


def read_pcd(path):
    """The points with all their fields."""
    data = pathlib.Path(path).read_bytes()
    head, at = _header(data, path)
    dtype, count = _dtype(head, path), int(head.get("POINTS", ["0"])[0])
    body, kind = data[at:], head["DATA"][0]
    if kind == "binary":
        if len(body) < count * dtype.itemsize:
            raise ValueError(f"{path}: {count} points take {count * dtype.itemsize} bytes, {len(body)} are there")
        return numpy.frombuffer(body, dtype, count)
    points = numpy.zeros(count, dtype)
    if kind == "ascii":
        columns = numpy.loadtxt(body.decode("ascii").splitlines(), ndmin=2, max_rows=count)
        first = 0
        for name in dtype.names:
            width = int(numpy.prod(dtype[name].shape)) if dtype[name].shape else 1
            points[name] = columns[:, first:first + width].reshape(points[name].shape)
            first += width
        return points
    if kind != "binary_compressed":
        raise ValueError(f"{path}: DATA {kind}; ascii, binary and binary_compressed are read")
    packed, size = (int(number) for number in numpy.frombuffer(body, "<u4", 2))
    if size != count * dtype.itemsize:
        raise ValueError(f"{path}: {count} points take {count * dtype.itemsize} bytes, {size} are told")
    plain, first = _lzf(body[8:8 + packed], size), 0
    for name in dtype.names:
        width = dtype[name].itemsize * count
        points[name] = numpy.frombuffer(plain[first:first + width], dtype[name].base).reshape(points[name].shape)
        first += width
    return points
