#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""No instruction in the libraries rounds a product and a sum in one: a machine without it would compute other bits.

    check_fused.py OBJDUMP ARCHIVE...
    check_fused.py OBJDUMP --levels "LEVEL|LEVEL..." "SOURCE|SOURCE..." COMPILER FLAG...

The first form reads the archives' disassembly. The second compiles each SOURCE at each LEVEL ("-O3 -march=haswell")
with the libraries' own FLAGs behind it, and reads that. Exit status 1 and one line per function with fused ones.

VMLA and VMLS of ARMv7 are none: they round the product first (Arm Architecture Reference Manual, ARMv7-A, A8.8.337)."""

import collections
import itertools
import pathlib
import re
import subprocess
import sys
import tempfile

# By mnemonic without what follows a dot (the type, on Arm and RISC-V).
FUSED = re.compile("|".join([
    r"v4?fn?m(add|sub)\w*",        # x86: FMA, FMA4 and AVX-512, the pairs vfmaddsub and vfmsubadd among them
    r"vfc?(madd|mul)c[ps]h",       # x86: complex products of AVX512-FP16
    r"fn?m(add|sub|la|ls)[l2tb]*",  # AArch64, SVE and RISC-V
    r"fn?m(ad|sb)",                # SVE
    r"fcmla|vcmla",                # complex products of Armv8.3 and SVE
    r"vfn?m[as](l|t|b)?",          # ARMv7's VFPv4 and later
]))
PREFIXES = {"lock", "rep", "repz", "repnz", "bnd", "notrack", "data16", "addr32"}


def mnemonic_of(line):
    """Of a line of disassembly; none where it is no instruction."""
    found = re.match(r"\s*[0-9a-f]+:\s+(.*)", line)
    words = [word for word in found.group(1).split() if word not in PREFIXES and word[0] != "{"] if found else []
    return words[0].split(".")[0] if words and words[0] != "." else None


def fused_of(objdump, archive):
    """{(function, mnemonic): how many} and how many instructions there are in all."""
    command = [objdump, "-d", "--no-show-raw-insn", str(archive)]
    text = subprocess.run(command, capture_output=True, text=True, check=False).stdout  # another machine's: no text
    fused, instructions, function = collections.Counter(), 0, "?"
    for line in text.splitlines():
        head = re.match(r"[0-9a-f]+ <(.+)>:$", line)
        if head:
            function = head.group(1)
            continue
        mnemonic = mnemonic_of(line)
        if mnemonic:
            instructions += 1
            if FUSED.fullmatch(mnemonic):
                fused[function, mnemonic] += 1
    return fused, instructions


def report(objdump, archive, name):
    """Lines of what is wrong, and how many instructions were looked at."""
    fused, instructions = fused_of(objdump, archive)
    if not instructions:
        return [f"{name}: {objdump} shows no instruction: nothing was checked"], 0
    lines = [f"{name}: {function}: {count} {mnemonic}" for (function, mnemonic), count in sorted(fused.items())]
    return lines, instructions


def of_levels(objdump, levels, sources, compiler):
    worse, total = [], 0
    with tempfile.TemporaryDirectory() as folder:
        compiled = pathlib.Path(folder) / "compiled.o"
        for level, source in itertools.product(levels.split("|"), sources.split("|")):
            subprocess.run([compiler[0], *level.split(), *compiler[1:], "-c", source, "-o", compiled], check=True)
            lines, instructions = report(objdump, compiled, f"{pathlib.Path(source).name}, {level}")
            worse, total = worse + lines, total + instructions
    return worse, total


def main():
    objdump, *words = sys.argv[1:]
    worse, total = [], 0
    if words[:1] == ["--levels"]:
        worse, total = of_levels(objdump, words[1], words[2], words[3:])
    else:
        for archive in words:
            lines, instructions = report(objdump, archive, pathlib.Path(archive).name)
            worse, total = worse + lines, total + instructions
    if not worse and not total:
        worse = ["nothing was checked"]
    print("\n".join(worse) or f"{total} instructions, none fused")
    sys.exit(1 if worse else 0)


if __name__ == "__main__":
    main()
