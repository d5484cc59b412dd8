# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Settings by name. Every key is read back as it was written. What is refused says why and changes nothing. A
pose_wall.yaml comes to the same as for the command."""

import copy
import math
import pickle
import re
import subprocess
import sys
import unittest

from support import ROOT, needs_command, np, pose_wall, run_command, scratch

from pose_wall.config import OUTSIDE_KEYS  # pylint: disable=wrong-import-order
from pose_wall import Config, ConfigError, KeyType, Status  # pylint: disable=wrong-import-order

try:
    import yaml
except ImportError:
    yaml = None

needs_yaml = unittest.skipUnless(yaml, "PyYAML is missing: apt install python3-yaml")


class Keys(unittest.TestCase):
    def test_defaults_are_those_of_the_table(self):
        config = Config()
        self.assertGreater(len(config), 50)
        self.assertEqual(set(config), set(pose_wall.KEYS))
        for key, info in pose_wall.KEYS.items():
            value = config[key]
            if info.type in (KeyType.NUMBER, KeyType.INTEGER):
                self.assertEqual(value, float(info.default), key)
                self.assertIs(type(value), int if info.type is KeyType.INTEGER else float, key)
            elif info.type is not KeyType.BOX:
                self.assertEqual(value, info.default, key)
            self.assertTrue(info.help and info.group and info.allowed, key)

    def test_every_key_is_written_and_read(self):
        for key, info in pose_wall.KEYS.items():
            config = Config()
            values = {KeyType.NUMBER: [info.minimum, info.maximum],
                      KeyType.INTEGER: [int(info.minimum), int(info.maximum)],
                      KeyType.CHOICE: info.choices, KeyType.TEXT: ["word", "", "x" * 63],
                      KeyType.BOX: [(-1.5, 2.0, -0.25, 0.5, -1.0, 0.125), ()]}[info.type]
            for value in values:
                config[key] = value
                self.assertEqual(config[key], value, key)
                self.assertEqual({other for other in config if config[other] != Config()[other]} - {key}, set())

    def test_kinds_of_numbers(self):
        config = Config()
        for value in (40, 40.0, np.float32(40), np.int16(40), "40", "+4e1"):
            config["yaw_max_deg"] = value
            self.assertEqual(config["yaw_max_deg"], 40.0)
        config["body_box_1"] = np.array([-1, 1, -1, 1, -1, 1])
        self.assertEqual(config["body_box_1"], (-1.0, 1.0, -1.0, 1.0, -1.0, 1.0))
        config["body_box_1"] = "[-2, 2, -2, 2, -2, 2]"
        self.assertEqual(config["body_box_1"], (-2.0, 2.0, -2.0, 2.0, -2.0, 2.0))
        for nothing in (None, (), [], "", "[]"):
            config["body_box_1"] = (-1, 1, -1, 1, -1, 1)
            config["body_box_1"] = nothing
            self.assertEqual(config["body_box_1"], ())

    def test_unknown_keys(self):
        for key, meant in (("yaw_max", "yaw_max_deg"), ("voxel_leave", "voxel_leaf")):
            for call in (lambda: Config()[key], lambda: Config({key: 1}), lambda: Config().replace(**{key: 1})):
                with self.assertRaises(KeyError) as caught:
                    call()
                self.assertIsInstance(caught.exception, pose_wall.Error)
                self.assertEqual(caught.exception.status, Status.KEY_UNKNOWN)
                self.assertIn(f"did you mean '{meant}'?", str(caught.exception))
        with self.assertRaisesRegex(KeyError, "replaced it: leave it out, or write integrity_risk=5.73e-07"):
            Config(protection_factor=5.0)
        for key in ("qqqqqqqq", "", 7, None, b"yaw_max_deg", "yaw_max_deg\0"):
            self.assertNotIn(key, Config())
            with self.assertRaises(KeyError):
                Config()[key]  # pylint: disable=expression-not-assigned
        with self.assertRaises((TypeError, AttributeError)):
            del Config()["yaw_max_deg"]

    def test_refused_values_change_nothing_and_say_what_is_allowed(self):
        for key, value, status, words in (
                ("yaw_max_deg", 1000, Status.VALUE_RANGE, "a number from"),
                ("yaw_max_deg", math.nan, Status.VALUE_RANGE, "deg"),
                ("yaw_max_deg", 10**400, Status.VALUE_RANGE, "deg"),
                ("yaw_max_deg", "fast", Status.VALUE_TYPE, "a number from"),
                ("yaw_max_deg", "nan", Status.VALUE_TYPE, "a number from"),
                ("yaw_max_deg", True, Status.VALUE_TYPE, "True"),
                ("yaw_max_deg", None, Status.VALUE_TYPE, "None"),
                ("yaw_max_deg", [1.0], Status.VALUE_TYPE, "a number from"),
                ("yaw_max_deg", "40\0", Status.VALUE_TYPE, "a number from"),
                ("points_max", 6000.5, Status.VALUE_TYPE, "a whole number from"),
                ("forward_axis", "+Q", Status.VALUE_TYPE, "one of +X, -X, +Y, -Y"),
                ("forward_axis", 1, Status.VALUE_TYPE, "one of +X"),
                ("lidar_frame", "x" * 64, Status.TEXT_LONG, "at most 63 bytes"),
                ("lidar_frame", 3, Status.VALUE_TYPE, "text"),
                ("body_box_1", (1, 2, 3), Status.VALUE_TYPE, "x_min x_max"),
                ("body_box_1", (2, 1, 0, 1, 0, 1), Status.VALUE_RANGE, "min < max"),
                ("body_box_1", (0, math.inf, 0, 1, 0, 1), Status.VALUE_TYPE, "x_min"),
                ("body_box_1", 5, Status.VALUE_TYPE, "x_min")):
            config = Config()
            with self.assertRaises(ConfigError, msg=f"{key} = {value!r}") as caught:
                config[key] = value
            self.assertEqual(caught.exception.status, status, f"{key} = {value!r}")
            self.assertIsInstance(caught.exception, ValueError)
            self.assertIn(key, str(caught.exception))
            self.assertIn(words, str(caught.exception))
            self.assertEqual(config, Config())

    def test_rules_over_several_keys(self):
        config = Config(range_min=9.0, range_max=8.0)
        for call in (config.check, lambda: pose_wall.Engine(config), lambda: config.memory_bytes):
            with self.assertRaises(ConfigError) as caught:
                call()
            self.assertEqual(caught.exception.status, Status.CONFIG_RULE)
            self.assertIn("range_min must be smaller than range_max", str(caught.exception))

    def test_copies(self):
        config = Config(voxel_leaf=0.1, body_box_2=(0, 1, 0, 1, 0, 1))
        for other in (config.copy(), copy.copy(config), copy.deepcopy(config), pickle.loads(pickle.dumps(config)),
                      config.replace(), Config(dict(config))):
            self.assertEqual(other, config)
            self.assertEqual(other.crc32, config.crc32)
            other["voxel_leaf"] = 0.2
            self.assertEqual(config["voxel_leaf"], 0.1)
            self.assertNotEqual(other, config)
        self.assertEqual(config.replace(voxel_leaf=0.05, body_box_2=None), Config())
        self.assertEqual(repr(config), "Config({'body_box_2': (0.0, 1.0, 0.0, 1.0, 0.0, 1.0), 'voxel_leaf': 0.1})")
        with self.assertRaises(TypeError):
            hash(config)


@needs_yaml
class Files(unittest.TestCase):
    def load(self, text, **settings):
        file = scratch() / "pose_wall.yaml"
        file.write_bytes(text if isinstance(text, bytes) else text.encode())
        return Config.load(file, set=settings)

    def refused(self, text, *words, kind=ConfigError, **settings):
        with self.assertRaises(kind) as caught:
            self.load(text, **settings)
        for word in words:
            self.assertIn(word, str(caught.exception))
        return str(caught.exception)

    def test_values_as_they_are_written(self):
        config = self.load("forward_axis: -Y\nyaw_max_deg: +40.0\nbody_box_1: [-1, 1, '-2', 2, -0.5, .5]\n"
                           "lidar_frame: yes\nbase_frame: 017\nvoxel_leaf: 1e-1 # leaf\n", voxel_leaf=0.2)
        self.assertEqual(config, Config(forward_axis="-Y", yaw_max_deg=40, body_box_1=(-1, 1, -2, 2, -0.5, 0.5),
                                        lidar_frame="yes", base_frame="017", voxel_leaf=0.2))
        for nothing in ("", "# only a comment\n"):
            self.assertEqual(self.load(nothing), Config())
        self.assertEqual(Config.load(set={"voxel_leaf": 0.1}), Config(voxel_leaf=0.1))

    def test_all_faults_at_once(self):
        text = self.refused("voxel_leave: 1\nyaw_max_deg: 1000\nrange_min: 1\nrange_min: 2\nforward_axis: [1]\n",
                            "pose_wall.yaml:1: 'voxel_leave', did you mean 'voxel_leaf'?",
                            "pose_wall.yaml:2: yaw_max_deg", "pose_wall.yaml:4: range_min is set a second time",
                            "pose_wall.yaml:5: forward_axis", "set: hold_max", hold_max=-1)
        self.assertEqual(len(text.splitlines()), 5)

    def test_a_file_for_the_daemon_too(self):
        self.assertEqual(self.load("http: 127.0.0.1:8080\nros2: 1\nvoxel_leaf: 0.1\n"), Config(voxel_leaf=0.1))
        self.refused("http: a\nhttp: b\n", "pose_wall.yaml:2: http is set a second time")
        self.refused("http: a\n", "'modbus'", modbus="127.0.0.1:502")  # what is set here is for the engine

    @needs_command
    def test_keys_of_the_daemon_are_those_of_the_command(self):
        told = set(re.findall(r"^  (\w+)$", run_command("check-config", "--keys"), re.M))
        self.assertEqual(told, set(pose_wall.KEYS) | OUTSIDE_KEYS)
        self.assertEqual(set(pose_wall.KEYS) & OUTSIDE_KEYS, set())

    def test_rules_name_where_keys_were_set(self):
        self.refused("range_min: 9\n", "range_min", "pose_wall.yaml:1", "range_max (set)", range_max=8)

    def test_what_is_no_list_of_settings(self):
        for text, word in (("- a\n- b\n", "'key: value'"), ("just words\n", "'key: value'"),
                           ("a: {b: c}\n", "not nested"), ("a: [[1]]\n", "nothing nested"),
                           ("a: &x 1\nb: *x\n", "aliases"),
                           ("{a: b", "not YAML"),
                           ("a: 1\n---\nb: 2\n", "a second document"), ("[a]: 1\n", "a key is expected"),
                           (b"\xff\xfe\xff\xff", "not YAML"), (b"a: \x00\n", "not YAML"), ("a: 'x\n", "not YAML")):
            self.refused(text, "pose_wall.yaml", word, kind=pose_wall.YamlError)
        self.refused(b"# " * 600_000, "1048576 bytes", kind=pose_wall.YamlError)
        with self.assertRaises(OSError):
            Config.load(scratch() / "missing.yaml")
        with self.assertRaises(OSError):
            Config.load(scratch())

    @needs_command
    def test_the_files_of_the_tree_come_to_what_the_command_says(self):
        """By the checksum over all settings."""
        files = sorted((ROOT / "config").glob("*.yaml"))
        self.assertGreater(len(files), 3)
        for file in files:
            self.assertIn(f"16#{Config.load(file).crc32:08X} ", run_command("check-config", file), file)


class WithoutYaml(unittest.TestCase):
    def test_it_says_what_to_install(self):
        code = ("import sys; sys.modules['yaml'] = None\nimport pose_wall\n"
                "print(pose_wall.Config(yaw_max_deg=40)['yaw_max_deg'])\npose_wall.Config.load('x.yaml')")
        done = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              check=False)
        self.assertEqual((done.returncode, done.stdout), (1, "40.0\n"))
        self.assertIn("apt install python3-yaml", done.stderr)


if __name__ == "__main__":
    unittest.main()
