#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# calibration_faults.sh TRUNNION EXAMPLES MACHINES: `trunnion calibrate kinematics --on-machine` with a fault in each phase. Each
# ends in one line with phase and cause, no parameter changes, and the measurement continues after the last complete pose.
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
END

# up LINE: a cluster whose truth has this instead of the probe of the example.
up() {
  sed "s/^probe: .*/$1/" "$2/calibration/truth.yaml" > "$machine/truth.yaml"
  rm -rf "$work/state"
  start_cluster "$machine"
}
measure() { "$trunnion" calibrate kinematics "$machine" --on-machine --inputs "$inputs" --save-touches "$work/touches" --write \
  --domain "$domain" "$@" > "$work/out" 2> "$work/error"; }
# Parameters that were written become active a moment after a reset.
settled() {
  for _ in $(seq 100); do
    "$trunnion" param get 040432 040433 040435 040436 040437 --json --domain "$domain" | grep -q '"pending": *true' || return 0
    sleep 0.1
  done
}
values() { "$trunnion" param get 040432 040433 040435 040436 040437 --domain "$domain"; }
# stopped PATTERN: it ended in one line (behind those of the progress), and nothing was written.
stopped() {
  [ "$(grep -c '^trunnion: ' "$work/error")" = 1 ] || fail "$1: not one line"
  grep -q "^trunnion: $1.*; nothing written, $2 of 5 poses are complete in" "$work/error" || fail "expected: $1, $2"
  [ "$(values)" = "$before" ] || fail "$1: parameters were changed"
}
clear_machine() {
  for _ in $(seq 100); do
    "$trunnion" channel reset --domain "$domain" > "$work/log" 2>&1 || true
    "$trunnion" alarms --reset --domain "$domain" > "$work/log" 2>&1 || true
    "$trunnion" alarms --domain "$domain" > "$work/log"
    if grep -q 'no alarms' "$work/log"; then
      # The probe may be in contact, and then it cannot be switched on.
      "$trunnion" mdi "G53 G1 Z0 F3000" --domain "$domain" > "$work/log" 2>&1 || { sleep 0.1; continue; }
      for _ in $(seq 100); do
        "$trunnion" status --domain "$domain" | grep -q ', ready$' || { sleep 0.1; continue; }
        case $("$trunnion" topic echo channel_state --count 1 --json --domain "$domain") in *'"state":"IDLE"'*) return ;; esac
        sleep 0.1
      done
    fi
    sleep 0.1
  done
  fail "alarms stay: $(cat "$work/log")"
}
probe='ball_radius_mm: 3, length_mm: 60, pre_travel_um: 8, delay_ms: 1'
# Each touch is two contacts; five touches check the repeatability.
echo "No signal while the repeatability is checked"
up "probe: {$probe, no_signal_from_touch: 4}" "$2"
before=$(values)
if measure; then fail "not stopped"; fi
stopped 'repeatability of the probe: alarm 1501: .*no contact of the probe' 0
stop_cluster

echo "A probe that repeats badly"
up "probe: {$probe, repeatability_um: 20}" "$2"
if measure; then fail "not stopped"; fi
stopped 'repeatability of the probe: 5 touches of one point differ by .* um, 5.00 um is permitted' 0
stop_cluster

echo "No signal in the second pose: 10 + 20 contacts, then 3"
up "probe: {$probe, no_signal_from_touch: 34}" "$2"
if measure; then fail "not stopped"; fi
stopped 'pose A-60 C0: alarm 1501: .*no contact of the probe' 1
stop_cluster

echo "An early signal in the second pose"
up "probe: {$probe, early_mm: 0.5, early_from_touch: 31}" "$2"
if measure; then fail "not stopped"; fi
stopped 'pose A-60 C0: measured diameter of the sphere 25.99.. mm, given 25.0000 mm' 1
stop_cluster

echo "A body in the way: found before anything moves, and without regard to bodies a contact outside a skip move"
up "probe: {$probe}" "$2"
echo '  - {box: {size_mm: [20, 20, 20]}, position_mm: [60, 40, -300]}' >> "$machine/truth.yaml"
stop_cluster
start_cluster "$machine"
if measure; then fail "not stopped"; fi
stopped "plan: pose A0 C0: 'box 2' and 'probe' overlap by .* over the sphere" 0
if measure --retract; then fail "not stopped"; fi
stopped 'repeatability of the probe: alarm 117: .*outside a skip move' 0
stop_cluster

up "probe: {$probe}" "$2"
# background POSES: measures until so many poses are complete.
background() {
  rm -f "$work/touches"
  : > "$work/error"
  "$trunnion" calibrate kinematics "$machine" --on-machine --inputs "$inputs" --save-touches "$work/touches" --write \
    --domain "$domain" > "$work/out" 2> "$work/error" &
  measuring=$!
  for _ in $(seq 600); do
    [ "$(grep -c '^pose ' "$work/error")" -ge "$1" ] && return
    kill -0 $measuring 2> /dev/null || fail "ended early"
    sleep 0.05
  done
  fail "no pose"
}
echo "Emergency stop"
background 1
"$trunnion" estop press --domain "$domain" > "$work/log"
if wait $measuring; then fail "not stopped"; fi
stopped 'pose A.*mergency stop' '[12]'
"$trunnion" estop release --domain "$domain" > "$work/log"
"$trunnion" estop reset --domain "$domain" > "$work/log" || true
clear_machine

for service in channel drive; do
  echo "kill -9 of the $service"
  background 1
  kill -9 "$("$trunnion" status --json --domain "$domain" | python3 -c '
import json, sys
print(next(s["pid"] for s in json.load(sys.stdin)["services"] if s["service"] == sys.argv[1]))' $service)"
  if wait $measuring; then fail "not stopped"; fi
  stopped 'pose A' '[1-5]'
  clear_machine
done

echo "SIGINT: the channel is held; refused until it is reset; then the rest"
background 2
kill -INT $measuring
if wait $measuring; then fail "not stopped"; fi
stopped 'pose [AC].*: interrupted; the channel is' '[2345]'
if grep -q 'the channel is HELD' "$work/error"; then
  if measure --resume; then fail "went on in a held channel"; fi
  grep -q 'end or reset it first' "$work/error" || fail "no reason"
fi
clear_machine
complete=$(grep -c '^A-60' "$work/touches")
measure --resume || fail "did not continue"
[ "$(grep -c '^pose ' "$work/error")" -lt 5 ] || fail "it began anew: $complete"
"$trunnion" channel reset --domain "$domain" > "$work/log"
settled
[ "$(values)" != "$before" ] || fail "nothing was written"
# The offset of A is that of its axis less that of C, 120 + 90 um (examples/calibration/truth.yaml); the inclinations of 36 urad
# over some 82 mm go into the offsets.
near() { awk -v n="$1" -v v="$2" '$1 == n { d = $4 - v; found = d < 0.005 && d > -0.005 } END { exit !found }' <(values) || fail "$1 is not $2: $(values)"; }
near 040433 0.21
near 040435 0.05
near 040436 -0.09
"$trunnion" calibrate undo --domain "$domain" > "$work/log"
"$trunnion" channel reset --domain "$domain" > "$work/log"
settled
[ "$(values)" = "$before" ] || fail "undo: $(values)"
