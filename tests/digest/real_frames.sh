#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Recorded frames of POSE_WALL_DATA (see tests/real) and simulated roads, as what compare_builds.py takes: prints its
# arguments, files lie in OUTPUT.
#
#   tests/digest/compare_builds.py build/compared --recorded $(tests/digest/real_frames.sh build/release build/compared)
#
# usage: real_frames.sh BUILD_OF_RELEASE OUTPUT
set -eu
build=$1 output=$2
to_xyz=$build/tests/pose_wall_to_xyz
mkdir -p "$output"

for scene in nominal steel_sets; do
  "$build/pose_wall" sim --scene "$scene" --frames 5 --output "$output/$scene" > "$output/sim.log"
  "$to_xyz" "$output/$scene.xyz" "$output/$scene"/frames/*
  echo "$output/$scene.xyz"
done
[ -n "${POSE_WALL_DATA:-}" ] || exit 0
convert() { # name, frames
  name=$1
  shift
  "$to_xyz" "$output/$name.xyz" "$@"
  echo "$output/$name.xyz"
}
echo "ground_roi_radius_max=20.0"
convert hall_rotating "$POSE_WALL_DATA"/hall_rotating/*.pcd
convert hall_tilted_os0 "$POSE_WALL_DATA"/hall_tilted_os0/*.pcd
convert corridor_sick "$POSE_WALL_DATA"/corridor_sick/*.pcd
convert room_dense "$POSE_WALL_DATA"/room_dense/*.pcd
for word in forward_axis=-Y outlier_radius=0.40 outlier_min_neighbors=2 ground_inlier_min=150 wall_inlier_min=250; do
  echo "$word"
done
convert corridor_vlp16 "$POSE_WALL_DATA"/corridor_vlp16/*.pcd
for file in "$POSE_WALL_DATA"/negative/*; do
  convert "negative_$(basename "${file%.*}")" "$file"
done
