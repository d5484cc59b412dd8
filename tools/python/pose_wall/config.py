# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Settings: the keys of pose_wall.yaml."""

import ctypes
import difflib
import pathlib

from ._headers import CONSTANTS, STRUCTS
from ._library import LIBRARY, Error, call

# Keys that the daemon reads and the engine does not; a file for both is a good file.
_TYPES = {"NUMBER": CONSTANTS["POSE_WALL_KEY_NUMBER"], "INTEGER": CONSTANTS["POSE_WALL_KEY_INTEGER"],
          "BOX": CONSTANTS["POSE_WALL_KEY_BOX"]}


def _table():
    keys = {}
    for index in range(LIBRARY.pose_wall_config_key_count()):
        row = STRUCTS["pose_wall_key_info"]()
        call("config_key", ctypes.c_uint32(index), row)
        keys[row.name.decode()] = row
    return keys


KEYS = _table()


class Config:
    """All settings of an engine, as a mapping: `config["yaw_max_deg"] = 40`. Boxes are tuples of six numbers."""

    def __init__(self, settings=None):
        self._struct = STRUCTS["pose_wall_config"]()
        call("config_init_2", self._struct)
        for key, value in (settings or {}).items():
            self[key] = value

    @classmethod
    def load(cls, path, settings=None):
        """From a pose_wall.yaml, then from `settings`. Keys of the daemon are passed over. Needs python3-yaml."""
        import yaml  # pylint: disable=import-outside-toplevel  # only who has a file needs it
        text = pathlib.Path(path).read_text(encoding="utf-8")
        # As text: +X and +2.0 are for the engine to read.
        read = yaml.load(text, Loader=yaml.BaseLoader) or {}
        if not isinstance(read, dict):
            raise ValueError(f"{path}: a mapping of keys to values is expected")
        config = cls()
        for key, value in (read | (settings or {})).items():
            if key in DAEMON_KEYS:
                continue
            try:
                config[key] = value
            except (KeyError, ValueError) as fault:
                raise type(fault)(f"{path}: {fault.args[0]}") from None
        return config

    @property
    def struct(self):
        return self._struct

    @property
    def crc32(self):
        """What a process image carries as config_crc32."""
        crc = ctypes.c_uint32()
        call("config_crc", self._struct, ctypes.byref(crc))
        return crc.value

    def check(self):
        """Raises ValueError for a rule over several keys that does not hold."""
        fault = STRUCTS["pose_wall_rule_fault"]()
        if LIBRARY.pose_wall_config_check(ctypes.byref(self._struct), ctypes.byref(fault)) != 0:
            raise ValueError(f"{fault.key.decode()} {fault.other_key.decode()}: {fault.rule.decode()}")

    def __setitem__(self, key, value):
        row = self._row(key)
        if isinstance(value, (list, tuple)):
            value = " ".join(str(item) for item in value)
        try:
            call("config_set", self._struct, key.encode(), str(value).encode())
        except Error as fault:
            allowed = row.choices.decode() or f"{row.minimum:g} to {row.maximum:g} {row.unit.decode()}"
            raise ValueError(f"{key}: {value!r} is refused ({fault}); allowed: {allowed}") from None

    def __getitem__(self, key):
        row = self._row(key)
        if row.type == _TYPES["BOX"]:
            box = (ctypes.c_double * 6)()
            call("config_get_box", self._struct, key.encode(), box)
            return tuple(box)
        if row.type in (_TYPES["NUMBER"], _TYPES["INTEGER"]):
            number = ctypes.c_double()
            call("config_get_number", self._struct, key.encode(), ctypes.byref(number))
            return int(number.value) if row.type == _TYPES["INTEGER"] else number.value
        text = ctypes.create_string_buffer(CONSTANTS["POSE_WALL_TEXT_MAX"])
        call("config_get_text", self._struct, key.encode(), text, ctypes.c_uint64(len(text)))
        return text.value.decode()

    def __iter__(self):
        return iter(KEYS)

    def __len__(self):
        return len(KEYS)

    def keys(self):
        return KEYS.keys()

    def items(self):
        return [(key, self[key]) for key in KEYS]

    @staticmethod
    def _row(key):
        if key not in KEYS:
            near = difflib.get_close_matches(str(key), KEYS, 1)
            raise KeyError(f"there is no key '{key}'" + (f"; did you mean '{near[0]}'?" if near else ""))
        return KEYS[key]


# Of tools/config_file/live_settings.cpp; a test compares them with what the command prints.
DAEMON_KEYS = frozenset(
    "source extrinsic_from sensor sensor_metadata udp_address udp_port udp_sender frame_points_max ros1 ros2 "
    "ros_distro http modbus mqtt mqtt_topic black_box black_box_mb recording recording_mb recording_clouds "
    "status_every_s".split())
