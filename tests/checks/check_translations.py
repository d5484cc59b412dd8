#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Every text that the tools mark for translation has its Chinese, and every Chinese text its use.

usage: check_translations.py ROOT     exit status 1 and one line per text that
  - is marked in tools/ (say("..."), tr("..."), translatable("...")), or stands in a table that tools print, and is in
    no tools/io/language/zh/*.po. Tables are, in src/engine, keys' help in config_keys.def; states, parts, senses,
    reasons and statuses of values in names.def; rules over two keys in config.cpp; and those of include/ whose rows a
    verb takes as settings
  - stands in a catalogue and is marked nowhere, or stands there twice
  - fills in other arguments than the English one or gives one another type ({:d} for {:.2f}), or holds no Chinese

Parts of the daemon (tools/apps/live) speak English, and log and page tell it again by live_health.po. There a text
needs no mark: each of its sentences has to stand in the daemon's sources. What a part says has to stand in a
catalogue."""

import collections
import pathlib
import re
import sys

LITERAL = r'"((?:[^"\\\n]|\\.)*)"'
MARKED = re.compile(rf'\b(?:say|tr|translatable)\(\s*((?:{LITERAL}\s*)+)')
KEY_HELP = re.compile(rf'^POSE_WALL_[A-Z]+ *\(.*, *{LITERAL}\)$', re.M)
NAME = re.compile(rf'^(?:STATE|PART|SENSE) *\(\w+, {LITERAL}\)$', re.M)
REASON = re.compile(rf'^REASON *\(\w+, "\w+", {LITERAL}\)$', re.M)
# Of the statuses tools print only why a key refuses its value; the others are for programmers.
STATUS = re.compile(rf'^STATUS *\(POSE_WALL_E_(?:VALUE|TEXT)_\w+, -\d+, {LITERAL}\)$', re.M)
PRINTED = re.compile(r'POSE_WALL_SETTING_ROW\(\w+, __VA_ARGS__\)\n#include "(\w+\.def)"')
# Of the motion library's reasons the texts; their names are no words.
MOTION_REASON = re.compile(rf'^ *\{{"\w+", {LITERAL}\}}[,}}]', re.M)
RULE = re.compile(rf'\{{"\w+", "\w+", {LITERAL}\}}')
HAN = re.compile(r"[\u3400-\u9fff]")
FIELD = re.compile(r"(?<!\{)\{(\w*)(:[^{}]*(?:\{\w*\}[^{}]*)*)?\}(?!\})")
ESCAPES = {"n": "\n", "t": "\t", '"': '"', "\\": "\\"}


def unescaped(text):
    return re.sub(r"\\(.)", lambda found: ESCAPES.get(found.group(1), found.group()), text)


def marked(root):
    """{text: where it is marked first}"""
    texts, tables = {}, []
    for path in sorted((root / "tools").rglob("*.[ch]pp")):
        source = path.read_text(encoding="utf-8")
        tables += [(root / "include" / table, KEY_HELP, False) for table in PRINTED.findall(source)]
        for found in MARKED.finditer(source):
            if source[: found.start()].rsplit("\n", 1)[-1].lstrip().startswith("//"):
                continue  # a comment that shows how
            text = "".join(unescaped(part) for part in re.findall(LITERAL, found.group(1)))
            texts.setdefault(text, f"{path.relative_to(root)}:{source.count(chr(10), 0, found.start()) + 1}")
    # The engine knows no language; tools print its tables, names with spaces for their underscores.
    engine = root / "src" / "engine"
    for path, rows, spoken in (*tables, (engine / "config_keys.def", KEY_HELP, False),
                               (engine / "names.def", NAME, True), (engine / "names.def", REASON, False),
                               (engine / "names.def", STATUS, False), (engine / "config.cpp", RULE, False),
                               (root / "src/motion/motion_api.cpp", MOTION_REASON, False)):
        for found in rows.finditer(path.read_text(encoding="utf-8") if path.exists() else ""):
            text = unescaped(found.group(1))
            texts.setdefault(text.replace("_", " ") if spoken else text, path.relative_to(root))
    return texts


RETOLD = "live_health.po"
STRINGS = re.compile(rf'(?:{LITERAL}\s*)+')
SAID = re.compile(r'(?:health(?:\.|->)summary \+?=|log_line\(|health(?:\.|->)add\()((?:"(?:[^"\\]|\\.)*"|[^;"])*);')


def sentences(text):
    """What stands between fields and semicolons, where it is more than a name or a unit."""
    parts = re.split(r"; |;$|\n", re.sub(FIELD, "; ", text))
    return [part.strip(" :,.()'") for part in parts if len(re.findall("[A-Za-z]", part)) > 4 and " " in part.strip()]


def strings_of(source):
    return ["".join(unescaped(part) for part in re.findall(LITERAL, found.group()))
            for found in STRINGS.finditer(source)]


def daemon_faults(root, catalogue):
    """Of what the daemon says and what is told again. `catalogue`: [(file, line, English)] of all."""
    every = "\n".join(msgid for _, _, msgid in catalogue)
    known = ""
    for path in sorted((root / "tools/apps/live").rglob("*.[ch]pp")):
        source = path.read_text(encoding="utf-8")
        known += "\n".join(strings_of(source)) + "\n"
        if path.suffix != ".cpp" or path.parent.name == "sensor_sim":
            continue
        for statement in SAID.findall(source):
            for text in strings_of(statement):
                for sentence in sentences(text):
                    if sentence not in every:
                        yield f"{path.relative_to(root)}: in no catalogue: {sentence[:70]!r}"
    for name, line, msgid in catalogue:
        for sentence in sentences(msgid) if name.name == RETOLD else ():
            if sentence not in known:
                yield f"{name}:{line}: said nowhere in tools/apps/live: {sentence[:60]}"


def entries(path):
    """(line, msgid, msgstr) of a PO file."""
    msgid = msgstr = None
    begun = 0
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines() + [""], 1):
        if line.startswith("msgid ") or not line:
            if msgid and msgstr is not None:
                yield begun, msgid, msgstr
            msgid = msgstr = None
        if line.startswith("msgid "):
            begun, msgid = number, unescaped(line[7:-1])
        elif line.startswith("msgstr "):
            msgstr = unescaped(line[8:-1])
        elif line.startswith('"'):
            if msgstr is None:
                msgid += unescaped(line[1:-1])
            else:
                msgstr += unescaped(line[1:-1])


def filled_in(text):
    """Which arguments a text takes, each with the letter of its type: {} counts on, {0} and {name} name theirs."""
    return sorted((name or str(number)) + (re.search(r"[a-zA-Z]?$", form).group() and f":{form[-1]}")
                  for number, (name, form) in enumerate(FIELD.findall(text)))


def faults(root):
    texts = marked(root)
    if not texts:
        yield "tools/ marks no text: nothing was checked"
    seen, catalogue = collections.Counter(), []
    for path in sorted((root / "tools/io/language/zh").glob("*.po")):
        name = path.relative_to(root)
        for line, msgid, msgstr in entries(path):
            seen[msgid] += 1
            shown = msgid[:60].replace("\n", "\\n")
            catalogue.append((name, line, msgid))
            if msgid not in texts and path.name != RETOLD:
                yield f"{name}:{line}: marked nowhere in tools/: {shown}"
            if seen[msgid] == 2:
                yield f"{name}:{line}: stands in the catalogues twice: {shown}"
            if filled_in(msgid) != sorted(set(filled_in(msgstr))) and filled_in(msgid) != filled_in(msgstr):
                yield f"{name}:{line}: fills in {filled_in(msgstr)}, the English {filled_in(msgid)}: {shown}"
            if not HAN.search(msgstr) and re.search(r"[A-Za-z]{3}", re.sub(r"\{[^}]*\}", "", msgid)):
                yield f"{name}:{line}: no Chinese: {shown}"
    for text, place in texts.items():
        if text not in seen:
            yield f"{place}: in no catalogue: {text[:70]!r}"
    yield from daemon_faults(root, catalogue)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root = pathlib.Path(sys.argv[1]).resolve()
    found = list(faults(root))
    print("\n".join(found) or f"{len(marked(root))} texts, each in both languages")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
