#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The packages of ROS 2 (tools/apps/live/ros2/packages) with tools that others wrote. catkin_pkg reads their
package.xml, colcon builds them with Debian's ament and rosidl. What rosidl made of the messages is asked for at run
time, and has the fields and the hash of type that the daemon sends. Debian has no messages of ROS 2: std_msgs/Header
and its Time are written here. The hash of sensor_msgs/PointCloud2 that others published shows that the hash is right.

usage: ros2_packages_peer.py ROOT POSE_WALL POSE_WALLD"""

import hashlib
import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import types
import unittest
from unittest import mock

sys.dont_write_bytecode = True  # the sources stay as they are
ROOT, POSE_WALL, POSE_WALLD = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(3))
sys.path[:0] = [str(ROOT / "tests/live")]

import live_peer  # noqa: E402  pylint: disable=wrong-import-position

live_peer.need(
    "colcon python3-colcon-cmake python3-colcon-ros rosidl-cmake rosidl-generator-c-cpp "
    "librosidl-typesupport-introspection-c-cpp-dev python3-catkin-pkg python3-yaml",
    programs=("colcon", "cmake", "g++"),
    modules=(
        "catkin_pkg",
        "rosidl_adapter",
        "rosidl_generator_cpp",
        "rosidl_typesupport_introspection_cpp",
        "colcon_ros",
        "yaml",
    ),
)
from catkin_pkg.package import parse_package  # noqa: E402  pylint: disable=wrong-import-position

ROS2 = ROOT / "tools/apps/live/ros2"
# What a workspace of ROS 2 brings and Debian has not: {package: (messages, dependencies, does it export these?)}.
STUBS = {
    "builtin_interfaces": ({"Time": "int32 sec\nuint32 nanosec\n"}, [], ""),
    "std_msgs": ({"Header": "builtin_interfaces/Time stamp\nstring frame_id\n"}, ["builtin_interfaces"], ""),
    # A type whose hash others published, with sequences, texts and types within types.
    "sensor_msgs": (
        {
            "PointField": "uint8 INT8=1\nstring name\nuint32 offset\nuint8 datatype\nuint32 count\n",
            "PointCloud2": "std_msgs/Header header\nuint32 height\nuint32 width\nPointField[] fields\n"
            "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n",
        },
        ["std_msgs"],
        "",
    ),
    "rosidl_default_generators": (
        {},
        ["rosidl_cmake", "rosidl_generator_c", "rosidl_generator_cpp", "rosidl_typesupport_introspection_cpp"],
        "depend",
    ),
    "rosidl_default_runtime": ({}, [], ""),
}
PUBLISHED = {"sensor_msgs/PointCloud2": "RIHS01_9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5"}
# Debian has the headers of each of them in a folder of its own.
DEBIANS = (
    "rosidl_typesupport_introspection_cpp",
    "rosidl_typesupport_interface",
    "rosidl_runtime_c",
    "rosidl_runtime_cpp",
    "rcutils",
)
OURS = ("pose_wall_msgs/Value", "pose_wall_msgs/State", "pose_wall_msgs/Stop")
# rosidl_typesupport_introspection_cpp/field_types.hpp -> type_description_interfaces/msg/FieldType of REP-2016.
TYPE_IDS = {1: 10, 2: 11, 6: 15, 7: 16, 8: 3, 9: 2, 10: 5, 11: 4, 12: 7, 13: 6, 14: 9, 15: 8, 16: 17, 18: 1}
WORDS = {
    10: "float32",
    11: "float64",
    15: "bool",
    3: "uint8",
    2: "int8",
    5: "uint16",
    4: "int16",
    7: "uint32",
    6: "int32",
    9: "uint64",
    8: "int64",
    17: "string",
}
ASK = """
#include <cstdio>
#include <rosidl_typesupport_introspection_cpp/message_introspection.hpp>
#include <rosidl_typesupport_introspection_cpp/message_type_support_decl.hpp>
%s
using rosidl_typesupport_introspection_cpp::MessageMembers;
void tell(const rosidl_message_type_support_t *support) {
  const auto *all = static_cast<const MessageMembers *>(support->data);
  std::printf("M %%s %%s\\n", all->message_namespace_, all->message_name_);
  for (unsigned k = 0; k < all->member_count_; ++k) {
    const auto &one = all->members_[k];
    const auto *nested = one.members_ ? static_cast<const MessageMembers *>(one.members_->data) : nullptr;
    std::printf("F %%s %%u %%zu %%d %%zu %%d %%s %%s\\n", one.name_, one.type_id_, one.string_upper_bound_,
                one.is_array_, one.array_size_, one.is_upper_bound_, nested ? nested->message_namespace_ : "-",
                nested ? nested->message_name_ : "-");
  }
}
int main() {
%s
}
"""


def stub(folder, name, messages, depends, ending):
    """A package of ROS 2 in a few lines."""
    (folder / name / "msg").mkdir(parents=True)
    for message, text in messages.items():
        (folder / name / "msg" / f"{message}.msg").write_text(text, encoding="utf-8")
    (folder / name / "package.xml").write_text(
        f"<package format='3'><name>{name}</name><version>0.0.0</version><description>x</description>"
        "<maintainer email='x@example.org'>x</maintainer><license>none</license>"
        "<buildtool_depend>ament_cmake</buildtool_depend>"
        + "".join(f"<depend>{other}</depend>" for other in depends)
        + (
            "<buildtool_depend>rosidl_default_generators</buildtool_depend>"
            "<member_of_group>rosidl_interface_packages</member_of_group>"
            if messages
            else ""
        )
        + "<export><build_type>ament_cmake</build_type></export></package>",
        encoding="utf-8",
    )
    lines = [
        "cmake_minimum_required(VERSION 3.19)",
        f"project({name}{'' if messages else ' NONE'})",
        "find_package(ament_cmake REQUIRED)",
    ]
    if messages:
        lines += ["find_package(rosidl_default_generators REQUIRED)"] + [
            f"find_package({other} REQUIRED)" for other in depends
        ]
        lines += [
            f"rosidl_generate_interfaces({name} "
            + " ".join(f"msg/{message}.msg" for message in messages)
            + (" DEPENDENCIES " + " ".join(depends) if depends else "")
            + ")"
        ]
    if ending:
        lines += ["ament_export_dependencies(" + " ".join(depends) + ")"]
    (folder / name / "CMakeLists.txt").write_text("\n".join([*lines, "ament_package()", ""]), encoding="utf-8")


def described(name, told):
    """The type description of REP-2016, of what rosidl knows at run time."""
    fields = []
    for field, kind, bound, is_array, size, is_bounded, nested in told[name]:
        added = 0 if not is_array else 96 if is_bounded else 48 if size else 144
        fields.append(
            {
                "name": field,
                "type": {
                    "type_id": TYPE_IDS[kind] + added,
                    "capacity": size,
                    "string_capacity": bound,
                    "nested_type_name": nested.replace("/", "/msg/"),
                },
            }
        )
    return {"type_name": name.replace("/", "/msg/"), "fields": fields}


def nested_of(name, told):
    found = {field[6] for field in told[name] if field[6]}
    return found.union(*(nested_of(other, told) for other in found)) if found else found


def rihs01(name, told):
    others = sorted(nested_of(name, told), key=lambda other: other.replace("/", "/msg/"))
    text = json.dumps(
        {
            "type_description": described(name, told),
            "referenced_type_descriptions": [described(other, told) for other in others],
        }
    )
    return "RIHS01_" + hashlib.sha256(text.encode()).hexdigest()


def types_of_the_daemon():
    """{name: (hash, text for ROS 2)} as ros_types.cpp has it, which the daemon announces and records."""
    source = (ROOT / "tools/apps/live/ros_messages/ros_types.cpp").read_text(encoding="utf-8")
    rows = re.findall(
        r'RosType \w+ = \{"([^"]+)", "\w+",\s*"(RIHS01_\w+)",\s*R"msg\(.*?\)msg",\s*R"msg\((.*?)\)msg"\};', source, re.S
    )
    return {name: (code, text) for name, code, text in rows}


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        cls.addClassCleanup(place.cleanup)
        cls.place = pathlib.Path(place.name)
        for name, (messages, depends, ending) in STUBS.items():
            stub(cls.place / "src", name, messages, depends, ending)
        os.symlink(ROS2 / "packages", cls.place / "src/pose_wall")  # as the README says
        done = subprocess.run(
            [
                "colcon",
                "--log-base",
                cls.place / "log",
                "build",
                "--event-handlers",
                "console_direct+",
                "--executor",
                "sequential",
                "--cmake-args",
                "-DCMAKE_BUILD_TYPE=Debug",
                "-DBUILD_TESTING=OFF",
                f"-DPython3_EXECUTABLE={sys.executable}",
            ],
            cwd=cls.place,
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, "HOME": place.name, "MAKEFLAGS": "-j2"},
        )  # or it waits for an idle machine
        cls.built = done.stdout + done.stderr
        if done.returncode != 0:
            raise RuntimeError(cls.built[-6000:])
        cls.told = cls.introspected()

    @classmethod
    def introspected(cls):
        """{type: fields} of each message, from the libraries that rosidl made."""
        names = [
            *OURS,
            *(f"{package}/{message}" for package, (messages, _, _) in STUBS.items() for message in messages),
        ]
        asks = "\n".join(
            "  tell(rosidl_typesupport_introspection_cpp::get_message_type_support_handle<"
            + name.replace("/", "::msg::")
            + ">());"
            for name in names
        )
        includes = "\n".join(f'#include "{name.split("/")[0]}/msg/{snake(name.split("/")[1])}.hpp"' for name in names)
        source = cls.place / "ask.cpp"
        source.write_text(ASK % (includes, asks), encoding="utf-8")
        packages = [cls.place / "install" / package for package in {name.split("/")[0] for name in names}]
        flags = [f"-I{package}/include/{package.name}" for package in packages]
        flags += [f"-I/usr/include/{name}" for name in DEBIANS]
        libraries = sorted(
            str(library) for package in packages for library in package.glob("lib/*introspection_cpp.so")
        )
        places = ":".join(f"{package}/lib" for package in packages)
        program = cls.place / "ask"
        subprocess.run(
            [
                "g++",
                "-std=c++17",
                source,
                "-o",
                program,
                *flags,
                *libraries,
                "-Wl,--allow-shlib-undefined",
                "-lrosidl_typesupport_introspection_cpp",
                "-lrosidl_runtime_c",
                "-lrcutils",
            ],
            check=True,
            env={**os.environ, "LD_RUN_PATH": places},
        )
        lines = subprocess.run(
            [program], capture_output=True, text=True, check=True, env={**os.environ, "LD_LIBRARY_PATH": places}
        ).stdout.splitlines()
        told, fields = {}, []
        for line in lines:
            mark, *words = line.split(" ")
            if mark == "M":
                fields = told.setdefault(words[0].split("::")[0] + "/" + words[1], [])
            else:
                nested = "" if words[6] == "-" else words[6].split("::")[0] + "/" + words[7]
                fields.append(
                    (words[0], int(words[1]), int(words[2]), words[3] == "1", int(words[4]), words[5] == "1", nested)
                )
        return told

    def test_package_xml_is_of_format_3_and_names_what_the_files_need(self):
        version = re.search(
            r"project\(pose_wall VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
        ).group(1)
        for name in ("pose_wall_msgs", "pose_wall"):
            warnings = []
            package = parse_package(str(ROS2 / "packages" / name), warnings=warnings)
            package.validate(warnings=warnings)
            self.assertEqual(
                (package.package_format, package.name, package.version, package.licenses, warnings),
                (3, name, version, ["BSD-3-Clause"], []),
            )
            package.evaluate_conditions({})
            tells = {depend.name for depend in package.buildtool_depends + package.build_depends + package.exec_depends}
            cmake = (ROS2 / "packages" / name / "CMakeLists.txt").read_text(encoding="utf-8")
            self.assertLessEqual(set(re.findall(r"find_package\((\w+)", cmake)), tells, name)
        self.assertEqual(
            [group.name for group in parse_package(str(ROS2 / "packages/pose_wall_msgs")).member_of_groups],
            ["rosidl_interface_packages"],
        )

    def test_colcon_builds_and_installs_them(self):
        share = self.place / "install/pose_wall_msgs/share/pose_wall_msgs"
        for message in ("Value", "State", "Stop"):
            self.assertEqual(
                (share / f"msg/{message}.msg").read_bytes(), (ROS2 / f"../ros_messages/msg/{message}.msg").read_bytes()
            )
        for name in ("pose_wall.launch.py", "pose_wall.rviz", "pose_wall.params.yaml"):
            self.assertEqual(
                (self.place / "install/pose_wall/share/pose_wall/launch" / name).read_bytes(),
                (ROS2 / name).read_bytes(),
            )
        self.assertNotRegex(self.built, "(?i)cmake warning|cmake error")
        for folder in ("build", "install", "log"):
            self.assertFalse(list((ROS2 / "packages").rglob(folder)), "nothing is written into the sources")

    def test_hashes_that_others_published_come_out(self):
        self.assertEqual({name: rihs01(name, self.told) for name in PUBLISHED}, PUBLISHED)

    def test_the_daemon_sends_the_fields_and_hashes_that_rosidl_made(self):
        sent = types_of_the_daemon()
        for name in OURS[1:]:
            code, text = sent[name]
            self.assertEqual(rihs01(name, self.told), code, name)
            main, *others = re.split(r"\n=+\n", text)
            parts = {name: main, **dict(other.split("\n", 1) for other in (o.removeprefix("MSG: ") for o in others))}
            self.assertEqual(set(parts), {name} | nested_of(name, self.told) - {"builtin_interfaces/Time"})
            for part, lines in parts.items():
                made = []
                for field, kind, bound, is_array, size, is_bounded, nested in self.told[part]:
                    self.assertEqual((bound, is_bounded), (0, False))
                    made.append(f"{nested or WORDS[TYPE_IDS[kind]]}{f'[{size or str()}]' if is_array else ''} {field}")
                self.assertEqual([line for line in lines.splitlines() if line], made, part)

    def test_a_field_that_differs_has_another_hash(self):
        for change in (
            lambda fields: fields[::-1],
            lambda fields: fields[:-1],
            lambda fields: [(field[0] + "x", *field[1:]) for field in fields],
        ):
            self.assertNotEqual(
                rihs01(
                    "pose_wall_msgs/Stop",
                    {**self.told, "pose_wall_msgs/Stop": change(self.told["pose_wall_msgs/Stop"])},
                ),
                types_of_the_daemon()["pose_wall_msgs/Stop"][0],
            )

    # The launch file, with stand-ins for ROS's launch: it has seen no ROS 2.

    def launch_file(self):
        modules = {
            name: types.ModuleType(name)
            for name in ("launch", "launch.actions", "launch.conditions", "launch.substitutions")
        }
        keep = lambda *words, **named: types.SimpleNamespace(words=words, **named)  # noqa: E731
        for module, names in (
            ("launch", ("LaunchDescription",)),
            ("launch.conditions", ("IfCondition",)),
            ("launch.actions", ("DeclareLaunchArgument", "ExecuteProcess", "OpaqueFunction")),
        ):
            for name in names:
                setattr(modules[module], name, keep)
        modules["launch.substitutions"].LaunchConfiguration = lambda name: types.SimpleNamespace(
            perform=lambda context: context[name]
        )
        spec = importlib.util.spec_from_file_location("pose_wall_launch", ROS2 / "pose_wall.launch.py")
        module = importlib.util.module_from_spec(spec)
        with mock.patch.dict(sys.modules, modules):
            spec.loader.exec_module(module)
        return module

    def test_the_launch_file_gives_the_daemon_keys_that_it_has(self):
        module, params = self.launch_file(), self.place / "my.params.yaml"
        params.write_text(
            "/pose_walld:\n  ros__parameters:\n    planar: off\n    ros2: false\n    alert_limit_angle_deg: 2.5\n"
            "pose_walld: {ros__parameters: {base_frame: machine}}\nother: {ros__parameters: {rate: 3}}\n",
            encoding="utf-8",
        )
        words = module.settings(params)
        self.assertEqual(words[1::2], ["planar=off", "ros2=0", "alert_limit_angle_deg=2.5", "base_frame=machine"])
        defaults = {
            argument.words[0]: argument.default_value for argument in module.generate_launch_description().words[0][:-2]
        }
        self.assertEqual(set(defaults), {name for name, _, _ in module.ARGUMENTS})
        road = live_peer.simulated_road(POSE_WALL)
        command = module.daemon({**defaults, "config": str(road / "pose_wall.yaml"), "params": str(params)})[0].cmd
        # Every key is one of the daemon's: it begins, and ends with the recording that stands in for clouds of ROS.
        done = subprocess.run(
            [POSE_WALLD, *command[1:], "--replay", road / "frames", "--speed", "0"],
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        params.write_text("/pose_walld: {ros__parameters: {planr: off}}\n", encoding="utf-8")
        done = subprocess.run(
            [
                POSE_WALLD,
                *module.daemon({**defaults, "config": str(road / "pose_wall.yaml"), "params": str(params)})[0].cmd[1:],
            ],
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("planr", done.stderr)
        params.write_text("/pose_walld: {ros__parameters: {body_box_1: [1, 2]}}\n", encoding="utf-8")
        with self.assertRaisesRegex(ValueError, "body_box_1"):
            module.settings(params)


def snake(name):
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()


if __name__ == "__main__":
    live_peer.main()
