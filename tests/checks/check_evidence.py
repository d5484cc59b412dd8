#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""What `pose_wall evidence` packs, other makers' programs read and verify (zipfile, OpenSSL's command). What anybody
did to it afterwards, `--verify` finds. Whatever fails, no half zip is left.

usage: check_evidence.py POSE_WALL         exit status 77 where the build has no evidence, or openssl is missing"""

import hashlib
import io
import json
import pathlib
import re
import resource
import shutil
import stat
import struct
import subprocess
import sys
import tempfile
import time
import warnings
import zipfile

FILES = {"settings.yaml": b"forward_axis: +X\nplanar: map\n", "doctor.json": b'{"verdict": "usable"}\n',
         "empty.txt": b"", "\u62a5\u544a.html": b"<html>" + "\u597d".encode() * 500,
         "recording_1.mcap": b"\x89MCAP0\r\n\x01" + bytes(8) + hashlib.sha512(b"points").digest() * 20}
OWN = ["manifest.json", "manifest.json.sig", "site.pub.pem"]
MEMORY_MOST = 1 << 29  # bytes: far below what the lies in these zips promise


class Trial:
    """A folder with a key and a packed zip, and what was found wrong."""

    def __init__(self, command, place):
        self.command, self.place, self.faults, self.asked = command, place, [], 0
        self.folder = place / "commissioning"
        self.folder.mkdir()
        for name, content in FILES.items():
            (self.folder / name).write_bytes(content)
        (self.folder / ".hidden").write_bytes(b"x")
        (self.folder / "link").symlink_to("empty.txt")
        (self.folder / "sub").mkdir()
        self.key, self.public = self.make_key("site")
        self.other, self.other_public = self.make_key("other")
        self.zip = place / "evidence.zip"

    def make_key(self, name, *kind):
        key, public = self.place / f"{name}.pem", self.place / f"{name}.pub.pem"
        run_openssl("genpkey", *(kind or ("-algorithm", "ed25519")), "-out", key)
        key.chmod(stat.S_IRUSR | stat.S_IWUSR)
        run_openssl("pkey", "-in", key, "-pubout", "-out", public)
        return key, public

    def run(self, *words, limits=None, **options):
        def begin():
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY_MOST, MEMORY_MOST))
            if limits:
                resource.setrlimit(*limits)
        return subprocess.run([self.command, "evidence", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              encoding="utf-8", preexec_fn=begin, stdin=subprocess.DEVNULL, check=False,
                              restore_signals=False, **options)

    def expect(self, case, status, part, *words, **options):
        """`part`: what it says, on either stream."""
        self.asked += 1
        ran = self.run(*words, **options)
        said = ran.stdout + ran.stderr
        if ran.returncode != status or part not in re.sub(r"\s+", " ", said):
            self.faults.append(f"{case}: exit status {ran.returncode}, not {status}, or no '{part}' in: {said}")
        return ran

    def check(self, case, is_right):
        self.asked += 1
        if not is_right:
            self.faults.append(case)

    def forged(self, case, part, content, *words, status=1):
        """What is said of a zip of these bytes."""
        bad = self.place / "bad.zip"
        bad.write_bytes(content)
        return self.expect(case, status, part, "--verify", bad, *words)


def run_openssl(*words):
    return subprocess.run(["openssl", *words], check=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def members_of(path):
    with zipfile.ZipFile(path) as packed:
        return {name: packed.read(name) for name in packed.namelist()}


def zipped(members, **changes):
    """A zip by another maker. members: (name, bytes) in their order."""
    out = io.BytesIO()
    with warnings.catch_warnings(), zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as made:
        warnings.simplefilter("ignore")  # names that are there twice
        for name, content in members:
            made.writestr(name, content)
        made.comment = changes.get("comment", b"")
    return out.getvalue()


def data_of(content, info):
    """Where a member's packed bytes lie."""
    name, extra = struct.unpack_from("<HH", content, info.header_offset + 26)
    begin = info.header_offset + 30 + name + extra
    return range(begin, begin + info.compress_size)


