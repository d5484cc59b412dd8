#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Assimp (Debian's package 5.2.5, which calls itself 5.2.4) reads a point cloud from a PLY: vertices with normals, and
# no faces. With its step that validates what was read (aiProcess_ValidateDataStructure) it refuses the same file:
# "Mesh  contains no faces".
# Guess before: a check of indices and ranges lets through what the reader itself makes of a valid file.
# What follows: whoever wants the check for meshes and reads clouds, too, has to check faces himself.
#
# Needs Debian 12 with apt-get download, dpkg, g++. Everything lies in a temporary folder. Exit 0: as told here.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -q libassimp5=5.2.5~ds0-1+b1 libassimp-dev=5.2.5~ds0-1+b1 libpugixml1v5 libminizip1 libdraco7 > log 2>&1 ||
  { cat log; exit 2; }
for package in *.deb; do dpkg -x "$package" root; done
libraries=$(dirname "$(find "$work/root" -name 'libassimp.so.5')")

cat > cloud.ply << 'PLY'
ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property float nx
property float ny
property float nz
end_header
0 0 0 0 0 1
1 0 0 0 0 1
0 1 0 0 0 1
PLY

cat > read.cpp << 'CPP'
#include <assimp/postprocess.h>
#include <assimp/version.h>

#include <assimp/Importer.hpp>
#include <cstdio>

int main() {
  std::printf("version %u.%u.%u\n", aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch());
  for (const unsigned steps : {0U, static_cast<unsigned>(aiProcess_ValidateDataStructure)}) {
    Assimp::Importer importer;
    const bool is_read = importer.ReadFile("cloud.ply", steps) != nullptr;
    std::printf("%s: %s\n", steps == 0 ? "plain" : "validated", is_read ? "read" : importer.GetErrorString());
  }
}
CPP
g++ -std=c++17 -I"$work/root/usr/include" read.cpp -L"$libraries" -lassimp -Wl,-rpath-link,"$libraries" -o read
LD_LIBRARY_PATH=$libraries ./read | tee seen
cat > expected << 'SEEN'
version 5.2.4
plain: read
validated: Validation failed: Mesh  contains no faces
SEEN
cmp seen expected
