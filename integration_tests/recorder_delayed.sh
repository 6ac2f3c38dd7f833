#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# recorder_delayed.sh TRUNNION MACHINES: in virtual time a recorder that gets no processor for 0.3 s at a time, during a
# program, has lost nothing, and the recording verifies. One that never continues is not waited for.
set -euo pipefail
trunnion=$1
. "$(dirname "$0")/cluster.sh"
# waits PROCESS: how often its first thread, which reads, has waited.
waits() { awk '/^voluntary_ctxt_switches/ {print $2}' "/proc/$1/task/$1/status"; }
# let_read PROCESS: continues it until it has waited twice. In between it has read whatever there was.
let_read() {
  local before end=$((SECONDS + 60))
  before=$(waits "$1")
  kill -CONT "$1"
  until [ "$(waits "$1")" -ge $((before + 2)) ]; do
    [ "$SECONDS" -lt "$end" ] || fail "the recorder does not read"
    sleep 0.005
  done
}
# 40 moves of 3 s, so 120,000 cycles: ten times what a channel writes without a recorder.
{ echo 'G90 G94 F200 G1 X0'; for _ in $(seq 20); do echo 'X10'; echo 'X0'; done; echo M30; } > "$work/long.nc"
for vendor in cyclonedds fastdds; do
  start_cluster "$2/ac-table" --vendor $vendor
  "$trunnion" program put "$work/long.nc" --domain "$domain" > /dev/null
  "$trunnion" channel mode auto --domain "$domain"
  select_program long.nc
  start_recording "$work/$vendor.mcap" "$work/record"
  command=$recorder
  # The process that records: the command itself, or its child.
  process=$(pgrep -P $command || echo $command)
  curl -fsS -X POST "http://127.0.0.1:$port/api/channels/0/cycle-start" > "$work/out" || fail "$(cat "$work/out")"
  for _ in $(seq 8); do
    kill -STOP $process
    sleep 0.3
    let_read $process
  done
  await_idle
  kill -INT $command
  wait $command || fail "$vendor: $(cat "$work/record")"
  for topic in path_batch feedback; do
    grep -q "$topic: [0-9]* cycles, 0 lost" "$work/record" || fail "$vendor: $(cat "$work/record")"
  done
  "$trunnion" verify --service channel --recording "$work/$vendor.mcap" --machine "$2/ac-table" > "$work/verify" 2>&1 ||
    fail "$vendor: $(cat "$work/verify")"

  start_recording "$work/$vendor.mcap" "$work/suspended" --force
  command=$recorder
  process=$(pgrep -P $command || echo $command)
  kill -STOP $process
  curl -fsS -X POST "http://127.0.0.1:$port/api/channels/0/cycle-start" > "$work/out" || fail "$(cat "$work/out")"
  await_idle
  kill -CONT $process
  kill -INT $command
  wait $command || true
  stop_cluster
  rm -rf "$work/state"
done
