# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""A viewer's WebSocket by hand: for those who break the protocol, and for one that only counts."""

import base64
import os
import socket
import struct


def handshake(port, **headers):
    """A raw WebSocket: (status of the answer, socket). What follows the answer's head is still to be read."""
    asked = {"Host": f"127.0.0.1:{port}", "Upgrade": "websocket", "Connection": "Upgrade",
             "Sec-WebSocket-Version": "13", "Sec-WebSocket-Key": base64.b64encode(os.urandom(16)).decode(),
             "Sec-WebSocket-Protocol": "foxglove.websocket.v1"}
    asked.update({name.replace("_", "-"): value for name, value in headers.items()})
    lines = ["GET / HTTP/1.1"] + [f"{name}: {value}" for name, value in asked.items() if value]
    connection = socket.create_connection(("127.0.0.1", port), 10)
    connection.sendall("\r\n".join(lines + ["", ""]).encode())
    head = b""
    while not head.endswith(b"\r\n\r\n"):
        more = connection.recv(1)
        if not more:
            break
        head += more
    return int(head.split()[1]) if head else 0, connection


def frame(payload, opcode=1, length=None):
    """As a client sends it, masked by zeros."""
    size = len(payload) if length is None else length
    head = bytes([0x80 | opcode])
    head += bytes([0x80 | size]) if size < 126 else struct.pack(">BH", 0xFE, size) if size < 65536 else struct.pack(
        ">BQ", 0xFF, size)
    return head + bytes(4) + payload
