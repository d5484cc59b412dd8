#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# check_man.sh PAGE: groff formats the manual page without a warning, and it names every verb of the command.
set -eu
page=$1
complain() { echo "$1"; exit 1; }
said=$(groff -man -Tutf8 -ww -z "$page" 2>&1) || complain "$said"
[ -z "$said" ] || complain "$said"
text=$(groff -man -Tutf8 -P-cbou "$page")
for word in NAME SYNOPSIS VERBS "EXIT STATUS" voxel_leaf "pose_wall run" "pose_wall doctor" "pose_wall sim" \
  "pose_wall demo" "pose_wall scan" "pose_wall map" "pose_wall localise" "pose_wall plan" "pose_wall drive" \
  "pose_wall report" \
  "pose_wall info" \
  "pose_wall eval" "pose_wall campaign" "pose_wall replay-box" \
  "pose_wall explain" "pose_wall check-config" "pose_wall completion"; do
  printf '%s\n' "$text" | grep -q -- "$word" || complain "$page: '$word' does not stand in it"
done

# A check that cannot fail is none.
broken=$(mktemp)
trap 'rm -f "$broken"' EXIT
{ cat "$page"; printf '.XY\n\\[nosuchsign]\n'; } > "$broken"
[ -n "$(groff -man -Tutf8 -ww -z "$broken" 2>&1)" ] || complain "a page with faults was let through"
