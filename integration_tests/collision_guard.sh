#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# collision_guard.sh TRUNNION MACHINES: `collision: stop` and `warn` in machine.yaml, for a program without a cluster and on
# clusters of both vendors.
set -euo pipefail
trunnion=$1
. "$(dirname "$0")/cluster.sh"
cp -r "$2/ac-table" "$work/m"
sed -i '/service: gateway/d' "$work/m/machine.yaml"
echo 'collision: stop' >> "$work/m/machine.yaml"
# Tool 1 is in no spindle: the spindle nose, whose face is the control point, goes to the table at Z-400. With 1 mm of clearance
# line 4 must not begin.
cat > "$work/m/programs/down.nc" <<'END'
G21 G17 G90 G94 G40 G49 G54
G0 G53 X20 Y0
G1 G53 Z-250 F8000
G1 G53 Z-420
M30
END
expected="down.nc:4: 'table' and 'spindle nose' would be 1\.[0-9]* mm apart (clearance 1 mm) at X20.000 Y0.000 Z-398\.[0-9]* mm"
program=$work/m/programs/down.nc

if "$trunnion" check "$program" --machine "$work/m" > "$work/out"; then fail "check finds nothing: $(cat "$work/out")"; fi
grep -q "down.nc:4: 176: 'table' and 'spindle nose' would be" "$work/out" || fail "$(cat "$work/out")"
if "$trunnion" plan "$program" --machine "$work/m" > "$work/out" 2> "$work/error"; then fail "plan finds nothing"; fi
grep -q "$expected" "$work/error" || fail "$(cat "$work/error")"
sed -i 's/^collision: .*/collision: warn/' "$work/m/machine.yaml"
"$trunnion" plan "$program" --machine "$work/m" > "$work/out" 2> "$work/error" || fail "warn ends a program"
grep -q "$expected" "$work/error" || fail "$(cat "$work/error")"
sed -i 's/^collision: .*/collision: perhaps/' "$work/m/machine.yaml"
if "$trunnion" plan "$program" --machine "$work/m" > /dev/null 2> "$work/error"; then fail "perhaps is accepted"; fi
grep -q "machine.yaml:[0-9]*:[0-9]*: .*collision must be 'off', 'warn' or 'stop'" "$work/error" || fail "$(cat "$work/error")"
sed -i 's/^collision: .*/collision: stop/' "$work/m/machine.yaml"

alarms() { "$trunnion" alarms --domain "$domain" > "$work/alarms"; cat "$work/alarms"; }
stopped() {
  alarms > /dev/null
  grep -q "$expected" "$work/alarms"
}
cleared() { ! stopped; }
for vendor in cyclonedds fastdds; do
  rm -rf "$work/state"
  start_cluster "$work/m" --vendor $vendor
  run() { "$trunnion" channel "$@" --domain "$domain" > "$work/answer" 2>&1; }
  run mode auto && run select down.nc && run start || fail "$vendor: $(cat "$work/answer")"
  wait_until "$vendor: the program is stopped before the table" stopped
  grep "$expected" "$work/alarms" | sed 's/^.*down.nc/down.nc/; s/  .*//' > "$work/alarm-$vendor"
  "$trunnion" alarms --reset --domain "$domain" > /dev/null
  wait_until "$vendor: the alarm goes with its reset" cleared
  # Up is away; the table is still in the way down.
  "$trunnion" mdi "G53 G0 Z-200" --domain "$domain" > "$work/answer" 2>&1 || fail "$vendor: $(cat "$work/answer")"
  if "$trunnion" mdi "G53 G0 Z-410" --domain "$domain" > "$work/answer" 2>&1; then fail "$vendor: MDI into the table"; fi
  grep -q "'table' and 'spindle nose' would be" "$work/answer" || fail "$vendor: $(cat "$work/answer")"
  stop_cluster
done
cmp "$work/alarm-cyclonedds" "$work/alarm-fastdds" || fail "the vendors stop at different places"
