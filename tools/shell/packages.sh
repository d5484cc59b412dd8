# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
# shellcheck shell=bash
#
# For sourcing, after steps.sh: need_packages PACKAGE... installs those that are missing, and says which; packages_of
# PRESET prints those that a preset needs.

# shellcheck disable=SC2034  # read by those who source this
packages_to_build="cmake ninja-build gcc g++ binutils libc6-dev libeigen3-dev libcli11-dev libyaml-dev liblzf-dev
  libfmt-dev nlohmann-json3-dev"
# Optional: what the command reads bags and captures with; a build without them says so when it meets one.
# shellcheck disable=SC2034
packages_to_read="liblz4-dev libzstd-dev libbz2-dev libsqlite3-dev libpcap-dev"
# Optional: what `pose_wall sim --surface` reads surfaces and casts rays with.
# shellcheck disable=SC2034
packages_to_survey="libembree-dev libassimp-dev"
# Optional: what `pose_wall evidence` packs and signs with; openssl is the other maker of its test.
# shellcheck disable=SC2034
packages_to_prove="libzip-dev libssl-dev openssl"
# Optional: the edges of pose_walld; a build without them says so when one is asked for.
# shellcheck disable=SC2034
packages_to_live="linux-libc-dev libmodbus-dev libpaho-mqtt-dev libcpp-httplib-dev libssl-dev libbrotli-dev zlib1g-dev
  libwebsockets-dev pkg-config libroscpp-dev libtopic-tools-dev cyclonedds-dev cyclonedds-tools"
# Peers of the edges that others wrote.
# shellcheck disable=SC2034
packages_to_test_live="python3-pymodbus python3-serial-asyncio mosquitto mosquitto-clients python3-rosmaster
  python3-rospy python3-rosbag python3-rostopic python3-geometry-msgs python3-sensor-msgs python3-std-msgs
  python3-tf2-msgs python3-diagnostic-msgs python3-genmsg ros-std-msgs ros-sensor-msgs ros-geometry-msgs
  ros-diagnostic-msgs ros-tf2-msgs ros-nav-msgs libtf2-dev python3-roslaunch libfastrtps-dev libfastcdr-dev tshark
  chromium chromium-driver nodejs python3-prometheus-client python3-jsonschema openssl"
# What builds the packages of ROS 2.
# shellcheck disable=SC2034
packages_to_test_ros2_packages="colcon python3-colcon-cmake python3-colcon-ros ament-cmake rosidl-cmake
  rosidl-generator-c-cpp librosidl-typesupport-introspection-c-cpp-dev python3-catkin-pkg python3-yaml"
# For the tests of the package for Python.
# shellcheck disable=SC2034
packages_to_test_python="python3-numpy python3-yaml python3-matplotlib python3-pip python3-setuptools python3-wheel
  python3-venv"
# shellcheck disable=SC2034
packages_to_test="libgtest-dev python3 pkg-config groff-base"
packages_to_cross="cmake ninja-build libeigen3-dev g++-aarch64-linux-gnu qemu-user-static"
packages_to_cross_armhf="cmake ninja-build libeigen3-dev g++-arm-linux-gnueabihf qemu-user-static"
# shellcheck disable=SC2034
packages_to_pack="dpkg-dev file" # dpkg-shlibdeps looks up what the command depends on, and asks `file` what it is
# shellcheck disable=SC2034
presets_to_test="release debug asan tsan msan fuzz arm64 arm64-clang arm64-asan armhf bare"

# shellcheck disable=SC2086  # lists of words
packages_of() { # preset: what it takes to build it and to run its tests
  case $1 in
    release | debug | asan)
      echo $packages_to_build $packages_to_read $packages_to_survey $packages_to_prove $packages_to_test ;;
    tsan) echo $packages_to_build $packages_to_test ;;
    msan | fuzz | coverage) echo $packages_to_build $packages_to_read $packages_to_test clang llvm libclang-rt-dev ;;
    arm64 | arm64-asan) echo $packages_to_cross $packages_to_test ;;
    armhf) echo $packages_to_cross_armhf $packages_to_test ;;
    arm64-clang | bare) echo $packages_to_cross clang $packages_to_test ;;
    *) return 1 ;;
  esac
}

need_packages() {
  local missing="" as_root="" package
  if ! command -v apt-get > /dev/null || ! command -v dpkg-query > /dev/null; then
    echo "This is not Debian or Ubuntu: please see that you have what these packages hold: $*"
    return
  fi
  for package in "$@"; do
    # A line for each architecture that has it.
    if ! dpkg-query -W -f='${db:Status-Status}\n' "$package" 2> /dev/null | grep -qx installed; then
      missing="$missing $package"
    fi
  done
  [ -n "$missing" ] || return 0

  echo "Missing packages:$missing"
  if [ "$(id -u)" -ne 0 ]; then
    as_root=sudo
    # With a terminal sudo may ask for the password; without one it must do without.
    if ! command -v sudo > /dev/null || { [ ! -t 0 ] && ! sudo -n true 2> /dev/null; }; then
      echo "Installing them needs root. Please run this, then start again:"
      echo "  apt-get update && apt-get install --no-install-recommends$missing"
      exit 1
    fi
    sudo -v
  fi
  step "Updating the package lists" $as_root apt-get update
  # shellcheck disable=SC2086  # a list of words
  step "Installing packages" $as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends $missing
}

need_cmake() {
  local version
  version=$(cmake --version | sed -n '1s/[^0-9]*//p')
  if [ "$(printf '%s\n' 3.25 "$version" | sort -V | head -n 1)" != 3.25 ]; then
    echo "pose_wall needs CMake 3.25 or newer (Debian 12, Ubuntu 24.04); here is $version."
    exit 1
  fi
}

# The clients of tests/live/peer and what tools/apps/opcua is made with, from npm's registry, in build/. Where it
# cannot be reached, the tests that need them are skipped, and say so.
need_peers() {
  if ! command -v npm > /dev/null; then
    echo "There is no npm here: the tests with clients in JavaScript will be skipped"
    return 0
  fi
  mkdir -p build
  cp tests/live/peer/package.json tests/live/peer/package-lock.json build/
  step "Getting the JavaScript clients" sh -c 'npm ci --prefix build --no-audit --no-fund ||
    echo "npm has no registry here: the tests with clients in JavaScript will be skipped"'
  mkdir -p build/opcua
  cp tools/apps/opcua/package.json tools/apps/opcua/package-lock.json build/opcua/
  step "Getting what the OPC UA server is made with" sh -c '
    npm ci --prefix build/opcua --omit=dev --no-audit --no-fund ||
    echo "npm has no registry here: the test of the OPC UA server will be skipped"'
}

# three.js and esbuild for the 3D view of the pages, from npm's registry, in build/three/node_modules. CMake looks
# there, so it comes first. Where it cannot be reached, the pages do without that view, and say so.
need_three() {
  if ! command -v npm > /dev/null; then
    echo "There is no npm here: the pages will have no 3D view"
    return 0
  fi
  mkdir -p build/three
  cp tools/study/report/three/package.json tools/study/report/three/package-lock.json build/three/
  cmp -s build/three/package-lock.json build/three/fetched && return 0
  step "Getting three.js" sh -c 'npm ci --prefix build/three --ignore-scripts --no-audit --no-fund &&
    cp build/three/package-lock.json build/three/fetched ||
    echo "npm has no registry here: the pages will have no 3D view"'
}
