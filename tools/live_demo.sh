#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# Builds pose_walld on a fresh Debian 12 machine and lets it live: a simulated sensor sends packets of an Ouster by UDP,
# the daemon measures and shows its page, publishes by ROS 1 and serves Modbus TCP. Ctrl-C ends it all. Installs what is
# missing (and says what).
# usage: live_demo.sh [SECONDS]        default: until Ctrl-C
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/shell/steps.sh
. tools/shell/packages.sh

# shellcheck disable=SC2086  # lists of words
need_packages $packages_to_build $packages_to_read $packages_to_live python3-rosmaster python3-rostopic
need_cmake
need_three
step "Configuring" cmake --preset release -DPOSE_WALL_BUILD_TESTS=OFF
step "Building" cmake --build --preset release --target pose_walld pose_wall_sensor

folder=$(mktemp -d)
end() {
  trap - EXIT INT TERM
  # shellcheck disable=SC2046  # a list of numbers
  kill $(jobs -p) 2> /dev/null || true
  wait 2> /dev/null || true
  rm -rf "$folder"
}
trap end EXIT
trap 'exit 0' INT TERM

export ROS_MASTER_URI=http://127.0.0.1:11311 ROS_IP=127.0.0.1
if ! rostopic list > /dev/null 2>&1; then
  rosmaster --core -p 11311 > "$folder/rosmaster.log" 2>&1 &
fi
build/release/pose_wall_sensor --sensor os1-64 --frames 70 --to 127.0.0.1:7502 --http 127.0.0.1:7580 \
  --config-to "$folder/pose_wall.yaml" &
while [ ! -s "$folder/pose_wall.yaml" ]; do sleep 0.1; done
build/release/pose_walld --config "$folder/pose_wall.yaml" --set udp_port=7502 \
  --set sensor_metadata=http://127.0.0.1:7580 --set ros1=1 --http 127.0.0.1:8080 --modbus 127.0.0.1:1502 &
daemon=$!
sleep 1
echo
echo "The page:   http://127.0.0.1:8080"
echo "ROS 1:      ROS_MASTER_URI=$ROS_MASTER_URI rostopic echo /pose_wall/attitude"
echo "Modbus TCP: 127.0.0.1:1502, input registers 0 to 119 and 1000 to 1123"
echo
[ -z "${DISPLAY:-}" ] || ! command -v xdg-open > /dev/null || xdg-open http://127.0.0.1:8080 > /dev/null 2>&1 || true
if [ -n "${1:-}" ]; then
  sleep "$1"
  kill -0 "$daemon" # it lives to the end
else
  wait "$daemon"
fi
