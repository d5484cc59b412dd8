#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Writes ros_types.cpp: names, MD5 sums, hashes and definitions of the message types that pose_walld speaks.

Reads msg/ and the .msg files of Debian's ROS 1 packages. The MD5 sum is that of ROS 1 (genmsg); the hash is that of
ROS 2 from Iron on, computed as REP-2016 says. Where ROS 2 has other fields than ROS 1 (its header has no seq), they
stand in ROS2_FIELDS.

usage: generate_types.py [--check]        --check compares: exit status 1 where the file would be written otherwise"""

import hashlib
import json
import pathlib
import re
import sys

SKIPPED = 77  # as tests/live/live.cmake has it
NEEDED = "python3-genmsg ros-std-msgs ros-geometry-msgs ros-sensor-msgs ros-diagnostic-msgs ros-nav-msgs ros-tf2-msgs"

try:
    import genmsg
    import genmsg.gentools
    import genmsg.msg_loader
except ImportError:
    print(f"SKIPPED: there is no genmsg (packages {NEEDED})")
    sys.exit(SKIPPED)

FOLDER = pathlib.Path(__file__).parent
SHARE = pathlib.Path("/usr/share")
OURS = "pose_wall_msgs"
PACKAGES = ("std_msgs", "geometry_msgs", "sensor_msgs", "diagnostic_msgs", "tf2_msgs", "nav_msgs")
TYPES = {"kPointCloud2Type": "sensor_msgs/PointCloud2", "kVector3StampedType": "geometry_msgs/Vector3Stamped",
         "kFloat32MultiArrayType": "std_msgs/Float32MultiArray", "kStateType": f"{OURS}/State",
         "kDiagnosticArrayType": "diagnostic_msgs/DiagnosticArray", "kTfMessageType": "tf2_msgs/TFMessage",
         "kLaserScanType": "sensor_msgs/LaserScan", "kOccupancyGridType": "nav_msgs/OccupancyGrid",
         "kCovariantPoseType": "geometry_msgs/PoseWithCovarianceStamped", "kBoolType": "std_msgs/Bool",
         "kStopType": f"{OURS}/Stop"}
GRAPH, LIVOX = "rmw_dds_common", "livox_ros_driver2"
# Known by name and hash alone: the graph of ROS 2, whose gids had 24 bytes before there were hashes; Livox's driver;
# what is read and never written.
ROS2_TYPES = {"kParticipantEntitiesType": f"{GRAPH}/ParticipantEntitiesInfo", "kLivoxCustomType": f"{LIVOX}/CustomMsg",
              "kTwistType": "geometry_msgs/Twist", "kTwistStampedType": "geometry_msgs/TwistStamped"}
ROS2_FIELDS = {"std_msgs/Header": [("builtin_interfaces/Time", "stamp"), ("string", "frame_id")],
               "builtin_interfaces/Time": [("int32", "sec"), ("uint32", "nanosec")],
               "geometry_msgs/Vector3": [("float64", "x"), ("float64", "y"), ("float64", "z")],
               "geometry_msgs/Twist": [("geometry_msgs/Vector3", "linear"), ("geometry_msgs/Vector3", "angular")],
               "geometry_msgs/TwistStamped": [("std_msgs/Header", "header"), ("geometry_msgs/Twist", "twist")],
               f"{GRAPH}/Gid": [("uint8[16]", "data")],
               f"{GRAPH}/NodeEntitiesInfo": [("string<=256", "node_namespace"), ("string<=256", "node_name"),
                                             (f"{GRAPH}/Gid[]", "reader_gid_seq"),
                                             (f"{GRAPH}/Gid[]", "writer_gid_seq")],
               f"{GRAPH}/ParticipantEntitiesInfo": [(f"{GRAPH}/Gid", "gid"),
                                                    (f"{GRAPH}/NodeEntitiesInfo[]", "node_entities_info_seq")],
               f"{LIVOX}/CustomPoint": [("uint32", "offset_time"), ("float32", "x"), ("float32", "y"), ("float32", "z"),
                                        ("uint8", "reflectivity"), ("uint8", "tag"), ("uint8", "line")],
               f"{LIVOX}/CustomMsg": [("std_msgs/Header", "header"), ("uint64", "timebase"), ("uint32", "point_num"),
                                      ("uint8", "lidar_id"), ("uint8[3]", "rsvd"),
                                      (f"{LIVOX}/CustomPoint[]", "points")]}
# type_description_interfaces/msg/FieldType: numbers of the elementary types, and what is added for arrays.
TYPE_ID = {"int8": 2, "uint8": 3, "int16": 4, "uint16": 5, "int32": 6, "uint32": 7, "int64": 8, "uint64": 9,
           "float32": 10, "float64": 11, "bool": 15, "byte": 16, "string": 17, "string<=256": 21}
NESTED, ARRAY, SEQUENCE = 1, 48, 144
# What others published of these types: the computation is wrong where it gives something else.
KNOWN_HASH = {"sensor_msgs/PointCloud2": ("RIHS01_9198cabf", "bae2b5"),
              "geometry_msgs/Vector3Stamped": ("RIHS01_d4829622", "7887a"),
              "std_msgs/Float32MultiArray": ("RIHS01_0599f6f8", "bfe0"),
              "tf2_msgs/TFMessage": ("RIHS01_e369d0f05a23ae52508854b66f6aa043", "7f3449d652e8cbf22d5abe85d020f087"),
              "diagnostic_msgs/DiagnosticArray": ("RIHS01_5a8a36efb05fb25070fa0fb3810290c0",
                                                  "e6cd4862b54a8fb975a1ee8dc55a333e"),
              "nav_msgs/OccupancyGrid": ("RIHS01_8d348150c12913a31ee0ec170fbf2508",
                                         "9e4745d17035792a1ba94d6f0bc0cfc7"),
              "sensor_msgs/LaserScan": ("RIHS01_64c191398013af96509d518dac71d516",
                                        "4f9382553fce5c1f8cca5be7924bd828"),
              "geometry_msgs/PoseWithCovarianceStamped": ("RIHS01_26432f9803e43727d3c8f668d1fdb3c6",
                                                          "30f548af631e2f4e31382371bfea3b6e"),
              "std_msgs/Bool": ("RIHS01_feb91e995ff9ebd09c0cb3d2aed18b11", "077585839fb5db80193b62d74528f6c9"),
              f"{GRAPH}/ParticipantEntitiesInfo": ("RIHS01_91a0593bacdcc50ea9bdcf849a938b12",
                                                   "8412cc1ea821245c663bcd26f83c295e")}


def load(context, name):
    package, short = name.split("/")
    folder = FOLDER / "msg" if package == OURS else SHARE / package / "msg"
    return genmsg.msg_loader.load_msg_from_file(context, str(folder / f"{short}.msg"), name)


def load_all(context, name, specs):
    """The type and all that it uses, by name."""
    if name in specs:
        return
    specs[name] = load(context, name)
    for used in specs[name].types:
        base = genmsg.msgs.bare_msg_type(used)
        if not genmsg.msgs.is_builtin(base):
            load_all(context, genmsg.msgs.resolve_type(base, name.split("/")[0]), specs)


def ros2_fields(name, specs):
    if name in ROS2_FIELDS:
        return ROS2_FIELDS[name]
    package = name.split("/")[0]
    fields = []
    for kind, field in zip(specs[name].types, specs[name].names):
        base = genmsg.msgs.bare_msg_type(kind)
        base = "builtin_interfaces/Time" if base == "time" else base
        full = base if base in TYPE_ID or "/" in base else genmsg.msgs.resolve_type(base, package)
        fields.append((full + kind[len(genmsg.msgs.bare_msg_type(kind)):], field))
    return fields


def ros2_name(name):
    return name.replace("/", "/msg/")


def field_description(kind, field):
    base, brackets = re.fullmatch(r"([^\[]*)(\[\d*\])?", kind).groups()
    added = 0 if not brackets else SEQUENCE if brackets == "[]" else ARRAY
    capacity = int(brackets[1:-1]) if brackets and brackets != "[]" else 0
    nested = "" if base in TYPE_ID else ros2_name(base)
    _, bound = base.split("<=") if "<=" in base else ("", "0")
    return {"name": field, "type": {"type_id": TYPE_ID.get(base, NESTED) + added, "capacity": capacity,
                                    "string_capacity": int(bound), "nested_type_name": nested}}


def description(name, specs):
    return {"type_name": ros2_name(name), "fields": [field_description(*row) for row in ros2_fields(name, specs)]}


def used_by(name, specs, found):
    for kind, _ in ros2_fields(name, specs):
        base = kind.split("[")[0]
        if base not in TYPE_ID and base not in found:
            found.add(base)
            used_by(base, specs, found)
    return found


def rihs01(name, specs):
    used = sorted(used_by(name, specs, set()), key=ros2_name)
    text = json.dumps({"type_description": description(name, specs),
                       "referenced_type_descriptions": [description(other, specs) for other in used]},
                      ensure_ascii=True, separators=(", ", ": "))
    code = "RIHS01_" + hashlib.sha256(text.encode()).hexdigest()
    begin, end = KNOWN_HASH.get(name, ("", ""))
    if not (code.startswith(begin) and code.endswith(end)):
        raise SystemExit(f"{name}: the hash is {code}; others have {begin}...{end}")
    return code


def ros2_text(name, specs):
    """The fields of the type, then those of each type that it uses, as MCAP wants ros2msg."""
    parts = ["\n".join(f"{kind} {field}" for kind, field in ros2_fields(name, specs))]
    for other in sorted(used_by(name, specs, set())):
        if other != "builtin_interfaces/Time":  # readers know it
            fields = "\n".join(f"{kind} {field}" for kind, field in ros2_fields(other, specs))
            parts.append(f"MSG: {other}\n{fields}")
    return ("\n" + 80 * "=" + "\n").join(parts) + "\n"


def literal(text):
    return f'R"msg({text})msg"'


def written():
    context, specs = genmsg.MsgContext.create_default(), {}
    for name in TYPES.values():
        load_all(context, name, specs)
    search = {package: [str(SHARE / package / "msg")] for package in PACKAGES} | {OURS: [str(FOLDER / "msg")]}
    rows = []
    for constant, name in TYPES.items():
        genmsg.msg_loader.load_depends(context, specs[name], search)
        md5 = genmsg.gentools.compute_md5(context, specs[name])
        full = genmsg.gentools.compute_full_text(context, specs[name])
        code = rihs01(name, specs)
        of_ros2 = literal(ros2_text(name, specs))
        rows.append(f'const RosType {constant} = {{"{name}", "{md5}",\n"{code}",\n{literal(full)},\n{of_ros2}}};\n')
    for constant, name in ROS2_TYPES.items():
        rows.append(f'const RosType {constant} = {{"{name}", "",\n"{rihs01(name, specs)}", "", ""}};\n')
    return ("// SPDX-License-Identifier: BSD-3-Clause\n// Copyright (c) 2026 the pose_wall authors\n"
            "// Written by generate_types.py from msg/ and the messages of ROS: do not edit.\n\n"
            "// clang-format off\n#include \"apps/live/ros_messages/ros_messages.hpp\"\n\n"
            "namespace pose_wall::tools::live {\n\n"
            + "\n".join(rows) + "\n}  // namespace pose_wall::tools::live\n// clang-format on\n")


def main():
    missing = [package for package in PACKAGES if not (SHARE / package / "msg").is_dir()]
    if missing:
        print(f"SKIPPED: {SHARE} has no messages of {', '.join(missing)} (packages {NEEDED})")
        sys.exit(SKIPPED)
    path = FOLDER / "ros_types.cpp"
    if sys.argv[1:] == ["--check"]:
        is_same = path.read_text(encoding="utf-8") == written()
        print("ros_types.cpp is as it would be written" if is_same else "ros_types.cpp differs: run generate_types.py")
        sys.exit(0 if is_same else 1)
    path.write_text(written(), encoding="utf-8")


if __name__ == "__main__":
    main()
