# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The engine's settings by name, from keywords, from a pose_wall.yaml, or both."""

from __future__ import annotations

import ctypes
import difflib
import numbers
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Optional, Union

from . import _abi
from ._abi import KeyType, Status
from ._library import Error, check, lib
from ._yaml import entries_of

Value = Union[float, int, str, "tuple[float, ...]"]


class ConfigError(Error, ValueError):
    """A setting that is refused; the message names key, value and what is allowed, one fault a line."""


class UnknownKey(Error, KeyError):
    """No such key; the message names the one that may have been meant."""

    __str__ = Error.__str__  # KeyError would put it in quotes


@dataclass(frozen=True)
class KeyInfo:
    """What the engine's table knows of a key."""

    name: str
    type: KeyType
    unit: str
    choices: "tuple[str, ...]"
    default: str  # as it would be written in pose_wall.yaml
    group: str
    help: str
    minimum: float
    maximum: float

    @property
    def allowed(self) -> str:
        """In words."""
        unit = "" if self.unit in ("", "1") else f" {self.unit}"
        if self.type is KeyType.CHOICE:
            return f"one of {', '.join(self.choices)}" if len(self.choices) > 1 else f"only {self.choices[0]}"
        if self.type is KeyType.TEXT:
            return f"text of at most {_abi.POSE_WALL_TEXT_MAX - 1} bytes"
        if self.type is KeyType.BOX:
            return ("x_min x_max y_min y_max z_min z_max, each from "
                    f"{self.minimum:g} to {self.maximum:g}{unit} and min < max, or none")
        kind = "whole number" if self.type is KeyType.INTEGER else "number"
        return f"a {kind} from {self.minimum:g} to {self.maximum:g}{unit}"


def _read_table() -> "dict[str, KeyInfo]":
    table = {}
    for index in range(lib.pose_wall_config_key_count()):
        row = _abi.pose_wall_key_info()
        check(lib.pose_wall_config_key(index, row))
        table[row.name.decode()] = KeyInfo(
            row.name.decode(), KeyType(row.type), row.unit.decode(),
            tuple(filter(None, row.choices.decode().split("|"))), row.default_text.decode(),
            row.group.decode(), row.help.decode(), row.minimum, row.maximum)
    return table


KEYS: "dict[str, KeyInfo]" = _read_table()


# Of motion and of pose_walld (tools/io/config_file/motion_settings.cpp, live_settings.cpp,
# planar_settings.cpp): a file for all is a good file.
# A test compares them with what the command prints.
OUTSIDE_KEYS = frozenset((
    "motion_speed_max", "motion_turn_max_deg", "motion_range_max", "motion_keyframe",
    "source", "extrinsic_from", "sensor", "sensor_metadata", "udp_address", "udp_port", "udp_device_port", "udp_sender",
    "ros_source", "frame_points_max", "worker_priority", "ros1", "ros2", "ros_distro", "http", "http_names",
    "http_login", "http_certificate", "commissioning", "commissioned", "foxglove", "foxglove_origin", "modbus",
    "can", "can_frames", "can_first", "can_address", "mqtt", "mqtt_topic", "mqtt_user", "mqtt_password_file",
    "mqtt_tls", "mqtt_ca_file", "mqtt_cert_file", "mqtt_key_file", "black_box", "black_box_mb",
    "recording", "recording_mb", "recording_clouds", "status_every_s", "log_level",
    "planar", "planar_map", "planar_map_whole", "planar_cell", "planar_map_every_s", "planar_tf", "planar_map_frame",
    "planar_odom_frame",
    "planar_motion", "planar_command_modbus", "planar_command_ros", "planar_command_can", "planar_command_age",
    "planar_x_min", "planar_x_max", "planar_y_min", "planar_y_max", "planar_floor_z", "planar_height",
    "planar_clearance", "planar_speed_max", "planar_turn_max_deg", "planar_deceleration",
    "planar_acceleration", "planar_creep", "planar_latency", "planar_period", "planar_stale", "planar_scan_time"))


# Keys of old files, and what to write instead.
REPLACED = {"protection_factor": "integrity_risk replaced it: leave it out, or write integrity_risk=5.73e-07 for 5.0"}


def _known(key: Any) -> KeyInfo:
    if isinstance(key, str) and key in KEYS:
        return KEYS[key]
    if isinstance(key, str) and key in REPLACED:
        raise UnknownKey(Status.KEY_UNKNOWN, f"{key!r}, {REPLACED[key]}")
    near = difflib.get_close_matches(str(key), KEYS, 1)
    raise UnknownKey(Status.KEY_UNKNOWN, f"{key!r}{f', did you mean {near[0]!r}?' if near else ''}")


def _double(value: numbers.Real) -> float:
    try:
        return float(value)
    except OverflowError:  # of a whole number; the engine refuses it as out of range
        return float("inf")


def _box_text(value: Any) -> Optional[str]:
    """Six numbers as text; empty for no box; None for what is neither."""
    if value is None:
        return ""
    try:
        sides = [float(side) for side in value]
    except (TypeError, ValueError):
        return None
    return " ".join(map(repr, sides))


