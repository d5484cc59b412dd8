#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Includes go one way. A trunk carries all libraries: base <- part <- lidar <- place. Engine, motion, planar and
runtime stand on it side by side, and inside each of them the rooms stand one on the other as a frame goes through them.
All take nothing but Eigen and small parts of the standard library; tools and the runtime see them by their headers.
Tools stand on each other, too: io <- study <- lab <- apps. Their folders form no circle, and the daemon takes nothing
of the command's verbs.

usage: check_layers.py ROOT        exit status 1 and one line per broken rule"""

import pathlib
import re
import sys

# From the ground up: a room includes itself and what stands before it in its own row, and the trunk. A room is a
# folder below src/, or a file and those whose names go on with a _; the longest name that fits a file is its room.
TRUNK = ["base/math", "base/simd", "base/containers", "base/gates", "base/estimation", "part", "lidar", "place"]
WALLS = ["wall", "scene", "propose", "choose", "fit", "sample", "doubts", "scratch", "doubts/doubts"]
ROWS = [
    ["config", "types", "trace", "gates", "cloud", "region", "floor",
     *[f"walls/{step}" for step in WALLS], "walls", "output", "report", "image", "engine"],
    ["pose", "trace", "gates", "frame_steps", "range_image", "segmentation", "relief_map", "features", "surface_fit",
     "road_axes", "registration", "along_match", "far_match", "start_counts", "wide_start", "machine_prior", "travel",
     "scan_motion", "frame", "frame_clock", "expect", "look", "keyframes", "place_scan", "conclude", "motion_report",
     "motion_image", "odometry", "motion_api", "trace_api"],
]
MAY_INCLUDE = {room: set(TRUNK[:k]) for k, room in enumerate(TRUNK)}
for library, row in zip(("engine", "motion"), ROWS):
    rooms = [f"{library}/{room}" for room in row]
    MAY_INCLUDE.update({room: {*TRUNK, *rooms[:k]} for k, room in enumerate(rooms)})
ENGINE_ROOMS = {room for room in MAY_INCLUDE if room.startswith("engine/")}
MAY_INCLUDE.update({
    "engine/self_test": {"base/math", "part"},
    "engine/names": {"part"},
    "engine/c_api": {*TRUNK, *ENGINE_ROOMS, "engine/self_test"},
    # Planar's parts stand side by side; two of them follow scans.
    "planar": set(TRUNK),
    **{f"planar/{part}": {*TRUNK, "planar"} for part in ("scan", "match", "map", "route", "stop")},
    **{f"planar/{part}": {*TRUNK, "planar", "planar/match"} for part in ("slam", "localise")},
    "runtime": set(TRUNK) - {"base/estimation", "place"},
})
# Public headers, by the beginning of a room's name.
PUBLIC = {
    "base/containers": {"pose_wall.h"},  # the arena's alignment is the interface's
    "base": set(),
    "part": {"pose_wall.h"},
    "lidar": {"pose_wall.h"},
    "place": {"pose_wall.h", "pose_wall_planar_types.h"},
    "engine": {"pose_wall.h", "pose_wall.hpp", "pose_wall_trace.h"},
    "motion": {"pose_wall.h", "pose_wall_motion.h", "pose_wall_motion_settings.def", "pose_wall_motion_trace.h"},
    "planar": {"pose_wall.h", "pose_wall_motion.h", "pose_wall_planar*.h", "pose_wall_planar*.def"},
    # Of motion the types alone: its functions come through the options.
    "runtime": {"pose_wall.h", "pose_wall_runtime.h", "pose_wall_box.h", "pose_wall_motion.h"},
}
# The trace reads the table of the gates, which judge and then note.
EXCEPTION = ("engine/trace", "engine/gates/gates.def")
# No heap, no clock, no printing, no threads: what is not listed here does not get in.
SMALL_HEADERS = {
    "algorithm", "array", "cfloat", "climits", "cmath", "cstddef", "cstdint", "cstring", "initializer_list",
    "iterator", "limits", "new", "numeric", "tuple", "type_traits", "utility"}
EIGEN = {f"Eigen/{part}" for part in ("Core", "Cholesky", "Dense", "Eigenvalues", "Geometry", "LU", "SVD")}
# The threads around the engine: no part of it, no Eigen.
THREAD_HEADERS = {"atomic", "pthread.h", "sched.h", "errno.h", "time.h", "sys/mman.h"}
# What a part of tools/ may include beside itself, from the ground up.
PARTS = {"io": set(), "study": {"io"}, "lab": {"io", "study"}, "apps": {"io", "study", "lab"}}
MOTION_PUBLIC = {"pose_wall.h", "pose_wall_motion.h"}
C_HEADERS = {"stddef.h", "stdint.h"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in {".c", ".h", ".cpp", ".hpp", ".def"})


def includes(path):
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def room_of(relative):
    """The room of a path below src/, or None."""
    name = relative.with_suffix("").as_posix()
    fitting = [room for room in MAY_INCLUDE if re.match(rf"{room}($|[/_])", name)]
    return max(fitting, key=len, default=None)


def public_of(room):
    return PUBLIC[max((start for start in PUBLIC if room.startswith(start)), key=len)]


def fault_of(src, path, bracket, name):
    """Why a file of src/ may not include `name`, or None."""
    room = room_of(path.relative_to(src))
    if room is None:
        return f"belongs to no room; rooms are {', '.join(MAY_INCLUDE)}"
    if any(pathlib.PurePath(name).match(pattern) for pattern in public_of(room)) and "/" not in name:
        return None
    if bracket == "<":
        allowed = SMALL_HEADERS | C_HEADERS | (THREAD_HEADERS if room == "runtime" else EIGEN)
        kind = "runtime" if room == "runtime" else "engine"
        return None if name in allowed else f"<{name}> is not on the {kind}'s list of headers"
    target = src / name if (src / name).exists() else path.parent / name
    target = target.resolve()
    if not target.exists() or not target.is_relative_to(src.resolve()):
        return f'"{name}" is no file of src/ and no public header that {room} may include'
    there = room_of(target.relative_to(src.resolve()))
    if there == room or there in MAY_INCLUDE[room] or (room, name) == EXCEPTION:
        return None
    if room == "runtime":
        return f'the runtime includes "{name}"; it sees the engine only through pose_wall.h'
    return f'{room} includes "{name}" of {there}; it may include {", ".join(sorted(MAY_INCLUDE[room])) or "nothing"}'


def folder_of(relative):
    """A folder of a part of tools/, or a file beside such folders."""
    return relative.with_suffix("") if len(relative.parts) < 3 else pathlib.PurePath(*relative.parts[:2])


def folder_includes(tools):
    """{(folder, folder that it includes): (file, name)}, the first file of each pair."""
    pairs = {}
    for path in sources(tools):
        for _, name in includes(path):
            target = tools / name if (tools / name).exists() else path.parent / name
            target = target.resolve()
            if not target.exists() or not target.is_relative_to(tools.resolve()):
                continue
            pair = folder_of(path.relative_to(tools)), folder_of(target.relative_to(tools.resolve()))
            if pair[0] != pair[1]:
                pairs.setdefault(pair, (path, name))
    return pairs


def folders_in_circles(pairs):
    """What is left when folders go that nobody includes, or that include nobody, until none is left to go."""
    folders = {folder for pair in pairs for folder in pair}
    while True:
        inside = [pair for pair in pairs if set(pair) <= folders]
        staying = {here for here, _ in inside} & {there for _, there in inside}
        if staying == folders:
            return folders
        folders = staying


def folder_faults(tools):
    for path in sources(tools):
        part = path.relative_to(tools).parts[0]
        if part not in PARTS:
            yield path, f"belongs to no part of tools/; parts are {', '.join(PARTS)}"
    pairs = folder_includes(tools)
    circle = folders_in_circles(pairs)
    for (here, there), (path, name) in pairs.items():
        part, other = here.parts[0], there.parts[0]
        if part in PARTS and other in PARTS and other not in PARTS[part] | {part}:
            allowed = ", ".join(sorted(PARTS[part])) or "nothing"
            yield path, f'tools/{part} includes "{name}"; it may include {allowed}'
        if here in circle and there in circle:
            yield path, f'tools/{here} includes "{name}" of {there}, and these stand in a circle of folders'
        if (str(here), str(there)) == ("apps/live", "apps/verbs"):
            yield path, f'the daemon includes "{name}" of the command\'s verbs'


def faults(root):
    src, include, tools = root / "src", root / "include", root / "tools"
    for path in sources(src):
        for bracket, name in includes(path):
            fault = fault_of(src, path, bracket, name)
            if fault:
                yield path, fault
    for header, allowed in ((include / "pose_wall.h", C_HEADERS),
                            (include / "pose_wall_runtime.h", C_HEADERS | MOTION_PUBLIC),
                            (include / "pose_wall_motion.h",
                             C_HEADERS | {"pose_wall.h", "pose_wall_motion_settings.def"}),
                            (include / "pose_wall_trace.h", C_HEADERS | {"pose_wall.h"}),
                            (include / "pose_wall_motion_trace.h", C_HEADERS | {"pose_wall_motion.h"}),
                            (include / "pose_wall_box.h", C_HEADERS | MOTION_PUBLIC)):
        for bracket, name in includes(header) if header.exists() else ():
            if name not in allowed:
                yield header, f"includes {name}; it may include {', '.join(sorted(allowed))}"
    for header in sorted(include.glob("pose_wall_planar*.h")):
        for bracket, name in includes(header):
            if name not in C_HEADERS | {"pose_wall.h"} and not name.startswith("pose_wall_planar_"):
                yield header, f"includes {name}; it may include pose_wall.h and other headers of planar"
    yield from folder_faults(tools)
    for path in sources(tools):
        for bracket, name in includes(path):
            inside = not (tools / name).exists() and not (path.parent / name).exists() and (src / name).exists()
            if inside or "src/" in name:
                yield path, f"includes {name}; tools see the engine only through pose_wall.h and pose_wall.hpp"


def main():
    root = pathlib.Path(sys.argv[1])
    if not sources(root / "src"):
        sys.exit(f"{root}/src holds no sources: nothing was checked")
    found = sorted({f"{path.relative_to(root)}: {fault}" for path, fault in faults(root)})
    counted = f"{len(sources(root / 'src'))} files of src/ and {len(sources(root / 'tools'))} of tools/"
    print("\n".join(found) or f"{counted}: includes go one way")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
