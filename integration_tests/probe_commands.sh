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
# One input beyond its limits each, and its alarm.
limits=(
  '#52001=2' 'the order of the axes in the report, must be 0 or 1'
  '#52002=3' 'the rotary axes, must be 4, 5 or 6'
  '#52003=4' 'must be two axes'
  '#52004=0.5' 'the safe height, must be 1 to 100 mm'
  '#52005=200' 'the feeds must be F1 above F2 above F3 above 0'
  '#52007=0' 'the feeds must be F1 above F2 above F3 above 0'
  '#52008=101' 'the radius of the sphere, must be above 0 and at most 100 mm'
  '#52009=-1' 'the tool length, must be 0 to 2000 mm'
  '#52010=0' 'the tool radius, must be above 0 and at most 100 mm'
  '#52011=#0' 'the retract plane, is missing'
  '#52000=1' 'a teaching point has a vacant coordinate'
)
for ((i = 0; i < ${#limits[@]}; i += 2)); do
  # Variables keep their values from program to program; calibrate.nc leaves #52001 to its default.
  { echo O0200; echo '#52001=#0'; grep '^#520' "$3/probe-sphere/calibrate.nc"; echo "${limits[i]}"; echo 'M98 P1'; echo M30; } > "$machine/programs/limit_$i.nc"
done
# The lines of the manual's macro program for its first point. It moves to the teaching point itself, so that has to be above
# the sphere; G54 is set to nothing, since P002 takes machine coordinates.
cat > "$machine/programs/printed.nc" <<'END'
O0201
G21 G17 G90 G94 G40 G80 G49
G10 L2 P1 X0 Y0 Z0
#52120=#52120+2
G53 G0 Z0
A#52130 C#52140
M40
G54 G01 X[#52100] Y[#52110] Z[#52120] F1000
G65 P002 X[#52100] Y[#52110] Z[#52120]
#52150=#50
#52151=#51
#52152=#52
#52160=#53
G53 G0 Z0
M41
M30
END

start_cluster "$machine"
"$trunnion" channel mode auto --domain "$domain"

# Inputs out of their limits are one clear alarm before anything moves.
is_told() { "$trunnion" alarms --domain "$domain" > "$work/alarms" && grep -qF "$1" "$work/alarms"; }
run_to_end O0001.nc
wait_until "the alarm of #52000" is_told '#52000, the calibration type, must be 0, 1 or 2'
reset_alarms
"$trunnion" channel reset --domain "$domain"

for ((i = 0; i < ${#limits[@]}; i += 2)); do
  run_to_end "limit_$i.nc"
  wait_until "${limits[i]}: ${limits[i + 1]}" is_told "${limits[i + 1]}"
  reset_alarms
  "$trunnion" channel reset --domain "$domain"
done

run_to_end calibrate.nc
run_to_end O0001.nc
"$trunnion" alarms --domain "$domain" > "$work/alarms"
grep -q 'no alarms' "$work/alarms" || fail "$(cat "$work/alarms")"
[ "$("$trunnion" variables 52999 --domain "$domain")" = "#52999 16" ] || fail "$("$trunnion" variables --domain "$domain")"
"$trunnion" variables --domain "$domain" --json > "$work/variables.json"
"$python" "$(dirname "$0")/check_measured_centres.py" "$trunnion" "$machine" "$work/variables.json" || fail "wrong centres"
# The vectors from these points. The axis of A is 15 + 25 um in Y from that of C, C itself 40, -25 and 30 um from its place.
kinematics() { "$trunnion" calibrate kinematics "$machine" --variables --domain "$domain" "$@"; }
kinematics > "$work/protocol" || fail "$(cat "$work/protocol")"
grep -q 'program %001' "$work/protocol" || fail "$(cat "$work/protocol")"
kinematics --mode correct --write > "$work/written" || fail "$(cat "$work/written")"
"$trunnion" channel reset --domain "$domain"
for expected in '040433 0.040' '040435 0.040' '040436 -0.025' '040437 -399.970'; do
  found=$(awk -v number="${expected% *}" '$1 == number && $3 == "=" { print $4 }' "$work/written")
  awk -v a="$found" -v b="${expected#* }" 'BEGIN { d = a - b; exit !(a != "" && d < 0.001 && d > -0.001) }' ||
    fail "$expected: $(cat "$work/written")"
done
"$trunnion" calibrate undo --domain "$domain" > "$work/undone" || fail "$(cat "$work/undone")"
"$trunnion" channel reset --domain "$domain"
# The same by HTTP.
"$python" - "http://localhost:$port/api/variables/0" "$work/variables.json" <<'END' || fail "HTTP"
import json, sys, urllib.request
with urllib.request.urlopen(sys.argv[1]) as answer: told = json.load(answer)
with open(sys.argv[2]) as file: shown = json.load(file)
assert {str(n): v for n, v in zip(told["numbers"], told["values"])} == shown
END

# The printed lines give the same touches of the first point.
run_to_end printed.nc
"$trunnion" variables --domain "$domain" --json > "$work/printed.json"
"$python" - "$work/variables.json" "$work/printed.json" <<'END' || fail "the printed lines give other touches"
import json, sys
before, after = (json.load(open(name)) for name in sys.argv[1:])
for number in ("52150", "52151", "52152", "52160"):
    assert abs(before[number] - after[number]) < 0.001, (number, before[number], after[number])
END

start_recording "$work/r.mcap" "$work/record.log"
run_to_end measure_sphere.nc
end_recording "$work/record.log"
for service in drive channel plc; do
  "$trunnion" verify --service $service --recording "$work/r.mcap" --machine "$machine" > "$work/verify.log" 2>&1 ||
    fail "$(cat "$work/verify.log")"
done
