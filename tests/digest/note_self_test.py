#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""Notes the digest that the self test comes to now, after a change of the engine that is meant to change results. It
refuses to note one under which a value of the self test's road is wrong. Then build again.

    note_self_test.py src/engine/self_test_digest.hpp COMMAND...   COMMAND: pose_wall_digest, an emulator before it
"""

import pathlib
import re
import subprocess
import sys

DIGEST = re.compile(r"(kSelfTestDigest = 0x)[0-9A-F]{16}(ULL)")


def report_of(command):
    done = subprocess.run([*command, "--self-test"], capture_output=True, text=True, check=False)
    report = dict(line.split() for line in done.stdout.splitlines() if len(line.split()) == 2)
    if "digest_found" not in report:
        sys.exit(f"{' '.join(command)}: no report of a self test\n{done.stdout}{done.stderr}")
    return report


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    path, report = pathlib.Path(sys.argv[1]), report_of(sys.argv[2:])
    if report["values_wrong"] != "0" or report["refused"] != "0":
        sys.exit(f"not noted: {report['values_wrong']} values are wrong, refused with {report['refused']}")
    text = path.read_text(encoding="utf-8")
    if not DIGEST.search(text):
        sys.exit(f"{path} holds no digest to replace")
    path.write_text(DIGEST.sub(rf"\g<1>{report['digest_found'].upper()}\g<2>", text), encoding="utf-8")
    print(f"noted {report['digest_found']}, was {report['digest_expected']}")


if __name__ == "__main__":
    main()