class Config(Mapping):  # type: ignore[type-arg]
    """All settings: defaults, then what is given. Keys are read and written like those of a dict; there are always all
    of them. Numbers are floats or ints, choices and texts str, boxes tuples of six floats or () for none. Text is taken
    for every key, as it stands in pose_wall.yaml. Copies and pickles; not to be changed by two threads at once."""

    def __init__(self, settings: Optional[Mapping] = None, **keys: Any) -> None:  # type: ignore[type-arg]
        self._c = _abi.pose_wall_config()
        check(lib.pose_wall_config_init(self._c))
        for key, value in {**(settings or {}), **keys}.items():
            self[key] = value

    @classmethod
    def load(cls, path: "Optional[Union[str, os.PathLike[str]]]" = None,
             set: Optional[Mapping] = None) -> Config:  # type: ignore[type-arg]  # pylint: disable=redefined-builtin
        """Defaults, then the file, then `set`; then the rules over several keys. All faults are told at once. Keys of
        the daemon are passed over."""
        config, origins = cls(), {}  # type: ignore[var-annotated]
        refused: "list[tuple[str, Error]]" = []
        given = [(f"{path}:{line}", key, value) for key, value, line in entries_of(path)] if path is not None else []
        for where, key, value in given:
            if key in origins:
                again = Error(Status.VALUE_TYPE, f"{key} is set a second time; the first is at {origins[key]}")
                refused.append((where, again))
            else:
                origins[key] = where
                refused += [] if key in OUTSIDE_KEYS else config._refusals(where, key, value)
        for key, value in (set or {}).items():
            origins[key] = "set"
            refused += config._refusals("set", key, value)
        if refused:
            raise ConfigError(refused[0][1].status, "\n".join(f"{where}: {error.detail}" for where, error in refused))
        config.check(origins)
        return config

    def _refusals(self, where: str, key: str, value: Any) -> "list[tuple[str, Error]]":
        try:
            self[key] = value
        except Error as error:
            return [(where, error)]
        return []

    def __getitem__(self, key: str) -> Value:
        info = _known(key)
        name = key.encode()
        if info.type is KeyType.BOX:
            box = (ctypes.c_double * 6)()
            check(lib.pose_wall_config_get_box(self._c, name, box), key)
            return tuple(box) if any(box) else ()
        if info.type in (KeyType.CHOICE, KeyType.TEXT):
            text = ctypes.create_string_buffer(_abi.POSE_WALL_TEXT_MAX)
            check(lib.pose_wall_config_get_text(self._c, name, text, len(text)), key)
            return text.value.decode(errors="surrogateescape")
        number = ctypes.c_double()
        check(lib.pose_wall_config_get_number(self._c, name, number), key)
        return int(number.value) if info.type is KeyType.INTEGER else number.value

    def __setitem__(self, key: str, value: Any) -> None:
        info = _known(key)
        status = self._set(info, value)
        if status != Status.OK:
            raise ConfigError(status, f"{key} = {value!r} is refused; allowed: {info.allowed}")

    def _set(self, info: KeyInfo, value: Any) -> int:
        name = info.name.encode()
        if info.type is KeyType.BOX and not isinstance(value, str):
            text = _box_text(value)
        elif isinstance(value, str):
            text = value
        elif isinstance(value, numbers.Real) and not isinstance(value, bool):
            return int(lib.pose_wall_config_set_number(self._c, name, _double(value)))
        else:
            text = None
        if text is None or "\0" in text:
            return Status.VALUE_TYPE
        return int(lib.pose_wall_config_set(self._c, name, text.encode(errors="surrogateescape")))

    def __iter__(self) -> Iterator[str]:
        return iter(KEYS)

    def __len__(self) -> int:
        return len(KEYS)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Config):
            return NotImplemented
        return bytes(self._c) == bytes(other._c)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        plain = Config()
        changed = {key: value for key, value in self.items() if value != plain[key]}
        return f"Config({changed})"

    def copy(self) -> Config:
        """Another one with the same settings."""
        made = Config()
        ctypes.memmove(ctypes.addressof(made._c), ctypes.addressof(self._c), ctypes.sizeof(self._c))
        return made

    __copy__ = copy

    def replace(self, **keys: Any) -> Config:
        """A copy in which these keys are others."""
        made = self.copy()
        for key, value in keys.items():
            made[key] = value
        return made

    def check(self, origins: Optional[Mapping] = None) -> None:  # type: ignore[type-arg]
        """The rules over several keys. `origins` says where a key was set, for the message."""
        fault = _abi.pose_wall_rule_fault()
        status = lib.pose_wall_config_check(self._c, fault)
        if status == Status.CONFIG_RULE:
            keys: "list[str]" = [key.decode() for key in (fault.key, fault.other_key) if key]
            places = keys if origins is None else [f"{key} ({origins.get(key, 'default')})" for key in keys]
            raise ConfigError(status, f"{' and '.join(places)}: {fault.rule.decode()}")
        check(status)

    @property
    def crc32(self) -> int:
        """As results and process images carry it."""
        crc = ctypes.c_uint32()
        check(lib.pose_wall_config_crc(self._c, crc))
        return crc.value

    @property
    def memory_bytes(self) -> int:
        """Of an engine with these settings."""
        self.check()
        size = ctypes.c_uint64()
        check(lib.pose_wall_memory_needed(self._c, size))
        return size.value
