# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
# shellcheck shell=bash
#
# For sourcing: step NAME COMMAND... runs a command quietly, its output in a log. A terminal sees the time and the
# log's last line pass by; a failure shows the log's end and ends the script.

step_log_dir=${step_log_dir:-build/logs}
step_log=

step() {
  local name=$1 started=$SECONDS status=0 busy
  shift
  mkdir -p "$step_log_dir"
  step_processor_s
  busy=$step_busy
  step_log=$step_log_dir/$(printf '%s' "$name" | tr -cs 'A-Za-z0-9\n' '_').log
  if [ -t 1 ]; then
    "$@" > "$step_log" 2>&1 < /dev/null &
    step_watch $! "$name" || status=$?
  else
    printf '==> %s ... ' "$name"
    "$@" > "$step_log" 2>&1 < /dev/null || status=$?
  fi
  if [ "$status" -ne 0 ]; then
    printf 'FAILED\n\n'
    tail -n 60 "$step_log"
    printf '\n%s failed with status %s after %s s. Whole log: %s\n' "$name" "$status" $((SECONDS - started)) "$step_log"
    exit 1
  fi
  step_processor_s
  printf 'done (%s s, %s of processors)\n' $((SECONDS - started)) $((step_busy - busy))
}

step_processor_s() { # step_busy: seconds that the programs run so far have kept a processor busy
  times > "$step_log_dir/times"
  step_busy=$(sed -n '2s/[ms]/ /gp' "$step_log_dir/times" | awk '{ printf "%d", 60 * ($1 + $3) + $2 + $4 }')
}

step_watch() { # pid, name: shows progress until the process ends, returns its status
  local pid=$1 name=$2 started=$SECONDS line room
  trap 'kill "$pid" 2> /dev/null; exit 130' INT TERM
  room=$(($(tput cols 2> /dev/null || echo 80) - ${#name} - 20))
  while kill -0 "$pid" 2> /dev/null; do
    line=$(tail -n 1 "$step_log" 2> /dev/null | tr -d '\r\033' | cut -c "1-$((room > 10 ? room : 10))")
    printf '\r\033[K==> %s ... %s s  %s' "$name" $((SECONDS - started)) "$line"
    sleep 0.3
  done
  trap - INT TERM
  printf '\r\033[K==> %s ... ' "$name"
  wait "$pid"
}
