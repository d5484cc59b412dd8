#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The code's CRC of the self test: the same for each run of a program, the very CRC-32 of the bytes in its file, and
another one as soon as a bit of the engine's code or constants falls over there.

    check_code_crc.py NM READELF PROGRAM [EMULATOR...]
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zlib

PARTS = ("text", "constants")
SEGMENT = re.compile(r"^\s*LOAD\s+0x(\w+)\s+0x(\w+)\s+0x\w+\s+0x(\w+)", re.MULTILINE)


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False)


def symbols_of(nm, program):
    return {name: int(value, 16) for value, name in
            re.findall(r"^(\w+) \w (engine_\w+|pose_wall_config_get_text)$", run(nm, program).stdout, re.MULTILINE)}


def offset_of(address, segments):
    for offset, begin, size in segments:
        if begin <= address < begin + size:
            return address - begin + offset
    return sys.exit(f"no segment of the file holds address {address:#x}")


def report_of(program, emulator):
    done = run(*emulator, program, "--self-test")
    report = dict(line.split() for line in done.stdout.splitlines() if len(line.split()) == 2)
    return done.returncode, report.get("code_crc32"), int(report.get("code_bytes", 0))


def flipped(data, at, folder):
    path = pathlib.Path(folder) / "program"
    path.write_bytes(data[:at] + bytes([data[at] ^ 1]) + data[at + 1:])
    path.chmod(0o755)
    return path


def main():
    nm, readelf, program, *emulator = sys.argv[1:]
    symbols = symbols_of(nm, program)
    segments = [[int(number, 16) for number in row] for row in SEGMENT.findall(run(readelf, "-lW", program).stdout)]
    data, faults, expected, covered = pathlib.Path(program).read_bytes(), [], 0, 0
    for part in PARTS:
        begin, size = (symbols[f"engine_{part}_{end}"] for end in ("begin", "end"))
        size -= begin
        at = offset_of(begin, segments)
        expected, covered = zlib.crc32(data[at:at + size], expected), covered + size
    first, second = report_of(program, emulator), report_of(program, emulator)
    if first != second or first != (0, f"{expected:08x}", covered):
        faults.append(f"status, CRC and bytes are {first}, then {second}; the file says {expected:08x}, {covered}")
    # What the self test never runs or reads, so that only the CRC can tell.
    constants = offset_of(symbols["engine_constants_begin"], segments)
    places = {"code": offset_of(symbols["pose_wall_config_get_text"], segments),
              "constants": data.index(b"unknown status", constants)}
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(program, folder)
        for what, at in places.items():
            status, crc, _ = report_of(flipped(data, at, folder), emulator)
            if status != 0 or crc is None or crc == first[1]:
                faults.append(f"a bit fell over in the {what}: status {status}, CRC {crc}, as before {first[1]}")
    print("\n".join(faults) or f"CRC {first[1]} over {covered} bytes, another one after each flipped bit")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
