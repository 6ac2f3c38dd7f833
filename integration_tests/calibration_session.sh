#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# calibration_session.sh TRUNNION EXAMPLES MACHINES: `trunnion calibrate` as the client of the measurement service: bodies in
# the way, Ctrl-C, --detach, status, abort, continue, confirm, discard, undo. Faults of the machine: measurement_faults_test.
set -euo pipefail
trunnion=$1
. "$(dirname "$0")/cluster.sh"
fail() { echo "$*" >&2; cat "$work/error" >&2; exit 1; }
machine=$work/mill
cp -r "$3/ac-table" "$machine"
inputs=$work/inputs.yaml
cat > "$inputs" <<'END'
mode: correct
axes:
  A: {start_deg: -60, end_deg: 60, points: 3, other_deg: 0}
  C: {start_deg: 0, end_deg: 240, points: 3, other_deg: 0}
# Ten times the delivered one: the 420 degrees of the ways of a measurement would last 70 s.
settings: {rotary_feed_deg_per_min: 3600}
END

# up LINE: a cluster whose truth has this instead of the probe of the example.
up() {
  sed "s/^probe: .*/$1/" "$2/calibration/truth.yaml" > "$machine/truth.yaml"
  rm -rf "$work/state"
  start_cluster "$machine"
}
calibrate() { "$trunnion" calibrate "$@" --domain "$domain" > "$work/out" 2> "$work/error"; }
measure() { calibrate kinematics "$machine" --on-machine --inputs "$inputs" "$@"; }
values() { "$trunnion" param get 040432 040433 040435 040436 040437 --domain "$domain"; }
settle() { reset_and_settle 040432 040433 040435 040436 040437; }
# stopped PATTERN POSES: it ended in one line (behind those of the progress), and nothing was written.
stopped() {
  [ "$(grep -c '^trunnion: ' "$work/error")" = 1 ] || fail "$1: not one line"
  grep -q "^trunnion: $1.*; nothing written, $2 of 5 poses are complete" "$work/error" || fail "expected: $1, $2"
  [ "$(values)" = "$before" ] || fail "$1: parameters were changed"
}
phase() { "$trunnion" calibrate status --json --domain "$domain" | python3 -c 'import json, sys; print(json.load(sys.stdin)["state"]["phase"])'; }
has_phase() { [ "$(phase)" = "$1" ]; }
is_cleared() {
  "$trunnion" channel reset --domain "$domain" > "$work/log" 2>&1 || true
  "$trunnion" alarms --reset --domain "$domain" > "$work/log" 2>&1 || true
  "$trunnion" alarms --domain "$domain" > "$work/log"
  # The probe may be in contact, and then it cannot be switched on.
  grep -q 'no alarms' "$work/log" && "$trunnion" mdi "G53 G1 Z0 F3000" --domain "$domain" > "$work/log" 2>&1
}
clear_machine() { wait_until "the machine is without alarms, the probe away" is_cleared; }
probe='ball_radius_mm: 3, length_mm: 60, pre_travel_um: 8, delay_ms: 1'

echo "A probe that repeats badly"
up "probe: {$probe, repeatability_um: 20}" "$2"
before=$(values)
if measure --write; then fail "not stopped"; fi
stopped 'repeatability of the probe: 5 touches of one point differ by .* um, 5.00 um is permitted' 0
stop_cluster

echo "A body in the way: found before anything moves, and without regard to bodies a contact outside a skip move"
up "probe: {$probe}" "$2"
echo '  - {box: {size_mm: [20, 20, 20]}, position_mm: [60, 40, -300]}' >> "$machine/truth.yaml"
stop_cluster
start_cluster "$machine"
if measure --write; then fail "not stopped"; fi
stopped "plan: pose A0 C0: 'box 2' and 'probe' overlap by .* over the sphere" 0
if measure --write --retract; then fail "not stopped"; fi
stopped 'repeatability of the probe: alarm 117: .*outside a skip move' 0
stop_cluster

up "probe: {$probe}" "$2"
[ "$(phase)" = NOTHING ] || fail "a new machine has a measurement"
for order in abort continue confirm discard; do
  [ "$order" = discard ] && { calibrate "$order" || fail "discard of nothing"; continue; }
  if calibrate "$order"; then fail "$order without a measurement"; fi
  grep -q 'no measurement\|no result' "$work/error" || fail "$order"
done

echo "SIGINT: the channel is held; refused until it is reset; then the rest"
: > "$work/error"
measure --write &
measuring=$!
two_poses_or_end() { [ "$(grep -c '^pose ' "$work/error")" -ge 2 ] || ! kill -0 $measuring 2> /dev/null; }
patience=300 wait_until "two poses are measured" two_poses_or_end
kill -0 $measuring 2> /dev/null || fail "ended early"
pid=$(pgrep -P $measuring trunnion || echo $measuring)
kill -INT "$pid"
if wait $measuring; then fail "not stopped"; fi
stopped '.*: aborted' '[2345]'
complete=$(grep -c '^pose ' "$work/error")
if grep -q 'the channel is HELD' "$work/error"; then
  if calibrate continue; then fail "went on in a held channel"; fi
  grep -q 'end or reset it first' "$work/error" || fail "no reason"
fi
clear_machine
measure --resume --write || fail "did not continue"
[ "$(grep -c '^pose ' "$work/error")" -le $((5 - complete)) ] || fail "it began anew: $complete"
grep -q 'written; active after a reset' "$work/out" || fail "$(cat "$work/out")"
settle
[ "$(values)" != "$before" ] || fail "nothing was written"
# The offset of A is that of its axis less that of C, 120 + 90 um (examples/calibration/truth.yaml); the inclinations of 36 urad
# over some 82 mm go into the offsets.
near() { awk -v n="$1" -v v="$2" '$1 == n { d = $4 - v; found = d < 0.005 && d > -0.005 } END { exit !found }' <(values) || fail "$1 is not $2: $(values)"; }
near 040433 0.21
near 040435 0.05
near 040436 -0.09
grep -q '"who":".* calibrate"' "$work/state/journal.jsonl" || fail "the journal does not name the calibration"
"$trunnion" calibrate undo --domain "$domain" > "$work/log"
settle
[ "$(values)" = "$before" ] || fail "undo: $(values)"

echo "Without --write the result waits; it is confirmed later"
measure || fail "did not measure"
grep -q 'calibrate confirm' "$work/out" || fail "$(cat "$work/out")"
calibrate status || fail "status"
grep -q 'calibrate confirm writes' "$work/out" && grep -q '^040433: 0.000000 -> 0.21' "$work/out" || fail "$(cat "$work/out")"
[ "$(phase)" = WAITING ] || fail "$(phase)"
calibrate confirm || fail "confirm"
settle
near 040433 0.21
if calibrate confirm; then fail "confirmed twice"; fi

echo "--detach, abort, discard"
measure --detach || fail "detach"
grep -q 'is under way' "$work/out" || fail "$(cat "$work/out")"
if measure; then fail "two measurements at a time"; fi
grep -q 'a measurement is under way: abort it first' "$work/error" || fail "no reason"
calibrate abort || fail "abort"
[ "$(phase)" = INTERRUPTED ] || fail "$(phase)"
await_alarm '^ *180 '
clear_machine
calibrate continue --detach || fail "continue"
patience=300 wait_until "the result waits" has_phase WAITING
calibrate discard || fail "discard"
[ "$(phase)" = NOTHING ] || fail "$(phase)"
near 040433 0.21
