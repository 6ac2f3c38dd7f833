#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# calibration.sh TRUNNION EXAMPLES MACHINES: examples/calibration, then what the commands refuse.
set -euo pipefail
export TRUNNION=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$*" >&2; exit 1; }

# Tests run in parallel: the first domain that no other cluster uses.
done=
for domain in $(seq 40 2 48); do
  if "$2/calibration/calibrate.sh" "$work/mill" "$domain" $((22000 + domain)) > "$work/log" 2>&1; then done=1; break; fi
  grep -q "domain $domain" "$work/log" || break
  rm -rf "$work/mill"
done
[ -n "$done" ] || fail "$(cat "$work/log")"

# The offset of A is that of its axis less that of C: 120 + 90 um. The inclinations of 20 and 30 urad, 36 urad together, are not
# written and go into the offsets with the distance of the sphere, 82 mm: 3 um; touches of 0.5 um come on top.
value() { awk -v number="$1" -v nth="$2" '$1 == number && $3 == "=" && $5 == "mm" && ++n == nth { print $4 }' "$work/log"; }
near() { awk -v a="$1" -v b="$2" 'BEGIN { d = a - b; exit !(d < 0.0045 && d > -0.0045) }' || fail "$3: $1, not $2: $(cat "$work/log")"; }
near "$(value 040433 1)" 0.21 "offset of A"
near "$(value 040435 1)" 0.05 "X of C"
near "$(value 040436 1)" -0.09 "Y of C"
near "$(value 040437 1)" -400.08 "Z of C"
for number in 040433 040435 040436; do [ "$(value $number 2)" = 0.0 ] || fail "$number after the undo: $(value $number 2)"; done
[ "$(value 040437 2)" = -400.0 ] || fail "040437 after the undo: $(value 040437 2)"
# RTCP before and after: the largest displacement is a twentieth at most.
awk '/^before  largest/ { b = $4 + $6 + $8 } /^after   largest/ { a = $4 + $6 + $8 } END { exit !(a > 0 && a < b / 20) }' "$work/log" ||
  fail "$(grep largest "$work/log")"
grep -q '"who":".* calibrate"' "$work/mill/state/journal.jsonl" || fail "the journal does not name the calibration"
grep -q '"who":".* calibrate undo"' "$work/mill/state/journal.jsonl" || fail "the journal does not name the undo"
[ "$(grep -c '^A.* after \|^C.* after ' "$work/mill/protocol.txt")" = 2 ] || fail "$(cat "$work/mill/protocol.txt")"
# The same touches give the same vectors.
diff <(grep '^[AC] after' "$work/mill/protocol.txt") <(grep '^[AC] after' "$work/mill/again.txt") || fail "the stored touches give others"
for number in 040433 040437; do grep -q "\"$number\"" "$work/mill/manual.yaml" || fail "$(cat "$work/mill/manual.yaml")"; done

# What it does to a part. Errors of 50 to 120 um, 82 mm to the inclined axes: some 200 um at most. After it the rest is what
# the probe's 0.5 um and the inclinations leave, and the commands' own contour error, up to 10 um at the edges of the S.
python3 - "$work/mill" << 'END' || fail "$(cat "$work/log")"
import json, sys
for program, largest, rms in (("s_piece", 10, 25), ("nas979_cone", 20, 40)):
    before, after = (json.load(open(f"{sys.argv[1]}/{when}/{program}/report.json"))["contour_error"]
                     for when in ("before", "after"))
    assert 0.1 < before["true_tip_feed"]["max_mm"] < 0.3, (program, before)
    assert max(run["commands_feed"]["max_mm"] for run in (before, after)) < 0.010, (program, before, after)
    assert after["true_tip_feed"]["max_mm"] < before["true_tip_feed"]["max_mm"] / largest, (program, before, after)
    assert after["true_tip_feed"]["rms_mm"] < before["true_tip_feed"]["rms_mm"] / rms, (program, before, after)
END

python3 -c 'import sys, xml.dom.minidom; xml.dom.minidom.parse(sys.argv[1])' "$work/mill/residuals.svg" || fail "residuals.svg is no XML"

refused() {
  local expected=$1
  shift
  if "$TRUNNION" calibrate "$@" > "$work/out" 2> "$work/error"; then fail "not refused: $*"; fi
  [ "$(wc -l < "$work/error")" = 1 ] || fail "$(cat "$work/error")"
  grep -qF -- "$expected" "$work/error" || fail "$*: $(cat "$work/error")"
}
refused "give one of --virtual" kinematics "$work/mill" --virtual --on-machine
refused "--resume continues a measurement --on-machine" kinematics "$work/mill" --virtual --resume
inputs=$2/calibration/inputs.yaml
refused "give one of --virtual, --on-machine, --variables and --touches FILE" kinematics "$work/mill"
refused "give --mode correct" kinematics "$work/mill" --virtual --output "$work/o.yaml"
refused "give the stored touches with --touches" kinematics "$work/mill" --virtual --mode only_correct
refused "the tolerance is 0.5000 mm" kinematics "$work/mill" --virtual --inputs "$inputs" --set 040437=-400.6 --output "$work/o.yaml"
[ ! -e "$work/o.yaml" ] || fail "written in spite of the tolerance"
refused "the confidence range is 1.0000 mm; reset" kinematics "$work/mill" --virtual --inputs "$inputs" --true-sphere 61.2,40,-360
refused "pose A0 C0, touch 1: no contact within the measuring path of 2 mm" kinematics "$work/mill" --virtual --inputs "$inputs" \
  --true-sphere 52,40,-360
