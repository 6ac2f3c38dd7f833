#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run_interrupted.sh TRUNNION: Ctrl-C and SIGTERM during `trunnion run` stop the cluster of the run.
set -euo pipefail
trunnion=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$1"; cat "$work/said"; exit 1; }

for signal in INT TERM; do
  "$trunnion" run ac-table nas979_cone --real-time --report "$work/report" > "$work/said" 2>&1 &
  run=$!
  for _ in $(seq 200); do
    grep -q "is ready in" "$work/said" && break
    sleep 0.05
  done
  domain=$(sed -n 's/.*domain \([0-9]*\)).*/\1/p' "$work/said")
  [ -n "$domain" ] || fail "the run does not name its domain"
  sleep 1  # in motion
  kill -$signal $run
  status=0
  wait $run || status=$?
  [ $status = 1 ] || fail "SIG$signal: status $status"
  grep -q "trunnion: interrupted; the cluster of the run was stopped" "$work/said" || fail "SIG$signal: it does not say so"
  ! pgrep -f -- "--domain $domain " > "$work/left" || fail "SIG$signal: processes are left: $(cat "$work/left")"
  [ ! -e "/tmp/trunnion-$(id -u)/$domain" ] || fail "SIG$signal: the run directory is left"
done