def check_round_trip(trial):
    trial.expect("pack", 0, "Signed by the key", trial.folder, "-o", trial.zip, "--key", trial.key)
    members = members_of(trial.zip)
    trial.check(f"members: {sorted(members)}", sorted(members) == sorted([*FILES, *OWN]))
    trial.check("bytes", all(members[name] == content for name, content in FILES.items()))
    with zipfile.ZipFile(trial.zip) as packed:
        methods = {info.filename: info.compress_type for info in packed.infolist()}
        trial.check("zipfile's test", packed.testzip() is None)
    trial.check("recordings are stored, text is deflated",
                methods["recording_1.mcap"] == zipfile.ZIP_STORED and methods["doctor.json"] == zipfile.ZIP_DEFLATED)
    manifest = json.loads(members["manifest.json"])
    told = {row["name"]: (row["bytes"], row["sha256"]) for row in manifest["files"]}
    trial.check("hashes", told == {n: (len(c), hashlib.sha256(c).hexdigest()) for n, c in FILES.items()})
    trial.check(f"manifest: {manifest}", manifest["schema"] == 1 and manifest["missing"] == ["report.html"]
                and {row["name"]: row["why"] for row in manifest["left_out"]}
                == {".hidden": "hidden", "link": "link", "sub": "folder"}
                and bool(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", manifest["made_at"])))
    for name in OWN:
        (trial.place / name).write_bytes(members[name])
    run_openssl("pkeyutl", "-verify", "-pubin", "-inkey", trial.place / "site.pub.pem", "-rawin", "-in",
                trial.place / "manifest.json", "-sigfile", trial.place / "manifest.json.sig")
    der = run_openssl("pkey", "-pubin", "-in", trial.public, "-outform", "DER").stdout
    trial.check("the fingerprint is that of the DER", manifest["signed_by"] == hashlib.sha256(der).hexdigest())
    trial.check("the public key is openssl's", members["site.pub.pem"] == trial.public.read_bytes())
    trial.expect("verify", 0, "compare the fingerprint with the site's", "--verify", trial.zip)
    trial.expect("verify by the site", 0, "Signed by the site", "--verify", trial.zip, "--public-key", trial.public)
    trial.expect("another site", 1, "by another one", "--verify", trial.zip, "--public-key", trial.other_public)
    verdict = json.loads(trial.run("--verify", trial.zip, "--format", "json", "--language", "zh").stdout)
    trial.check(f"verdict: {verdict}", verdict["proven"] and verdict["signature"] == "own_key"
                and verdict["manifest"] == manifest and all(row["state"] == "same" for row in verdict["files"]))
    trial.expect("Chinese", 0, "\u7b7e\u540d", "--verify", trial.zip, "--language", "zh")
    trial.forged("packed anew by another maker", "Signed by the site", zipped(members.items()), "--public-key",
                 trial.public, status=0)


def check_settings(trial):
    """The CRCs are those that the other verbs tell."""
    ran = subprocess.run([trial.command, "check-config", trial.folder / "settings.yaml"], check=True,
                         stdout=subprocess.PIPE, encoding="utf-8")
    crc = int(re.search(r"CRC of the settings: 16#([0-9A-F]{8})", ran.stdout)[1], 16)
    settings = json.loads(members_of(trial.zip)["manifest.json"])["settings"]
    trial.check(f"CRC {crc}: {settings}", settings["config_crc32"] == crc and settings["planar_stop_crc32"] is not None)
    marks = []
    for text in ("planar: map\nplanar_x_max: 3\n", "planar: off\n", "source: ros1\nextrinsic_from: tf\n"):
        (trial.folder / "settings.yaml").write_text(text)
        ran = trial.run(trial.folder, "-o", trial.place / "s.zip", "--force", "--format", "json")
        marks.append(json.loads(ran.stdout)["settings"])
    trial.check(f"planar: {marks}", marks[0]["planar_stop_crc32"] not in (None, settings["planar_stop_crc32"])
                and marks[1]["planar_stop_crc32"] is None and marks[2]["extrinsic_from"] == "tf")
    (trial.folder / "settings.yaml").write_text("forward_axis: +Q\n")
    trial.expect("settings with faults", 2, "settings.yaml:1", trial.folder, "-o", trial.place / "t.zip")
    (trial.folder / "settings.yaml").write_bytes(FILES["settings.yaml"])


def check_flip(trial, content, at, mask, case):
    """A flip is found, or nothing has changed that other makers unpack: deflate's last bits carry no content."""
    bad = trial.place / "flipped.zip"
    bad.write_bytes(content[:at] + bytes([content[at] ^ mask]) + content[at + 1:])
    ran = trial.run("--verify", bad)
    found = ran.returncode == 1 and "NOT WHOLE" in ran.stdout + ran.stderr
    trial.check(f"{case}: {ran.returncode} {ran.stdout}{ran.stderr}",
                found or (ran.returncode == 0 and members_of(bad) == members_of(trial.zip)))


def check_damage(trial):
    content = trial.zip.read_bytes()
    with zipfile.ZipFile(trial.zip) as packed:
        infos = packed.infolist()
    for info in infos:
        data = data_of(content, info)
        for at in sorted({*data[:2], *data[::max(1, len(data) // 5)], *data[-2:]}):
            check_flip(trial, content, at, 0xFF, f"byte {at} of {info.filename}")
            check_flip(trial, content, at, 1 << at % 8, f"a bit of byte {at} of {info.filename}")
    for length in (0, 1, 21, 22, 100, len(content) // 2, len(content) - 22, len(content) - 1):
        trial.forged(f"cut to {length}", "NOT WHOLE", content[:length])
    trial.forged("no zip", "it is no zip", b"this is no zip, but long enough to be one\n" * 9)
    trial.forged("bytes behind", "bytes follow its end", content + b"x")
    trial.forged("bytes before", "NOT WHOLE", b"#!/bin/sh\n" + content)
    # A zip in front: its members are seen by programs that read from the front.
    trial.forged("two zips", "NOT WHOLE", zipped([("evil.txt", b"evil")]) + content)
    name = content.index(b"doctor.json")
    trial.forged("two names", "NOT WHOLE", content[:name] + b"doctor.jsoN" + content[name + 11:])
    # Every size of the list's row and of the member's own head becomes 4 GB.
    huge = bytearray(content)
    info = next(info for info in infos if info.filename == "doctor.json")
    row = content.index(b"doctor.json", name + 1) - 46
    for at in (info.header_offset + 22, row + 24):
        struct.pack_into("<I", huge, at, 0xFFFFFFF0)
    begun = time.monotonic()
    trial.forged("a huge size", "cannot come out of", bytes(huge))
    trial.check("a huge size takes no time", time.monotonic() - begun < 10.0)


def check_forgery(trial):
    members = members_of(trial.zip)
    rest = {name: content for name, content in members.items() if name not in OWN}
    own = {name: members[name] for name in OWN}

    def made(case, part, changed, *words, **options):
        rows = changed.items() if isinstance(changed, dict) else changed
        return trial.forged(case, part, zipped(rows), *words, **options)

    made("the other maker's zip", "Whole", members, status=0)
    made("a member renamed", "doctor.jso: manifest.json does not tell of it",
         {("doctor.jso" if name == "doctor.json" else name): content for name, content in members.items()})
    made("a member added", "evil.txt: manifest.json does not tell of it", {**members, "evil.txt": b"evil"})
    made("a folder added", "sub/: a member of this name", {**members, "sub/": b""})
    made("a member removed", "doctor.json: it is missing", {n: c for n, c in members.items() if n != "doctor.json"})
    made("a member changed", "its bytes are others than were packed",
         {**members, "settings.yaml": b"forward_axis: -X\nplanar: map\n"})
    made("a member longer", "bytes instead of", {**members, "settings.yaml": FILES["settings.yaml"] + b"#"})
    made("a bomb", "bytes instead of", {**members, "doctor.json": bytes(50_000_000)})
    made("a member twice", "NOT WHOLE", [*members.items(), ("doctor.json", b"evil")])
    for name in ("../evil", "/tmp/evil", "a\\b", "a\nb", ".bashrc"):
        made(f"the name {name!r}", "NOT WHOLE", {**members, name: b"evil"})
    trial.forged("a comment", "NOT WHOLE", zipped(members.items(), comment=b"evil"))
    edited = members["manifest.json"].replace(b"2", b"3", 1)
    for words in ((), ("--public-key", trial.public)):
        made("the manifest edited", "signature is wrong", {**members, "manifest.json": edited}, *words)
    made("no manifest", "it is no evidence", rest)
    made("a manifest that is none", "NOT WHOLE", {**members, "manifest.json": b"[1, 2"})
    made("a long manifest", "at most", {**members, "manifest.json": bytes(5_000_000)})
    made("no signature", "one of them was taken out", {**rest, "manifest.json": own["manifest.json"]})
    made("half a signature", "one is missing", {n: c for n, c in members.items() if n != "site.pub.pem"})
    made("words before the key", "its bytes are damaged", {**members, "site.pub.pem": b"x\n" + own["site.pub.pem"]})
    # Whoever has a key of his own can make all of it anew: that is what the site's public key is for.
    signature = trial.place / "other.sig"
    run_openssl("pkeyutl", "-sign", "-inkey", trial.other, "-rawin", "-in", trial.place / "manifest.json", "-out",
                signature)
    other = {**members, "manifest.json.sig": signature.read_bytes()}
    made("the signature of another key", "is no signature", other)
    made("the signature and key of another", "names another key", {**other, "site.pub.pem":
                                                                  trial.other_public.read_bytes()})
    forged = trial.place / "forged.zip"
    trial.expect("by another key", 0, "Signed by", trial.folder, "-o", forged, "--key", trial.other)
    trial.expect("by another key, unasked", 0, "key in the zip itself", "--verify", forged)
    trial.expect("by another key, asked", 1, "by another one", "--verify", forged, "--public-key", trial.public)
    unsigned = trial.place / "unsigned.zip"
    trial.expect("no key", 0, "Nothing proves who made it", trial.folder, "-o", unsigned)
    trial.expect("unsigned, unasked", 0, "Nothing proves who made it", "--verify", unsigned)
    trial.expect("unsigned, asked", 1, "Nothing proves who made it", "--verify", unsigned, "--public-key", trial.public)


def check_refusals(trial):
    out = trial.place / "out"
    out.mkdir()
    new = out / "new.zip"
    trial.expect("no folder", 1, "nowhere", trial.place / "nowhere", "-o", new)
    trial.expect("nothing in it", 1, "there is no file in it", trial.folder / "sub", "-o", new)
    trial.expect("an existing zip", 2, "--force", trial.folder, "-o", trial.zip)
    trial.expect("forced", 0, "Signed", trial.folder, "-o", trial.zip, "--force", "--key", trial.key)
    trial.expect("in the folder", 0, "Signed", trial.folder, "-o", trial.folder / "e.zip", "--key", trial.key)
    trial.expect("in the folder again", 0, "the zip itself", trial.folder, "-o", trial.folder / "e.zip", "--force")
    (trial.folder / "e.zip").unlink()
    for name, content in (("manifest.json", b"{}"), ("site.pem", trial.key.read_bytes()), ("a\nb", b"x")):
        (trial.folder / name).write_bytes(content)
        trial.expect(f"{name!r} in the folder", 1, name.replace("\n", "?"), trial.folder, "-o", new)
        (trial.folder / name).unlink()
    for kind in (("-algorithm", "RSA"), ("-algorithm", "EC", "-pkeyopt", "ec_paramgen_curve:P-256")):
        key, public = trial.make_key(f"key{len(kind)}", *kind)
        trial.expect(f"{kind}", 2, "openssl genpkey -algorithm ed25519", trial.folder, "-o", new, "--key", key)
        trial.expect(f"{kind}", 2, "Ed25519", "--verify", trial.zip, "--public-key", public)
    trial.expect("a public key signs", 2, "no private key", trial.folder, "-o", new, "--key", trial.public)
    trial.expect("a private key verifies", 2, "no public key", "--verify", trial.zip, "--public-key", trial.key)
    for words in ((), (trial.folder,), ("-o", new), (trial.folder, "--verify", trial.zip), ("--verify", out / "none"),
                  (trial.folder, "-o", new, "--public-key", trial.public), ("--verify", trial.zip, "--force")):
        trial.expect(f"words {words}", 2, "", *words)
    trial.expect("a device", 2, "device", trial.folder, "-o", "/dev/full", "--force")
    # A disk that is full: no file may grow beyond so many bytes. Big enough that libzip's buffers are written before.
    (trial.folder / "big.mcap").write_bytes(bytes(3_000_000))
    for most in (0, 100, 1_000_000):
        trial.expect(f"a disk with {most} bytes", 1, "cannot be written", trial.folder, "-o", new,
                     limits=(resource.RLIMIT_FSIZE, (most, most)))
    (trial.folder / "big.mcap").unlink()
    trial.check(f"left there: {sorted(out.iterdir())}", not list(out.iterdir()))
    trial.key.chmod(0o644)
    trial.expect("an open key", 0, "can be read by others", trial.folder, "-o", new, "--key", trial.key)
    trial.check(f"left there: {sorted(out.iterdir())}", sorted(out.iterdir()) == [new])


def main():
    command = pathlib.Path(sys.argv[1]).resolve()
    if shutil.which("openssl") is None:
        print("there is no openssl here: skipped")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as place:
        trial = Trial(command, pathlib.Path(place))
        if "libzip-dev and libssl-dev" in trial.run(trial.folder, "-o", trial.place / "x.zip").stderr:
            print("this build neither packs nor checks evidence: skipped")
            sys.exit(77)
        for part in (check_round_trip, check_settings, check_damage, check_forgery, check_refusals):
            part(trial)
    if trial.asked < 100:
        sys.exit(f"{trial.asked} cases alone")
    print("\n".join(trial.faults) or f"{trial.asked} cases")
    sys.exit(1 if trial.faults else 0)


if __name__ == "__main__":
    main()