printf 'X1 Y2\n' > "$work/touches"
refused "touches:1:1: error: axis Z is missing" kinematics "$work/mill" --touches "$work/touches" --inputs "$inputs"
refused "use \`trunnion calibrate kinematics\`" manual "$3/nutating-b-head-c-table" --virtual
"$TRUNNION" calibrate kinematics "$work/mill" --virtual --inputs "$inputs" --set 040437=-400.6 --output "$work/o.yaml" --acknowledge > "$work/out"
grep -q 040437 "$work/o.yaml" || fail "$(cat "$work/out")"
"$TRUNNION" calibrate kinematics "$work/mill" --virtual --inputs "$inputs" --json > "$work/json"
grep -q '"type": *"P"' "$work/json" || fail "$(cat "$work/json")"

# Parameters of a run: read before anything starts, all or none, and none that need a restart of the cluster.
run_refused() {
  printf '%s\n' "$2" > "$work/values.yaml"
  if "$TRUNNION" run "$work/mill" s_piece.nc --report "$work/run" --parameters "$work/values.yaml" > "$work/out" 2> "$work/error"; then
    fail "not refused: $2"
  fi
  [ "$(grep -cF -- "$1" "$work/error")" = 1 ] || fail "$2: $(cat "$work/error")"
}
run_refused "values.yaml:1:1: error: parameter 000051 does not exist" '"000051": 1'
run_refused "parameter 000900 is not active after a reset" '"000900": 64'

# By hand on the other kinds of machine, whose rotary axes are not where their parameters have them.
for case in "cb-head XOB=60 YOC=-40" "ac-head XOC=50 YOA=-30" "b-head-c-table XOC=40 YOC=-60"; do
  read -r name first second <<< "$case"
  "$TRUNNION" calibrate manual "$3/$name" --virtual --set "$first" --set "$second" --json > "$work/manual.json" || fail "$case: $(cat "$work/manual.json")"
  python3 - "$work/manual.json" <<'END' || fail "$case: $(cat "$work/manual.json")"
import json, sys
told = json.load(open(sys.argv[1]))
assert told["before"] != told["after"] and told["checks"][-1]["accepted"], told
# Exact dials leave nothing of offsets of some 10 um: the acceptance is 20 um.
assert all(line["value_mm"] < 0.001 for line in told["checks"][-1]["acceptance"]), told["checks"][-1]
END
done

# Written into a cluster, taken back, and once more by the readings that were printed.
trunnion=$TRUNNION
. "$(dirname "$0")/cluster.sh"
cp -r "$3/ac-table" "$work/hand"
cp "$2/calibration/truth.yaml" "$work/hand"
start_cluster "$work/hand"
hand() { "$trunnion" calibrate manual "$work/hand" --domain "$domain" --write "$@"; }
offsets() {
  reset_and_settle 040433 040435 040436 040437
  "$trunnion" param get 040433 040435 040436 040437 --domain "$domain"
}
offsets > "$work/delivered"
hand --virtual --place 60,40,-360 > "$work/by_hand" || fail "$(cat "$work/by_hand")"
offsets > "$work/by_virtual"
! cmp -s "$work/delivered" "$work/by_virtual" || fail "nothing was written"
grep -q '"who":".* calibrate"' "$work/state/journal.jsonl" || fail "the journal does not name the manual calibration"
"$trunnion" calibrate undo --domain "$domain" > "$work/undo" || fail "$(cat "$work/undo")"
offsets | cmp - "$work/delivered" || fail "after the undo: $(offsets)"
sed -n 's/^reading \([^ ]*\) *\(.*\)/\1: \2/p' "$work/by_hand" > "$work/readings.yaml"
hand --readings "$work/readings.yaml" > "$work/log" || fail "$(cat "$work/log")"
offsets > "$work/by_readings"
# The readings are printed to 0.1 um; the corrections of the RTCP check come on top of the formulas in the first run only.
paste "$work/by_readings" "$work/by_virtual" | awk '{ d = $4 - $(NF / 2 + 4); if (d > 0.02 || d < -0.02) exit 1 }' ||
  fail "by the printed readings: $(cat "$work/by_readings" "$work/by_virtual")"
# Nine displacements within the limits change nothing, one of 50 um is corrected.
for _ in $(seq 9); do echo '0.001 -0.001 0.002'; done > "$work/displacements"
hand --displacements "$work/displacements" > "$work/log" || fail "$(cat "$work/log")"
grep -q 'accepted; no correction' "$work/log" || fail "$(cat "$work/log")"
offsets | cmp - "$work/by_readings" || fail "an accepted check has changed the vectors"
sed '3s/.*/0.05 0 0/' "$work/displacements" > "$work/displaced"
hand --displacements "$work/displaced" > "$work/log" || fail "$(cat "$work/log")"
grep -q 'EXCEEDED' "$work/log" || fail "$(cat "$work/log")"
! offsets | cmp -s - "$work/by_readings" || fail "a check beyond its limits has corrected nothing"
