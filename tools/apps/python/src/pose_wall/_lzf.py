# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""LZF, the packing of binary_compressed PCD: runs of bytes as they are, and references to what came before."""

# The longest reference, 264 bytes, takes three: no stream grows by more, so that no size is believed that cannot be.
GROWTH_MAX = 88


def decompress(packed: bytes, size: int) -> bytes:
    """Exactly `size` bytes. Raises ValueError for a stream that gives others or is damaged."""
    if size > GROWTH_MAX * len(packed):
        raise ValueError(f"{len(packed)} packed bytes cannot hold {size} bytes")
    unpacked = bytearray()
    at = 0
    try:
        while at < len(packed):
            control = packed[at]
            at += 1
            if control < 32:  # so many bytes and one more, as they are
                unpacked += packed[at:at + control + 1]
                at += control + 1
                if at > len(packed):
                    raise IndexError
                continue
            length = control >> 5
            if length == 7:
                length += packed[at]
                at += 1
            back = ((control & 31) << 8 | packed[at]) + 1
            at += 1
            length += 2
            start = len(unpacked) - back
            if start < 0:
                raise IndexError
            piece = unpacked[start:start + length]
            if back < length:  # it runs into what it writes: the same bytes over and over
                piece = (piece * (length // back + 1))[:length]
            unpacked += piece
            if len(unpacked) > size:
                break
    except IndexError:
        raise ValueError(f"damaged, {len(unpacked)} of {size} bytes could be unpacked") from None
    if len(unpacked) != size:
        raise ValueError(f"damaged, it holds other than {size} bytes")
    return bytes(unpacked)
