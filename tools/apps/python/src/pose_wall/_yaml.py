# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The entries of a pose_wall.yaml as text: what YAML means by a number is not asked, for the engine reads "+X" and
"+2.0" itself."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any, Union

from ._abi import Status
from ._library import Error

# As `pose_wall run` has it: far above any config, and a recording by mistake is not read whole.
FILE_BYTES_MAX = 1024 * 1024


class YamlError(Error, ValueError):
    """A file that holds no settings; the message names file and line."""


def _fault(where: str, text: str) -> YamlError:
    return YamlError(Status.VALUE_TYPE, f"{where}: {text}")


def entries_of(path: "Union[str, os.PathLike[str]]") -> "Iterator[tuple[str, Union[str, list[str]], int]]":
    """Key, value and line of each entry."""
    try:
        import yaml  # type: ignore[import]  # pylint: disable=import-outside-toplevel
    except ImportError:
        raise ImportError("Config.load reads YAML with PyYAML: apt install python3-yaml (or pip install pyyaml). "
                          "Config({...}) and Config(key=value) need no file") from None
    with open(path, "rb") as file:
        text = file.read(FILE_BYTES_MAX + 1)
    if len(text) > FILE_BYTES_MAX:
        raise _fault(str(path), f"a config file has at most {FILE_BYTES_MAX} bytes; this has more")
    try:
        events = list(yaml.parse(text, Loader=yaml.SafeLoader))
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = f"{path}:{mark.line + 1}" if mark else str(path)
        raise _fault(where, f"not YAML: {getattr(error, 'problem', None) or error}") from None
    yield from _Walk(str(path), yaml, events).entries()


class _Walk:
    """From event to event of one document."""

    def __init__(self, path: str, yaml: Any, events: "list[Any]") -> None:
        self.path, self.yaml, self.events = path, yaml, iter(events)

    def entries(self) -> "Iterator[tuple[str, Union[str, list[str]], int]]":
        """See entries_of."""
        next(self.events)  # start of the stream
        if isinstance(next(self.events), self.yaml.StreamEndEvent):
            return
        root = next(self.events)
        if not isinstance(root, self.yaml.MappingStartEvent):
            raise self.fault(root, "lines of the form 'key: value' are expected")
        for event in self.events:
            if isinstance(event, self.yaml.MappingEndEvent):
                break
            if not isinstance(event, self.yaml.ScalarEvent):
                raise self.fault(event, "a key is expected here")
            yield event.value, self.value(event.value), event.start_mark.line + 1
        next(self.events)  # end of the document
        last = next(self.events)
        if not isinstance(last, self.yaml.StreamEndEvent):
            raise self.fault(last, "a second document; one is allowed")

    def value(self, key: str) -> "Union[str, list[str]]":
        event = next(self.events)
        if isinstance(event, self.yaml.ScalarEvent):
            return str(event.value)
        if not isinstance(event, self.yaml.SequenceStartEvent):
            raise self.fault(event, f"{key}: one value is expected; keys are not nested, aliases are not supported")
        items: "list[str]" = []
        for item in self.events:
            if isinstance(item, self.yaml.SequenceEndEvent):
                return items
            if not isinstance(item, self.yaml.ScalarEvent):
                raise self.fault(item, f"{key}: a list of numbers is allowed here, nothing nested")
            items.append(item.value)
        raise self.fault(event, f"{key}: a list without an end")

    def fault(self, event: Any, text: str) -> YamlError:
        return _fault(f"{self.path}:{event.start_mark.line + 1}", text)
