# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""For the tests that look at pose_walld from outside: starts it, waits for what it logs, finds free ports; says what is
missing, so that a test is skipped by name."""

import contextlib
import importlib.util
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

SKIPPED = 77  # as live.cmake has it

PATIENCE_S = 30  # long enough for the slowest machine; what is waited for comes far sooner


def program(name):
    """Where it lies; empty where it is not installed. Debian keeps daemons out of people's path."""
    return shutil.which(name) or shutil.which(name, path="/usr/sbin") or ""


def has_module(name):
    return importlib.util.find_spec(name) is not None


def need(packages, programs=(), modules=()):
    """Ends the test as skipped, with the names, unless all of these are there. One of them says nothing of the others:
    each script of tools/ brings other packages, and so do people."""
    missing = [name for name in programs if not program(name)] + [name for name in modules if not has_module(name)]
    if missing:
        print(f"SKIPPED: there is no {', no '.join(missing)} (packages {packages})")
        sys.exit(SKIPPED)


def main(**options):
    """unittest's, but what failed is never hidden by a part that was skipped for want of a package."""
    result = unittest.main(exit=False, **options).result
    missing = [(str(test), why) for test, why in result.skipped if why.startswith("SKIPPED:")]
    for test, why in missing:
        print(f"{why}: {test}")
    sys.exit(1 if not result.wasSuccessful() else SKIPPED if missing else 0)


def free_port(kind=socket.SOCK_STREAM):
    with socket.socket(socket.AF_INET, kind) as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


def becomes_true(condition, patience_s=PATIENCE_S):
    until = time.monotonic() + patience_s
    while time.monotonic() < until:
        if condition():
            return True
        time.sleep(0.02)
    return False


class Program:
    """A program that runs while the test does; its log is read as it comes."""

    def __init__(self, *words, **options):
        self.process = subprocess.Popen([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                        text=True, **options)
        self.lines = []
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self):
        for line in self.process.stdout:
            self.lines.append(line.rstrip("\n"))

    def says(self, text, patience_s=PATIENCE_S):
        return becomes_true(lambda: any(text in line for line in list(self.lines)), patience_s)

    def log(self):
        return "\n".join(self.lines[-60:])

    def stop(self, patience_s=PATIENCE_S):
        """Asks it to end; how many seconds that took."""
        begin = time.monotonic()
        if self.process.poll() is None:
            self.process.terminate()
        self.process.wait(patience_s)
        self.reader.join(patience_s)
        return time.monotonic() - begin

    def stops_by_itself(self):
        """Asked to end. The daemon gives its parts a second; then it ends by force, with another status."""
        self.stop()
        return self.process.returncode == 0

    def kill(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.reader.join()


@contextlib.contextmanager
def running(*words, **options):
    program = Program(*words, **options)
    try:
        yield program
    finally:
        program.kill()


def fact(of_program, part, name):
    """The newest count of a part, as the log's status lines tell it."""
    for line in reversed(list(of_program.lines)):
        if f" {part}" in line and f"; {name} " in line:
            return int(line.split(f"; {name} ")[1].split(";")[0])
    return -1


def lost_frames(of_program):
    """Of those that the daemon took: pushed, less measured, less dropped with a reason. 0 once it has stopped."""
    for line in reversed(list(of_program.lines)):
        if "; frames pushed " in line:
            counts = dict(part.rsplit(" ", 1) for part in line.split("; ") if part.rsplit(" ", 1)[-1].isdigit())
            dropped = sum(int(count) for name, count in counts.items() if name.startswith("dropped"))
            return int(counts["frames pushed"]) - int(counts["frames measured"]) - dropped
    return -1


def simulated_road(pose_wall, frames=70, sensor="os1-64", scene="nominal"):
    """A folder with frames and the settings that fit them; made once a build. They go round: 64 that do are frozen."""
    name = f"{sensor}_{frames}" + ("" if scene == "nominal" else f"_{scene}")
    folder = pathlib.Path(pose_wall).parent / "live_roads" / name
    if not (folder / "pose_wall.yaml").exists():
        folder.parent.mkdir(exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder.parent) as making:
            made = pathlib.Path(making) / "road"
            subprocess.run([str(pose_wall), "sim", "--scene", scene, "--sensor", sensor, "--frames", str(frames),
                            "--output", str(made)], check=True, capture_output=True)
            with contextlib.suppress(OSError):  # another test was quicker
                os.rename(made, folder)
    return folder


def self_signed_page(pem, certificate):
    """Writes a certificate for 127.0.0.1, and for the daemon's http_certificate the same with its key."""
    key = pem.with_suffix(".key")
    subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", "/CN=localhost",
                    "-addext", "subjectAltName=IP:127.0.0.1", "-keyout", str(key), "-out", str(certificate)],
                   check=True, capture_output=True)
    pem.write_bytes(certificate.read_bytes() + key.read_bytes())


def replay_words(pose_walld, road, *more):
    return [pose_walld, "--config", road / "pose_wall.yaml", "--replay", road / "frames", "--repeat", *more]
