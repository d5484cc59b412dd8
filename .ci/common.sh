# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
# shellcheck shell=bash
#
# For sourcing by run and weekly from the project's root: where recordings lie, what a step is called, and the sum of
# all tests at the end, whatever comes.

. tools/shell/steps.sh
. tools/shell/packages.sh

if [ -z "${POSE_WALL_DATA:-}" ] && [ -d ../shared/data ]; then
  POSE_WALL_DATA=$(cd ../shared/data && pwd)
  export POSE_WALL_DATA
fi

if [ ! -d /proc/self/task ]; then
  echo "/proc is not mounted here: AddressSanitizer cannot look for leaks"
  export ASAN_OPTIONS=detect_leaks=0
fi

weekly_passed=.ci/weekly_passed

# Sources of the libraries that changed since the commit that a file ends with, newest first; the last hundred commits where there is none.
changed_files() {
  local since
  since=$(awk '{print $NF}' "$1" 2> /dev/null || true)
  git cat-file -e "$since^{commit}" 2> /dev/null || since=HEAD~100
  git cat-file -e "$since^{commit}" 2> /dev/null || since=$(git rev-list --max-parents=0 HEAD | tail -n 1)
  [ -n "$since" ] && git log -M90% --diff-filter=dr --format= --name-only "$since.." -- src |
    awk '/[.]cpp$/ && !seen[$0]++'
}

announce() { printf '\n### %s (%s s so far)\n' "$1" "$SECONDS"; }

# Packages of the project, and what is needed beyond.
need_all() {
  # shellcheck disable=SC2086  # lists of words
  need_packages $packages_to_build $packages_to_read $packages_to_survey $packages_to_prove $packages_to_live $packages_to_test \
    $packages_to_test_live $packages_to_test_python clang clang-format clang-tidy "$@"
}

summary() {
  local status=$? log line bad all passed=0 failed=0
  [ -z "${rates:-}" ] || kill "$rates" 2> /dev/null || true
  printf '\n### Summary after %s s\n' "$SECONDS"
  for log in build/logs/Testing*.log; do
    line=$(grep -hoE '[0-9]+% tests passed, .*' "$log" 2> /dev/null | tail -n 1) || continue
    [ -n "$line" ] || continue
    # What a failed test said: a log's end holds names alone, and its middle is long.
    grep -hE '^(FAIL|ERROR): |^[A-Za-z_.]*Error: |: Failure$|\*\*\*(Failed|Timeout|Exception)' "$log" | tail -n 20 || true
    bad=$(sed -E 's/.*passed, ([0-9]+) tests? failed.*/\1/' <<< "$line")
    all=${line##* }
    failed=$((failed + bad)) passed=$((passed + all - bad))
    printf '%s: %s\n' "$(basename "$log" .log)" "$line"
  done
  printf 'the weekly checks last passed: %s\n' "$(cat "$weekly_passed" 2> /dev/null || echo never)"
  [ "$status" -eq 0 ] && echo "every step passed" || echo "a step failed, see above"
  echo "$passed passed, $failed failed"
}
