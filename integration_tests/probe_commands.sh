#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# probe_commands.sh TRUNNION MACHINES EXAMPLES PYTHON: examples/probe-sphere in virtual time. %001 measures 16 centres on a
# machine whose table is beside its place; they are those of the true axes. A recorded measurement is verified.
set -euo pipefail
trunnion=$1 python=$4
. "$(dirname "$0")/cluster.sh"
machine=$work/m
cp -r "$2/ac-table" "$machine"
cp "$3"/probe-sphere/*.nc "$3"/calibration/programs/*.nc "$machine/programs"
sed 's/, repeatability_um: 0.3//; s/lobing_um: 0.5, //' "$3/probe-sphere/truth.yaml" > "$machine/truth.yaml"
echo 'axes: {C: {XOC_um: 40, YOC_um: -25}, A: {ZOA_um: 30, YOA_um: 15}}' >> "$machine/truth.yaml"

start_cluster "$machine"
"$trunnion" channel mode auto --domain "$domain"

# run PROGRAM: to its end, or the alarm that has ended it.
run() {
  "$trunnion" channel select "$1" --domain "$domain"
  "$trunnion" channel start --domain "$domain"
  for _ in $(seq 600); do
    "$trunnion" topic echo channel_state --count 1 --json --domain "$domain" > "$work/state.json"
    case $(cat "$work/state.json") in *'"state":"IDLE"'*) return ;; esac
    sleep 0.1
  done
  fail "$1 does not end: $(cat "$work/state.json")"
}

# Inputs out of their limits are one clear alarm before anything moves.
run O0001.nc
"$trunnion" alarms --domain "$domain" > "$work/alarms"
grep -q '#52000, the calibration type, must be 0, 1 or 2' "$work/alarms" || fail "$(cat "$work/alarms")"
"$trunnion" alarms --reset --domain "$domain" > "$work/log"
"$trunnion" channel reset --domain "$domain"

run calibrate.nc
run O0001.nc
"$trunnion" alarms --domain "$domain" > "$work/alarms"
grep -q 'no alarms' "$work/alarms" || fail "$(cat "$work/alarms")"
[ "$("$trunnion" variables 52999 --domain "$domain")" = "#52999 16" ] || fail "$("$trunnion" variables --domain "$domain")"
"$trunnion" variables --domain "$domain" --json > "$work/variables.json"
"$python" "$(dirname "$0")/check_measured_centres.py" "$trunnion" "$machine" "$work/variables.json" || fail "wrong centres"
# The same by HTTP.
"$python" - "http://localhost:$port/api/variables/0" "$work/variables.json" <<'END' || fail "HTTP"
import json, sys, urllib.request
with urllib.request.urlopen(sys.argv[1]) as answer: told = json.load(answer)
with open(sys.argv[2]) as file: shown = json.load(file)
assert {str(n): v for n, v in zip(told["numbers"], told["values"])} == shown
END

"$trunnion" record "$work/r.mcap" --domain "$domain" > "$work/record.log" 2>&1 &
recorder=$!
for _ in $(seq 100); do [ -s "$work/r.mcap" ] && break; sleep 0.1; done
run measure_sphere.nc
kill -INT $recorder
wait $recorder || fail "$(cat "$work/record.log")"
for service in drive channel plc; do
  "$trunnion" verify --service $service --recording "$work/r.mcap" --machine "$machine" > "$work/verify.log" 2>&1 ||
    fail "$(cat "$work/verify.log")"
done
