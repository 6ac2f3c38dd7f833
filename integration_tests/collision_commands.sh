#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# collision_commands.sh TRUNNION EXAMPLES MACHINES: `trunnion collision`, and what `calibrate kinematics` says of the bodies.
set -euo pipefail
trunnion=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$*" >&2; exit 1; }
machine=$work/mill
cp -r "$3/ac-table" "$machine"

# The delivered programs touch nothing with the tool of the table.
for program in nas979_cone s_piece; do
  "$trunnion" collision "$machine" --program "$machine/programs/$program.nc" --tool 1 > "$work/out" || fail "$(cat "$work/out")"
  grep -q "no contact, clearance 1.000 mm" "$work/out" || fail "$(cat "$work/out")"
done

# Nor do those of the other machines, and their reference position is free.
for bodies in "$3"/*/bodies.yaml; do
  directory=$(dirname "$bodies")
  for program in "$directory"/programs/*.nc; do
    "$trunnion" collision "$directory" --program "$program" --tool 1 > "$work/out" || fail "$(cat "$work/out")"
    grep -Eq "no contact, clearance 1.000 mm, [1-9][0-9]* pairs" "$work/out" || fail "$(cat "$work/out")"
  done
done

# A tool of 100 mm and 20 mm diameter goes down beside the centre of the table, whose face is at Z-400: its face comes to it at
# Z-300, and within the clearance of 1 mm, and at most 0.01 mm earlier, at Z-299.
cat > "$work/down.nc" <<'END'
G21 G17 G90 G94 G40 G49 G54
G0 G53 X20 Y0
G1 G53 Z-250 F2000
G1 G53 Z-320
M30
END
if "$trunnion" collision "$machine" --program "$work/down.nc" --tool 100,20 > "$work/out"; then fail "$(cat "$work/out")"; fi
head -1 "$work/out" | grep -q "^$work/down.nc:4: 'table' and 'tool' are 1.0.. mm apart (clearance 1.000 mm) at X20.000 Y0.000 Z-29[89]" ||
  fail "$(cat "$work/out")"
grep -q "^table  *tool  *-" "$work/out" || fail "no depth in the table: $(cat "$work/out")"
if "$trunnion" collision "$machine" --program "$work/down.nc" --tool 100,20 --json > "$work/json"; then fail "$(cat "$work/json")"; fi
python3 - "$work/json" <<'END' || fail "$(cat "$work/json")"
import json, sys
with open(sys.argv[1]) as file: told = json.load(file)
contact = told["first_contact"]
assert not told["free"] and contact["line"] == 4 and contact["bodies"] == ["table", "tool"], contact
assert -299 <= contact["axes"][2] <= -298.98, contact
assert abs(contact["on_first_mm"][2] + 400) < 0.01, contact
END
# 22 mm shorter its face stays 2 mm from the table.
"$trunnion" collision "$machine" --program "$work/down.nc" --tool 78,20 > "$work/out" || fail "$(cat "$work/out")"
if "$trunnion" collision "$machine" --program "$work/down.nc" --tool 78,20 --clearance 3 > "$work/out"; then fail "$(cat "$work/out")"; fi

# The picture of docs/collision.md.
"$trunnion" collision "$3/ac-table" --tool 1 --picture "$work/bodies.svg" --pose "Z-100 A30 C45" || fail picture
python3 -c 'import sys, xml.dom.minidom; xml.dom.minidom.parse(sys.argv[1])' "$work/bodies.svg" || fail "the picture is no XML"
cmp "$work/bodies.svg" "$2/../docs/images/bodies-ac-table.svg" || fail "trunnion collision makes another picture than docs/images has"

refused() {
  local expected=$1
  shift
  if "$trunnion" "$@" > "$work/out" 2> "$work/error"; then fail "not refused: $*"; fi
  [ "$(wc -l < "$work/error")" = 1 ] || fail "$(cat "$work/error")"
  grep -qF -- "$expected" "$work/error" || fail "$*: $(cat "$work/error")"
}
refused "there is no such tool in tools.yaml" collision "$machine" --program "$work/down.nc" --tool 77
refused "expected the number of a tool, or LENGTH,DIAMETER in mm" collision "$machine" --program "$work/down.nc" --tool long
refused 'expected axis words of the machine, as in "X10 A30"' collision "$machine" --picture "$work/p.svg" --pose "B30"
refused "give --program FILE or --picture FILE" collision "$machine"
printf 'G1 X10 M13\n' > "$work/bad.nc"
refused "bad.nc:1:" collision "$machine" --program "$work/bad.nc" --tool 1
printf 'bodies: [{name: a, on: B, sphere: {diameter_mm: 1}}]\n' > "$machine/bodies.yaml"
refused "bodies.yaml:1:24: error: 'B' is none of base, workpiece, spindle, tool" collision "$machine" --program "$work/down.nc"
# Without the file: a table and a spindle nose by the chain.
rm "$machine/bodies.yaml"
if "$trunnion" collision "$machine" --program "$work/down.nc" --tool 100,20 > "$work/out"; then fail "$(cat "$work/out")"; fi
grep -q "'table' and 'tool'" "$work/out" || fail "$(cat "$work/out")"

# The probe reaches the sphere up to A-70: beyond, the spindle nose comes to the table.
cp "$3/ac-table/bodies.yaml" "$2/calibration/truth.yaml" "$machine"
sed 's/start_deg: -70/start_deg: -90/' "$2/calibration/inputs.yaml" > "$work/inputs.yaml"
"$trunnion" calibrate kinematics "$machine" --propose --inputs "$work/inputs.yaml" > "$work/proposal" || fail propose
grep -q 'A: {start_deg: -70, end_deg: 60, points: 8, other_deg: 0}' "$work/proposal" || fail "$(cat "$work/proposal")"
