#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The bill of materials has what SPDX 2.3 asks for, names the archives by their digests, and Eigen by the version that
the compiler finds in its headers.

usage: check_sbom.py SPDX_JSON VERSION CXX EIGEN_INCLUDE_DIR ARCHIVE..."""

import hashlib
import json
import pathlib
import re
import subprocess
import sys

DOCUMENT = {"spdxVersion": r"SPDX-2\.3", "dataLicense": r"CC0-1\.0", "SPDXID": "SPDXRef-DOCUMENT",
            "name": r"pose_wall-\d+\.\d+\.\d+", "documentNamespace": r"https?://[^#\s]+"}
PACKAGE = {"SPDXID": r"SPDXRef-[A-Za-z0-9.-]+", "name": r".+", "downloadLocation": r"NOASSERTION|https://.+",
           "versionInfo": r"\d+\.\d+.*"}
LICENCES = {"Eigen": ("MPL-2.0", "MPL-2.0")}
OWN_LICENCES = ("BSD-3-Clause", "BSD-3-Clause AND MPL-2.0")


def field_faults(where, found, rules):
    for key, pattern in rules.items():
        if not re.fullmatch(pattern, str(found.get(key, ""))):
            yield f"{where}: {key} is {found.get(key)!r}"


def document_faults(document):
    yield from field_faults("document", document, DOCUMENT)
    creation = document.get("creationInfo", {})
    yield from field_faults("creationInfo", creation, {"created": r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ"})
    creators = creation.get("creators", [])
    if not creators or not all(re.match(r"(Tool|Organization|Person): .", creator) for creator in creators):
        yield "creationInfo: creators"
    known = {package.get("SPDXID") for package in document.get("packages", [])} | {"SPDXRef-DOCUMENT"}
    for row in document.get("relationships", []):
        if row["spdxElementId"] not in known or row["relatedSpdxElement"] not in known:
            yield f"relationship between what is not there: {row}"
    kinds = {row["relationshipType"] for row in document.get("relationships", [])}
    if not {"DESCRIBES", "STATIC_LINK"} <= kinds:
        yield f"relationships are {sorted(kinds)}"


def package_faults(packages, expected_versions, digests):
    for package in packages.values():
        yield from field_faults(package["name"], package, PACKAGE)
    for name, version in expected_versions.items():
        package = packages.get(name)
        if package is None:
            yield f"no package {name}"
            continue
        if package["versionInfo"] != version:
            yield f"{name} is {version}, the bill says {package['versionInfo']}"
        if (package["licenseDeclared"], package["licenseConcluded"]) != LICENCES.get(name, OWN_LICENCES):
            yield f"licences of {name}"
    for name, digest in digests.items():
        if {"algorithm": "SHA256", "checksumValue": digest} not in packages.get(name, {}).get("checksums", []):
            yield f"{name}: the digest is not that of the archive"


def eigen_version(compiler, folder):
    text = "#include <Eigen/Core>\nversion EIGEN_WORLD_VERSION EIGEN_MAJOR_VERSION EIGEN_MINOR_VERSION\n"
    done = subprocess.run([compiler, "-E", "-P", "-x", "c++", f"-I{folder}", "-"], input=text, capture_output=True,
                          text=True, check=True)
    return ".".join(re.search(r"^version (\d+) (\d+) (\d+)", done.stdout, re.M).groups())


def main():
    file, version, compiler, folder, *archives = sys.argv[1:]
    if not archives:
        sys.exit(__doc__)
    document = json.loads(pathlib.Path(file).read_text(encoding="utf-8"))
    packages = {package["name"]: package for package in document.get("packages", [])}
    digests = {re.sub(r"^lib(.*)\.a$", r"\1", path.name): hashlib.sha256(path.read_bytes()).hexdigest()
               for path in map(pathlib.Path, archives)}
    versions = {**{name: version for name in digests}, "Eigen": eigen_version(compiler, folder)}
    faults = [*document_faults(document), *package_faults(packages, versions, digests)]
    print("\n".join(faults) or "; ".join(f"{name} {package['versionInfo']}" for name, package in packages.items()))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
