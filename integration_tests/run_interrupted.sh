#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run_interrupted.sh TRUNNION: a cluster that a command has started for itself ends with the command, in whatever way.
set -euo pipefail
trunnion=$1
. "$(dirname "$0")/cluster.sh"
fail() { echo "$1"; cat "$work/said"; exit 1; }

# In motion: the drive executes setpoints of the program.
moves() {
  "$trunnion" topic echo channel_state --count 1 --timeout 5 --json --domain "$in_domain" > "$work/state" 2>&1 &&
    grep -q '"state":"RUNNING"' "$work/state" && ! grep -q '"feed":0\.0,' "$work/state"
}
names_domain() { grep -q "is ready in .*domain [0-9]*)" "$work/said" || ! kill -0 "$run" 2> /dev/null; }
begin() {
  # The shell that starts the run empties the file later than this one could look for the domain in it.
  : > "$work/said"
  "$trunnion" run ac-table nas979_cone --real-time --report "$work/report" > "$work/said" 2>&1 &
  run=$!
  wait_until "the run names its domain" names_domain
  in_domain=$(sed -n 's/.*domain \([0-9]*\)).*/\1/p' "$work/said")
  [ -n "$in_domain" ] || fail "the run does not name its domain"
  launcher=$(pgrep -f -- "trunnion-launcher .*--domain $in_domain ")
  of_the_run=$(processes)
  [ "$(echo "$of_the_run" | wc -w)" -ge 8 ] || fail "the processes of the run are not found: $of_the_run"
  wait_until "the axes move" moves
}

# Afterwards another cluster of this computer may have taken the domain.
processes() { pgrep -f -- "--domain $in_domain " || true; }
# Not one that has ended and that its new parent has not waited for.
runs() { [ -e "/proc/$1" ] && [ -n "$(cat "/proc/$1/cmdline" 2> /dev/null | tr -d "\0")" ]; }
nothing_left() {
  for pid in $of_the_run; do
    ! runs "$pid" || fail "$1: a process is left: $(tr '\0' ' ' < "/proc/$pid/cmdline")"
  done
  local directory="/tmp/trunnion-$(id -u)/$in_domain"
  ! grep -qs "\b$launcher\b" "$directory/launcher.pid" || fail "$1: the run directory is left"
}
all_gone() {
  for pid in $of_the_run; do ! runs "$pid" || return 1; done
}

for signal in INT TERM; do
  begin
  kill -$signal $run
  status=0
  wait $run || status=$?
  [ $status = 1 ] || fail "SIG$signal: status $status"
  grep -q "trunnion: interrupted; the cluster of the run was stopped" "$work/said" || fail "SIG$signal: it does not say so"
  nothing_left "SIG$signal"
done

# Nothing of the command is left that could stop it: the launcher does so itself.
begin
kill -KILL $run
wait $run 2> /dev/null || true
wait_until "the launcher stops what a killed run has started" all_gone
nothing_left SIGKILL

# The reader of the output is gone before the first line of a command with a cluster of its own.
set +e
in_domain=71
"$trunnion" gantry gantry-cb-head --domain "$in_domain" 2> "$work/said" | true
status=${PIPESTATUS[0]}
set -e
[ $status = 141 ] || fail "closed pipe: status $status, not that of SIGPIPE"
wait_until "closed pipe: the run directory is removed" test ! -e "/tmp/trunnion-$(id -u)/$in_domain"
[ -z "$(processes)" ] || fail "closed pipe: processes are left: $(processes)"
