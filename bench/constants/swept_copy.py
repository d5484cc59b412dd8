# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""A copy of the sources in which constants are read once at start (swept.hpp), and the command built from it.

What depends on a swept constant is no constant expression any more. The compiler finds such places. A constant that is
computed from a swept one becomes const as well, and a static_assert goes. Where neither helps (sizes of arrays,
arguments of templates) the constant is not swept."""

import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tests/checks"))
import check_constants as checked  # noqa: E402  # one reader of constants and their reasons, also of the check

ROOMS = ("base", "lidar", "engine")
COPIED = ("CMakeLists.txt", "LICENSE", "README.md", "bench", "config", "include", "src", "tools", "toolchains")
DECLARED = (r"(?P<aside>(?:(?:static|inline)\s+)*)constexpr\s+(?P<type>[\w:]+(?:\s+\w+)?)\s+{name}\s*=\s*"
            r"(?P<value>[^;]+);")
NOT_CONSTANT = re.compile(
    r"^([^\s:]+):(\d+):\d+: error: the value of '(?:[^']*::)?(\w+)' is not usable in a constant expression\n"
    r"(?:(?!.*?(?:error|note): ).*\n)*([^\s:]+):\d+:\d+: note: ", re.M)
ARRAY = re.compile(r"^([^\s:]+):(\d+):\d+: error: size of array", re.M)
ROUNDS = 12  # each finds what the last one's changes touch


class Constant:
    def __init__(self, file, name, reason):
        self.file, self.name, self.reason = file, name, reason

    @property
    def key(self):
        return f"{self.file}:{self.name}"


def all_constants(root=ROOT):
    """Each named number of base and engine, and each gate of the table, with its reason."""
    found = []
    for path in checked.sources(root / "src", ROOMS):
        file = str(path.relative_to(root / "src"))
        found += [Constant(file, name, reason) for _, name, reason in checked.constants(path.read_text("utf-8"))]
    return found


def scope_at(code, at):
    """Where a declaration stands: in a namespace, a class or a function. `code` is without comments."""
    opened, begin = [], 0
    for match in re.finditer(r"[;{}]", code[:at]):
        if match[0] == "{":
            opened.append(code[begin:match.start()])
        elif match[0] == "}" and opened:
            opened.pop()
        begin = match.end()
    inner = opened[-1] if opened else "namespace"
    if "namespace" in inner or 'extern "' in inner:
        return "namespace"
    return "class" if re.search(r"\b(?:struct|class)\b", inner) and "(" not in inner else "function"


ASIDE = {"namespace": "[[maybe_unused]] static const", "class": "inline static const", "function": "static const"}


class Copy:
    """`folder`: tree and build of the copy. They stay, so that the next sweep compiles only what is different."""

    def __init__(self, folder):
        self.tree, self.build = folder / "tree", folder / "build"
        self.command, self.found = self.build / "pose_wall", folder / "found.json"
        self.swept, self.derived, self.left, self.asserts = {}, {}, {}, set()

    def fill(self, constants):
        """With what the last call found of the same sources, so that it compiles once."""
        self.swept = {c.key: c for c in constants}
        if not self.found.exists():
            return
        known = json.loads(self.found.read_text("utf-8"))
        if known["sources"] != fingerprint():
            sys.exit(f"{self.found.parent} is of other sources: take another work folder (--work)")
        self.derived, self.asserts = known["derived"], {tuple(place) for place in known["asserts"]}
        self.left = {key: why for key, why in known["left"].items() if key in self.swept}
        self.swept = {key: c for key, c in self.swept.items() if key not in self.left}

    def note(self):
        self.found.write_text(json.dumps({"sources": fingerprint(), "derived": self.derived, "left": self.left,
                                          "asserts": sorted(self.asserts)}, indent=1), encoding="utf-8")

    def write(self):
        """The sources with the constants of `swept` and `derived` rewritten; files keep their times where they are
        the same."""
        for name in COPIED:
            paths = [ROOT / name] if (ROOT / name).is_file() else sorted((ROOT / name).rglob("*"))
            for path in paths:
                if path.is_file() and "__pycache__" not in path.parts:
                    self.write_file(path)
        for name, place in (("swept.hpp", "src/base"), ("kept_frames.hpp", "tools/lab/campaign")):
            put(self.tree / place / name, (HERE / name).read_bytes())

    def write_file(self, path):
        file = path.relative_to(ROOT)
        content = path.read_bytes()
        if file.parts[0] == "src" and path.suffix in {".cpp", ".hpp"}:
            content = self.rewritten(str(file.relative_to("src")), content.decode("utf-8")).encode("utf-8")
        elif str(file) == "tools/lab/campaign/runner.cpp":
            content = with_kept_frames(content.decode("utf-8")).encode("utf-8")
        put(self.tree / file, content)
        shutil.copymode(path, self.tree / file)

    def rewritten(self, file, text):
        before = text
        for key, constant in self.swept.items():
            if constant.file == file:
                text = self.changed(text, constant.name, key)
        for key in self.derived:
            if key.rpartition(":")[0] == file:
                text = self.changed(text, key.rpartition(":")[2], None)
        text = without_asserts(text, [line for f, line in self.asserts if f == file])
        return with_include(text) if text != before else text

    def changed(self, text, name, key):
        """The declaration of `name` without constexpr; with `key`, its value is asked for at start."""
        code, _ = checked.split(text)
        match = re.search(DECLARED.format(name=name), code)
        if not match or re.search(r",\s*\w+\s*=", match["value"]):
            self.left[key or name] = "is declared together with others, or is a table"
            return text
        kind, (begin, end) = match["type"], match.span("value")
        value = text[begin:end]
        if key:
            value = f'pose_wall_swept::swept<{kind}>("{key}", {value})'
        return f"{text[:match.start()]}{ASIDE[scope_at(code, match.start())]} {kind} {name} = {value}{text[end:]}"

    def make(self):
        """Builds; takes out of `swept` what cannot be built. The command is then at `command`."""
        if not (self.build / "build.ninja").exists():
            self.configure()
        for _ in range(ROUNDS):
            self.write()
            done = subprocess.run(["ninja", "-C", self.build, "-k0", "pose_wall_objects"], text=True, env=english(),
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            if done.returncode == 0:
                break
            if not self.mend(done.stdout):
                sys.exit(f"the copy does not compile:\n{done.stdout[-4000:]}")
            print(f"compiled: {len(self.swept)} swept, {len(self.derived)} computed from them", file=sys.stderr)
        self.note()
        subprocess.run(["ninja", "-C", self.build, "pose_wall_cli"], check=True, stdout=subprocess.DEVNULL)

    def configure(self):
        self.write()
        options = ["CMAKE_BUILD_TYPE=Release", "POSE_WALL_QUICK_BUILD=ON", "POSE_WALL_WERROR=OFF",
                   "POSE_WALL_BUILD_TESTS=OFF", "POSE_WALL_BUILD_PYTHON=OFF", "CMAKE_CXX_FLAGS=-Wno-narrowing -w"]
        subprocess.run(["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", *[f"-D{o}" for o in options]],
                       check=True, stdout=subprocess.DEVNULL)

    def mend(self, told):
        """What the compiler's words ask for. False if they ask for nothing new."""
        places = {(self.file(path), int(line), name, self.file(declared))
                  for path, line, name, declared in NOT_CONSTANT.findall(told)}
        derived, asserts = set(self.derived), set(self.asserts)
        mended = [self.mend_one(*place, derived, asserts) for place in sorted(places)]
        mended += [self.leave_size(self.file(path), int(line)) for path, line in sorted(set(ARRAY.findall(told)))]
        return any(mended)

    def file(self, path):
        return os.path.relpath(os.path.join(self.build, path), self.tree / "src")

    def mend_one(self, file, line, name, declared_in, derived, asserts):
        """`derived`, `asserts`: what was mended before this round, to no avail if it comes again."""
        statement = statement_at((ROOT / "src" / file).read_text("utf-8"), line)  # the copy's #line counts as there
        declared = re.search(r"constexpr\s+[\w:]+(?:\s+\w+)?\s+(\w+)\s*=", statement)
        if declared and f"{file}:{declared[1]}" not in derived:
            self.derived.setdefault(f"{file}:{declared[1]}", f"{declared_in}:{name}")
            return True
        if "static_assert" in statement and (file, line) not in asserts:
            self.asserts.add((file, line))
            return True
        return self.leave(f"{declared_in}:{name}", f"a constant expression needs it ({file}:{line})")

    def leave_size(self, file, line):
        """Of an array's size the compiler does not say which constant it is."""
        lines = (ROOT / "src" / file).read_text("utf-8").split("\n")
        names = set(re.findall(r"\bk\w+", lines[line - 1]))
        keys = [key for key in [*self.swept, *self.derived] if key.rpartition(":")[2] in names]
        here = [key for key in keys if key.rpartition(":")[0] == file] or keys
        return any([self.leave(key, f"the size of an array ({file}:{line})") for key in here])

    def leave(self, key, why):
        """It stays a constant; where it is computed from a swept one, that one does as well."""
        if key in self.derived:
            self.leave(self.derived.pop(key), why)
            return True
        if key not in self.swept:
            return False
        self.left[key] = why
        del self.swept[key]
        return True


