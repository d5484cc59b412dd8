#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Includes go one way, in the order in which a frame goes through the house: base <- config <- trace <- gates <- cloud
<- floor <- walls <- output <- engine <- c_api; within the walls propose <- choose <- fit <- sample <- doubts. Motion
and planar take the base and the cloud reader and are no part of the engine; all take nothing but Eigen and small
parts of the standard library; tools and the runtime see them by their headers.

usage: check_layers.py ROOT        exit status 1 and one line per broken rule"""

import pathlib
import re
import sys

# From the ground up: a room includes itself and what stands before it.
ROOMS = ["base/math", "base/simd", "base/containers", "base/estimation", "config", "types", "trace", "gates", "cloud",
         "region", "floor", "walls", "output", "engine"]
# A wall goes from one to the next; what lies in walls/ itself is of all.
WALL_STEPS = ["propose", "choose", "fit", "sample", "doubts"]
# Those that stand beside the rooms: what each may include, besides itself.
BESIDE = {
    "struct_sizes": {"public"},
    "struct_versions": {"struct_sizes", "public"},
    "export": set(),
    "self_test": {"base/math", "public"},
    "motion": {*ROOMS[:5], "struct_sizes", "struct_versions", "export", "public"},
    "planar": {*ROOMS[:5], "struct_sizes", "struct_versions", "export", "public"},
    "c_api": {*ROOMS, "self_test", "struct_sizes", "struct_versions", "export", "public"},
}
# The base knows nothing of the C interface.
MAY_INCLUDE = {room: {*ROOMS[:k], *([] if room.startswith("base/") else ["public"])} for k, room in enumerate(ROOMS)}
MAY_INCLUDE["base/containers"].add("public")  # the arena's alignment is the interface's
MAY_INCLUDE.update(BESIDE)
# Files of src/ itself belong to a room by how their names begin.
ROOT_FILES = {"config": "config", "number_text": "config", "types": "types", "report": "engine", "engine": "engine",
              "image": "engine", "self_test": "self_test", "names": "c_api", "c_api": "c_api",
              "struct_versions": "struct_versions", "struct_sizes": "struct_sizes", "export": "export"}
# No heap, no clock, no printing, no threads: what is not listed here does not get in.
ENGINE_HEADERS = {
    "algorithm", "array", "cfloat", "climits", "cmath", "cstddef", "cstdint", "cstring", "initializer_list",
    "iterator", "limits", "new", "numeric", "tuple", "type_traits", "utility",
    "Eigen/Core", "Eigen/Cholesky", "Eigen/Dense", "Eigen/Eigenvalues", "Eigen/Geometry", "Eigen/LU", "Eigen/SVD",
}
PUBLIC_HEADERS = {"pose_wall.h", "pose_wall.hpp", "pose_wall_trace.h"}
MOTION_PUBLIC = {"pose_wall.h", "pose_wall_motion.h"}
# The trace reads the table of the gates, which judge and then note.
GATE_TABLE = "gates/gates.def"
# What motion and planar share of a room: how a cloud is read, what of it is the machine, and whether it came before.
OF_CLOUDS = {"cloud/cloud_reader.hpp", "cloud/body_boxes.hpp", "cloud/cloud_print.hpp", "cloud/seen_clouds.hpp"}
# The threads around the engine: no part of it, no Eigen.
RUNTIME_HEADERS = {h for h in ENGINE_HEADERS if not h.startswith("Eigen/")} | {
    "atomic", "pthread.h", "sched.h", "errno.h", "time.h", "sys/mman.h"}
# Of motion the types alone: its functions come through the options.
RUNTIME_PUBLIC = {"pose_wall.h", "pose_wall_runtime.h", "pose_wall_box.h", "pose_wall_motion.h"}
# How both read and write structs of callers: no part of the engine either.
RUNTIME_SHARED = {"../struct_sizes.hpp", "../export.hpp"}
C_HEADERS = {"stddef.h", "stdint.h"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in {".c", ".h", ".cpp", ".hpp", ".def"})


def includes(path):
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def layer_of(relative):
    """Room of a path below src/: its folder (of base/ the one below), or what ROOT_FILES says."""
    if relative.parts[0] == "base" and len(relative.parts) > 2:
        return "/".join(relative.parts[:2])
    if len(relative.parts) > 1:
        return relative.parts[0]
    return next((layer for start, layer in ROOT_FILES.items() if relative.stem.startswith(start)), relative.stem)


def wall_step_of(relative):
    in_step = relative.parts[0] == "walls" and len(relative.parts) > 2 and relative.parts[1] in WALL_STEPS
    return WALL_STEPS.index(relative.parts[1]) if in_step else None


def engine_fault(src, path, bracket, name):
    """Why a file of the engine may not include `name`, or None."""
    relative = path.relative_to(src)
    layer = layer_of(relative)
    if layer not in MAY_INCLUDE:
        return f"belongs to no room; rooms are {', '.join(MAY_INCLUDE)}"
    if layer == "trace" and name == GATE_TABLE:
        return None
    if layer == "motion" and (name in MOTION_PUBLIC or name in OF_CLOUDS):
        return None
    if layer == "planar" and (name in MOTION_PUBLIC or name.startswith("pose_wall_planar") or name in OF_CLOUDS):
        return None
    if name in PUBLIC_HEADERS:
        return None if "public" in MAY_INCLUDE[layer] else f"{layer} may not include the public header"
    if bracket == "<":
        return None if name in ENGINE_HEADERS | C_HEADERS else f"<{name}> is not on the engine's list of headers"
    target = src / name if (src / name).exists() else (path.parent / name).resolve()
    if not target.is_relative_to(src.resolve()) and not target.is_relative_to(src):
        return f'"{name}" is not a file of src/'
    target = target.relative_to(src if target.is_relative_to(src) else src.resolve())
    step, target_step = wall_step_of(relative), wall_step_of(target)
    if step is not None and target_step is not None and target_step > step:
        return f'{WALL_STEPS[step]} includes "{name}" of {WALL_STEPS[target_step]}, which comes later'
    if layer_of(target) != layer and layer_of(target) not in MAY_INCLUDE[layer]:
        allowed = ", ".join(sorted(MAY_INCLUDE[layer])) or "nothing"
        return f'{layer} includes "{name}" of {layer_of(target)}; it may include {allowed}'
    return None


def runtime_fault(path, bracket, name):
    """Why a file of the runtime may not include `name`, or None."""
    if bracket == "<":
        return None if name in RUNTIME_HEADERS | C_HEADERS else f"<{name}> is not on the runtime's list of headers"
    known = name in RUNTIME_PUBLIC | RUNTIME_SHARED or ("/" not in name and (path.parent / name).exists())
    return None if known else f'the runtime includes "{name}"; it sees the engine only through pose_wall.h'


def faults(root):
    src, include, tools = root / "src", root / "include", root / "tools"
    for path in sources(src):
        for bracket, name in includes(path):
            of_runtime = path.is_relative_to(src / "runtime")
            fault = runtime_fault(path, bracket, name) if of_runtime else engine_fault(src, path, bracket, name)
            if fault:
                yield path, fault
    for header, allowed in ((include / "pose_wall.h", C_HEADERS),
                            (include / "pose_wall_runtime.h", C_HEADERS | MOTION_PUBLIC),
                            (include / "pose_wall_motion.h", C_HEADERS | {"pose_wall.h"}),
                            (include / "pose_wall_trace.h", C_HEADERS | {"pose_wall.h"}),
                            (include / "pose_wall_box.h", C_HEADERS | MOTION_PUBLIC)):
        for bracket, name in includes(header) if header.exists() else ():
            if name not in allowed:
                yield header, f"includes {name}; it may include {', '.join(sorted(allowed))}"
    for header in sorted(include.glob("pose_wall_planar*.h")):
        for bracket, name in includes(header):
            if name not in C_HEADERS | {"pose_wall.h"} and not name.startswith("pose_wall_planar_"):
                yield header, f"includes {name}; it may include pose_wall.h and other headers of planar"
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