def fingerprint():
    """Of the sources that the copy is made from."""
    total = hashlib.sha256()
    for path in sorted((ROOT / "src").rglob("*")):
        if path.is_file():
            total.update(path.read_bytes())
    return total.hexdigest()


def put(path, content):
    if path.exists() and path.read_bytes() == content:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


def english():
    return {**os.environ, "LC_ALL": "C"}


def statement_at(text, line):
    """The statement that line `line` (from 1) is part of."""
    code, _ = checked.split(text)
    at = sum(len(part) + 1 for part in code.split("\n")[:line - 1])
    end = code.find("\n", at)
    begin = max(code.rfind(mark, 0, at) for mark in ";{}") + 1
    return code[begin:max(code.find(";", at), end)]


def without_asserts(text, lines):
    """Lines keep their numbers: a static_assert becomes a comment."""
    parts = text.split("\n")
    for line in lines:
        k = line - 1
        while "static_assert" not in parts[k]:
            k -= 1
        while True:
            last = ");" in parts[k]
            parts[k] = "//" + parts[k]
            if last:
                break
            k += 1
    return "\n".join(parts)


def with_include(text):
    """The header before the first include; after it the lines count as in the sources."""
    at = re.search(r"^#include", text, re.M).start()
    line = text.count("\n", 0, at) + 1
    return f'{text[:at]}#include "base/swept.hpp"\n#line {line}\n{text[at:]}'


def replaced_once(text, old, new):
    if text.count(old) != 1:
        sys.exit(f"sweep.py no longer knows the sources: {old!r} stands there {text.count(old)} times, not once")
    return text.replace(old, new)


def with_kept_frames(text):
    """The campaign's loop with frames that are kept (kept_frames.hpp)."""
    before = '#include "lab/campaign/folder.hpp"\n'
    text = replaced_once(text, before, before + '#include "lab/campaign/kept_frames.hpp"\n')
    return replaced_once(text, "const sim::Simulator simulator = simulator_of(run);", "KeptRun simulator(run);")
